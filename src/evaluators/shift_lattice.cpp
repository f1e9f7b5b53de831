/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "evaluators/shift_lattice.h"

#include <pcl/registration/kss/detail/grid_index.h>
#include <pcl/registration/kss/detail/stopping.h>

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

  fold_ = foldFor(counts);
  if (fold_ * (every_ * size_).cast<double>().prod() > most_nodes)
    fold_ = 1;
  placeNodes();
  const int in_line = roundedUp(counts[2], lanes) / lanes; // rows along z
  for (int x = 0; x < counts[0]; ++x)
    for (int y = 0; y < counts[1]; ++y) {
      const std::size_t first = y % fold_ == 0 ? rows_.size() : rows_.size() - in_line;
      for (int z = 0; z < counts[2]; ++z) {
        if (y % fold_ == 0 && z % lanes == 0)
          rows_.push_back(fold_ * ((x * size_[1] + y) * size_[2] + z));
        places_.push_back((first + z / lanes) * lanes + z % lanes * fold_ + y % fold_);
      }
    }
  rows_.resize(roundedUp<std::size_t>(rows_.size(), rows_at_once), rows_.back());
}

int
ShiftLattice::foldFor(const Eigen::Array3i& counts)
{
  const auto rowsFor = [&](int fold) {
    return roundedUp(counts[0] * (roundedUp(counts[1], fold) / fold), rows_at_once);
  };
  // no more memory than saves rows
  int best = 1;
  for (int fold = 2; fold <= counts[1] && fold * counts[2] <= lanes; ++fold)
    if (rowsFor(fold) < rowsFor(best))
      best = fold;
  return best;
}

void
ShiftLattice::placeNodes()
{
  // the arrays of nodes that lie a centre apart, one after the other
  const std::uint32_t array = fold_ * size_.prod();
  const std::uint32_t arrays[] = {array * every_[1] * every_[2], array * every_[2],
                                  array};
  const std::uint32_t strides[] = {
      static_cast<std::uint32_t>(fold_ * size_[1] * size_[2]),
      static_cast<std::uint32_t>(fold_ * size_[2]), static_cast<std::uint32_t>(fold_)};
  for (int axis = 0; axis < 3; ++axis)
    for (int i = 0; i < all_[axis]; ++i)
      nodes_[axis].push_back(i % every_[axis] * arrays[axis] +
                             i / every_[axis] * strides[axis]);
}

std::vector<std::uint8_t>
ShiftLattice::field(const Points& cloud) const
{
  constexpr float most = 255.0f;
  // the last row may reach beyond the end
  std::vector<std::uint8_t> field(fold_ * numberOfCells(every_) * numberOfCells(size_) +
                                      lanes,
                                  static_cast<std::uint8_t>(most));
  const Points points = turned(cloud);
  const float steps = most / limit_, squared_limit = limit_ * limit_;
  const Eigen::Array3i end = inner_ - 1, before = width_ + 1;
  // from beside a node to beside the one a centre before it along y: there are as many
  // before the inner ones as there are centres
  const std::ptrdiff_t to_folded = 1 - static_cast<std::ptrdiff_t>(fold_) * size_[2];
  // nodes learn of the points that are nearer than the limit, few of all
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    if (i % 256 == 0)
      throwIfStopped();
    const Eigen::Array3f point = points.col(i).array() - lower_;
    const auto first =
                   toIndices(Eigen::Array3f(((point - limit_) / step_).ceil()), end),
               last = toIndices(Eigen::Array3f((point + limit_) / step_), end);
    for (int x = first[0]; x <= last[0]; ++x)
      for (int y = first[1]; y <= last[1]; ++y) {
        const float dx = x * step_[0] - point[0], dy = y * step_[1] - point[1];
        const float off_line = dx * dx + dy * dy;
        if (off_line >= squared_limit)
          continue;
        std::uint8_t* const row =
            &field[nodes_[0][before[0] + x] + nodes_[1][before[1] + y]];
        for (int z = first[2]; z <= last[2]; ++z) {
          const float dz = z * step_[2] - point[2];
          const float squared = off_line + dz * dz;
          if (squared >= squared_limit)
            continue;
          const auto byte =
              static_cast<std::uint8_t>(steps * std::sqrt(squared) + 0.5f);
          std::uint8_t* const node = row + nodes_[2][before[2] + z];
          for (int folded = 0; folded < fold_; ++folded) {
            std::uint8_t& copy = node[folded * to_folded];
            copy = std::min(copy, byte);
          }
        }
      }
  }
  return field;
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
