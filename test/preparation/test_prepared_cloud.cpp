/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "poses.h"

#include "preparation/preparation.h"

#include <gtest/gtest.h>

namespace {

using namespace kss_test;
using namespace pcl::kss;

TEST(PreparedCloud, JudgesByMorePointsWhereTheScaleIsKnown)
{
  const LocalCloud cloud{sampled(lump(), 60000, 1)};
  const auto judges = [&](bool estimate_scale, double smallest, double largest) {
    Settings settings;
    settings.estimate_scale = estimate_scale;
    settings.smallest_scale = smallest;
    settings.largest_scale = largest;
    return prepared(cloud, fingerprintOf(cloud), settings).dense.points.cols();
  };
  EXPECT_LE(judges(true, 0.5, 2.0), 40000);
  EXPECT_GT(judges(true, 0.5, 2.0), 20000);
  EXPECT_GT(judges(false, 0.5, 2.0), 50000);
  EXPECT_EQ(judges(false, 0.5, 2.0), judges(true, 1.0, 1.0));
}

TEST(Preparation, IsTheSameForAnyNumberOfThreads)
{
  const LocalCloud a{sampled(lump(), 20000, 2)}, b{sampled(creature(), 15000, 3)};
  Settings settings;
  settings.threads = 1;
  Preparation alone(settings);
  const PreparedPair expected = alone.prepared(a, b, [](double) {});
  for (const unsigned int threads : {2u, 3u, 8u}) {
    settings.threads = threads;
    Preparation preparation(settings);
    const PreparedPair pair = preparation.prepared(a, b, [](double) {});
    for (const auto cloud : {&PreparedPair::source, &PreparedPair::target}) {
      EXPECT_EQ((expected.*cloud)->surface.points, (pair.*cloud)->surface.points);
      EXPECT_EQ((expected.*cloud)->dense.points, (pair.*cloud)->dense.points);
      EXPECT_EQ((expected.*cloud)->planes.normals, (pair.*cloud)->planes.normals);
      EXPECT_EQ((expected.*cloud)->order.indices, (pair.*cloud)->order.indices);
    }
  }
}

TEST(Preparation, MakesAnewWhatHasChangedAlone)
{
  Settings settings;
  Preparation preparation(settings);
  LocalCloud a{sampled(lump(), 2000, 4)}, b{sampled(creature(), 2000, 5)};
  const auto none = [](double) {};
  const PreparedPair first = preparation.prepared(a, b, none);
  EXPECT_EQ(first.target, preparation.prepared(a, b, none).target);
  // one digit of one point, its origin, its normals
  a.points(1, 1999) = std::nextafter(a.points(1, 1999), 1.0f);
  const PreparedPair moved = preparation.prepared(a, b, none);
  EXPECT_NE(first.source, moved.source);
  EXPECT_EQ(first.target, moved.target);
  b.origin.z() = 1e-9;
  const PreparedPair shifted = preparation.prepared(a, b, none);
  EXPECT_EQ(moved.source, shifted.source);
  EXPECT_NE(moved.target, shifted.target);
  b.normals = b.points.colwise().normalized();
  EXPECT_NE(shifted.target, preparation.prepared(a, b, none).target);
}

} // namespace
