/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "search/screening.h"

#include "evaluators/evaluator_choice.h"
#include "evaluators/shift_sums.h"
#include "geometry/clouds.h"

#include <algorithm>
#include <optional>

namespace pcl {
namespace kss {
namespace {

/** Placements that a device has enough to do with: no more scales are screened at once,
 * whose sums have to be kept. */
constexpr std::size_t enough = 16384;

/** The lowest energies' limit: no more than so many candidates lie below it, unless the
 * very lowest are more.
 * \param[in] histogram how many candidates have each energy */
std::uint16_t
limitOfLowest(const std::vector<std::size_t>& histogram, std::size_t many)
{
  std::uint16_t limit = 0;
  while (histogram[limit] == 0)
    ++limit;
  for (std::size_t below = histogram[limit++];
       limit < 0xffff && below + histogram[limit] <= many;)
    below += histogram[limit++];
  return limit;
}

} // namespace

/** The field is kept as long as neither the cloud nor the centres change. */
struct Screening::ScreenedCloud {
  explicit ScreenedCloud(const Settings& settings)
  : sums(makeShiftSums(settings))
  {
  }

  void
  setPoints(const Points& cloud)
  {
    if (!areEqual(cloud, points))
      lattice.reset();
    points = cloud;
  }

  void
  setCenters(const CandidateCenters& centers, float limit)
  {
    const ShiftLattice wanted(points, centers, limit);
    if (lattice && *lattice == wanted)
      return;
    lattice.reset(); // in case that it fails
    sums->setField(points, wanted);
    lattice = wanted;
  }

  std::unique_ptr<ShiftSums> sums;
  Points points;
  std::optional<ShiftLattice> lattice;
};

Screening::Screening(const Settings& settings)
: source_(std::make_unique<ScreenedCloud>(settings))
, target_(std::make_unique<ScreenedCloud>(settings))
, probes_(std::min<Eigen::Index>(settings.search_points, ShiftSums::most_points))
{
}

Screening::~Screening() = default;

void
Screening::setClouds(const Points& source, const Points& target, float limit)
{
  source_->setPoints(source);
  target_->setPoints(target);
  limit_ = limit;
}

std::vector<std::size_t>
Screening::lowest(const Candidates& candidates, std::size_t many)
{
  const bool on_target = candidates.centered() == Role::TARGET;
  ScreenedCloud& fixed = on_target ? *target_ : *source_;
  fixed.setCenters(candidates.centers(), limit_);
  const ShiftLattice& lattice = *fixed.lattice;
  const Points& turned = on_target ? source_->points : target_->points;
  const Points probes = turned.leftCols(std::min(probes_, turned.cols()));

  const auto& rotations = candidates.rotations().rotations();
  const auto& places = lattice.places();
  const std::size_t centers = places.size(), scales = candidates.scales().size();
  const std::size_t block = ShiftLattice::lanes * lattice.rows().size();
  const auto placementsAt = [&](double scale, std::vector<Placement>& placements) {
    for (const Eigen::Quaterniond& rotation : rotations) {
      const Eigen::Matrix3d linear =
          on_target ? Eigen::Matrix3d(scale * rotation.toRotationMatrix())
                    : Eigen::Matrix3d(rotation.conjugate().toRotationMatrix() / scale);
      placements.push_back(lattice.toNodes(linear.cast<float>()));
    }
  };
  std::vector<std::size_t> found;
  const auto takeLowest = [&](const std::uint16_t* sums, std::size_t scale) {
    std::vector<std::size_t> histogram(1 << 16);
    for (std::size_t r = 0; r < rotations.size(); ++r)
      for (const std::uint32_t place : places)
        ++histogram[sums[r * block + place]];
    const std::uint16_t cut = limitOfLowest(histogram, many / scales);
    for (std::size_t r = 0; r < rotations.size(); ++r)
      for (std::size_t c = 0; c < centers; ++c)
        if (sums[r * block + places[c]] < cut)
          found.push_back((r * scales + scale) * centers + c);
  };

  const std::size_t at_once = std::max<std::size_t>(1, enough / rotations.size());
  for (std::size_t begin = 0; begin < scales; begin += at_once) {
    const std::size_t end = std::min(scales, begin + at_once);
    std::vector<Placement> placements;
    for (std::size_t scale = begin; scale < end; ++scale)
      placementsAt(candidates.scales()[scale], placements);
    const std::vector<std::uint16_t> sums = fixed.sums->sums(probes, placements);
    for (std::size_t scale = begin; scale < end; ++scale)
      takeLowest(&sums[(scale - begin) * rotations.size() * block], scale);
  }
  std::sort(found.begin(), found.end());
  return found;
}

} // namespace kss
} // namespace pcl
