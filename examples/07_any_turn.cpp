/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

// How often IterativeClosestPoint and KSSICP come right when the source is turned at
// random: on clouds of yours, the pose that counts as right is the one that KSSICP
// finds before any turn.
//
//   07_any_turn [SOURCE.pcd TARGET.pcd [TURNS]]

#include "lump.h"

#include <pcl/common/centroid.h>
#include <pcl/common/transforms.h>
#include <pcl/registration/icp.h>
#include <pcl/registration/kss_icp.h>

#include <algorithm>
#include <chrono>
#include <iostream>

using Cloud = pcl::PointCloud<pcl::PointXYZ>;

/** What became of the turns. */
struct Tally {
  int right = 0, converged = 0, both = 0;
  double seconds = 0.0;
};

/** Less than 5 degrees off, and the centroid by less than 5 % of the cloud's size. */
bool
isRight(const Eigen::Affine3f& found,
        const Eigen::Affine3f& truth,
        const Eigen::Vector3f& centroid,
        float size)
{
  const Eigen::AngleAxisf turn(
      Eigen::Matrix3f(found.rotation() * truth.rotation().transpose()));
  return std::abs(turn.angle()) < 5.0f * M_PI / 180.0f &&
         (found * centroid - truth * centroid).norm() < 0.05f * size;
}

template <typename Registration>
Eigen::Affine3f
align(Registration& registration, Cloud::Ptr source, Cloud::Ptr target)
{
  registration.setInputSource(source);
  registration.setInputTarget(target);
  Cloud aligned;
  registration.align(aligned);
  return Eigen::Affine3f(registration.getFinalTransformation());
}

void
print(const char* name, const Tally& tally, int turns)
{
  std::cout << name << ": right " << tally.right << " of " << turns
            << ", hasConverged() " << tally.converged << " times, " << tally.both
            << " of them right, " << tally.seconds / turns << " s each\n";
}

int
main(int argc, char** argv)
{
  Cloud::Ptr source, target;
  const bool generated = argc < 3;
  if (generated) {
    source = example::makeLump<pcl::PointXYZ>(800, 1);
    target = example::makeLump<pcl::PointXYZ>(1000, 2);
  }
  else {
    source = example::load<pcl::PointXYZ>(argv[1]);
    target = example::load<pcl::PointXYZ>(argv[2]);
  }
  const int turns = argc > 3 ? std::max(1, std::atoi(argv[3])) : 10;

  pcl::IterativeClosestPoint<pcl::PointXYZ, pcl::PointXYZ> icp;
  icp.setMaximumIterations(1000);
  pcl::KSSICP<pcl::PointXYZ, pcl::PointXYZ> kss_icp;
  kss_icp.setScaleEstimation(false);

  const Eigen::Affine3f unturned = align(kss_icp, source, target);
  if (!kss_icp.hasConverged()) {
    std::cerr << kss_icp.getFailureReason() << '\n';
    return 1;
  }
  Eigen::Vector4f centroid;
  pcl::compute3DCentroid(*source, centroid);
  float size = 0.0f; // the diameter about the centroid
  for (const pcl::PointXYZ& point : *source)
    size = std::max(size, 2.0f * (point.getVector4fMap() - centroid).head<3>().norm());

  std::mt19937 random(1);
  std::normal_distribution<float> gauss;
  Tally of_icp, of_kss_icp;
  for (int i = 0; i < turns; ++i) {
    // four normal numbers are an evenly distributed rotation
    const float w = gauss(random), x = gauss(random), y = gauss(random),
                z = gauss(random);
    const Eigen::Affine3f turn = Eigen::Translation3f(centroid.head<3>()) *
                                 Eigen::Quaternionf(w, x, y, z).normalized() *
                                 Eigen::Translation3f(-centroid.head<3>());
    Cloud::Ptr turned(new Cloud);
    pcl::transformPointCloud(*source, *turned, turn);
    const auto run = [&](auto& registration, Tally& tally) {
      const auto start = std::chrono::steady_clock::now();
      const Eigen::Affine3f found = align(registration, turned, target);
      tally.seconds +=
          std::chrono::duration<double>(std::chrono::steady_clock::now() - start)
              .count();
      const bool right =
          isRight(found, unturned * turn.inverse(), centroid.head<3>(), size);
      tally.right += right;
      tally.converged += registration.hasConverged();
      tally.both += right && registration.hasConverged();
    };
    run(icp, of_icp);
    run(kss_icp, of_kss_icp);
  }
  print("IterativeClosestPoint", of_icp, turns);
  print("KSSICP", of_kss_icp, turns);
  return of_kss_icp.both == turns || !generated ? 0 : 1;
}
