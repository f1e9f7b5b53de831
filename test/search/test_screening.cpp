/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "poses.h"

#include "preparation/farthest_points.h"
#include "search/screening.h"
#include <pcl/registration/kss/devices.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace {

using namespace kss_test;
using namespace pcl::kss;

constexpr float limit = 0.35f;

/** A cloud in pre-shape space, in the order of farthest points. */
Points
shape(const Mesh& mesh, Eigen::Index number, unsigned int seed)
{
  Points points = sampled(mesh, number, seed);
  points.colwise() -= points.rowwise().mean().eval();
  points /= std::sqrt(points.squaredNorm() / number);
  Points ordered(3, number);
  const auto order = inFarthestOrder(points, number).indices;
  for (Eigen::Index i = 0; i < number; ++i)
    ordered.col(i) = points.col(order[i]);
  return ordered;
}

/** The directed truncated mean from the first points of the cloud that is turned to the
 * one that has centres, in the frame of that one. */
double
energyOf(const Points& source,
         const Points& target,
         const Eigen::Matrix4d& pose,
         Role side,
         Eigen::Index probes)
{
  const bool on_target = side == Role::TARGET;
  const Points& fixed = on_target ? target : source;
  const Points& turned = on_target ? source : target;
  const Points placed = transformed(turned.leftCols(std::min(probes, turned.cols())),
                                    on_target ? pose : Eigen::Matrix4d(pose.inverse()));
  double sum = 0.0;
  for (Eigen::Index i = 0; i < placed.cols(); ++i)
    sum += std::min<double>(
        limit,
        std::sqrt(
            (fixed.colwise() - placed.col(i)).colwise().squaredNorm().minCoeff()));
  return sum / placed.cols();
}

class Screens : public ::testing::TestWithParam<const char*> {
protected:
  void
  SetUp() override
  {
    if (GetParam() != std::string("host") && openCLDeviceNames().empty())
      GTEST_SKIP() << "There is no OpenCL device on this machine.";
    settings_.device = GetParam();
    settings_.threads = 1;
  }

  const std::vector<double> scales_{0.8, 1.0, 1.25};
  const std::shared_ptr<const CandidateRotations> rotations_ =
      std::make_shared<EvenRotations>(60);
  Settings settings_;
};

TEST_P(Screens, FindTheCandidatesOfTheLowestEnergies)
{
  const Points source = shape(creature(), 200, 1), target = shape(creature(), 250, 2);
  Screening screening(settings_);
  screening.setClouds(source, target, limit);
  for (const Role side : {Role::TARGET, Role::SOURCE}) {
    const CandidateCenters centers =
        spreadCenters(side == Role::TARGET ? target : source, 1.1, 0.5);
    const Candidates candidates(rotations_, scales_, centers, side);
    ASSERT_GT(centers.centers.size(), 20u);
    std::vector<double> energies;
    for (std::size_t i = 0; i < candidates.size(); ++i)
      energies.push_back(energyOf(source, target, candidates.pose(i).matrix(), side,
                                  settings_.search_points));
    for (const std::size_t many : {300u, 1500u}) {
      const auto found = screening.lowest(candidates, many);
      ASSERT_TRUE(std::is_sorted(found.begin(), found.end()));
      const std::set<std::size_t> distinct(found.begin(), found.end());
      ASSERT_EQ(distinct.size(), found.size());
      ASSERT_LT(found.back(), candidates.size());
      for (const double scale : scales_) {
        std::vector<double> all, chosen;
        for (std::size_t i = 0; i < candidates.size(); ++i)
          if (std::abs(candidates.pose(i).scale - scale) < 1e-6) {
            all.push_back(energies[i]);
            if (distinct.count(i) > 0)
              chosen.push_back(energies[i]);
          }
        std::sort(all.begin(), all.end());
        // as many at each scale, equal ones aside
        const std::size_t share = many / scales_.size();
        ASSERT_LE(chosen.size(), share);
        ASSERT_GT(chosen.size(), 0.95 * share);
        // Cells are coarse, but errors of a hundred distances cancel: what is chosen is
        // not much worse than the worst that should be, and the best are all there.
        const double worst = *std::max_element(chosen.begin(), chosen.end());
        EXPECT_LT(worst, all[share - 1] + 0.06 * limit) << scale;
        const auto missed = [&](double energy) {
          return std::count_if(all.begin(), all.end(),
                               [&](double e) { return e < energy; }) -
                 std::count_if(chosen.begin(), chosen.end(),
                               [&](double e) { return e < energy; });
        };
        EXPECT_EQ(0, missed(all[share - 1] - 0.06 * limit)) << scale;
        EXPECT_LT(missed(all[share - 1]), 0.2 * share) << scale;
      }
    }
  }
}

