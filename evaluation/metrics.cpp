/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "metrics.h"

#include <pcl/common/transforms.h>
#include <pcl/kdtree/kdtree_flann.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace evaluation {
namespace {

using Tree = pcl::KdTreeFLANN<pcl::PointXYZ>;

/** Of larger clouds every so-manieth point is measured. */
constexpr std::size_t most_points = 20000;

struct Nearest {
  int index;
  double distance;
};

Nearest
nearestOf(const Tree& tree, const Eigen::Vector3d& position)
{
  pcl::Indices index(1);
  std::vector<float> squared(1, std::numeric_limits<float>::infinity());
  const Eigen::Vector3f p = position.cast<float>();
  tree.nearestKSearch({p.x(), p.y(), p.z()}, 1, index, squared);
  return {index[0], std::sqrt(squared[0])};
}

class Sums {
public:
  void
  add(double value)
  {
    squares_ += value * value;
    values_ += value;
    ++number_;
  }

  Errors
  errors() const
  {
    const double number = std::max(number_, 1.0);
    return {squares_ / number, std::sqrt(squares_ / number), values_ / number};
  }

private:
  double squares_ = 0.0, values_ = 0.0, number_ = 0.0;
};

Eigen::Vector3d
placed(const Eigen::Matrix4d& pose, const pcl::PointXYZ& point)
{
  return (pose * point.getVector3fMap().cast<double>().homogeneous()).head<3>();
}

/** Whether a model that is moved from where it should be lies on itself, as closely as
 * another sampling of it does: then no cloud can tell the two poses apart.
 */
bool
lieOnEachOther(const Case& work, const Eigen::Matrix4d& displacement)
{
  constexpr double factor = 1.5, tolerance = 0.002; // of the diagonal
  Tree tree;
  tree.setInputCloud(work.whole_again);
  double apart = 0.0, unmoved = 0.0;
  for (const auto& point : *work.whole) {
    apart += nearestOf(tree, placed(displacement, point)).distance;
    unmoved += nearestOf(tree, point.getVector3fMap().cast<double>()).distance;
  }
  const double number = static_cast<double>(work.whole->size());
  return apart / number <= factor * unmoved / number + tolerance * work.diagonal;
}

/** Whether distances can be measured under a pose: no shear, and not so far away that
 * their squares were too much for a float.
 */
bool
isSimilarity(const Eigen::Matrix4d& pose, double diagonal)
{
  if (!pose.allFinite() || pose.cwiseAbs().maxCoeff() > 1e9 * std::max(1.0, diagonal))
    return false;
  const Eigen::Matrix3d linear = pose.topLeftCorner<3, 3>();
  if (!(linear.determinant() > 0.0))
    return false;
  const Eigen::Matrix3d rotation = linear / scaleOf(pose);
  return (rotation * rotation.transpose()).isIdentity(1e-3);
}

/** \brief The paper's measures. */
void
measureSurface(const Case& work, const Eigen::Matrix4d& pose, Metrics& metrics)
{
  Tree tree;
  tree.setInputCloud(work.target);
  const Eigen::Matrix3d rotation = pose.topLeftCorner<3, 3>() / scaleOf(pose);
  const std::size_t step = (work.source->size() + most_points - 1) / most_points;
  Sums distances, angles;
  for (std::size_t i = 0; i < work.source->size(); i += step) {
    const Nearest nearest = nearestOf(tree, placed(pose, (*work.source)[i]));
    distances.add(nearest.distance / work.diagonal);
    const Eigen::Vector3f& normal = work.target_normals[nearest.index];
    if (normal.isZero() || work.source_normals[i].isZero())
      continue; // a point on its own has none
    const double cosine = std::abs(
        normal.cast<double>().dot(rotation * work.source_normals[i].cast<double>()));
    angles.add(std::acos(std::min(cosine, 1.0)));
  }
  metrics.distance = distances.errors();
  metrics.angle = angles.errors();
}

/** \brief The differences to the true pose. */
void
measurePose(const Case& work, const Eigen::Matrix4d& pose, Metrics& metrics)
{
  const double scale = scaleOf(pose), true_scale = scaleOf(work.truth);
  const Eigen::Matrix3d turn = pose.topLeftCorner<3, 3>() *
                               work.truth.topLeftCorner<3, 3>().transpose() /
                               (scale * true_scale);
  metrics.rotation_degrees =
      Eigen::AngleAxisd(Eigen::Quaterniond(turn).normalized()).angle() * 180.0 / M_PI;
  metrics.rotation_degrees =
      std::min(metrics.rotation_degrees, 360.0 - metrics.rotation_degrees);
  metrics.scale = std::abs(scale / true_scale - 1.0);

  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  double squares = 0.0;
  const double number = static_cast<double>(work.source->size());
  for (const auto& point : *work.source) {
    const Eigen::Vector3d off = placed(pose, point) - placed(work.truth, point);
    mean += off / number;
    squares += off.squaredNorm() / number;
  }
  metrics.translation = mean.norm() / work.diagonal;
  metrics.target_registration_error = std::sqrt(squares) / work.diagonal;
}

} // namespace

Metrics
metricsOf(const Case& work, const Eigen::Matrix4d& pose)
{
  // Nothing can be measured of what is no similarity: the clouds stay as they are.
  const bool is_similarity = isSimilarity(pose, work.diagonal);
  const Eigen::Matrix4d used =
      is_similarity ? pose : Eigen::Matrix4d(Eigen::Matrix4d::Identity());
  Metrics metrics;
  measureSurface(work, used, metrics);
  measurePose(work, used, metrics);
  const bool right_scale = is_similarity && metrics.scale < 0.05;
  metrics.solved =
      right_scale && metrics.rotation_degrees < 5.0 && metrics.translation < 0.05;
  metrics.by_symmetry = right_scale && !metrics.solved &&
                        lieOnEachOther(work, used * work.truth.inverse());
  metrics.solved = metrics.solved || metrics.by_symmetry;
  return metrics;
}

} // namespace evaluation
