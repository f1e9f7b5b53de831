/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "poses.h"

#include "search/candidate_search.h"
#include <pcl/registration/kss/detail/stopping.h>

#include "candidates/neighbours.h"
#include "search/exact/known_distances.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <memory>
#include <numeric>
#include <random>
#include <stdexcept>

/** \file
 * Sets of rotations as large as settings allow.
 */

namespace {

using namespace kss_test;
using namespace pcl::kss;

/** Sixteen times as many take less than so many times the time: as many as that if the
 * time is linear, 256 if each is compared with all. */
constexpr double most_growth = 90.0;

template <typename Work>
double
cpuSeconds(const Work& work)
{
  const std::clock_t start = std::clock();
  work();
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

/** How many times as long the work takes with the second argument. */
template <typename Work, typename Argument>
double
growth(const Work& work, const Argument& few, const Argument& many)
{
  double least = cpuSeconds([&] { work(few); });
  for (int i = 0; i < 4; ++i)
    least = std::min(least, cpuSeconds([&] { work(few); }));
  return cpuSeconds([&] { work(many); }) / std::max(least, 1e-4);
}

Candidates
candidatesOf(const std::shared_ptr<const CandidateRotations>& rotations)
{
  return Candidates(rotations, {1.0}, ownCenter(), Role::TARGET);
}

/** Every distance is 1 and its bounds are 0 and 2. */
class FixedBounds : public BoundsEvaluator {
public:
  void
  setClouds(const Points&, const Points&, const BoundsScope&) override
  {
  }

  std::vector<DistanceBounds>
  evaluate(const std::vector<Placement>& placements, Eigen::Index) override
  {
    return std::vector<DistanceBounds>(placements.size(), {{0, 0, 0, 0}, {2, 2, 2, 2}});
  }
};

class FixedDistances : public DistanceEvaluator {
public:
  void
  setClouds(const Points&, const Points&, float) override
  {
  }

  std::vector<DirectedDistances>
  evaluate(const std::vector<Placement>& placements) override
  {
    return std::vector<DirectedDistances>(placements.size(), {1, 1, 1, 1});
  }

  std::string
  deviceName() const override
  {
    return "fixed";
  }
};

TEST(ManyRotations, HaveTheNeighboursThatAskingAllFinds)
{
  for (const unsigned int number : {1u, 2u, 7u, 240u}) {
    const EvenRotations candidates(number);
    const auto& rotations = candidates.rotations();
    const double step = std::cbrt(8.0 * M_PI * M_PI / number);
    for (const unsigned int kernel : {1u, 2u, 3u, 4u, 8u, 13u, 1000u}) {
      const double radius = std::min(M_PI, 0.5 * (kernel - 1.0) * step);
      for (std::size_t i = 0; i < number; ++i) {
        std::vector<std::size_t> expected;
        for (std::size_t j = 0; j < number; ++j)
          if (j != i &&
              std::abs(rotations[i].dot(rotations[j])) >= std::cos(0.5 * radius))
            expected.push_back(j);
        ASSERT_EQ(expected, candidates.neighbours(i, kernel)) << number << ' ' << i;
      }
    }
  }
}

TEST(ManyRotations, FindTheirNeighboursInLinearTime)
{
  const auto work = [](unsigned int number) {
    const EvenRotations candidates(number);
    for (std::size_t i = 0; i < number; ++i)
      candidates.neighbours(i, 3);
  };
  EXPECT_LT(growth(work, 2500u, 40000u), most_growth);
}

TEST(ManyRotations, AreDistinctAsIfEachWereComparedWithAll)
{
  const auto rotations = std::make_shared<EulerRotations>(M_PI / 5.0);
  CandidateCenters centers = ownCenter();
  centers.centers.resize(2, Eigen::Vector3d::Ones());
  centers.steps = {2, 1, 1};
  const Candidates candidates(rotations, {0.8, 1.0}, centers, Role::TARGET);
  std::vector<std::size_t> order(candidates.size());
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), std::mt19937(4));
  for (const double angle : {1e-6, 0.1, M_PI / 18.0, 0.7, 3.0, 7.0}) {
    std::vector<std::size_t> expected;
    for (const std::size_t i : order)
      if (std::none_of(expected.begin(), expected.end(), [&](std::size_t j) {
            const auto &a = rotations->rotations()[i / 4],
                       &b = rotations->rotations()[j / 4];
            return i % 4 == j % 4 && std::abs(a.dot(b)) > std::cos(0.5 * angle);
          }))
        expected.push_back(i);
    EXPECT_EQ(expected, candidates.distinct(order, angle)) << angle;
  }
}

