/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "poses.h"

#include "candidates/rotations.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <vector>

namespace {

using namespace kss_test;
using namespace pcl::kss;

constexpr double paper_step = M_PI / 6.0;

/** Rz Ry Rx, written out. */
Eigen::Matrix3d
composed(double x, double y, double z)
{
  const double cx = std::cos(x), sx = std::sin(x);
  const double cy = std::cos(y), sy = std::sin(y);
  const double cz = std::cos(z), sz = std::sin(z);
  Eigen::Matrix3d matrix;
  matrix << cz * cy, cz * sy * sx - sz * cx, cz * sy * cx + sz * sx, //
      sz * cy, sz * sy * sx + cz * cx, sz * sy * cx - cz * sx,       //
      -sy, cy * sx, cy * cx;
  return matrix;
}

/** The rotation's entries in thousandths, to tell distinct ones apart. */
std::array<int, 9>
fingerprint(const Eigen::Quaterniond& rotation)
{
  const Eigen::Matrix3d matrix = rotation.toRotationMatrix();
  std::array<int, 9> entries;
  for (int i = 0; i < 9; ++i)
    entries[i] = static_cast<int>(std::lround(matrix.data()[i] * 1000.0));
  return entries;
}

/** The largest angle, in degrees, from any of many random rotations to the set. */
double
coveringDegrees(const CandidateRotations& candidates)
{
  std::mt19937 random(1);
  double worst = 1.0;
  for (int i = 0; i < 5000; ++i) {
    const Eigen::Quaterniond rotation = randomRotation(random);
    double best = 0.0;
    for (const Eigen::Quaterniond& candidate : candidates.rotations())
      best = std::max(best, std::abs(rotation.dot(candidate)));
    worst = std::min(worst, best);
  }
  return 2.0 * std::acos(std::min(1.0, worst)) * 180.0 / M_PI;
}

TEST(EulerRotations, AreAllTriplesOfTheStep)
{
  for (const int steps : {2, 3, 4, 12}) {
    const EulerRotations candidates(2.0 * M_PI / steps);
    const auto& rotations = candidates.rotations();
    ASSERT_EQ(static_cast<std::size_t>(steps * steps * steps), rotations.size());
    std::size_t i = 0;
    for (int x = 0; x < steps; ++x)
      for (int y = 0; y < steps; ++y)
        for (int z = 0; z < steps; ++z, ++i) {
          const double step = 2.0 * M_PI / steps;
          ASSERT_TRUE(rotations[i].toRotationMatrix().isApprox(
              composed(x * step, y * step, z * step), 1e-12));
        }
  }
}

TEST(EulerRotations, HoldThePapersNumber)
{
  const EulerRotations candidates(paper_step);
  EXPECT_EQ(1728u, candidates.rotations().size());
  // full-range Euler angles name most rotations twice, those at the poles more often
  std::set<std::array<int, 9>> distinct;
  for (const Eigen::Quaterniond& rotation : candidates.rotations())
    distinct.insert(fingerprint(rotation));
  EXPECT_EQ(744u, distinct.size());
}

TEST(EulerRotations, FillTheCircleWhateverTheStep)
{
  // 50 degrees do not divide the circle: the nearest step that does makes 7 of them
  EXPECT_EQ(343u, EulerRotations(50.0 * M_PI / 180.0).rotations().size());
  EXPECT_EQ(8u, EulerRotations(M_PI).rotations().size());
  EXPECT_EQ(1u, EulerRotations(10.0).rotations().size());
}

TEST(EulerRotations, HaveNeighboursAllAround)
{
  constexpr int steps = 12;
  const EulerRotations candidates(paper_step);
  for (const unsigned int kernel : {3u, 5u, 7u})
    for (const int x : {0, 1, 5, 11})
      for (const int y : {0, 6, 11})
        for (const int z : {0, 2, 10, 11}) {
          const int reach = kernel / 2;
          std::set<std::size_t> expected;
          for (int dx = -reach; dx <= reach; ++dx)
            for (int dy = -reach; dy <= reach; ++dy)
              for (int dz = -reach; dz <= reach; ++dz)
                if (dx || dy || dz)
                  expected.insert(
                      ((x + dx + steps) % steps * steps + (y + dy + steps) % steps) *
                          steps +
                      (z + dz + steps) % steps);
          const auto found = candidates.neighbours((x * steps + y) * steps + z, kernel);
          EXPECT_EQ(kernel * kernel * kernel - 1, found.size());
          EXPECT_EQ(expected, std::set<std::size_t>(found.begin(), found.end()));
        }
}

TEST(EulerRotations, KnowTheNeighboursOfEachKernel)
{
  // as a set that has not been asked before
  const EulerRotations candidates(paper_step);
  for (const unsigned int kernel : {3u, 5u, 3u, 3u, 7u, 5u})
    for (const std::size_t i : {0u, 700u, 1727u})
      EXPECT_EQ(EulerRotations(paper_step).neighbours(i, kernel),
                candidates.neighbours(i, kernel));
}

TEST(EulerRotations, TakeEvenKernelsAsTheNextOddOne)
{
  const EulerRotations candidates(paper_step);
  for (const std::size_t i : {0u, 700u, 1727u})
    for (const unsigned int kernel : {2u, 4u, 6u}) {
      const std::vector<std::size_t> odd = candidates.neighbours(i, kernel + 1);
      EXPECT_EQ(odd, candidates.neighbours(i, kernel));
    }
}

TEST(EulerRotations, HaveEachNeighbourOnceWhereTheKernelIsWiderThanTheCircle)
{
  const EulerRotations candidates(M_PI / 2.0);
  for (const unsigned int kernel : {5u, 7u, 101u}) {
    const auto found = candidates.neighbours(21, kernel);
    EXPECT_EQ(63u, found.size());
    EXPECT_EQ(63u, std::set<std::size_t>(found.begin(), found.end()).size());
    EXPECT_EQ(0, std::count(found.begin(), found.end(), 21u));
  }
}

TEST(EvenRotations, HoldAnyNumberOfDistinctRotations)
{
  for (const unsigned int number : {1u, 2u, 17u, 500u, 1728u}) {
    const EvenRotations candidates(number);
    ASSERT_EQ(number, candidates.rotations().size());
    std::set<std::array<int, 9>> distinct;
    for (const Eigen::Quaterniond& rotation : candidates.rotations()) {
      EXPECT_NEAR(1.0, rotation.norm(), 1e-12);
      distinct.insert(fingerprint(rotation));
    }
    EXPECT_EQ(number, distinct.size());
  }
}

TEST(EvenRotations, AreNotBunched)
{
  // On SO(3), of volume 8 pi^2, 1728 rotations have room for balls of 0.22 rad each;
  // an even set leaves each most of it.
  const EvenRotations candidates(1728);
  const auto& rotations = candidates.rotations();
  double nearest = M_PI;
  for (std::size_t i = 0; i < rotations.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      nearest = std::min(nearest, rotations[i].angularDistance(rotations[j]));
  EXPECT_GT(nearest, 0.15);
}

TEST(EvenRotations, HaveABallOfNeighbours)
{
  const EvenRotations candidates(1728);
  const auto& rotations = candidates.rotations();
  const double step = std::cbrt(8.0 * M_PI * M_PI / 1728.0);
  for (const unsigned int kernel : {3u, 4u, 5u, 7u}) {
    const double radius = 0.5 * (kernel - 1.0) * step;
    for (const std::size_t i : {0u, 1u, 863u, 1727u}) {
      std::vector<std::size_t> expected;
      for (std::size_t j = 0; j < rotations.size(); ++j)
        if (j != i && rotations[i].angularDistance(rotations[j]) <= radius)
          expected.push_back(j);
      auto found = candidates.neighbours(i, kernel);
      std::sort(found.begin(), found.end());
      EXPECT_EQ(expected, found);
    }
    // as many as the ball has room for besides the one in its middle
    double mean = 0.0;
    for (std::size_t i = 0; i < rotations.size(); i += 8)
      mean += candidates.neighbours(i, kernel).size() / 216.0;
    const double room = 4.0 / 3.0 * M_PI * std::pow(0.5 * (kernel - 1.0), 3) - 1.0;
    EXPECT_NEAR(room, mean, 0.3 * room) << kernel;
  }
}

TEST(EvenRotations, AreNeighboursOfEachOther)
{
  const EvenRotations candidates(300);
  for (std::size_t i = 0; i < 300; ++i)
    for (const std::size_t j : candidates.neighbours(i, 5)) {
      const auto back = candidates.neighbours(j, 5);
      EXPECT_EQ(1, std::count(back.begin(), back.end(), i));
    }
}

TEST(CandidateRotations, LeaveNoRotationFar)
{
  // Each Euler angle is at most half a step off, which adds up to at most 26 degrees
  // for three axes at right angles and 30 where two of them fall together.
  const double euler = coveringDegrees(EulerRotations(paper_step));
  EXPECT_LT(euler, 30.0);
  // as many even rotations do better: cells of (20.5 degrees)^3
  const double even = coveringDegrees(EvenRotations(1728));
  EXPECT_LT(even, 20.5);
  EXPECT_LT(even, euler);
}

TEST(CandidateRotations, AreThoseTheSettingsAskFor)
{
  Settings settings;
  const auto by_default = candidateRotations(settings);
  EXPECT_EQ(1728u, by_default->rotations().size());
  EXPECT_NE(nullptr, dynamic_cast<const EvenRotations*>(by_default.get()));
  const auto of_the_paper = candidateRotations(paperSettings(settings));
  EXPECT_EQ(1728u, of_the_paper->rotations().size());
  EXPECT_NE(nullptr, dynamic_cast<const EulerRotations*>(of_the_paper.get()));
  settings.rotation_set = RotationSet::EULER;
  settings.angle_step = M_PI / 2.0;
  EXPECT_EQ(64u, candidateRotations(settings)->rotations().size());
  settings.rotation_set = RotationSet::EVEN;
  settings.even_rotations = 77;
  EXPECT_EQ(77u, candidateRotations(settings)->rotations().size());
}

TEST(Rotations, UprightOnesGoRoundTheAxis)
{
  Settings settings;
  settings.rotation_axis = RotationAxis::Y;
  for (const RotationSet set : {RotationSet::EVEN, RotationSet::EULER}) {
    settings.rotation_set = set;
    const auto upright = candidateRotations(settings);
    const auto& rotations = upright->rotations();
    // no farther apart than those of the whole set
    ASSERT_GE(rotations.size(), 24u);
    const double step = 2.0 * M_PI / static_cast<double>(rotations.size());
    for (std::size_t i = 0; i < rotations.size(); ++i) {
      EXPECT_TRUE((rotations[i] * Eigen::Vector3d::UnitY())
                      .isApprox(Eigen::Vector3d::UnitY(), 1e-12));
      const std::size_t next = (i + 1) % rotations.size();
      EXPECT_NEAR(step, rotations[i].angularDistance(rotations[next]), 1e-9);
    }
    // a kernel of three steps of the whole set: two steps to either side, all round
    const std::size_t last = rotations.size() - 1;
    EXPECT_EQ((std::vector<std::size_t>{1, 2, last - 1, last}),
              upright->neighbours(0, 3));
    EXPECT_EQ(last, upright->neighbours(5, 4000000000u).size());
  }
}

} // namespace
