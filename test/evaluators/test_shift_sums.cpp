/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "poses.h"

#include "evaluators/evaluator_choice.h"
#include "evaluators/shift_sums.h"

#include <pcl/registration/kss/devices.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace {

using namespace kss_test;
using namespace pcl::kss;

/** A cloud in pre-shape space. */
Points
shape(Eigen::Index number, unsigned int seed)
{
  Points points = sampled(creature(), number, seed);
  points.colwise() -= points.rowwise().mean().eval();
  return points / std::sqrt(points.squaredNorm() / number);
}

/** A grid of 2 n + 1 centres along each of three axes that are turned somehow. */
CandidateCenters
gridOf(const Eigen::Array3i& n, const Eigen::Array3d& spacing, unsigned int seed)
{
  std::mt19937 random(seed);
  CandidateCenters found;
  found.axes = randomRotation(random).toRotationMatrix();
  found.spacing = spacing;
  for (int x = -n.x(); x <= n.x(); ++x)
    for (int y = -n.y(); y <= n.y(); ++y)
      for (int z = -n.z(); z <= n.z(); ++z)
        found.centers.push_back(found.axes *
                                (spacing * Eigen::Array3d(x, y, z)).matrix());
  for (int axis = 0; axis < 3; ++axis)
    found.steps[axis] = 2 * n[axis] + 1;
  return found;
}

/** Grids of one centre, of a few, and of more than fill one, two vectors along z; some
 * with nodes between the centres. */
std::vector<CandidateCenters>
grids(const Points& cloud)
{
  return {ownCenter(),
          paperCenters(cloud),
          spreadCenters(cloud, 1.6, 0.3),
          gridOf({0, 0, 0}, {0.2, 0.3, 0.1}, 1),
          gridOf({1, 2, 3}, {0.3, 0.1, 0.25}, 2),
          gridOf({2, 0, 1}, {0.05, 0.3, 0.5}, 3),
          gridOf({0, 1, 7}, {0.0, 0.4, 0.1}, 4),
          gridOf({1, 0, 8}, {0.1, 0.0, 0.2}, 5),
          gridOf({0, 0, 16}, {0.3, 0.3, 0.05}, 6),
          gridOf({3, 1, 0}, {0.12, 0.9, 0.3}, 7)};
}

std::vector<Eigen::Matrix3f>
turns(int number, unsigned int seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> scale(0.5, 2.0);
  std::vector<Eigen::Matrix3f> found;
  for (int i = 0; i < number; ++i) {
    const double factor = scale(random);
    found.push_back((factor * randomRotation(random).toRotationMatrix()).cast<float>());
  }
  return found;
}

/** The sums of all turns at all centres, without what fills up the rows. */
std::vector<std::vector<int>>
sumsOf(ShiftSums& sums,
       const ShiftLattice& lattice,
       const Points& probes,
       const std::vector<Eigen::Matrix3f>& turns)
{
  std::vector<Placement> placements;
  for (const Eigen::Matrix3f& linear : turns)
    placements.push_back(lattice.toNodes(linear));
  const auto found = sums.sums(probes, placements);
  const std::size_t block = 16 * lattice.rows().size();
  EXPECT_EQ(block * turns.size(), found.size());
  std::vector<std::vector<int>> sums_of;
  for (std::size_t t = 0; t < turns.size(); ++t) {
    sums_of.emplace_back();
    for (const std::uint32_t place : lattice.places())
      sums_of.back().push_back(found[t * block + place]);
  }
  return sums_of;
}

/** A distance as it counts. */
double
counted(const Points& cloud, const Eigen::Vector3f& position, float limit)
{
  const float squared = (cloud.colwise() - position).colwise().squaredNorm().minCoeff();
  return 255.0 / limit * std::min(limit, std::sqrt(squared));
}

class Sums : public ::testing::TestWithParam<const char*> {
protected:
  void
  SetUp() override
  {
    if (GetParam() != std::string("host") && openCLDeviceNames().empty())
      GTEST_SKIP() << "There is no OpenCL device on this machine.";
  }

  std::unique_ptr<ShiftSums>
  make(unsigned int threads = 1) const
  {
    Settings settings;
    settings.device = GetParam();
    settings.threads = threads;
    return makeShiftSums(settings);
  }
};

