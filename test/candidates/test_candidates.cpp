/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "poses.h"

#include "candidates/candidates.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <random>

namespace {

using namespace kss_test;
using namespace pcl::kss;

constexpr int steps = 12;
constexpr double distinct_angle = M_PI / 18.0;

std::size_t
cellOf(int x, int y, int z)
{
  const auto around = [](int step) { return (step % steps + steps) % steps; };
  return (around(x) * steps + around(y)) * steps + around(z);
}

std::vector<float>
randomEnergies(std::size_t number, unsigned int seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> energy(0.1f, 1.0f);
  std::vector<float> energies(number);
  std::generate(energies.begin(), energies.end(), [&] { return energy(random); });
  return energies;
}

/** Energies that vary slowly, as those of a shape do. */
std::vector<float>
smoothEnergies(const CandidateRotations& candidates, unsigned int seed)
{
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::vector<Eigen::Quaterniond> hollows;
  for (int i = 0; i < 6; ++i)
    hollows.push_back(Eigen::Quaterniond(normal(random), normal(random), normal(random),
                                         normal(random))
                          .normalized());
  std::vector<float> energies;
  for (const Eigen::Quaterniond& rotation : candidates.rotations()) {
    double energy = 10.0;
    for (std::size_t i = 0; i < hollows.size(); ++i)
      energy = std::min(energy, 0.1 * i + rotation.angularDistance(hollows[i]));
    energies.push_back(static_cast<float>(energy));
  }
  return energies;
}

/** The cells of the wrapped Euler grid that are the lowest of their cube. */
std::vector<std::size_t>
lowestOfTheirCube(const std::vector<float>& energies, int reach)
{
  std::vector<std::size_t> lowest;
  for (int x = 0; x < steps; ++x)
    for (int y = 0; y < steps; ++y)
      for (int z = 0; z < steps; ++z) {
        bool is_lowest = true;
        for (int dx = -reach; dx <= reach; ++dx)
          for (int dy = -reach; dy <= reach; ++dy)
            for (int dz = -reach; dz <= reach; ++dz)
              is_lowest &=
                  energies[cellOf(x, y, z)] <= energies[cellOf(x + dx, y + dy, z + dz)];
        if (is_lowest)
          lowest.push_back(cellOf(x, y, z));
      }
  return lowest;
}

/** The minima among rotations alone: one centre and scale. */
std::vector<std::size_t>
localMinima(const std::vector<float>& energies,
            const std::shared_ptr<const CandidateRotations>& rotations,
            unsigned int kernel,
            double distinct)
{
  return Candidates(rotations, {1.0}, ownCenter(), Role::TARGET)
      .localMinima(energies, kernel, distinct);
}

std::vector<std::size_t>
sorted(std::vector<std::size_t> indices)
{
  std::sort(indices.begin(), indices.end());
  return indices;
}

class LocalMinima : public ::testing::Test {
protected:
  const std::shared_ptr<const CandidateRotations> euler_ =
      std::make_shared<EulerRotations>(2.0 * M_PI / steps);
  const std::shared_ptr<const CandidateRotations> even_ =
      std::make_shared<EvenRotations>(1000);
};

TEST_F(LocalMinima, AreTheLowestOfTheirKernel)
{
  for (const unsigned int kernel : {3u, 5u})
    for (unsigned int seed = 0; seed < 5; ++seed) {
      const auto energies = randomEnergies(1728, seed);
      // with an angle of 0 none is dropped as a double
      EXPECT_EQ(lowestOfTheirCube(energies, kernel / 2),
                sorted(localMinima(energies, euler_, kernel, 0.0)));
    }
}

TEST_F(LocalMinima, AreTheLowestOfTheirBallInAnEvenSet)
{
  const auto& rotations = even_->rotations();
  const double radius = 2.0 * std::cbrt(8.0 * M_PI * M_PI / rotations.size());
  const auto energies = randomEnergies(rotations.size(), 1);
  std::vector<std::size_t> expected;
  for (std::size_t i = 0; i < rotations.size(); ++i) {
    bool is_lowest = true;
    for (std::size_t j = 0; j < rotations.size(); ++j)
      is_lowest &= rotations[i].angularDistance(rotations[j]) > radius ||
                   energies[i] <= energies[j];
    if (is_lowest)
      expected.push_back(i);
  }
  EXPECT_EQ(expected, sorted(localMinima(energies, even_, 5, 0.0)));
}

TEST_F(LocalMinima, RiseInEnergyFromTheGlobalOne)
{
  for (const auto& set : {euler_, even_})
    for (const auto& energies :
         {randomEnergies(set->rotations().size(), 2), smoothEnergies(*set, 3)}) {
      const auto minima = localMinima(energies, set, 5, distinct_angle);
      ASSERT_FALSE(minima.empty());
      EXPECT_EQ(*std::min_element(energies.begin(), energies.end()),
                energies[minima.front()]);
      for (std::size_t i = 1; i < minima.size(); ++i)
        EXPECT_LE(energies[minima[i - 1]], energies[minima[i]]);
    }
}

TEST_F(LocalMinima, AreDistinct)
{
  // The Euler grid names rotations twice, so that each hollow shows up twice in it.
  const auto energies = smoothEnergies(*euler_, 4);
  const auto all = localMinima(energies, euler_, 5, 0.0);
  const auto distinct = localMinima(energies, euler_, 5, distinct_angle);
  EXPECT_LT(distinct.size(), all.size());
  const auto& rotations = euler_->rotations();
  for (std::size_t i = 0; i < distinct.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_GE(rotations[distinct[i]].angularDistance(rotations[distinct[j]]),
                distinct_angle);
  // nothing is lost: each that was dropped has one at least as low beside it
  for (const std::size_t i : all)
    EXPECT_TRUE(std::any_of(distinct.begin(), distinct.end(), [&](std::size_t j) {
      return energies[j] <= energies[i] &&
             rotations[i].angularDistance(rotations[j]) < distinct_angle + 1e-9;
    }));
}

TEST_F(LocalMinima, WrapRound)
{
  // two hollows on either side of where the angles start: neighbours
  std::vector<float> energies(1728, 1.0f);
  energies[cellOf(0, 0, 0)] = 0.2f;
  energies[cellOf(11, 10, 11)] = 0.1f;
  auto minima = localMinima(energies, euler_, 5, 0.0);
  EXPECT_EQ(cellOf(11, 10, 11), minima.front());
  EXPECT_EQ(0, std::count(minima.begin(), minima.end(), cellOf(0, 0, 0)));
  // three steps apart they are not
  energies[cellOf(11, 10, 11)] = 1.0f;
  energies[cellOf(0, 0, 9)] = 0.1f;
  minima = localMinima(energies, euler_, 5, 0.0);
  EXPECT_EQ(cellOf(0, 0, 9), minima[0]);
  EXPECT_EQ(cellOf(0, 0, 0), minima[1]);
}

TEST_F(LocalMinima, ArePlateausOnce)
{
  const std::vector<float> flat(1728, 0.5f);
  EXPECT_EQ(1u, localMinima(flat, euler_, 5, 0.0).size());
  std::vector<float> energies = randomEnergies(1728, 5);
  for (int x = 0; x < 2; ++x)
    for (int z = 0; z < 2; ++z)
      energies[cellOf(4 + x, 4, 4 + z)] = 0.01f;
  const auto minima = localMinima(energies, euler_, 5, 0.0);
  EXPECT_EQ(0.01f, energies[minima[0]]);
  EXPECT_LT(0.01f, energies[minima[1]]);
}

TEST_F(LocalMinima, AreFoundWhereTheSetIsTiny)
{
  const auto one = std::make_shared<EvenRotations>(1);
  EXPECT_EQ(std::vector<std::size_t>{0}, localMinima({0.3f}, one, 5, distinct_angle));
  const auto eight = std::make_shared<EulerRotations>(M_PI);
  const auto minima = localMinima({8, 7, 6, 5, 4, 3, 2, 1}, eight, 5, distinct_angle);
  EXPECT_EQ(std::vector<std::size_t>{7}, minima);
}

/** A grid of so many centres, a unit apart, whose middle is the origin. */
CandidateCenters
gridOf(int nx, int ny, int nz)
{
  CandidateCenters found;
  found.steps = {nx, ny, nz};
  for (int x = 0; x < nx; ++x)
    for (int y = 0; y < ny; ++y)
      for (int z = 0; z < nz; ++z)
        found.centers.emplace_back(x - 0.5 * (nx - 1), y - 0.5 * (ny - 1),
                                   z - 0.5 * (nz - 1));
  return found;
}

const std::vector<double> three_scales{0.8, 1.0, 1.25};

TEST(Candidates, AreAllRotationsScalesAndCentersOnce)
{
  const auto rotations = std::make_shared<EvenRotations>(7);
  const CandidateCenters centers = gridOf(2, 3, 1);
  for (const Role side : {Role::SOURCE, Role::TARGET}) {
    const Candidates candidates(rotations, three_scales, centers, side);
    ASSERT_EQ(7u * 3u * 6u, candidates.size());
    for (const Eigen::Quaterniond& rotation : rotations->rotations())
      for (const double scale : three_scales)
        for (const Eigen::Vector3d& center : centers.centers) {
          // the source's centre, turned and scaled, comes to lie upon the target's
          Eigen::Matrix4d expected =
              similarity(rotation, scale,
                         side == Role::TARGET ? center : Eigen::Vector3d(0, 0, 0));
          if (side == Role::SOURCE)
            expected *= similarity(Eigen::Quaterniond::Identity(), 1.0, -center);
          int found = 0;
          for (std::size_t i = 0; i < candidates.size(); ++i)
            found += candidates.pose(i).matrix().isApprox(expected, 1e-12);
          EXPECT_EQ(1, found);
        }
  }
}

TEST(Candidates, BringTheirCentersTogether)
{
  const auto rotations = std::make_shared<EvenRotations>(5);
  const CandidateCenters centers = gridOf(3, 1, 2);
  const Candidates of_source(rotations, three_scales, centers, Role::SOURCE);
  const Candidates of_target(rotations, three_scales, centers, Role::TARGET);
  for (const Eigen::Vector3d& center : centers.centers) {
    int on_origin = 0, from_origin = 0;
    for (std::size_t i = 0; i < of_source.size(); ++i) {
      const Eigen::Affine3d source(of_source.pose(i).matrix()),
          target(of_target.pose(i).matrix());
      on_origin += (source * center).norm() < 1e-12;
      from_origin += (target * Eigen::Vector3d(0, 0, 0) - center).norm() < 1e-12;
    }
    // whatever the rotation and the scale
    EXPECT_EQ(15, on_origin);
    EXPECT_EQ(15, from_origin);
  }
}

TEST(Candidates, HaveThePlacementsOfTheirPoses)
{
  const Candidates candidates(std::make_shared<EvenRotations>(9), three_scales,
                              gridOf(2, 2, 2), Role::SOURCE);
  const std::pair<std::size_t, std::size_t> ranges[] = {
      {0, candidates.size()}, {0, 0}, {17, 50}, {candidates.size() - 1, 1}};
  for (const auto& range : ranges) {
    const auto placements = candidates.placements(range.first, range.second);
    ASSERT_EQ(range.second, placements.size());
    for (std::size_t i = 0; i < placements.size(); ++i)
      EXPECT_EQ(candidates.pose(range.first + i).matrix().topRows<3>().cast<float>(),
                placements[i]);
  }
}

TEST(Candidates, AreMinimaWhereNoNeighbourIsLower)
{
  // by the poses alone: within a step in rotation, scale and centre
  constexpr unsigned int kernel = 4;
  const auto rotations = std::make_shared<EvenRotations>(60);
  const double radius = 1.5 * std::cbrt(8.0 * M_PI * M_PI / 60.0);
  for (const auto& centers : {gridOf(3, 2, 1), gridOf(1, 1, 5), gridOf(2, 2, 3)}) {
    const Candidates candidates(rotations, three_scales, centers, Role::TARGET);
    const auto energies = randomEnergies(candidates.size(), 6);
    std::vector<Eigen::Matrix4d> poses;
    for (std::size_t i = 0; i < candidates.size(); ++i)
      poses.push_back(candidates.pose(i).matrix());
    const auto areNeighbours = [&](const Eigen::Matrix4d& a, const Eigen::Matrix4d& b) {
      return std::abs(std::log(scaleIn(a) / scaleIn(b))) < std::log(1.3) &&
             (a - b).topRightCorner<3, 1>().cwiseAbs().maxCoeff() < 1.5 &&
             rotationErrorDegrees(a, b) * M_PI / 180.0 <= radius;
    };
    std::vector<std::size_t> expected;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      bool is_lowest = true;
      for (std::size_t j = 0; j < candidates.size() && is_lowest; ++j)
        is_lowest = energies[i] <= energies[j] || !areNeighbours(poses[i], poses[j]);
      if (is_lowest)
        expected.push_back(i);
    }
    EXPECT_GT(expected.size(), 1u);
    EXPECT_EQ(expected, sorted(candidates.localMinima(energies, kernel, 0.0)));
  }
}

TEST(Candidates, AreMinimaAmongSomeAsAmongAll)
{
  const auto rotations = std::make_shared<EvenRotations>(60);
  const Candidates candidates(rotations, three_scales, gridOf(3, 2, 2), Role::SOURCE);
  const auto energies = randomEnergies(candidates.size(), 7);
  const auto all = candidates.localMinima(energies, 3, distinct_angle);
  std::vector<std::size_t> some, every;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    every.push_back(i);
    if (energies[i] < 0.3f)
      some.push_back(i);
  }
  const auto known = [&](const std::vector<std::size_t>& among) {
    SomeEnergies known(among, energies.size());
    for (std::size_t i = 0; i < among.size(); ++i)
      known.ofPlace(i) = energies[among[i]];
    return known;
  };
  for (std::size_t i = 0; i < candidates.size(); ++i)
    EXPECT_EQ(energies[i] < 0.3f ? energies[i] : std::numeric_limits<float>::infinity(),
              known(some)[i]);
  EXPECT_EQ(all, candidates.localMinima(known(every), 3, distinct_angle));
  // unknown energies are no lower ones
  std::vector<std::size_t> expected;
  for (const std::size_t i : all)
    if (energies[i] < 0.3f)
      expected.push_back(i);
  EXPECT_GT(expected.size(), 1u);
  EXPECT_EQ(expected, candidates.localMinima(known(some), 3, distinct_angle));
  EXPECT_EQ((std::vector<std::size_t>{all[1]}),
            candidates.localMinima(known({all[1]}), 3, distinct_angle));
}