TEST_P(Screens, HoldTheRightOne)
{
  // six tenths of the target, and a centre, rotation and scale that are nearly right
  const Points whole = sampled(lump(), 1000, 3);
  Points front = part(sampled(lump(), 1000, 4), {1, 0, 0}, 0.6);
  const Eigen::Vector3f shift = front.rowwise().mean() - whole.rowwise().mean();
  const Points source = front.colwise() - front.rowwise().mean().eval();
  const Points target = whole.colwise() - whole.rowwise().mean().eval();
  CandidateCenters centers = spreadCenters(target, 1.1, 0.36);
  Eigen::Index nearest = 0;
  for (std::size_t i = 0; i < centers.centers.size(); ++i)
    if ((centers.centers[i] - shift.cast<double>()).norm() <
        (centers.centers[nearest] - shift.cast<double>()).norm())
      nearest = static_cast<Eigen::Index>(i);
  Screening screening(settings_);
  screening.setClouds(source, target, limit);
  // the first of the even rotations turned such that it is the identity
  const auto rotations = std::make_shared<EvenRotations>(500);
  const Eigen::Matrix3d first = rotations->rotations().front().toRotationMatrix();
  Points turned = (first.transpose().cast<float>() * source).eval();
  screening.setClouds(turned, target, limit);
  const Candidates candidates(rotations, {1.0}, centers, Role::TARGET);
  const auto found = screening.lowest(candidates, candidates.size() / 100);
  EXPECT_EQ(1, std::count(found.begin(), found.end(), nearest));
}

TEST_P(Screens, FollowCloudsCentersAndLimits)
{
  const Points a = shape(creature(), 150, 5), b = shape(lump(), 200, 6);
  const Points c = shape(cross(), 200, 7);
  Screening screening(settings_);
  const auto lowest = [&](Screening& any, const Points& source, const Points& target,
                          Role side, double reach, float most) {
    any.setClouds(source, target, most);
    const Points& cloud = side == Role::TARGET ? target : source;
    return any.lowest(
        Candidates(rotations_, scales_, spreadCenters(cloud, reach, 0.4), side), 500);
  };
  const auto expectAsFresh = [&](const Points& source, const Points& target, Role side,
                                 double reach, float most) {
    Screening fresh(settings_);
    EXPECT_EQ(lowest(fresh, source, target, side, reach, most),
              lowest(screening, source, target, side, reach, most));
  };
  for (const Role side : {Role::TARGET, Role::SOURCE}) {
    expectAsFresh(a, b, side, 1.1, 0.35f);
    expectAsFresh(a, b, side, 1.1, 0.35f);
    expectAsFresh(a, b, side, 1.6, 0.35f);
    expectAsFresh(a, b, side, 1.6, 0.2f);
    expectAsFresh(c, b, side, 1.6, 0.2f);
    expectAsFresh(c, a, side, 1.6, 0.2f);
  }
  // as many points as before in the same box, and the same centres
  Points d = c;
  for (Eigen::Index i = 0; i < c.cols(); ++i)
    if (c.col(i).cwiseAbs().maxCoeff() < 0.7f * c.cwiseAbs().maxCoeff())
      d.col(i).setZero();
  CandidateCenters centers = spreadCenters(c, 1.1, 0.4);
  centers.axes.setIdentity();
  for (const Role side : {Role::TARGET, Role::SOURCE}) {
    const Candidates candidates(rotations_, scales_, centers, side);
    std::vector<std::vector<std::size_t>> found;
    for (const Points& cloud : {c, d, c}) {
      if (side == Role::TARGET)
        screening.setClouds(a, cloud, limit);
      else
        screening.setClouds(cloud, a, limit);
      found.push_back(screening.lowest(candidates, 500));
    }
    EXPECT_NE(found[0], found[1]);
    EXPECT_EQ(found[0], found[2]);
  }
}

TEST_P(Screens, WorkForFewPointsAndCandidates)
{
  // fewer points than take part, and fewer candidates than asked for
  const Points source = shape(creature(), 20, 8), target = shape(creature(), 30, 9);
  Screening screening(settings_);
  screening.setClouds(source, target, limit);
  const Candidates candidates(std::make_shared<EvenRotations>(3), {1.0},
                              spreadCenters(target, 1.1, 0.5), Role::TARGET);
  std::vector<std::size_t> all(candidates.size());
  for (std::size_t i = 0; i < all.size(); ++i)
    all[i] = i;
  EXPECT_EQ(all, screening.lowest(candidates, candidates.size()));
  EXPECT_EQ(all, screening.lowest(candidates, 10 * candidates.size()));
}

TEST_P(Screens, AlwaysFindOne)
{
  // a single point lies well at most centres: all that are equally good cannot be told
  // apart, but none is no answer
  settings_.search_points = 1;
  const Points source = Points::Zero(3, 20);
  const Points target = shape(ellipsoid({0, 0, 0}, {1, 1, 1}), 200, 10);
  Screening screening(settings_);
  screening.setClouds(source, target, limit);
  const Candidates candidates(rotations_, {1.0}, spreadCenters(target, 1.1, 0.5),
                              Role::TARGET);
  EXPECT_FALSE(screening.lowest(candidates, 30).empty());
}

INSTANTIATE_TEST_SUITE_P(Host, Screens, ::testing::Values("host"));
INSTANTIATE_TEST_SUITE_P(OpenCL, Screens, ::testing::Values("auto"));

} // namespace
