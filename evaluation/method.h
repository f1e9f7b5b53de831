/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <Eigen/Core>

#include <functional>
#include <string>
#include <vector>

/** The paper's experiments: cases, methods, and what comes out. */
namespace evaluation {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;

/** \brief What a method is told about a case. */
struct Task {
  Cloud::ConstPtr source, target;
  /** The share of the target that the source shows; for methods that ask for it. */
  double overlap = 1.0;
  /** Whether the clouds have the same scale, and the method is told so. */
  bool same_scale = false;
  /** For methods that draw random numbers. */
  unsigned int seed = 0;
};

/** \brief What a method answers. */
struct Answer {
  /** A similarity that maps the source to the target. */
  Eigen::Matrix4d pose = Eigen::Matrix4d::Identity();
  /** Whether the method says that it has succeeded. */
  bool claimed = false;
};

/** \brief A way to register two clouds, from the clouds as they are to the final pose.
 */
struct Method {
  std::string name;
  /** Whether it finds the scale; the others also run on clouds of the same scale. */
  bool estimates_scale = false;
  std::function<Answer(const Task&)> run;
  /** What a process does once, like opening a device; not timed. May be empty. */
  std::function<void()> warm_up;
};

/** \brief KSS-ICP as shipped and with the paper's settings, on OpenCL and on the host.
 */
std::vector<Method>
kssICPMethods();

/** \brief PCL's own: ICP, SAC-IA, SampleConsensusPrerejective, FPCS and KFPCS, each
 * with ICP after it.
 */
std::vector<Method>
pclMethods();

/** \brief Open3D's RANSAC and fast global registration, each with ICP after it; empty
 * where this program was built without Open3D.
 */
std::vector<Method>
open3dMethods();

} // namespace evaluation