TEST(Candidates, TellWhatTheyAreMadeOf)
{
  const auto rotations = std::make_shared<EvenRotations>(7);
  const CandidateCenters centers = gridOf(3, 4, 2);
  const Candidates candidates(rotations, three_scales, centers, Role::SOURCE);
  EXPECT_EQ(rotations.get(), &candidates.rotations());
  EXPECT_EQ(three_scales, candidates.scales());
  EXPECT_EQ(centers.centers, candidates.centers().centers);
  EXPECT_EQ(Role::SOURCE, candidates.centered());
  for (std::size_t c = 0; c < centers.centers.size(); ++c) {
    std::vector<std::size_t> expected;
    for (std::size_t other = 0; other < centers.centers.size(); ++other)
      if ((centers.centers[c] - centers.centers[other]).cwiseAbs().maxCoeff() < 1.5)
        expected.push_back(other);
    EXPECT_EQ(expected, sorted(candidates.centersAround(c)));
  }
  const std::vector<std::size_t> some{5, 0, 77, 77};
  const auto placements = candidates.placements(some);
  ASSERT_EQ(some.size(), placements.size());
  for (std::size_t i = 0; i < some.size(); ++i)
    EXPECT_EQ(candidates.placements(some[i], 1).front(), placements[i]);
}

