/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "candidates/numbers.h"
#include "candidates/rotations.h"

#include <gtest/gtest.h>

namespace {

using namespace pcl::kss;
using search_numbers::reachOf;

TEST(Reach, FollowsTheStepOfFewRotationsAndStaysForMany)
{
  Settings settings;
  EXPECT_EQ(0.35, reachOf(numberOfRotations(settings)));
  settings.even_rotations = 1728 / 8; // steps twice as wide
  EXPECT_DOUBLE_EQ(0.7, reachOf(numberOfRotations(settings)));
  settings.even_rotations = 100000;
  EXPECT_EQ(0.35, reachOf(numberOfRotations(settings)));
  settings.rotation_set = RotationSet::EULER;
  EXPECT_EQ(0.35, reachOf(numberOfRotations(settings)));
  settings.angle_step *= 2.0;
  EXPECT_DOUBLE_EQ(0.7, reachOf(numberOfRotations(settings)));
}

TEST(NumberOfRotations, IsThatOfTheSet)
{
  Settings settings;
  for (const RotationSet set : {RotationSet::EVEN, RotationSet::EULER})
    for (const double step : {0.5, 0.7, 3.0}) {
      settings.rotation_set = set;
      settings.angle_step = step;
      settings.even_rotations = static_cast<unsigned int>(100.0 * step);
      EXPECT_EQ(candidateRotations(settings)->rotations().size(),
                numberOfRotations(settings));
    }
}

} // namespace
