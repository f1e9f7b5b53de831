/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "poses.h"

#include "evaluators/bounds.h"
#include "geometry/pre_shape.h"
#include "preparation/simplification.h"
#include "search/candidate_search.h"
#include "search/exact/exact_search.h"
#include <pcl/registration/kss/devices.h>

#include "evaluators/evaluator_choice.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <random>

namespace {

using namespace kss_test;
using namespace pcl::kss;

/** The points, such that any leading part of them covers the cloud. */
Points
inOrder(const Points& cloud)
{
  return simplify(cloud, cloud.cols(), Density::UNIFORM, 1);
}

constexpr float no_limit = std::numeric_limits<float>::max();
constexpr double distinct_angle = M_PI / 18.0;

/** A cloud of one of many kinds, centred, of unit size where it has a size. */
Points
randomCloud(std::mt19937& random, Eigen::Index points)
{
  const auto seed = static_cast<unsigned int>(random());
  const auto oneOf = [&](int n) { return static_cast<int>(random() % n); };
  Points cloud;
  switch (oneOf(7)) {
  case 0:
    cloud = sampled(cross(), points, seed);
    break;
  case 1:
    cloud = sampled(lump(), points, seed);
    break;
  case 2:
    cloud = sampled(pennant(), points, seed);
    break;
  case 3: // has more symmetries than one can tell apart
    cloud = sampled(ellipsoid({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}), points, seed);
    break;
  case 4:
    cloud = noisy(sampled(creature(), points, seed), 0.05, seed + 1);
    break;
  case 5: { // every point several times
    const Points some = sampled(creature(), (points + 2) / 3, seed);
    cloud.resize(3, points);
    for (Eigen::Index i = 0; i < points; ++i)
      cloud.col(i) = some.col(i % some.cols());
    break;
  }
  default:
    cloud = part(sampled(creature(), 2 * points, seed), {1.0f, 0.3f, -0.2f}, 0.5);
  }
  cloud.colwise() -= cloud.rowwise().mean().eval();
  const float size = cloud.norm() / std::sqrt(static_cast<float>(cloud.cols()));
  if (size > 0.0f)
    cloud /= size;
  return oneOf(3) > 0 ? inOrder(cloud) : cloud;
}

/** On the host and on an OpenCL device. */
class ExactSearch : public ::testing::TestWithParam<const char*> {
protected:
  void
  SetUp() override
  {
    settings_.device = GetParam();
    if (settings_.device == "auto" && openCLDeviceNames().empty())
      GTEST_SKIP() << "There is no OpenCL device on this machine.";
    settings_.search = brute_force;
  }

