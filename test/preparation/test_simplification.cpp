/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "shapes.h"

#include "preparation/simplification.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace {

using namespace kss_test;
using pcl::kss::Density;
using pcl::kss::inFarthestOrder;
using pcl::kss::neighbourhoodsOf;
using pcl::kss::random_points;
using pcl::kss::simplify;

constexpr auto densities = {Density::UNIFORM, Density::PAPER, random_points};

const char*
nameOf(Density density)
{
  switch (density) {
  case Density::UNIFORM:
    return "UNIFORM";
  case Density::PAPER:
    return "PAPER";
  default:
    return "RANDOM";
  }
}

/** How many of k samples a cloud can spread evenly. */
std::size_t
evenSampleSize(const Points& cloud, std::size_t k, unsigned int threads)
{
  return pcl::kss::evenSampleSize(inFarthestOrder(cloud, k),
                                  neighbourhoodsOf(cloud, 12, threads));
}

using Coordinates = std::array<float, 3>;

std::multiset<Coordinates>
contentsOf(const Points& points)
{
  std::multiset<Coordinates> contents;
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    contents.insert({points(0, i), points(1, i), points(2, i)});
  return contents;
}

/** Whether each sample is a point of the cloud, and none is taken twice. */
bool
isSubset(const Points& samples, const Points& cloud)
{
  const auto few = contentsOf(samples), many = contentsOf(cloud);
  return std::includes(many.begin(), many.end(), few.begin(), few.end());
}

float
distanceTo(const Eigen::Vector3f& point, const Points& points)
{
  return std::sqrt((points.colwise() - point).colwise().squaredNorm().minCoeff());
}

/** The distance of every point to its nearest companion. */
std::vector<float>
gapsOf(const Points& points)
{
  std::vector<float> gaps;
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    Eigen::RowVectorXf squared =
        (points.colwise() - points.col(i)).colwise().squaredNorm();
    squared[i] = std::numeric_limits<float>::max();
    gaps.push_back(std::sqrt(squared.minCoeff()));
  }
  return gaps;
}

float
smallestGap(const Points& points)
{
  const auto gaps = gapsOf(points);
  return *std::min_element(gaps.begin(), gaps.end());
}

/** The largest distance from a point of the cloud to its nearest sample. */
float
coveringRadius(const Points& samples, const Points& cloud)
{
  float radius = 0.0f;
  for (Eigen::Index i = 0; i < cloud.cols(); ++i)
    radius = std::max(radius, distanceTo(cloud.col(i), samples));
  return radius;
}

/** Farthest point sampling as the textbooks have it, over the whole cloud. */
Points
farthestPoints(const Points& cloud, Eigen::Index k)
{
  Points samples(3, k);
  Eigen::RowVectorXf squared =
      Eigen::RowVectorXf::Constant(cloud.cols(), std::numeric_limits<float>::max());
  Eigen::Index next = 0;
  for (Eigen::Index i = 0; i < k; ++i) {
    samples.col(i) = cloud.col(next);
    squared =
        squared.cwiseMin((cloud.colwise() - cloud.col(next)).colwise().squaredNorm());
    squared.maxCoeff(&next);
  }
  return samples;
}

/** A unit square whose density falls off exponentially, by a factor of 50. */
Points
unevenSquare(Eigen::Index number, unsigned int seed)
{
  const Points even = scattered(number, seed);
  Points uneven = even;
  const double steepness = std::log(50.0);
  for (Eigen::Index i = 0; i < number; ++i) {
    const double share = even(0, i) * (1.0 - std::exp(-steepness));
    uneven(0, i) = static_cast<float>(-std::log1p(-share) / steepness);
    uneven(2, i) = 0.0f;
  }
  return uneven;
}

/** How many of the points lie in each of five stripes along x. */
std::array<double, 5>
stripesOf(const Points& points)
{
  std::array<double, 5> stripes{};
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    stripes[std::min(4, static_cast<int>(points(0, i) * 5.0f))] += 1.0;
  return stripes;
}