TEST_P(Sums, AreAsRightAsACellIsSmall)
{
  const Points cloud = shape(300, 1), probes = shape(40, 2);
  const auto sums = make();
  for (const float limit : {0.35f, 0.2f})
    for (const CandidateCenters& centers : grids(cloud)) {
      const ShiftLattice lattice(cloud, centers, limit);
      ASSERT_EQ(centers.centers.size(), lattice.places().size());
      EXPECT_LT(lattice.step().maxCoeff(), 0.36f * limit);
      sums->setField(cloud, lattice);
      const auto linear = turns(5, 3);
      const auto found = sumsOf(*sums, lattice, probes, linear);
      // half a diagonal of a cell, and rounding to bytes
      const double rough = 0.5 * lattice.step().matrix().norm() * 255.0 / limit + 0.51;
      double bias = 0.0;
      std::size_t number = 0;
      for (std::size_t t = 0; t < linear.size(); ++t)
        for (std::size_t c = 0; c < centers.centers.size(); ++c, ++number) {
          const Points placed =
              (linear[t] * probes).colwise() + centers.centers[c].cast<float>().eval();
          double expected = 0.0;
          for (Eigen::Index p = 0; p < placed.cols(); ++p)
            expected += counted(cloud, placed.col(p), limit);
          ASSERT_NEAR(expected, found[t][c], rough * probes.cols());
          bias += (found[t][c] - expected) / probes.cols();
        }
      // too near as often as too far, hardly on a surface, though
      EXPECT_LT(std::abs(bias / number), 0.25 * rough);
    }
}

TEST_P(Sums, AreThoseOfTheNearestNodes)
{
  const Points cloud = shape(300, 4), probes = shape(128, 5);
  constexpr float limit = 0.35f;
  const auto sums = make();
  std::size_t number = 0, different = 0;
  for (const CandidateCenters& centers : grids(cloud)) {
    const ShiftLattice lattice(cloud, centers, limit);
    sums->setField(cloud, lattice);
    const auto linear = turns(4, 6);
    const auto found = sumsOf(*sums, lattice, probes, linear);
    for (std::size_t t = 0; t < linear.size(); ++t)
      for (std::size_t c = 0; c < centers.centers.size(); c += 5, ++number) {
        long expected = 0;
        for (Eigen::Index p = 0; p < probes.cols(); ++p) {
          const Eigen::Vector3d placed =
              (linear[t] * probes.col(p)).cast<double>() + centers.centers[c];
          const Eigen::Array3d node = (((centers.axes.transpose() * placed).array() -
                                        lattice.lower().cast<double>()) /
                                       lattice.step().cast<double>())
                                          .round();
          const bool is_inner =
              (node >= 0.0).all() && (node < lattice.inner().cast<double>()).all();
          const Eigen::Vector3d nearest =
              centers.axes *
              (lattice.lower().cast<double>() + node * lattice.step().cast<double>())
                  .matrix();
          expected += is_inner
                          ? std::lround(counted(cloud, nearest.cast<float>(), limit))
                          : 255;
        }
        different += expected != found[t][c];
        // on the border of two cells rounding decides
        ASSERT_NEAR(expected, found[t][c], 0.01 * 255.0 * probes.cols());
      }
  }
  EXPECT_LT(different, 0.05 * number);
}

TEST_P(Sums, CountTheLimitFarAway)
{
  // no point of this one comes near, whatever the centre
  const Points cloud = shape(200, 7);
  const Points probes = sampled(ellipsoid({0, 0, 0}, {1, 1, 1}), 128, 8);
  const auto sums = make();
  for (const CandidateCenters& centers : grids(cloud)) {
    const ShiftLattice lattice(cloud, centers, 0.35f);
    sums->setField(cloud, lattice);
    std::vector<Eigen::Matrix3f> linear = turns(3, 9);
    for (const float factor : {16.0f, 1e3f, 1e6f, 1e12f})
      linear.push_back(factor * Eigen::Matrix3f::Identity());
    const auto found = sumsOf(*sums, lattice, probes, linear);
    for (std::size_t t = 3; t < linear.size(); ++t)
      for (const int sum : found[t])
        ASSERT_EQ(255 * 128, sum);
  }
}

