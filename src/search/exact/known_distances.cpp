/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "search/exact/known_distances.h"

#include <pcl/registration/kss/detail/stopping.h>

#include "candidates/numbers.h"
#include "candidates/rotation_cells.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl {
namespace kss {
namespace {

/** Points of each cloud at the first level. */
constexpr Eigen::Index first_probes = 128;

using search_numbers::at_once;

/** For each rotation, the first that is the same: the Euler grid holds most twice.
 * Bounds have more room for rounding errors than the two differ by. */
std::vector<std::size_t>
firstOfEach(const CandidateRotations::Rotations& rotations)
{
  constexpr double same = 1e-9;
  RotationCells cells(same, rotations.size());
  std::vector<std::size_t> first(rotations.size());
  for (std::size_t i = 0; i < rotations.size(); ++i) {
    throwIfStopped();
    first[i] = i;
    cells.anyNear(rotations[i], same, 0, [&](std::size_t j) {
      if (j < first[i] &&
          std::min((rotations[i].coeffs() - rotations[j].coeffs()).norm(),
                   (rotations[i].coeffs() + rotations[j].coeffs()).norm()) < same)
        first[i] = j;
      return false;
    });
    cells.add(rotations[i]);
  }
  return first;
}

template <typename Work>
void
inBatches(const std::vector<std::size_t>& candidates, const Work& work)
{
  for (std::size_t begin = 0; begin < candidates.size(); begin += at_once) {
    throwIfStopped();
    const std::size_t end = std::min(begin + at_once, candidates.size());
    work({candidates.begin() + begin, candidates.begin() + end});
  }
}

void
narrow(DistanceBounds& known, const DistanceBounds& bounds)
{
  for (const auto d :
       {&DirectedDistances::source_to_target, &DirectedDistances::mean_source_to_target,
        &DirectedDistances::target_to_source,
        &DirectedDistances::mean_target_to_source}) {
    known.lower.*d = std::max(known.lower.*d, bounds.lower.*d);
    known.upper.*d = std::min(known.upper.*d, bounds.upper.*d);
  }
}

} // namespace

KnownDistances::KnownDistances(const Candidates& candidates,
                               Eigen::Index points,
                               BoundsEvaluator& bounds,
                               DistanceEvaluator& distances)
: candidates_(candidates)
, bounds_(bounds)
, distances_(distances)
, row_size_(candidates.scales().size() * candidates.centers().centers.size())
, first_(firstOfEach(candidates.rotations().rotations()))
, next_(first_.size(), first_.size())
, level_(candidates.size(), 0)
{
  std::vector<std::size_t> last = first_;
  for (std::size_t i = 0; i < first_.size(); ++i)
    if (first_[i] != i) {
      next_[last[first_[i]]] = i;
      last[first_[i]] = i;
    }
  const float most = std::numeric_limits<float>::max();
  known_.assign(candidates.size(), {{0, 0, 0, 0}, {most, most, most, most}});
  // the last step is no shorter than the others
  for (Eigen::Index probes = first_probes; 1.4 * probes < points; probes *= 2)
    effort_.levels.push_back({probes, 0});
  effort_.levels.push_back({points, 0});
}

std::vector<std::size_t>
KnownDistances::raise(const std::vector<std::size_t>& candidates, int level)
{
  return level == exact() ? compute(candidates) : bound(candidates, level);
}

std::vector<std::size_t>
KnownDistances::bound(const std::vector<std::size_t>& candidates, int level)
{
  // one candidate stands for all of the same pose
  std::vector<std::size_t> chosen;
  for (const std::size_t i : candidates)
    chosen.push_back(first_[i / row_size_] * row_size_ + i % row_size_);
  std::sort(chosen.begin(), chosen.end());
  chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());

  SearchEffort::Level& effort = effort_.levels[level - 1];
  effort.candidates += chosen.size();
  std::vector<std::size_t> changed;
  inBatches(chosen, [&](const std::vector<std::size_t>& these) {
    const auto bounds = bounds_.evaluate(candidates_.placements(these), effort.probes);
    for (std::size_t i = 0; i < these.size(); ++i)
      for (std::size_t rotation = these[i] / row_size_; rotation < next_.size();
           rotation = next_[rotation]) {
        const std::size_t candidate = rotation * row_size_ + these[i] % row_size_;
        if (level_[candidate] < level) {
          level_[candidate] = static_cast<std::uint8_t>(level);
          narrow(known_[candidate], bounds[i]);
          changed.push_back(candidate);
        }
      }
  });
  return changed;
}

std::vector<std::size_t>
KnownDistances::compute(const std::vector<std::size_t>& candidates)
{
  effort_.exact += candidates.size();
  inBatches(candidates, [&](const std::vector<std::size_t>& these) {
    const auto distances = distances_.evaluate(candidates_.placements(these));
    for (std::size_t i = 0; i < these.size(); ++i) {
      level_[these[i]] = static_cast<std::uint8_t>(exact());
      known_[these[i]] = {distances[i], distances[i]};
    }
  });
  return candidates;
}

} // namespace kss
} // namespace pcl