  Settings settings_;
};

bool
isBetween(const DistanceBounds& bounds, const DirectedDistances& distances)
{
  bool is_between = true;
  for (const auto d :
       {&DirectedDistances::source_to_target, &DirectedDistances::mean_source_to_target,
        &DirectedDistances::target_to_source,
        &DirectedDistances::mean_target_to_source})
    is_between &= bounds.lower.*d <= distances.*d && distances.*d <= bounds.upper.*d;
  return is_between;
}

/** Any rotation; scales from 0.5 to 2, shifts up to half a unit. */
std::vector<Placement>
randomPlacements(std::size_t number, unsigned int seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> exponent(-1.0, 1.0);
  std::vector<Placement> placements{Eigen::Matrix4f::Identity().topRows<3>()};
  while (placements.size() < number)
    placements.push_back(similarity(randomRotation(random), std::exp2(exponent(random)),
                                    randomVector(random, 0.28))
                             .topRows<3>()
                             .cast<float>());
  return placements;
}

TEST_P(ExactSearch, HasBoundsThatHold)
{
  std::mt19937 random(1);
  const auto evaluator = makePairDistances(settings_);
  const auto bounds = makeBounds(settings_);
  const auto placements = randomPlacements(60, 2);
  int pair = 0;
  for (const Eigen::Index n : {1, 2, 8, 9, 40, 500})
    for (const Eigen::Index m : {1, 7, 33, 300})
      for (const float limit : {0.05f, 0.35f, no_limit}) {
        SCOPED_TRACE(::testing::Message() << n << " on " << m << ", limit " << limit);
        const Points source = randomCloud(random, n);
        const Points target = ++pair % 5 == 0 ? source : randomCloud(random, m);
        BoundsScope scope;
        scope.smallest_scale = 0.5;
        scope.largest_scale = 2.0;
        // a smaller scope makes them less close, not wrong
        scope.largest_shift = random() % 4 == 0 ? 0.1 : 0.5;
        scope.limit = limit;
        scope.beyond_limit = limit == no_limit || random() % 2 == 0;
        scope.nodes = 100 << random() % 8;
        bounds->setClouds(source, target, scope);
        evaluator->setClouds(source, target, limit);
        const auto distances = evaluator->evaluate(placements);
        for (const Eigen::Index probes : {1, 5, 64, 128, 700}) {
          const auto found = bounds->evaluate(placements, probes);
          ASSERT_EQ(placements.size(), found.size());
          for (std::size_t i = 0; i < placements.size(); ++i)
            ASSERT_TRUE(isBetween(found[i], distances[i])) << probes << " probes";
        }
      }
}

TEST_P(ExactSearch, HasCloseBounds)
{
  const auto evaluator = makePairDistances(settings_);
  const auto bounds = makeBounds(settings_);
  const auto placements = randomPlacements(100, 3);
  std::mt19937 random(4);
  const Points source = inOrder(sampled(creature(), 800, 5));
  const Points target = inOrder(sampled(lump(), 900, 6));
  for (const bool beyond_limit : {true, false}) {
    BoundsScope scope;
    scope.smallest_scale = 0.5;
    scope.largest_scale = 2.0;
    scope.largest_shift = 0.5;
    scope.limit = 0.35f;
    scope.beyond_limit = beyond_limit;
    bounds->setClouds(source, target, scope);
    evaluator->setClouds(source, target, scope.limit);
    const auto distances = evaluator->evaluate(placements);
    double before = 1.0;
    for (const Eigen::Index probes : {100, 200, 400, 900}) {
      const auto found = bounds->evaluate(placements, probes);
      double means = 0.0, largest = 0.0;
      for (const DistanceBounds& b : found) {
        means += b.upper.mean_source_to_target - b.lower.mean_source_to_target +
                 b.upper.mean_target_to_source - b.lower.mean_target_to_source;
        largest += b.upper.source_to_target - b.lower.source_to_target +
                   b.upper.target_to_source - b.lower.target_to_source;
      }
      means /= 2.0 * found.size();
      largest /= 2.0 * found.size();
      EXPECT_LT(means, before);
      before = means;
      if (probes == 900) {
        EXPECT_LT(means, beyond_limit ? 0.12 : 0.04);
        if (beyond_limit) {
          EXPECT_LT(largest, 0.1);
        }
      }
    }
  }
}

TEST_P(ExactSearch, HasNoBoundsOfDirectionsThatDoNotMatter)
{
  const auto bounds = makeBounds(settings_);
  const Points cloud = sampled(creature(), 200, 7);
  const auto placements = randomPlacements(10, 8);
  for (const bool forth : {true, false}) {
    BoundsScope scope;
    scope.smallest_scale = 0.5;
    scope.largest_scale = 2.0;
    scope.largest_shift = 0.5;
    scope.source_to_target = forth;
    scope.target_to_source = !forth;
    bounds->setClouds(cloud, 2.0f * cloud, scope);
    for (const DistanceBounds& b : bounds->evaluate(placements, 200)) {
      EXPECT_EQ(forth, b.upper.source_to_target > 1e-3f);
      EXPECT_EQ(!forth, b.upper.target_to_source > 1e-3f);
    }
  }
  EXPECT_TRUE(bounds->evaluate({}, 100).empty());
}

/** So many centres, \a step apart, whose middle is the origin. */
CandidateCenters
gridOf(int nx, int ny, int nz, double step)
{
  CandidateCenters found;
  found.steps = {nx, ny, nz};
  for (int x = 0; x < nx; ++x)
    for (int y = 0; y < ny; ++y)
      for (int z = 0; z < nz; ++z)
        found.centers.push_back(step * Eigen::Vector3d(x - 0.5 * (nx - 1),
                                                       y - 0.5 * (ny - 1),
                                                       z - 0.5 * (nz - 1)));
  return found;
}

const std::vector<Weights> all_weights{
    {1.0f, 1.0f}, {1.0f, 0.0f}, {0.0f, 1.0f}, {1.0f, 0.25f}, {0.25f, 1.0f}};

/** Whether the minima are brute force's, bit for bit. */
void
expectBruteForce(const Settings& settings,
                 const Sweep& sweep,
                 const Points& source,
                 const Points& target,
                 float limit)
{
  const auto evaluator = makePairDistances(settings);
  evaluator->setClouds(source, target, limit);
  const auto distances =
      evaluator->evaluate(sweep.candidates.placements(0, sweep.candidates.size()));
  const auto found =
      exactMinima(settings, sweep, distinct_angle, source, target, limit, *evaluator);
  EXPECT_EQ(sweep.energies.size(), found.size());
  for (std::size_t e = 0; e < found.size(); ++e) {
    std::vector<float> energies;
    for (const DirectedDistances& d : distances)
      energies.push_back(energyOf(d, sweep.energies[e], settings.energy));
    std::vector<std::size_t> candidates;
    for (const FoundMinimum& minimum : found[e]) {
      candidates.push_back(minimum.candidate);
      EXPECT_EQ(energies[minimum.candidate], minimum.energy);
    }
    EXPECT_EQ(sweep.candidates.localMinima(energies, settings.local_minimum_kernel,
                                           distinct_angle),
              candidates)
        << "weights " << sweep.energies[e].source_to_target << " and "
        << sweep.energies[e].target_to_source;
  }
}

TEST_P(ExactSearch, FindsTheMinimaOfBruteForce)
{
  std::mt19937 random(9);
  const auto oneOf = [&](int n) { return static_cast<int>(random() % n); };
  const std::vector<std::vector<double>> all_scales{
      {1.0}, {0.8}, {0.8, 1.0}, {0.64, 0.8, 1.0, 1.25}};
  const Eigen::Index sizes[] = {1, 2, 5, 30, 150, 250, 400};
  const int pairs = settings_.device == "host" ? 80 : 250; // that much slower
  for (int pair = 0; pair < pairs && !HasFailure(); ++pair) {
    const Eigen::Index n = sizes[oneOf(7)];
    const Points source = randomCloud(random, n);
    const Points target = oneOf(4) == 0 ? source : randomCloud(random, sizes[oneOf(7)]);
    std::shared_ptr<const CandidateRotations> rotations;
    if (oneOf(2) == 0)
      rotations = std::make_shared<EulerRotations>(2.0 * M_PI / (2 + oneOf(5)));
    else
      rotations = std::make_shared<EvenRotations>(1 + oneOf(100));
    const auto scales = all_scales[oneOf(4)];
    const auto centers = oneOf(3) == 0
                             ? ownCenter()
                             : gridOf(1 + oneOf(3), 1 + oneOf(3), 1 + oneOf(2), 0.3);
    settings_.local_minimum_kernel = 1 + oneOf(6);
    settings_.energy = oneOf(2) == 0 ? Energy::HAUSDORFF : Energy::TRUNCATED_MEAN;
    const float limits[] = {0.1f, 0.35f, no_limit};
    const float limit = limits[oneOf(3)];
    Sweep sweep{Candidates(rotations, scales, centers,
                           oneOf(2) == 0 ? Role::SOURCE : Role::TARGET),
                {all_weights[oneOf(5)]}};
    if (oneOf(3) == 0)
      sweep.energies = all_weights;
    SCOPED_TRACE(::testing::Message()
                 << "pair " << pair << ": " << n << " on " << target.cols()
                 << " points, " << sweep.candidates.size() << " candidates");
    expectBruteForce(settings_, sweep, source, target, limit);
  }
}

Points
preShape(const Points& cloud)
{
  return toPreShape({inOrder(cloud), Eigen::Vector3d::Zero()}).points;
}

TEST_P(ExactSearch, AsksForFewEnergies)
{
  // all pairs of points of a few candidates do, even where the clouds are small
  const Points source =
      preShape(part(sampled(creature(), 900, 10), {1.0f, 0.2f, 0.1f}, 0.6));
  const Points target = preShape(sampled(creature(), 500, 11));
  const Candidates candidates(std::make_shared<EulerRotations>(M_PI / 4.0), {1.0},
                              paperCenters(source), Role::SOURCE);
  settings_.local_minimum_kernel = 3;
  for (const Energy energy : {Energy::HAUSDORFF, Energy::TRUNCATED_MEAN}) {
    settings_.energy = energy;
    const auto evaluator = makePairDistances(settings_);
    evaluator->setClouds(source, target, 0.35f);
    SearchEffort effort;
    const auto found =
        exactMinima(settings_, {candidates, {{1.0f, 0.0f}}}, distinct_angle, source,
                    target, 0.35f, *evaluator, &effort);
    ASSERT_EQ(1u, found.size());
    EXPECT_LT(effort.exact,
              candidates.size() / (energy == Energy::HAUSDORFF ? 100 : 15));
    ASSERT_GE(effort.levels.size(), 2u);
    // each rotation is in the set twice at least
    EXPECT_LE(effort.levels.front().candidates, candidates.size() / 2);
    EXPECT_LT(effort.levels.back().candidates, candidates.size() / 5);
    EXPECT_EQ(540, effort.levels.back().probes);
  }
}

INSTANTIATE_TEST_SUITE_P(Host, ExactSearch, ::testing::Values("host"));
INSTANTIATE_TEST_SUITE_P(OpenCL, ExactSearch, ::testing::Values("auto"));

/** The sets of the paper, some rotations left out, and its number of points. */
TEST(ExactSearchAtFullSize, FindsTheMinimaOfBruteForce)
{
  Settings settings;
  settings.search = Search::EXACT;
  settings.local_minimum_kernel = 5;
  const Points whole = preShape(sampled(creature(), 2000, 12));
  const Points half =
      preShape(part(sampled(creature(), 3400, 13), {0.3f, 1.0f, 0.2f}, 0.6));
  const Points other = preShape(noisy(sampled(lump(), 2000, 14), 0.02, 15));
  const auto euler = std::make_shared<EulerRotations>(M_PI / 4.0);
  const auto even = std::make_shared<EvenRotations>(8);
  for (const Energy energy : {Energy::HAUSDORFF, Energy::TRUNCATED_MEAN}) {
    settings.energy = energy;
    const Weights from_source{1.0f, 0.0f};
    expectBruteForce(settings,
                     {Candidates(euler, {1.0}, ownCenter(), Role::TARGET), all_weights},
                     whole, other, 0.35f);
    expectBruteForce(
        settings,
        {Candidates(even, {1.0}, paperCenters(half), Role::SOURCE), {from_source}},
        half, whole, 0.35f);
  }
}

} // namespace