TEST_P(Sums, AreRightForAnyNumberOfPointsAndPlacements)
{
  const Points cloud = shape(200, 10);
  const auto sums = make();
  const ShiftLattice lattice(cloud, gridOf({1, 1, 1}, {0.3, 0.3, 0.3}, 11), 0.35f);
  sums->setField(cloud, lattice);
  const auto linear = turns(130, 12);
  for (const Eigen::Index points : {1, 2, 7, 8, 100, 127, 128}) {
    const Points probes = shape(200, 13).leftCols(points);
    const auto all = sumsOf(*sums, lattice, probes, linear);
    for (const std::size_t number : {1u, 2u, 63u, 64u, 65u}) {
      const auto some =
          sumsOf(*sums, lattice, probes, {linear.begin(), linear.begin() + number});
      for (std::size_t t = 0; t < number; ++t)
        ASSERT_EQ(all[t], some[t]);
    }
    // the sum over the points is that of the sums of each
    std::vector<int> added(lattice.places().size());
    for (Eigen::Index p = 0; p < points; ++p) {
      const auto one = sumsOf(*sums, lattice, probes.col(p), {linear.front()});
      for (std::size_t c = 0; c < added.size(); ++c)
        added[c] += one.front()[c];
    }
    EXPECT_EQ(added, all.front()) << points;
  }
}

TEST_P(Sums, FollowAnotherField)
{
  const Points large = shape(400, 14), small = 0.3f * shape(50, 15);
  const Points probes = shape(60, 16);
  const auto linear = turns(10, 17);
  const auto sums = make();
  const auto sumsOn = [&](ShiftSums& any, const Points& cloud, int n) {
    const ShiftLattice lattice(cloud, gridOf({n, n, n}, {0.3, 0.2, 0.1}, 18), 0.35f);
    any.setField(cloud, lattice);
    return sumsOf(any, lattice, probes, linear);
  };
  const auto first = sumsOn(*sums, large, 2);
  const auto second = sumsOn(*sums, small, 1);
  EXPECT_EQ(first, sumsOn(*sums, large, 2));
  EXPECT_EQ(second, sumsOn(*make(), small, 1));
}

TEST_P(Sums, AreTheSameWithAnyNumberOfThreadsAndOnAnyDevice)
{
  const Points cloud = shape(500, 19), probes = shape(128, 20);
  const auto linear = turns(100, 21);
  const auto on_host = makeHostShiftSums(1);
  for (const unsigned int threads : {1u, 2u, 0u}) {
    const auto sums = make(threads);
    std::size_t number = 0, different = 0;
    for (const CandidateCenters& centers : grids(cloud)) {
      const ShiftLattice lattice(cloud, centers, 0.35f);
      on_host->setField(cloud, lattice);
      sums->setField(cloud, lattice);
      const auto expected = sumsOf(*on_host, lattice, probes, linear);
      const auto found = sumsOf(*sums, lattice, probes, linear);
      if (GetParam() == std::string("host")) {
        ASSERT_EQ(expected, found);
      }
      for (std::size_t t = 0; t < linear.size(); ++t)
        for (std::size_t c = 0; c < found[t].size(); ++c, ++number) {
          different += expected[t][c] != found[t][c];
          // a point on the border of two cells, where rounding decides
          ASSERT_NEAR(expected[t][c], found[t][c], 160);
        }
    }
    EXPECT_LT(different, 0.05 * number);
  }
}

INSTANTIATE_TEST_SUITE_P(Host, Sums, ::testing::Values("host"));
INSTANTIATE_TEST_SUITE_P(OpenCL, Sums, ::testing::Values("auto"));

TEST(ShiftLattice, IsTheSameForTheSameCentersAlone)
{
  const Points cloud = shape(300, 22);
  const Eigen::Array3d spacing(0.3, 0.2, 0.1);
  const ShiftLattice lattice(cloud, gridOf({1, 2, 3}, spacing, 23), 0.35f);
  EXPECT_TRUE(lattice == ShiftLattice(cloud, gridOf({1, 2, 3}, spacing, 23), 0.35f));
  EXPECT_FALSE(lattice == ShiftLattice(cloud, gridOf({1, 2, 3}, spacing, 24), 0.35f));
  EXPECT_FALSE(lattice == ShiftLattice(cloud, gridOf({1, 2, 2}, spacing, 23), 0.35f));
  EXPECT_FALSE(lattice ==
               ShiftLattice(cloud, gridOf({1, 2, 3}, 1.1 * spacing, 23), 0.35f));
  EXPECT_FALSE(lattice == ShiftLattice(cloud, gridOf({1, 2, 3}, spacing, 23), 0.3f));
}

