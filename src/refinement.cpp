/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include <pcl/registration/kss/pre_shape.h>
#include <pcl/registration/kss/refinement.h>

#include <Eigen/Geometry>
#include <Eigen/SVD>

#include <cmath>

namespace pcl {
namespace kss {
namespace {

PointXYZ
pointOf(const Eigen::Vector3f& p)
{
  return {p.x(), p.y(), p.z()};
}

/** A tree over the points in their order. */
search::KdTree<PointXYZ>
treeOf(const Points& points)
{
  const auto cloud = pcl::make_shared<PointCloud<PointXYZ>>();
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    cloud->push_back(pointOf(points.col(i)));
  search::KdTree<PointXYZ> tree(false);
  tree.setInputCloud(cloud);
  return tree;
}

/** The sums over correspondences that a similarity follows from. */
class Procrustes {
public:
  void
  add(const Eigen::Vector3d& source, const Eigen::Vector3d& target)
  {
    ++n_;
    source_ += source;
    target_ += target;
    product_ += target * source.transpose();
    source_squared_ += source.squaredNorm();
    target_squared_ += target.squaredNorm();
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
  double n_ = 0.0;
  Eigen::Vector3d source_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d target_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d product_ = Eigen::Matrix3d::Zero();
  double source_squared_ = 0.0;
  double target_squared_ = 0.0;
};

/** Every stride-th point, placed by a similarity, with its nearest point in the tree:
 * found(index, nearest) for each. */
template <typename Found>
void
forNearest(const Points& points,
           Eigen::Index stride,
           const Eigen::Matrix4d& placement,
           const search::KdTree<PointXYZ>& tree,
           const Found& found)
{
  const Eigen::Affine3f place(placement.cast<float>());
  Indices index(1);
  std::vector<float> squared(1);
  for (Eigen::Index i = 0; i < points.cols(); i += stride) {
    tree.nearestKSearch(pointOf(place * points.col(i)), 1, index, squared);
    found(i, index[0]);
  }
}

} // namespace

Refinement::Refinement(const Points& source, const Points& target)
: source_(source)
, target_(target)
, source_tree_(treeOf(source))
, target_tree_(treeOf(target))
{
}

Eigen::Matrix4d
Refinement::refine(const Eigen::Matrix4d& initial,
                   bool estimate_scale,
                   Effort effort) const
{
  const auto stride = [&](const Points& points) {
    const Eigen::Index wanted = effort.points > 0 ? effort.points : points.cols();
    return std::max<Eigen::Index>(1, points.cols() / wanted);
  };
  Eigen::Matrix4d pose = initial;
  const double known_scale = scaleOf(initial);
  for (unsigned int iteration = 0; iteration < effort.iterations; ++iteration) {
    Procrustes pairs;
    forNearest(source_, stride(source_), pose, target_tree_, [&](int s, int t) {
      pairs.add(source_.col(s).cast<double>(), target_.col(t).cast<double>());
    });
    forNearest(
        target_, stride(target_), pose.inverse(), source_tree_, [&](int t, int s) {
          pairs.add(source_.col(s).cast<double>(), target_.col(t).cast<double>());
        });
    const double scale = estimate_scale ? pairs.symmetricScale() : known_scale;
    const Eigen::Matrix4d next = pairs.similarity(scale);
    const bool settled = (next - pose).cwiseAbs().maxCoeff() < effort.tolerance;
    pose = next;
    if (settled)
      break;
  }
  return pose;
}

} // namespace kss
} // namespace pcl