double
secondsFor(const Points& cloud, unsigned int k, Density density)
{
  double best = std::numeric_limits<double>::max();
  for (int run = 0; run < 3; ++run) {
    const auto start = std::chrono::steady_clock::now();
    simplify(cloud, k, density, 1);
    const std::chrono::duration<double> seconds =
        std::chrono::steady_clock::now() - start;
    best = std::min(best, seconds.count());
  }
  return best;
}

TEST(Simplification, GivesExactlyKOfThePoints)
{
  for (const Eigen::Index n : {1, 2, 3, 10, 100, 999, 5000, 30000}) {
    const Points surface = sampled(creature(), n, 1);
    const Points body = scattered(n, 2);
    for (const unsigned int k : {1u, 2u, 3u, 20u, 64u, 500u, 2000u})
      for (const Density density : densities)
        for (const Points* cloud : {&surface, &body}) {
          const Points samples = simplify(*cloud, k, density, 1);
          ASSERT_EQ(std::min<Eigen::Index>(k, n), samples.cols())
              << n << " points, " << nameOf(density);
          ASSERT_TRUE(isSubset(samples, *cloud)) << n << " points to " << k;
        }
  }
}

TEST(Simplification, GivesExactlyKNearAStrayPoint)
{
  // A single wrong echo far away makes the bounding box say nothing about the shape.
  for (const float distance : {1e2f, 1e5f}) {
    Points cloud = sampled(creature(), 40000, 3);
    cloud.col(17).setConstant(distance);
    for (const Density density : densities)
      EXPECT_EQ(2000, simplify(cloud, 2000, density, 1).cols())
          << "stray point at " << distance << ", " << nameOf(density);
  }
}

TEST(Simplification, TakesCopiesOfAPointLast)
{
  const Points once = scattered(300, 4);
  Points thrice(3, 900);
  thrice << once, once, once;
  for (const Density density : densities) {
    const Points few = simplify(thrice, 100, density, 1);
    EXPECT_EQ(100, few.cols()) << nameOf(density);
    EXPECT_TRUE(isSubset(few, thrice)) << nameOf(density);
  }
  for (const Density density : densities) {
    // all points where the cloud has no more, the copies at the end
    const Points all = simplify(thrice, 900, density, 1);
    EXPECT_TRUE(contentsOf(thrice) == contentsOf(all)) << nameOf(density);
    EXPECT_TRUE(contentsOf(once) == contentsOf(all.leftCols(300))) << nameOf(density);
  }
  for (const unsigned int k : {100u, 300u})
    EXPECT_TRUE(isSubset(simplify(thrice, k, Density::UNIFORM, 1), once)) << k;
}

TEST(Simplification, SpreadsAsEvenlyAsFarthestPointSampling)
{
  for (const unsigned int k : {100u, 1000u}) {
    const Points cloud = sampled(creature(), 20000, 5);
    const Points samples = simplify(cloud, k, Density::UNIFORM, 1);
    const Points reference = farthestPoints(cloud, k);
    const auto gaps = gapsOf(samples);
    const float mean = std::accumulate(gaps.begin(), gaps.end(), 0.0f) / k;
    EXPECT_GT(smallestGap(samples), 0.6f * mean);
    // the textbook's but for the first point
    EXPECT_GT(smallestGap(samples), 0.95f * smallestGap(reference));
    EXPECT_LT(coveringRadius(samples, cloud), 1.05f * coveringRadius(reference, cloud));
  }
}

TEST(Simplification, DrawsPointsWithoutRegardToTheirPlace)
{
  const Points cloud = unevenSquare(40000, 6);
  const Points samples = simplify(cloud, 2000, random_points, 1);
  EXPECT_TRUE(samples == simplify(cloud, 2000, random_points, 2));
  const auto input = stripesOf(cloud), drawn = stripesOf(samples);
  for (int stripe = 0; stripe < 5; ++stripe) // five standard deviations
    EXPECT_NEAR(input[stripe] / 20.0, drawn[stripe],
                5.0 * std::sqrt(input[stripe] / 20.0))
        << stripe;
  // far from even: some of the draws are near neighbours
  EXPECT_LT(smallestGap(samples),
            0.2f * smallestGap(simplify(cloud, 2000, Density::UNIFORM, 1)));
}