TEST(ShiftLattice, IsNotLargeForFlatClouds)
{
  // the centres lie in the plane; off it, they hardly differ
  for (unsigned int seed = 0; seed < 10; ++seed) {
    Points cloud = transformed(sampled(pennant(), 1000, seed), randomRigid(seed));
    cloud.colwise() -= cloud.rowwise().mean().eval();
    cloud /= std::sqrt(cloud.squaredNorm() / cloud.cols());
    const ShiftLattice lattice(cloud, spreadCenters(cloud, 1.6, 0.3), 0.35f);
    EXPECT_LT(lattice.inner().cast<double>().prod(), 50000.0);
  }
}

TEST(ShiftLattice, IsBoundedWhereOneCloudIsMuchLargerThanTheOther)
{
  const Points cloud = shape(500, 30);
  const float limit = 0.35f;
  for (const double ratio : {1.0, 10.0, 40.0, 100.0, 400.0, 600.0, 1e3, 1e6, 1e12})
    for (const bool is_large : {false, true}) {
      const Points points = cloud * static_cast<float>(is_large ? ratio : 1.0);
      const CandidateCenters centers = spreadCenters(points, 1.6 * ratio, 0.3);
      EXPECT_LE(centers.centers.size(), 10000);
      const ShiftLattice lattice(points, centers, limit);
      const double nodes = (lattice.every() * lattice.size()).cast<double>().prod();
      EXPECT_LE(nodes, ShiftLattice::most_nodes) << ratio;
      const auto row = std::max_element(lattice.rows().begin(), lattice.rows().end());
      EXPECT_LT(*row, ShiftLattice::most_nodes);
      // each centre is a whole number of nodes from the next
      for (int axis = 0; axis < 3; ++axis)
        if (centers.steps[axis] > 1) {
          EXPECT_NEAR(centers.spacing[axis] / lattice.every()[axis],
                      lattice.step()[axis], 1e-6 * lattice.step()[axis]);
        }
    }
}

TEST(ShiftLattice, FoldsRowsOnlyWhereTheFieldStaysSmall)
{
  const Points cloud = shape(200, 31);
  for (const int n : {5, 150}) {
    const CandidateCenters centers = gridOf({n, n, 2}, {0.3, 0.3, 0.3}, 32);
    const ShiftLattice lattice(cloud, centers, 0.35f);
    const std::size_t lines = centers.steps[0] * centers.steps[1];
    EXPECT_EQ(n == 5, 2 * lattice.rows().size() < lines) << n;
    EXPECT_LE(lattice.field(cloud).size(), ShiftLattice::most_nodes + 16u) << n;
  }
}

TEST(ShiftLattice, HasBytesForAllItsNodes)
{
  const Points cloud = shape(100, 31);
  const CandidateCenters centers = spreadCenters(cloud, 1.6 * 30.0, 0.3);
  const ShiftLattice lattice(cloud, centers, 0.35f);
  const auto sums = makeHostShiftSums(1);
  sums->setField(cloud, lattice);
  const auto found = sums->sums(
      cloud, {lattice.toNodes(Eigen::Matrix3f::Identity()),
              lattice.toNodes(Eigen::Matrix3f::Constant(std::nanf(""))),
              lattice.toNodes(Eigen::Matrix3f(1e30f * Eigen::Matrix3f::Identity()))});
  // the centre of all is where the cloud lies on itself
  const std::size_t middle = lattice.places()[centers.centers.size() / 2];
  EXPECT_LT(found[middle], 255 * cloud.cols() / 2);
}

TEST(ShiftLattice, RefusesCentersThatAreMoreThanItsNodes)
{
  Points cloud = shape(100, 32);
  cloud.col(0) *= 1e6f;
  EXPECT_THROW(ShiftLattice(cloud, gridOf({1, 1, 1}, {1e-3, 1e-3, 1e-3}, 8), 0.35f),
               std::invalid_argument);
}

} // namespace
