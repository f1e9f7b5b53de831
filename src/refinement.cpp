/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include <pcl/registration/kss/pre_shape.h>
#include <pcl/registration/kss/refinement.h>

#include <Eigen/Geometry>
#include <Eigen/SVD>

#include <algorithm>
#include <cmath>

namespace pcl {
namespace kss {
namespace {

/** The sums over weighted correspondences that a similarity follows from. */
class Procrustes {
public:
  void
  add(const Eigen::Vector3d& source, const Eigen::Vector3d& target, double weight)
  {
    n_ += weight;
    source_ += weight * source;
    target_ += weight * target;
    product_ += weight * target * source.transpose();
    source_squared_ += weight * source.squaredNorm();
    target_squared_ += weight * target.squaredNorm();
  }

  /** As much larger as the target points are spread wider: Horn's symmetric scale. */
  double
  symmetricScale() const
  {
    return std::sqrt((target_squared_ - target_.squaredNorm() / n_) /
                     (source_squared_ - source_.squaredNorm() / n_));
  }

  /** The similarity of this scale that brings the source points closest to their
   * counterparts: (e7) and (e8), with a determinant that cannot become a mirror's. */
  Eigen::Matrix4d
  similarity(double scale) const
  {
    const Eigen::Matrix3d covariance = product_ - target_ * source_.transpose() / n_;
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance, Eigen::ComputeFullU |
                                                                Eigen::ComputeFullV);
    const Eigen::Matrix3d& u = svd.matrixU();
    const Eigen::Matrix3d& v = svd.matrixV();
    const Eigen::Vector3d signs(1.0, 1.0,
                                (u * v.transpose()).determinant() < 0 ? -1 : 1);
    const Eigen::Matrix3d linear = scale * u * signs.asDiagonal() * v.transpose();
    Eigen::Matrix4d similarity = Eigen::Matrix4d::Identity();
    similarity.topLeftCorner<3, 3>() = linear;
    similarity.topRightCorner<3, 1>() = (target_ - linear * source_) / n_;
    return similarity;
  }

private:
  double n_ = 0.0; // the sum of the weights
  Eigen::Vector3d source_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d target_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d product_ = Eigen::Matrix3d::Zero();
  double source_squared_ = 0.0;
  double target_squared_ = 0.0;
};

/** The first points, each with its nearest one once it has been placed:
 * found(point, nearest, squared distance). */
template <typename Found>
void
forNearest(const Points& probes,
           Eigen::Index count,
           const Eigen::Affine3f& placement,
           const NearestPoints& others,
           bool exact,
           const Found& found)
{
  for (Eigen::Index i = 0; i < std::min(count, probes.cols()); ++i) {
    float squared;
    const Eigen::Vector3f placed = placement * probes.col(i);
    const int nearest =
        exact ? others.nearest(placed, squared) : others.near(placed, squared);
    found(probes.col(i).cast<double>(), others.points().col(nearest).cast<double>(),
          squared);
  }
}

} // namespace

Refinement::Refinement(const Points& source_probes,
                       const Points& target_probes,
                       const NearestPoints& source,
                       const NearestPoints& target,
                       const ScaleRange& scales)
: source_probes_(source_probes)
, target_probes_(target_probes)
, source_(source)
, target_(target)
, scales_(scales)
{
}

Eigen::Matrix4d
Refinement::refine(const Eigen::Matrix4d& initial, const Effort& effort) const
{
  Eigen::Matrix4d pose = initial;
  const int falling = std::max(1, effort.iterations / 2);
  for (int iteration = 0; iteration < effort.iterations; ++iteration) {
    const double fallen = std::min(1.0, static_cast<double>(iteration) / falling);
    const double reach =
        effort.widest * std::pow(effort.narrowest / effort.widest, fallen);
    const auto weight = [&](double squared) {
      const double w = reach * reach / (reach * reach + squared);
      return w * w;
    };
    Procrustes pairs;
    const Eigen::Affine3f placement(pose.cast<float>());
    const double scale = scaleOf(pose);
    forNearest(source_probes_, effort.points, placement, target_, effort.exact,
               [&](const auto& source, const auto& target, double squared) {
                 pairs.add(source, target, weight(squared));
               });
    forNearest(target_probes_, effort.points, placement.inverse(), source_,
               effort.exact,
               [&](const auto& target, const auto& source, double squared) {
                 pairs.add(source, target, weight(scale * scale * squared));
               });
    const double estimate = scales_.smallest < scales_.largest
                                ? scales_.clamp(pairs.symmetricScale())
                                : scale;
    const Eigen::Matrix4d next = pairs.similarity(estimate);
    if (!next.allFinite())
      break;
    const bool settled =
        iteration > falling && (next - pose).cwiseAbs().maxCoeff() < 1e-5;
    pose = next;
    if (settled)
      break;
  }
  return pose;
}

} // namespace kss
} // namespace pcl