TEST(Simplification, EvensOutASteepDensityGradient)
{
  const Points cloud = unevenSquare(40000, 6);
  const unsigned int k = 500;
  const auto input = stripesOf(cloud);
  ASSERT_GT(input[0], 10.0 * input[4]); // else the test would say nothing
  const auto uniform = stripesOf(simplify(cloud, k, Density::UNIFORM, 1));
  const auto reference = stripesOf(farthestPoints(cloud, k));
  const auto paper = stripesOf(simplify(cloud, k, Density::PAPER, 1));
  for (int stripe = 0; stripe < 5; ++stripe) {
    EXPECT_NEAR(reference[stripe], uniform[stripe], 0.2 * reference[stripe]) << stripe;
    // 500 of 40000 points, rounded in each of a few dozen voxels
    EXPECT_NEAR(input[stripe] * k / 40000.0, paper[stripe], 0.05 * k) << stripe;
  }
}

TEST(Simplification, KeepsThePapersQuotas)
{
  // (e5) recomputed for a cloud whose voxels no rounding can blur: the box has the edge
  // 1, and [cbrt(4096) / 2] = 8 divisions.
  constexpr Eigen::Index n = 4096;
  Points cloud = scattered(n, 7).array().pow(1.5f);
  cloud.col(0).setZero();
  cloud.col(1).setOnes();
  const auto countsOf = [](const Points& points) {
    std::map<std::array<int, 3>, std::size_t> counts;
    for (Eigen::Index i = 0; i < points.cols(); ++i) {
      const Eigen::Vector3i cell = (points.col(i) * 8.0f).cast<int>();
      ++counts[{cell.x(), cell.y(), cell.z()}];
    }
    return counts;
  };
  const auto available = countsOf(cloud);
  for (const std::size_t k : {100u, 777u, 2000u, 4000u}) {
    auto taken = countsOf(simplify(cloud, k, Density::PAPER, 1));
    std::size_t smallest_rounded_up = n, largest_rounded_down = 0;
    for (const auto& voxel : available) {
      const std::size_t share = voxel.second * k / n;
      const std::size_t remainder = voxel.second * k % n;
      const std::size_t quota = taken[voxel.first];
      ASSERT_GE(quota, share);
      ASSERT_LE(quota, share + 1);
      if (quota > share)
        smallest_rounded_up = std::min(smallest_rounded_up, remainder);
      else
        largest_rounded_down = std::max(largest_rounded_down, remainder);
    }
    // the shares with the largest remainders are the ones rounded up
    EXPECT_GE(smallest_rounded_up, largest_rounded_down);
  }
}

TEST(Simplification, DoesNotDependOnThreads)
{
  const Points cloud = sampled(creature(), 30000, 8);
  for (const Density density : densities) {
    const Points one = simplify(cloud, 1000, density, 1);
    EXPECT_EQ(one, simplify(cloud, 1000, density, 1)) << nameOf(density);
    for (const unsigned int threads : {0u, 2u, 3u, 8u})
      EXPECT_EQ(one, simplify(cloud, 1000, density, threads)) << nameOf(density);
  }
  EXPECT_EQ(evenSampleSize(cloud, 5000, 1), evenSampleSize(cloud, 5000, 3));
}

TEST(Simplification, DoesNotDependOnTheUnit)
{
  // A power of two scales floats without rounding: nothing at all may change.
  const Points cloud = sampled(creature(), 20000, 9);
  for (const float unit : {0x1p-20f, 0x1p10f, 0x1p20f})
    for (const Density density : densities) {
      const Points samples = simplify(cloud, 500, density, 1);
      EXPECT_EQ(Points(samples * unit), simplify(cloud * unit, 500, density, 1))
          << nameOf(density) << " times " << unit;
      EXPECT_EQ(evenSampleSize(cloud, 5000, 1), evenSampleSize(cloud * unit, 5000, 1));
    }
}

