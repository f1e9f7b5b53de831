/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/PCLPointCloud2.h>
#include <pcl/conversions.h>
#include <pcl/io/pcd_io.h>
#include <pcl/point_cloud.h>

#include <Eigen/Geometry>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <random>
#include <string>

/** What the examples share: a shape to try them on where no clouds are given. */
namespace example {

/** The lump's radius in some direction: a ball with four bumps, and no symmetry. */
inline float
radius(const Eigen::Vector3f& direction)
{
  static const float bumps[4][5] = {// direction, height, narrowness
                                    {1.0f, 0.2f, 0.1f, 0.9f, 8.0f},
                                    {-0.3f, 0.9f, 0.4f, 0.6f, 12.0f},
                                    {-0.5f, -0.4f, 0.8f, 0.4f, 6.0f},
                                    {0.2f, -0.7f, -0.7f, 0.7f, 20.0f}};
  float sum = 1.0f;
  for (const auto& bump : bumps) {
    const Eigen::Vector3f middle =
        Eigen::Vector3f(bump[0], bump[1], bump[2]).normalized();
    sum += bump[3] * std::exp(bump[4] * (middle.dot(direction) - 1.0f));
  }
  return sum;
}

/** Points on the lump: other ones with every seed, as if it had been scanned anew. */
template <typename PointT>
typename pcl::PointCloud<PointT>::Ptr
makeLump(std::size_t size, unsigned int seed)
{
  std::mt19937 random(seed);
  std::normal_distribution<float> gauss;
  typename pcl::PointCloud<PointT>::Ptr cloud(new pcl::PointCloud<PointT>);
  while (cloud->size() < size) {
    const float x = gauss(random), y = gauss(random), z = gauss(random);
    const Eigen::Vector3f direction = Eigen::Vector3f(x, y, z).normalized();
    PointT point;
    point.getVector3fMap() = radius(direction) * direction;
    cloud->push_back(point);
  }
  return cloud;
}

/** A similarity from an angle about an axis, a translation and a scale. */
inline Eigen::Affine3f
makePose(float degrees,
         const Eigen::Vector3f& axis,
         const Eigen::Vector3f& translation,
         float scale = 1.0f)
{
  return Eigen::Translation3f(translation) *
         Eigen::AngleAxisf(degrees * static_cast<float>(M_PI) / 180.0f,
                           axis.normalized()) *
         Eigen::Scaling(scale);
}

/** How far a pose puts the lump from where another one puts it: root mean square, as a
 * percentage of the lump's radius.
 */
inline double
misplacement(const Eigen::Affine3f& pose, const Eigen::Affine3f& truth)
{
  // the corners of an octahedron stand for the lump
  Eigen::Matrix<float, 3, 6> corners;
  corners << Eigen::Matrix3f::Identity(), -Eigen::Matrix3f::Identity();
  const double distance = (pose * corners - truth * corners).norm() / std::sqrt(6.0);
  return 100.0 * distance / std::cbrt(truth.linear().determinant());
}

/** The misplacement, in percent, that the examples accept: about the distance between
 * neighbouring points. */
constexpr double tolerance = 3.0;

/** Read a PCD file, or end the program. PCL's points are of floats and take no others:
 * doubles, as a file may have them, become floats where they stand.
 */
template <typename PointT>
typename pcl::PointCloud<PointT>::Ptr
load(const std::string& name)
{
  pcl::PCLPointCloud2 file;
  if (pcl::io::loadPCDFile(name, file) < 0) {
    std::cerr << "cannot read " << name << '\n';
    std::exit(2);
  }
  for (pcl::PCLPointField& field : file.fields) {
    if (field.datatype != pcl::PCLPointField::FLOAT64)
      continue;
    field.datatype = pcl::PCLPointField::FLOAT32;
    for (std::size_t at = field.offset; at < file.data.size(); at += file.point_step) {
      double value;
      std::memcpy(&value, &file.data[at], sizeof value);
      const float rounded = static_cast<float>(value);
      std::memcpy(&file.data[at], &rounded, sizeof rounded);
    }
  }
  typename pcl::PointCloud<PointT>::Ptr cloud(new pcl::PointCloud<PointT>);
  pcl::fromPCLPointCloud2(file, *cloud);
  return cloud;
}

} // namespace example
