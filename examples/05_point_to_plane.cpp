/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

// The final ICP with PCL's point to plane estimation, and with the estimation of
// KSSICP's own, which also says how sure the pose is: its inverse covariance is the
// information matrix of an edge in a pose graph.
//
//   05_point_to_plane [SOURCE.pcd TARGET.pcd]

#include "lump.h"

#include <pcl/common/transforms.h>
#include <pcl/features/normal_3d.h>
#include <pcl/registration/kss_icp.h>
#include <pcl/registration/transformation_estimation_point_to_plane_lls.h>

#include <iostream>

using Cloud = pcl::PointCloud<pcl::PointNormal>;
using Registration = pcl::KSSICP<pcl::PointNormal, pcl::PointNormal>;

/** Noise of 1 % of the lump's radius, as a scanner has it. */
void
addNoise(Cloud& cloud, unsigned int seed)
{
  std::mt19937 random(seed);
  std::normal_distribution<float> gauss(0.0f, 0.01f);
  for (pcl::PointNormal& point : cloud) {
    const float x = gauss(random), y = gauss(random), z = gauss(random);
    point.getVector3fMap() += Eigen::Vector3f(x, y, z);
  }
}

/** Normals from the ten nearest points, as PCL finds them. */
void
estimateNormals(Cloud& cloud)
{
  pcl::NormalEstimation<pcl::PointNormal, pcl::PointNormal> estimation;
  estimation.setInputCloud(cloud.makeShared());
  estimation.setKSearch(10);
  estimation.compute(cloud); // writes the normals, and leaves the coordinates
}

/** Register, and end the program where that fails. */
Eigen::Affine3f
registered(Registration& registration)
{
  Cloud aligned;
  registration.align(aligned);
  if (!registration.hasConverged()) {
    std::cerr << registration.getFailureReason() << '\n';
    std::exit(1);
  }
  return Eigen::Affine3f(registration.getFinalTransformation());
}

int
main(int argc, char** argv)
{
  Cloud::Ptr source, target;
  const Eigen::Affine3f truth =
      example::makePose(140.0f, {1.0f, 2.0f, 3.0f}, {5.0f, -3.0f, 2.0f});
  const bool generated = argc != 3;
  if (generated) {
    source = example::makeLump<pcl::PointNormal>(8000, 1);
    target = example::makeLump<pcl::PointNormal>(12000, 2);
    addNoise(*source, 1);
    addNoise(*target, 2);
    pcl::transformPointCloud(*target, *target, truth);
  }
  else {
    source = example::load<pcl::PointNormal>(argv[1]);
    target = example::load<pcl::PointNormal>(argv[2]);
  }
  estimateNormals(*source); // the search asks for the source's, too
  estimateNormals(*target);

  Registration registration;
  registration.setInputSource(source);
  registration.setInputTarget(target);
  registration.setScaleEstimation(false); // PCL's estimation knows no scale

  // As with IterativeClosestPoint: what lays the points on each other is up to you.
  registration.setTransformationEstimation(
      std::make_shared<pcl::registration::TransformationEstimationPointToPlaneLLS<
          pcl::PointNormal, pcl::PointNormal>>());
  const Eigen::Affine3f by_pcl = registered(registration);
  const double confidence_by_pcl = registration.getConfidence();

  // Another object, with the estimation that KSSICP comes with.
  Registration own;
  own.setInputSource(source);
  own.setInputTarget(target);
  own.setScaleEstimation(false);
  const Eigen::Affine3f by_own = registered(own);

  // getCovariance() is that of KSSICP's own estimation; with another one it is empty.
  // Rotation comes first (radians about the target's axes), then the place of the
  // source's centroid (in the target's unit).
  const Eigen::MatrixXd covariance = own.getCovariance();
  if (covariance.rows() != 6 || registration.getCovariance().size() != 0) {
    std::cerr << "the surfaces say nothing about the precision\n";
    return 1;
  }
  const Eigen::VectorXd deviation = covariance.diagonal().cwiseSqrt();
  std::cout << "confidence, with PCL's point to plane: " << confidence_by_pcl
            << "\nconfidence, with KSSICP's own:         " << own.getConfidence()
            << "\nKSSICP's own knows its standard deviations:\n  about x, y, z: "
            << deviation.head<3>().transpose() * 180.0 / M_PI
            << " degrees\n  along x, y, z: " << deviation.tail<3>().transpose()
            << " of the target's unit\n  directions that the surfaces leave open: "
            << own.getUndeterminedDirections() << '\n';

  // What a pose graph wants of an edge: how much each direction of the pose weighs.
  const Eigen::MatrixXd information = covariance.inverse();
  std::cout << "information matrix of the edge:\n" << information << '\n';
  if (!generated)
    return 0;

  const double off_by_pcl = example::misplacement(by_pcl, truth),
               off_by_own = example::misplacement(by_own, truth);
  std::cout << "misplaced, with PCL's point to plane: " << off_by_pcl
            << " % of the radius\nmisplaced, with KSSICP's own: " << off_by_own
            << " %\n";
  return off_by_pcl < example::tolerance && off_by_own < example::tolerance &&
                 information.allFinite()
             ? 0
             : 1;
}
