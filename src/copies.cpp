/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include <pcl/registration/kss/detail/copies.h>

#include <pcl/registration/kss/detail/similarity.h>

#include "geometry/turns.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace pcl {
namespace kss {
namespace {

/** Three points fit others by chance. */
constexpr Eigen::Index fewest = 4;

/** How far the points of a copy are off, in root mean square radii: what single
 * precision leaves of coordinates a thousand radii away from the origin. */
constexpr double tolerance = 1e-4;

/** Rotations that differ by less, in radians, are one. */
constexpr double same_rotation = 0.01;

/** Points about their mean, by their root mean square distance from it. */
struct Constellation {
  explicit Constellation(const LocalCloud& cloud)
  : points(cloud.points.cast<double>())
  {
    const Eigen::Vector3d mean = points.rowwise().mean();
    points.colwise() -= mean;
    radius = std::sqrt(points.squaredNorm() / static_cast<double>(points.cols()));
    points /= radius;
    middle = cloud.origin + mean;
  }

  Eigen::Matrix3Xd points;
  Eigen::Vector3d middle;
  double radius;
};

bool
areAlike(double a, double b)
{
  return std::abs(a - b) <= 2.0 * tolerance;
}

/** A frame along two directions. */
Eigen::Matrix3d
frameOf(const Eigen::Vector3d& a, const Eigen::Vector3d& b)
{
  Eigen::Matrix3d frame;
  frame.col(0) = a.normalized();
  frame.col(2) = a.cross(b).normalized();
  frame.col(1) = frame.col(2).cross(frame.col(0));
  return frame;
}

/** The rotation that lays all points on points, near another one that does so about.
 * \return whether there is one */
bool
fit(const Eigen::Matrix3Xd& source,
    const Eigen::Matrix3Xd& target,
    RotationAxis axis,
    Eigen::Matrix3d& rotation)
{
  const Eigen::Matrix3Xd placed = rotation * source;
  std::vector<bool> is_taken(target.cols(), false);
  Eigen::Matrix3d products = Eigen::Matrix3d::Zero();
  for (Eigen::Index i = 0; i < placed.cols(); ++i) {
    Eigen::Index nearest;
    // a frame of two points is off by a few times as much as they are
    if ((target.colwise() - placed.col(i)).colwise().squaredNorm().minCoeff(&nearest) >
            100.0 * tolerance * tolerance ||
        is_taken[nearest])
      return false;
    is_taken[nearest] = true;
    products += target.col(nearest) * source.col(i).transpose();
  }
  rotation = nearestRotation(products, axis);
  const Eigen::Matrix3Xd settled = rotation * source;
  for (Eigen::Index i = 0; i < settled.cols(); ++i)
    if ((target.colwise() - settled.col(i)).colwise().squaredNorm().minCoeff() >
        tolerance * tolerance)
      return false;
  return true;
}

/** All rotations that lay a constellation on another one. */
std::vector<Eigen::Matrix3d>
rotationsBetween(const Eigen::Matrix3Xd& source,
                 const Eigen::Matrix3Xd& target,
                 RotationAxis axis)
{
  // the two points of the source that tell rotations best
  Eigen::Index a, b;
  source.colwise().squaredNorm().maxCoeff(&a);
  std::vector<double> areas;
  for (Eigen::Index i = 0; i < source.cols(); ++i)
    areas.push_back(source.col(a).cross(source.col(i)).norm());
  b = std::max_element(areas.begin(), areas.end()) - areas.begin();
  std::vector<Eigen::Matrix3d> rotations;
  if (areas[b] < 0.01) // on a line
    return rotations;
  const Eigen::Matrix3d from = frameOf(source.col(a), source.col(b)).transpose();
  const double length_a = source.col(a).norm(), length_b = source.col(b).norm();
  const double apart = (source.col(a) - source.col(b)).norm();
  for (Eigen::Index i = 0; i < target.cols(); ++i) {
    if (!areAlike(target.col(i).norm(), length_a))
      continue;
    for (Eigen::Index j = 0; j < target.cols(); ++j) {
      if (!areAlike(target.col(j).norm(), length_b) ||
          !areAlike((target.col(i) - target.col(j)).norm(), apart))
        continue;
      Eigen::Matrix3d rotation = frameOf(target.col(i), target.col(j)) * from;
      if (fit(source, target, axis, rotation) &&
          std::none_of(rotations.begin(), rotations.end(), [&](const auto& other) {
            return (rotation - other).norm() < same_rotation;
          }))
        rotations.push_back(rotation);
    }
  }
  return rotations;
}

/** A pose that explains all of so many points. */
Alternative
explaining(const StoredPose& pose, Eigen::Index points)
{
  Alternative alternative;
  alternative.transformation = pose;
  alternative.overlap = {1.0, 1.0, 2.0};
  const Support all{1.0, 1.0, 1.0, 1.0, static_cast<double>(points)};
  alternative.evidence.source = alternative.evidence.target = all;
  return alternative;
}

} // namespace

Alternatives
copiesOf(const LocalCloud& source,
         const LocalCloud& target,
         const Settings& settings,
         const std::optional<StoredPose>& guess)
{
  const Eigen::Index size = source.points.cols();
  if (size != target.points.cols() || size < fewest ||
      static_cast<std::size_t>(size) > most_points_of_copies)
    return {};
  const Constellation from(source), to(target);
  if (!(from.radius > 0.0 && to.radius > 0.0))
    return {};
  double scale = to.radius / from.radius;
  const double given = guess ? scaleOf(*guess) : 1.0;
  if (!settings.estimate_scale) {
    if (!areAlike(scale / given, 1.0))
      return {};
    scale = given;
  }
  else if (scale < settings.smallest_scale * (1.0 - tolerance) ||
           scale > settings.largest_scale * (1.0 + tolerance))
    return {};
  Alternatives copies;
  for (const Eigen::Matrix3d& rotation :
       rotationsBetween(from.points, to.points, settings.rotation_axis)) {
    StoredPose pose = StoredPose::Identity();
    pose.topLeftCorner<3, 3>() = scale * rotation;
    pose.topRightCorner<3, 1>() = to.middle - scale * (rotation * from.middle);
    copies.push_back(explaining(pose, size));
  }
  // of a symmetric one, all are as good
  const StoredPose near = guess.value_or(StoredPose::Identity());
  std::stable_sort(copies.begin(), copies.end(), [&](const auto& a, const auto& b) {
    const auto distance = [&](const Alternative& pose) {
      return (pose.transformation - near).topLeftCorner<3, 3>().norm();
    };
    return distance(a) < distance(b);
  });
  return copies;
}

} // namespace kss
} // namespace pcl
