/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

// Points that carry colours and normals: the registration uses the coordinates, and
// takes the rest along. Normals are turned, not scaled: they stay of unit length.
//
//   02_colours_and_normals [SOURCE.pcd TARGET.pcd]

#include "lump.h"

#include <pcl/common/transforms.h>
#include <pcl/registration/kss_icp.h>

#include <algorithm>
#include <cmath>
#include <iostream>

using Cloud = pcl::PointCloud<pcl::PointXYZRGBNormal>;

/** Give each point of the lump its normal, and a colour that tells where it lies. */
void
paint(Cloud& lump)
{
  // the lump is where f is 0, and the gradient of f is its normal
  const auto f = [](const Eigen::Vector3f& p) {
    return p.norm() - example::radius(p.normalized());
  };
  for (pcl::PointXYZRGBNormal& point : lump) {
    const Eigen::Vector3f p = point.getVector3fMap();
    Eigen::Vector3f gradient;
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Vector3f step = 0.01f * Eigen::Vector3f::Unit(axis);
      gradient[axis] = f(p + step) - f(p - step);
    }
    point.getNormalVector3fMap() = gradient.normalized();
    point.r = static_cast<std::uint8_t>(127.5f + 60.0f * p.x());
    point.g = static_cast<std::uint8_t>(127.5f + 60.0f * p.y());
    point.b = static_cast<std::uint8_t>(127.5f + 60.0f * p.z());
  }
}

/** The largest difference between a normal's length and 1. */
double
normalLengthError(const Cloud& cloud)
{
  double largest = 0.0;
  for (const pcl::PointXYZRGBNormal& point : cloud)
    if (point.getNormalVector3fMap().allFinite())
      largest = std::max(largest, std::abs(point.getNormalVector3fMap().norm() - 1.0));
  return largest;
}

int
main(int argc, char** argv)
{
  Cloud::Ptr source, target;
  const Eigen::Affine3f truth =
      example::makePose(200.0f, {-1.0f, 0.5f, 1.0f}, {10.0f, 0.0f, -4.0f}, 0.4f);
  const bool generated = argc != 3;
  if (generated) {
    source = example::makeLump<pcl::PointXYZRGBNormal>(8000, 1);
    paint(*source);
    target = example::makeLump<pcl::PointXYZRGBNormal>(8000, 2);
    pcl::transformPointCloud(*target, *target, truth);
  }
  else {
    source = example::load<pcl::PointXYZRGBNormal>(argv[1]);
    target = example::load<pcl::PointXYZRGBNormal>(argv[2]);
  }

  pcl::KSSICP<pcl::PointXYZRGBNormal, pcl::PointXYZRGBNormal> registration;
  registration.setInputSource(source);
  registration.setInputTarget(target);
  Cloud aligned;
  registration.align(aligned);
  if (!registration.hasConverged()) {
    std::cerr << registration.getFailureReason() << '\n';
    return 1;
  }

  const double length_error = normalLengthError(aligned);
  std::cout << registration.getFinalTransformation() << "\nscale "
            << registration.getScale() << "\nlength of the aligned normals: 1, within "
            << length_error << '\n';
  if (!generated)
    return 0;

  const Eigen::Affine3f found(registration.getFinalTransformation());
  const Eigen::Matrix3f rotation = found.linear() / registration.getScale();
  bool carried = true;
  for (std::size_t i = 0; i < source->size(); ++i) {
    const Eigen::Vector3f turned = rotation * (*source)[i].getNormalVector3fMap();
    carried = carried && (*source)[i].rgba == aligned[i].rgba &&
              (turned - aligned[i].getNormalVector3fMap()).norm() < 1e-4f;
  }
  const double error = example::misplacement(found, truth);
  std::cout << "colours kept and normals turned: " << std::boolalpha << carried
            << "\nmisplaced by " << error << " % of the radius\n";
  return carried && length_error < 1e-4 && error < example::tolerance ? 0 : 1;
}
