/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "clouds.h"
#include "quick.h"

#include <pcl/registration/kss_icp.h>

#include <gtest/gtest.h>

#include <type_traits>

namespace kss_test {

/** \brief Two independent samplings of one shape. */
template <typename PointSource = pcl::PointXYZ, typename PointTarget = PointSource>
struct Pair {
  typename pcl::PointCloud<PointSource>::Ptr source;
  typename pcl::PointCloud<PointTarget>::Ptr target;
  Eigen::Matrix4d truth; ///< maps the source onto the target
};

template <typename PointSource = pcl::PointXYZ, typename PointTarget = PointSource>
Pair<PointSource, PointTarget>
pairOf(const Eigen::Matrix4d& truth,
       unsigned int seed = 1,
       const Mesh& mesh = creature())
{
  return {
      cloudOf<PointSource>(transformed(sampled(mesh, 1500, 2 * seed), truth.inverse())),
      cloudOf<PointTarget>(sampled(mesh, 1800, 2 * seed + 1)), truth};
}

/** \brief A pair of given points, the source away from where it belongs. */
inline Pair<>
pairOf(const Points& source, const Points& target, const Eigen::Matrix4d& truth)
{
  return {cloudOf<pcl::PointXYZ>(transformed(source, truth.inverse())),
          cloudOf<pcl::PointXYZ>(target), truth};
}

/** \brief Give a registration one setting. */
template <typename Registration, typename Value>
void
set(Registration& registration,
    Value pcl::kss::Settings::*setting,
    const std::common_type_t<Value>& value)
{
  pcl::kss::Settings settings = registration.getSettings();
  settings.*setting = value;
  registration.setSettings(settings);
}

/** \brief Points that the clouds of pairs are simplified to. */
constexpr unsigned int quick_points = 200;

/** \brief Have a registration take no longer than it needs for such pairs. */
template <typename Registration>
void
makeQuick(Registration& registration)
{
  registration.setSettings(quickSettings(quick_points, registration.getSettings()));
}

template <typename Registration, typename PairT>
void
setClouds(Registration& registration, const PairT& pair)
{
  registration.setInputSource(pair.source);
  registration.setInputTarget(pair.target);
}

template <typename Registration>
Eigen::Matrix4d
poseFrom(Registration& registration)
{
  return registration.getFinalTransformation().template cast<double>();
}

/** \brief The registration's pose is right. Two samplings with a spacing of 3 % of the
 * diagonal agree to a fraction of that. */
template <typename Registration, typename PairT>
void
expectRight(Registration& registration, const PairT& pair, double tolerance = 0.01)
{
  Points finite(3, 0);
  for (const auto& point : *pair.source)
    if (point.getVector3fMap().allFinite()) {
      finite.conservativeResize(3, finite.cols() + 1);
      finite.rightCols<1>() = point.getVector3fMap();
    }
  EXPECT_LT(displacement(poseFrom(registration), pair.truth, finite), tolerance);
}

/** \brief The output is the source transformed, and points that are not finite are as
 * they were. */
template <typename PointT, typename Matrix>
void
expectTransformed(const pcl::PointCloud<PointT>& output,
                  const pcl::PointCloud<PointT>& source,
                  const Matrix& transformation)
{
  ASSERT_EQ(source.size(), output.size());
  const Eigen::Affine3d pose(transformation.template cast<double>());
  for (std::size_t i = 0; i < source.size(); ++i) {
    const Eigen::Vector3d before = source[i].getVector3fMap().template cast<double>();
    const Eigen::Vector3d after = output[i].getVector3fMap().template cast<double>();
    if (!before.allFinite()) {
      for (int axis = 0; axis < 3; ++axis)
        EXPECT_TRUE(after[axis] == before[axis] ||
                    (std::isnan(after[axis]) && std::isnan(before[axis])));
      continue;
    }
    const Eigen::Vector3d expected = pose * before;
    ASSERT_LT((after - expected).norm(), 1e-6 * (1.0 + expected.norm())) << i;
  }
}

/** \brief The indexed points of a cloud. */
template <typename PointT>
pcl::PointCloud<PointT>
picked(const pcl::PointCloud<PointT>& cloud, const pcl::Indices& indices)
{
  return {cloud, indices};
}

} // namespace kss_test
