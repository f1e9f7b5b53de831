/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "evaluators/shift_lattice.h"

#include <pcl/registration/kss/detail/grid_index.h>

#include "geometry/clouds.h"
#include "support/rounded_up.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace pcl {
namespace kss {
namespace {

/** The widest distance of nodes: a field read at the nearest one is off by 0.3 of what
 * a distance counts at most. */
constexpr double widest_step = 0.35;

/** Nodes along a cloud that is much larger than the other, where that takes fewer. */
constexpr float most_steps = 100.0f;

/** Nodes from centre to centre that are not too many already. */
constexpr int most_every = 1000;

} // namespace

ShiftLattice::ShiftLattice(const Points& cloud,
                           const CandidateCenters& centers,
                           float limit)
: axes_(centers.axes.cast<float>())
, limit_(limit)
{
  const Points points = turned(cloud);
  const Eigen::AlignedBox3f box = boxOf(points);
  const Eigen::Array3f extent = box.sizes();
  const Eigen::Array3i counts(centers.steps[0], centers.steps[1], centers.steps[2]);
  const auto most = Eigen::Array3i::Constant(most_nodes);
  double widest = std::max<double>(widest_step * limit, extent.maxCoeff() / most_steps);
  for (;; widest *= 1.1) {
    for (int axis = 0; axis < 3; ++axis) {
      // one centre has no others that nodes had to fall on
      const double spacing = centers.steps[axis] > 1 ? centers.spacing[axis] : widest;
      every_[axis] = std::max(1, toIndex(std::ceil(spacing / widest), most_every));
      step_[axis] = static_cast<float>(spacing / every_[axis]);
    }
    width_ = every_ * (counts - 1);
    inner_ = toIndices(Eigen::Array3f(((extent + 2.0f * limit) / step_).ceil()), most);
    inner_[2] = roundedUp<int>(inner_[2], vector);
    // all centres fit beside the inner nodes: what falls there lies beyond the limit
    all_ = inner_ + 2 * (width_ + 1);
    size_ = (all_ + every_ - 1) / every_;
    if ((every_ * size_).cast<double>().prod() <= most_nodes)
      break;
    // nodes that are as far apart as the centres
    if (every_.maxCoeff() == 1 && widest > extent.maxCoeff())
      throw std::invalid_argument("The clouds are too different in size to be searched "
                                  "for each other.");
  }
  lower_ = box.min().array() - limit + 0.5f * step_;

  for (int x = 0; x < counts[0]; ++x)
    for (int y = 0; y < counts[1]; ++y)
      for (int z = 0; z < counts[2]; ++z) {
        if (z % lanes == 0)
          rows_.push_back((x * size_[1] + y) * size_[2] + z);
        places_.push_back((rows_.size() - 1) * lanes + z % lanes);
      }
  rows_.resize(roundedUp<std::size_t>(rows_.size(), rows_at_once), rows_.back());
}

std::vector<std::uint8_t>
ShiftLattice::bytes(const std::vector<float>& distances) const
{
  constexpr float most = 255.0f;
  // the last row may reach beyond the end
  const std::size_t array_size = numberOfCells(size_);
  std::vector<std::uint8_t> bytes(numberOfCells(every_) * array_size + lanes,
                                  static_cast<std::uint8_t>(most));
  const Eigen::Array3i shift = width_ + 1;
  std::size_t node = 0;
  for (int x = 0; x < inner_[0]; ++x)
    for (int y = 0; y < inner_[1]; ++y)
      for (int z = 0; z < inner_[2]; ++z, ++node) {
        const Eigen::Array3i at = shift + Eigen::Array3i(x, y, z);
        const Eigen::Array3i part = at / every_;
        const Eigen::Array3i rest = at - part * every_;
        const std::size_t array = (rest[0] * every_[1] + rest[1]) * every_[2] + rest[2];
        bytes[array * array_size + (part[0] * size_[1] + part[1]) * size_[2] +
              part[2]] =
            static_cast<std::uint8_t>(
                std::lround(most / limit_ * std::min(distances[node], limit_)));
      }
  return bytes;
}

Placement
ShiftLattice::toNodes(const Eigen::Matrix3f& linear) const
{
  Placement placement;
  placement.leftCols<3>() =
      (1.0f / step_).matrix().asDiagonal() * axes_.transpose() * linear;
  // node 0 lies width + 1 before the inner ones, and its cell half a step before it;
  // the first centre half a width before the origin
  placement.col(3) = 0.5f - lower_ / step_ + (width_ + 1 - width_ / 2).cast<float>();
  return placement;
}

} // namespace kss
} // namespace pcl
