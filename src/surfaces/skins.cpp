/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "surfaces/skins.h"

#include "geometry/take.h"
#include "surfaces/pose_rows.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <vector>

namespace pcl {
namespace kss {
namespace {

/** Points of the source that tell. */
constexpr Eigen::Index most_tellers = 1000;

/** Where surfaces explain this share of what is near them, there is nothing to look
 * for: two samplings of one surface come to more. */
constexpr double well_explained = 0.9;

/** As many times as many explained points are no chance. */
constexpr double many_more = 1.25;

/** Counts the points of the source that the target explains. */
class Tellers {
public:
  Tellers(const OrientedPoints& source, const OrientedPoints& target)
  : source_(source)
  , target_(target)
  , size_(source.points->points().cols())
  , count_(std::min(most_tellers, size_))
  {
  }

  struct Counts {
    Eigen::Index near = 0, explained = 0;
  };

  Counts
  at(const Similarity& pose) const
  {
    const PlacedSurface placed(source_, pose);
    const float noise = std::max(static_cast<float>(pose.scale) * source_.planes.noise,
                                 target_.planes.noise);
    Counts counts;
    for (Eigen::Index n = 0; n < count_; ++n) {
      const Explanation found =
          explanationOf(target_, placed, evenlySpaced(n, count_, size_), noise);
      counts.near += found.is_near;
      counts.explained += found.is_explained;
    }
    return counts;
  }

  /** The principal directions of what the points say, a column each, as long as move
   * the points by one unit off their planes, root mean square.
   * \param[in] free a basis of the moves that there are */
  Eigen::MatrixXf
  directionsAt(const Similarity& pose, const Eigen::MatrixXf& free) const
  {
    const PlacedSurface placed(source_, pose);
    const Eigen::Index directions = free.rows();
    Eigen::MatrixXf information = Eigen::MatrixXf::Zero(directions, directions);
    for (Eigen::Index n = 0; n < count_; ++n) {
      const Eigen::Index i = evenlySpaced(n, count_, size_);
      const PoseRow row = placed.row(placed.point(i), placed.normal(i));
      information += row.head(directions) * row.head(directions).transpose();
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXf> solver(
        free.transpose() * (information / static_cast<float>(count_)) * free);
    Eigen::MatrixXf found(directions, 0);
    for (Eigen::Index i = 0; i < free.cols(); ++i)
      if (solver.eigenvalues()[i] > determined) {
        found.conservativeResize(Eigen::NoChange, found.cols() + 1);
        found.rightCols(1) =
            free * solver.eigenvectors().col(i) / std::sqrt(solver.eigenvalues()[i]);
      }
    return found;
  }

private:
  /** Directions that say less move the cloud by far more than its points off planes. */
  static constexpr float determined = 0.01f;

  const OrientedPoints& source_;
  const OrientedPoints& target_;
  Eigen::Index size_, count_;
};

/** A pose, moved by small shifts, turns and a change of scale about a centre; see
 * PoseRow. */
Similarity
moved(const Similarity& pose, const PlacedSurface& placed, const Eigen::VectorXf& by)
{
  const Eigen::Vector3d center = placed.center().cast<double>();
  const Eigen::Vector3d turn = by.segment<3>(3).cast<double>() / placed.radius();
  Similarity move;
  if (turn.norm() > 0.0)
    move.rotation =
        Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
  if (by.size() > 6)
    move.scale = std::exp(by[6] / placed.radius());
  move.translation = center - move.linear() * center + by.head<3>().cast<double>();
  return move * pose;
}

/** A basis of these moves. */
Eigen::MatrixXf
freeMoves(const Turns& turns, bool with_scale)
{
  const Eigen::Index scales = with_scale ? 1 : 0;
  Eigen::MatrixXf free = Eigen::MatrixXf::Zero(6 + scales, 3 + turns.cols() + scales);
  free.topLeftCorner<3, 3>().setIdentity();
  free.block(3, 3, 3, turns.cols()) = turns.cast<float>();
  free.bottomRightCorner(scales, scales).setIdentity();
  return free;
}

} // namespace

std::optional<Similarity>
skinBeside(const OrientedPoints& source,
           const OrientedPoints& target,
           const Similarity& T_target_source,
           const ScaleRange& scales,
           const Turns& turns)
{
  const Tellers tellers(source, target);
  const Tellers::Counts here = tellers.at(T_target_source);
  if (here.explained >= well_explained * here.near)
    return {};
  const auto scale = static_cast<float>(T_target_source.scale);
  const float spacing =
      std::max(scale * source.points->usualSpacing(), target.points->usualSpacing());
  const float reach = near_spacings * spacing;
  const float step =
      within_noise * std::max({scale * source.planes.noise, target.planes.noise,
                               least_noise * spacing});
  // but for what rounding adds to a scale at a bound
  const double smallest = std::min(scales.smallest, T_target_source.scale);
  const double largest = std::max(scales.largest, T_target_source.scale);
  const PlacedSurface placed(source, T_target_source);
  const Eigen::MatrixXf directions = tellers.directionsAt(
      T_target_source, freeMoves(turns, scales.smallest < scales.largest));
  Similarity best = T_target_source;
  Eigen::Index most = here.explained;
  for (Eigen::Index d = 0; d < directions.cols(); ++d)
    for (float by = step; by < reach; by += step)
      for (const float side : {-by, by}) {
        const Similarity pose =
            moved(T_target_source, placed, side * directions.col(d));
        if (pose.scale < smallest || pose.scale > largest)
          continue;
        const Eigen::Index explained = tellers.at(pose).explained;
        if (explained > most) {
          most = explained;
          best = pose;
        }
      }
  if (most < many_more * here.explained)
    return {};
  return best;
}

} // namespace kss
} // namespace pcl
