/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * PCL's pairwise_incremental_registration, call by call, with KSSICP in the place of
 * its registration: docs/pcl_programs.md.
 */

#include "pairs.h"

#include <pcl/features/normal_3d.h>

#include <cmath>

namespace {

using namespace kss_test;
using Cloud = pcl::PointCloud<pcl::PointXYZ>;
using Point = pcl::PointNormal;

/** Points with normals and curvatures from thirty neighbours. */
pcl::PointCloud<Point>::Ptr
withNormals(const Cloud::Ptr& cloud)
{
  pcl::NormalEstimation<pcl::PointXYZ, Point> estimation;
  estimation.setSearchMethod(pcl::make_shared<pcl::search::KdTree<pcl::PointXYZ>>());
  estimation.setKSearch(30);
  estimation.setInputCloud(cloud);
  auto points = pcl::make_shared<pcl::PointCloud<Point>>();
  estimation.compute(*points);
  for (std::size_t i = 0; i < cloud->size(); ++i)
    (*points)[i].getVector3fMap() = (*cloud)[i].getVector3fMap();
  return points;
}

/** What points are compared by: their places and how much the surface bends. */
class PlaceAndCurvature : public pcl::PointRepresentation<Point> {
public:
  PlaceAndCurvature() { nr_dimensions_ = 4; }

  void
  copyToFloatArray(const Point& point, float* out) const override
  {
    out[0] = point.x;
    out[1] = point.y;
    out[2] = point.z;
    out[3] = point.curvature;
  }
};

/** Two scans of a lump that share about half of it, a small motion apart. */
Pair<>
consecutiveScans(double noise)
{
  Eigen::Matrix4d moved = turn(8.0, {1.0, 2.0, 3.0});
  moved.topRightCorner<3, 1>() = Eigen::Vector3d(0.1, -0.05, 0.08);
  const auto scan = [&](const Eigen::Vector3f& from, unsigned int seed) {
    return noisy(part(sampled(lump(), 3000, seed), from, 0.75), noise, seed + 2);
  };
  return pairOf(scan({1.0f, 0.2f, 0.3f}, 7), scan({-0.3f, 1.0f, 0.2f}, 8), moved);
}

TEST(Programs, PairwiseIncrementalRegistration)
{
  for (const double noise : {0.0, 0.01}) {
    const Pair<> pair = consecutiveScans(noise);
    auto source = withNormals(pair.source);
    const auto target = withNormals(pair.target);
    PlaceAndCurvature representation;
    const float alike[] = {1.0f, 1.0f, 1.0f, 1.0f};
    representation.setRescaleValues(alike);
    pcl::KSSICP<Point, Point> registration;
    registration.setTransformationEpsilon(1e-6);
    registration.setMaxCorrespondenceDistance(0.4);
    registration.setPointRepresentation(
        pcl::make_shared<const PlaceAndCurvature>(representation));
    registration.setInputSource(source);
    registration.setInputTarget(target);
    registration.setMaximumIterations(2);
    auto result = source;
    Eigen::Matrix4f all = Eigen::Matrix4f::Identity(), previous = all;
    for (int i = 0; i < 30; ++i) {
      source = result;
      registration.setInputSource(source);
      registration.align(*result);
      all = registration.getFinalTransformation() * all;
      const Eigen::Matrix4f last = registration.getLastIncrementalTransformation();
      if (std::abs((last - previous).sum()) < registration.getTransformationEpsilon())
        registration.setMaxCorrespondenceDistance(
            registration.getMaxCorrespondenceDistance() - 0.001);
      previous = last;
      ASSERT_TRUE(registration.hasConverged())
          << noise << ", " << i << ": " << registration.getFailureReason();
      EXPECT_LT(displacement(all.cast<double>(), pair.truth, pointsOf(*pair.source)),
                noise > 0.0 ? 2e-3 : 5e-4);
    }
    // all that came of it is in the output
    expectTransformed(*result, *withNormals(pair.source), all);
    // and the target can be laid on the source
    EXPECT_LT(displacement(all.cast<double>().inverse(), pair.truth.inverse(),
                           pointsOf(*pair.target)),
              2e-3);
  }
}

} // namespace
