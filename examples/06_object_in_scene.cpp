/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

// An object found in a scene: a model of the object, and a scan of a table with other
// things on it, both in the same unit.
//
//   06_object_in_scene [OBJECT.pcd SCENE.pcd]

#include "lump.h"

#include <pcl/common/transforms.h>
#include <pcl/registration/kss_icp.h>

#include <iostream>

using Cloud = pcl::PointCloud<pcl::PointXYZ>;

/** A table, a ball and a box on it, and the lump among them. */
Cloud::Ptr
makeScene(const Eigen::Affine3f& place_of_lump)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<float> uniform(-1.0f, 1.0f);
  std::normal_distribution<float> gauss;
  Cloud::Ptr scene(new Cloud);
  for (int i = 0; i < 40000; ++i)
    scene->push_back({8.0f * uniform(random), 6.0f * uniform(random), 0.0f});
  for (int i = 0; i < 6000; ++i) {
    const float x = gauss(random), y = gauss(random), z = gauss(random);
    const Eigen::Vector3f direction = Eigen::Vector3f(x, y, z).normalized();
    pcl::PointXYZ point;
    point.getVector3fMap() =
        1.2f * direction + Eigen::Vector3f(-4.0f, 2.0f, 1.2f); // a ball
    scene->push_back(point);
  }
  for (int i = 0; i < 8000; ++i) {
    Eigen::Vector3f point(uniform(random), uniform(random), uniform(random));
    point[i % 3] = i % 2 ? 1.0f : -1.0f; // onto one of the six faces of a box
    scene->push_back({2.0f * point.x() + 3.0f, point.y() - 3.0f, point.z() + 1.0f});
  }
  Cloud lump;
  pcl::transformPointCloud(*example::makeLump<pcl::PointXYZ>(8000, 2), lump,
                           place_of_lump);
  for (const pcl::PointXYZ& point : lump)
    if (point.z > 0.0f) // the rest is in the table
      scene->push_back(point);
  return scene;
}

int
main(int argc, char** argv)
{
  Cloud::Ptr object, scene;
  const Eigen::Affine3f truth =
      example::makePose(140.0f, {1.0f, 2.0f, 3.0f}, {2.0f, 3.0f, 1.0f});
  const bool generated = argc != 3;
  if (generated) {
    object = example::makeLump<pcl::PointXYZ>(8000, 1);
    scene = makeScene(truth);
  }
  else {
    object = example::load<pcl::PointXYZ>(argv[1]);
    scene = example::load<pcl::PointXYZ>(argv[2]);
  }

  pcl::KSSICP<pcl::PointXYZ, pcl::PointXYZ> registration;
  registration.setInputSource(object);
  registration.setInputTarget(scene);
  registration.setScaleEstimation(false); // the mode asks for a scale that is known
  registration.setMode(pcl::kss::Mode::IN_SCENE);
  Cloud placed;
  registration.align(placed);
  if (!registration.hasConverged()) {
    std::cerr << "not found: " << registration.getFailureReason() << '\n';
    return 1;
  }

  // The scene owes the object nothing: what counts is how much of the object it shows.
  std::cout << "found, with confidence " << registration.getConfidence()
            << "; the scene shows "
            << 100.0 * registration.getEvidence().source.explained
            << " % of the object, at\n"
            << registration.getFinalTransformation() << '\n';
  if (!generated)
    return 0;

  const double error = example::misplacement(
      Eigen::Affine3f(registration.getFinalTransformation()), truth);
  std::cout << "misplaced by " << error << " % of the radius\n";
  return error < example::tolerance ? 0 : 1;
}