TEST(Simplification, DoesNotDependOnThePlace)
{
  // Multiples of 1/1024, shifted by whole numbers, stay exact.
  const Points cloud =
      (sampled(creature(), 20000, 10) * 1024.0f).array().round() / 1024.0f;
  const Eigen::Vector3f shift(512.0f, -256.0f, 1024.0f);
  const Points shifted = cloud.colwise() + shift;
  const Points here = simplify(cloud, 500, Density::UNIFORM, 1);
  const Points there = simplify(shifted, 500, Density::UNIFORM, 1);
  // ties may fall otherwise, the quality may not
  EXPECT_TRUE(isSubset(there.colwise() - shift, cloud));
  EXPECT_NEAR(smallestGap(here), smallestGap(there), 0.1f * smallestGap(here));
  EXPECT_NEAR(coveringRadius(here, cloud), coveringRadius(there, shifted),
              0.15f * coveringRadius(here, cloud));
}

TEST(Simplification, TakesTimeInProportionToTheCloud)
{
  const Points small = sampled(creature(), 50000, 11);
  const Points large = sampled(creature(), 200000, 12);
  for (const Density density : densities) {
    // four times the points: a quadratic cost would take sixteen times as long
    const double few = std::max(0.01, secondsFor(small, 1000, density));
    EXPECT_LT(secondsFor(large, 1000, density), 10.0 * few) << nameOf(density);
  }
}

TEST(Simplification, LeavesNothingToDoubtForDegenerateClouds)
{
  const Points one = Points::Constant(3, 1, 2.5f);
  const Points equal = Points::Constant(3, 500, 2.5f);
  Points line(3, 2000);
  for (Eigen::Index i = 0; i < line.cols(); ++i)
    line.col(i) = Eigen::Vector3f(1.0f, 2.0f, -1.0f) * static_cast<float>(i);
  for (const Density density : densities) {
    EXPECT_EQ(one, simplify(one, 100, density, 1)) << nameOf(density);
    const Points samples = simplify(equal, 100, density, 1);
    ASSERT_GE(samples.cols(), 1) << nameOf(density);
    EXPECT_TRUE(isSubset(samples, equal)) << nameOf(density);
    EXPECT_EQ(100, simplify(line, 100, density, 1).cols()) << nameOf(density);
  }
  // of 2000 places in a row, 100 even ones are 20 apart
  const float step = std::sqrt(6.0f);
  EXPECT_GE(smallestGap(simplify(line, 100, Density::UNIFORM, 1)), 10.0f * step);
  EXPECT_EQ(1u, evenSampleSize(one, 100, 1));
  EXPECT_GE(evenSampleSize(equal, 100, 1), 1u);
}

TEST(EvenSampleSize, ShrinksForSparseCloudsOnly)
{
  const Points dense = sampled(creature(), 50000, 13);
  EXPECT_EQ(1000u, evenSampleSize(dense, 1000, 1));
  for (const Eigen::Index n : {300, 2100}) {
    // Points at random leave holes; as many samples as points would show them.
    const Points sparse = sampled(creature(), n, 14);
    const std::size_t k = evenSampleSize(sparse, 2000, 1);
    EXPECT_LT(k, 0.8 * n);
    EXPECT_GT(k, 0.1 * n);
    // so many samples are even, indeed
    const auto gaps = gapsOf(simplify(sparse, k, Density::UNIFORM, 1));
    const float mean = std::accumulate(gaps.begin(), gaps.end(), 0.0f) / k;
    EXPECT_GT(*std::min_element(gaps.begin(), gaps.end()), 0.5f * mean);
  }
  // too few points to be choosy
  EXPECT_EQ(40u, evenSampleSize(sampled(creature(), 40, 15), 2000, 1));
  EXPECT_EQ(64u, evenSampleSize(sampled(creature(), 70, 16), 2000, 1));
  for (const unsigned int k : {1u, 2u, 20u, 200u})
    EXPECT_LE(evenSampleSize(dense, k, 1), k);
}

} // namespace