TEST(Candidates, AreToldApartByCenterAndScaleToo)
{
  // The identity is in the Euler grid as (0, 0, 0) and as (pi, pi, pi).
  const auto rotations = std::make_shared<EulerRotations>(2.0 * M_PI / steps);
  const Candidates candidates(rotations, {0.64, 0.8, 1.0}, gridOf(4, 1, 1),
                              Role::TARGET);
  std::vector<float> energies(candidates.size(), 1.0f);
  const auto lower = [&](double scale, double x, float energy) {
    const Eigen::Matrix4d pose =
        similarity(Eigen::Quaterniond::Identity(), scale, {x, 0.0, 0.0});
    int found = 0;
    for (std::size_t i = 0; i < candidates.size(); ++i)
      if (candidates.pose(i).matrix().isApprox(pose, 1e-9)) {
        energies[i] = energy;
        ++found;
      }
    EXPECT_EQ(2, found);
  };
  lower(0.64, -1.5, 0.1f);
  lower(1.0, -1.5, 0.2f); // two scales away
  lower(0.64, 1.5, 0.3f); // three centres away
  lower(0.8, -0.5, 0.4f); // next to both
  const auto minima = candidates.localMinima(energies, 3, distinct_angle);
  ASSERT_GE(minima.size(), 3u);
  EXPECT_EQ(0.1f, energies[minima[0]]);
  EXPECT_EQ(0.2f, energies[minima[1]]);
  EXPECT_EQ(0.3f, energies[minima[2]]);
  for (std::size_t i = 3; i < minima.size(); ++i)
    EXPECT_EQ(1.0f, energies[minima[i]]);
}

} // namespace