TEST(ManyRotations, AreDistinctInLinearTime)
{
  // no two of them are the same, so that each would be compared with all before
  const auto work = [](unsigned int number) {
    const Candidates candidates = candidatesOf(std::make_shared<EvenRotations>(number));
    std::vector<std::size_t> all(number);
    std::iota(all.begin(), all.end(), 0);
    EXPECT_EQ(number, candidates.distinct(all, 0.02).size());
  };
  EXPECT_LT(growth(work, 2500u, 40000u), most_growth);
}

TEST(ManyRotations, AreBoundedOnceWhereTheyAreTheSame)
{
  const auto rotations = std::make_shared<EulerRotations>(M_PI / 6.0);
  const Candidates candidates = candidatesOf(rotations);
  FixedBounds bounds;
  FixedDistances distances;
  for (std::size_t i = 0; i < candidates.size(); i += 7) {
    KnownDistances known(candidates, 100, bounds, distances);
    std::vector<std::size_t> expected;
    for (std::size_t j = 0; j < candidates.size(); ++j)
      if (std::abs(rotations->rotations()[i].dot(rotations->rotations()[j])) >
          1.0 - 1e-12)
        expected.push_back(j);
    EXPECT_EQ(expected, known.raise({i}, 1));
    EXPECT_EQ(1u, known.effort().levels.front().candidates);
  }
}

TEST(ManyRotations, AreComparedInLinearTime)
{
  FixedBounds bounds;
  FixedDistances distances;
  const auto work = [&](int steps) {
    const auto rotations = std::make_shared<EulerRotations>(2.0 * M_PI / steps);
    KnownDistances known(candidatesOf(rotations), 100, bounds, distances);
  };
  EXPECT_LT(growth(work, 15, 38), most_growth); // 3375 and 54872 rotations
}

TEST(ManyRotations, AreRefusedWhereTheyTakeTooMuchMemory)
{
  // 79^3 rotations and 5^3 centres
  Settings settings = paperSettings({});
  settings.mode = Mode::PARTIAL_GLOBAL;
  settings.angle_step = 0.08;
  settings.device = "host";
  CandidateSearch search(settings);
  const Points cloud = Points::Random(3, 20);
  try {
    search.localMinima(cloud, cloud, {1.0, 1.0}, PoseMetric(cloud),
                       {search_numbers::of_two_parts, 1e9, 0.35f, 8000, 80},
                       [](double) {});
    FAIL() << "61,629,875 candidates are searched";
  }
  catch (const std::invalid_argument& refusal) {
    EXPECT_STREQ("There are too many candidate poses, 61629875: they would take 5 GB, "
                 "but 4 GB at most are used; take fewer rotations or a larger angle "
                 "step.",
                 refusal.what());
  }
}

TEST(ManyRotations, AskWhetherToStop)
{
  const auto even = std::make_shared<EvenRotations>(100);
  const Candidates candidates = candidatesOf(even);
  const std::vector<float> energies(100, 1.0f);
  const std::vector<std::size_t> some{0, 1};
  FixedBounds bounds;
  FixedDistances distances;
  KnownDistances known(candidates, 100, bounds, distances);
  const CandidateNeighbours neighbours(candidates, 3);
  const std::vector<char> rows(100, 1);

  StopSignal signal;
  signal.cancel();
  const HeedingSignal heeding(&signal);
  EXPECT_THROW(candidates.localMinima(energies, 3, 0.1), Stopped);
  EXPECT_THROW(candidates.distinct(some, 0.1), Stopped);
  EXPECT_THROW(KnownDistances(candidates, 100, bounds, distances), Stopped);
  EXPECT_THROW(known.raise(some, 1), Stopped);
  EXPECT_THROW(known.raise(some, known.exact()), Stopped);
  EXPECT_THROW(neighbours.lowestAround(energies, rows), Stopped);
  EXPECT_THROW(neighbours.highestAround(energies, rows), Stopped);
}

} // namespace
