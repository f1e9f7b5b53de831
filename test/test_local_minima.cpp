/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include <pcl/registration/kss/local_minima.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace {

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

std::vector<std::size_t>
sorted(std::vector<std::size_t> indices)
{
  std::sort(indices.begin(), indices.end());
  return indices;
}

class LocalMinima : public ::testing::Test {
protected:
  const EulerRotations euler_{2.0 * M_PI / steps};
  const EvenRotations even_{1000};
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
  const auto& rotations = even_.rotations();
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
  for (const CandidateRotations* set : {static_cast<const CandidateRotations*>(&euler_),
                                        static_cast<const CandidateRotations*>(&even_)})
    for (const auto& energies :
         {randomEnergies(set->rotations().size(), 2), smoothEnergies(*set, 3)}) {
      const auto minima = localMinima(energies, *set, 5, distinct_angle);
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
  const auto energies = smoothEnergies(euler_, 4);
  const auto all = localMinima(energies, euler_, 5, 0.0);
  const auto distinct = localMinima(energies, euler_, 5, distinct_angle);
  EXPECT_LT(distinct.size(), all.size());
  const auto& rotations = euler_.rotations();
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
  const EvenRotations one(1);
  EXPECT_EQ(std::vector<std::size_t>{0}, localMinima({0.3f}, one, 5, distinct_angle));
  const EulerRotations eight(M_PI);
  const auto minima = localMinima({8, 7, 6, 5, 4, 3, 2, 1}, eight, 5, distinct_angle);
  EXPECT_EQ(std::vector<std::size_t>{7}, minima);
}

} // namespace
