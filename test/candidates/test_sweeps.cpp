/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "local_cloud.h"
#include "poses.h"

#include "candidates/sweeps.h"
#include "geometry/pre_shape.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>

namespace {

using namespace kss_test;
using namespace pcl::kss;

constexpr ScaleRange one{1.0, 1.0};
constexpr ScaleRange wide{0.35, 1.0 / 0.35};

PreShape
preShape(const Points& points)
{
  return toPreShape(local(points));
}

Settings
few(Mode mode)
{
  Settings settings;
  settings.mode = mode;
  settings.even_rotations = 3;
  return settings;
}

constexpr Grain coarse{search_numbers::of_two_parts, 1e9, 0.35f, 8000, 80};

/** The scales of a sweep's candidates, rising. */
std::set<long>
scalesOf(const Sweep& sweep)
{
  std::set<long> thousandths;
  for (std::size_t i = 0; i < sweep.candidates.size(); ++i)
    thousandths.insert(std::lround(1000.0 * sweep.candidates.pose(i).scale));
  return thousandths;
}

double
farthestShift(const Sweep& sweep)
{
  double farthest = 0.0;
  for (std::size_t i = 0; i < sweep.candidates.size(); ++i)
    farthest = std::max(farthest, sweep.candidates.pose(i).translation.norm());
  return farthest;
}

class Sweeps : public ::testing::Test {
protected:
  std::vector<Sweep>
  of(const Settings& settings, const ScaleRange& scales) const
  {
    return sweepsOf(settings, source_, target_, scales, coarse);
  }

  const Points source_ = preShape(part(sampled(lump(), 900, 1), {1, 0, 0}, 0.6)).points;
  const Points target_ = preShape(sampled(lump(), 900, 2)).points;
};

TEST(EnergyOf, IsWhatWasAskedFor)
{
  const DirectedDistances d{4.0f, 0.5f, 3.0f, 0.25f};
  EXPECT_FLOAT_EQ(4.0f, energyOf(d, {1.0f, 1.0f}, Energy::HAUSDORFF));
  EXPECT_FLOAT_EQ(4.0f, energyOf(d, {1.0f, 0.0f}, Energy::HAUSDORFF));
  EXPECT_FLOAT_EQ(3.0f, energyOf(d, {0.0f, 1.0f}, Energy::HAUSDORFF));
  EXPECT_FLOAT_EQ(0.75f, energyOf(d, {1.0f, 1.0f}, Energy::TRUNCATED_MEAN));
  EXPECT_FLOAT_EQ(0.5f, energyOf(d, {1.0f, 0.0f}, Energy::TRUNCATED_MEAN));
  EXPECT_FLOAT_EQ(0.375f, energyOf(d, {0.25f, 1.0f}, Energy::TRUNCATED_MEAN));
}

TEST(ScaleRange, BringsScalesIntoIt)
{
  constexpr ScaleRange range{0.5, 2.0};
  EXPECT_EQ(0.5, range.clamp(0.1));
  EXPECT_EQ(1.3, range.clamp(1.3));
  EXPECT_EQ(2.0, range.clamp(3.0));
  EXPECT_EQ(1.0, ScaleRange().clamp(7.0));
}

TEST_F(Sweeps, ForCompleteCloudsLeaveTheCentersWhereTheyAre)
{
  const auto sweeps = of(few(Mode::GLOBAL_GLOBAL), wide);
  ASSERT_EQ(1u, sweeps.size());
  EXPECT_EQ(3u, sweeps[0].candidates.size());
  EXPECT_EQ(0.0, farthestShift(sweeps[0]));
  EXPECT_EQ((std::set<long>{1000}), scalesOf(sweeps[0]));
  // E_d of (e9) counts both directions
  ASSERT_EQ(1u, sweeps[0].energies.size());
  EXPECT_EQ(1.0f, sweeps[0].energies[0].source_to_target);
  EXPECT_EQ(1.0f, sweeps[0].energies[0].target_to_source);
  // a range without 1 is not left
  EXPECT_EQ((std::set<long>{1500}),
            scalesOf(of(few(Mode::GLOBAL_GLOBAL), {1.5, 2.0}).front()));
  EXPECT_EQ((std::set<long>{700}),
            scalesOf(of(few(Mode::GLOBAL_GLOBAL), {0.5, 0.7}).front()));
}

TEST_F(Sweeps, ForAPartTakeEitherCloudForIt)
{
  const auto sweeps = of(few(Mode::PARTIAL_GLOBAL), wide);
  ASSERT_EQ(2u, sweeps.size());
  // the source a part: it may have to shrink
  EXPECT_GT(sweeps[0].energies.front().source_to_target,
            sweeps[0].energies.front().target_to_source);
  EXPECT_EQ(1000, *scalesOf(sweeps[0]).rbegin());
  EXPECT_GT(scalesOf(sweeps[0]).size(), 1u);
  // the target a part: the other way round
  EXPECT_LT(sweeps[1].energies.front().source_to_target,
            sweeps[1].energies.front().target_to_source);
  EXPECT_EQ(1000, *scalesOf(sweeps[1]).begin());
  EXPECT_EQ(scalesOf(sweeps[0]).size(), scalesOf(sweeps[1]).size());
  for (const Sweep& sweep : sweeps)
    EXPECT_GT(farthestShift(sweep), 0.5);
  // the cloud that the part is looked for in is given centres
  EXPECT_EQ(Role::TARGET, sweeps[0].candidates.centered());
  EXPECT_EQ(Role::SOURCE, sweeps[1].candidates.centered());
  // a known scale is the only one
  for (const Sweep& sweep : of(few(Mode::PARTIAL_GLOBAL), one))
    EXPECT_EQ((std::set<long>{1000}), scalesOf(sweep));
}

TEST_F(Sweeps, ForTwoPartsLookFarther)
{
  const auto part = of(few(Mode::PARTIAL_GLOBAL), one);
  const auto two = of(few(Mode::PARTIAL_PARTIAL), one);
  ASSERT_EQ(2u, part.size());
  ASSERT_EQ(2u, two.size());
  for (std::size_t i = 0; i < 2; ++i) {
    ASSERT_EQ(1u, two[i].energies.size());
    const Weights& weights = two[i].energies.front();
    EXPECT_EQ(weights.source_to_target, weights.target_to_source);
    ASSERT_EQ(part[i].candidates.centered(), two[i].candidates.centered());
    EXPECT_GT(farthestShift(two[i]), 1.2 * farthestShift(part[i]));
  }
  // scales both ways, where there are more than one: what is turned shrinks
  const auto sweeps = of(few(Mode::PARTIAL_PARTIAL), wide);
  ASSERT_EQ(2u, sweeps.size());
  EXPECT_EQ(Role::TARGET, sweeps[0].candidates.centered());
  EXPECT_EQ(Role::SOURCE, sweeps[1].candidates.centered());
  const auto shrunk = scalesOf(sweeps[0]), grown = scalesOf(sweeps[1]);
  EXPECT_LT(*shrunk.begin(), 600);
  EXPECT_GT(*grown.rbegin(), 1700);
  // and one step more, where the other is a part, too
  EXPECT_EQ(1250, *shrunk.rbegin());
  EXPECT_EQ(800, *grown.begin());
  for (const auto& scales : {shrunk, grown})
    EXPECT_EQ(1u, scales.count(1000));
}

TEST_F(Sweeps, LookAsFarAsTheLargerCloudReaches)
{
  // with a known scale the pre-shapes differ in size
  const auto sweepsFor = [&](float size) {
    return sweepsOf(few(Mode::PARTIAL_PARTIAL), size * source_, target_, one, coarse);
  };
  const auto same = sweepsFor(1.0f), small = sweepsFor(0.5f), large = sweepsFor(2.0f);
  // centres on the target reach as far as a larger source asks, and the other way round
  EXPECT_NEAR(farthestShift(same[0]), farthestShift(small[0]), 0.05);
  EXPECT_NEAR(2.0 * farthestShift(same[0]), farthestShift(large[0]), 0.05);
  EXPECT_NEAR(farthestShift(same[1]), farthestShift(small[1]), 0.05);
  EXPECT_NEAR(2.0 * farthestShift(same[1]), farthestShift(large[1]), 0.05);
}

TEST_F(Sweeps, WithoutAModeAskForAllEnergies)
{
  for (const ScaleRange& scales : {one, wide}) {
    const auto sweeps = of(few(Mode::AUTOMATIC), scales);
    ASSERT_EQ(2u, sweeps.size());
    for (const Sweep& sweep : sweeps) {
      int both = 0, from_source = 0, from_target = 0;
      for (const Weights& weights : sweep.energies) {
        both += weights.source_to_target == weights.target_to_source;
        from_source += weights.source_to_target > weights.target_to_source;
        from_target += weights.source_to_target < weights.target_to_source;
      }
      // the cloud that an energy is directed to is the one that is given centres
      const bool on_target = sweep.candidates.centered() == Role::TARGET;
      EXPECT_EQ(&sweep == &sweeps[0], on_target);
      EXPECT_EQ(1, both);
      EXPECT_EQ(on_target ? 1 : 0, from_source);
      EXPECT_EQ(on_target ? 0 : 1, from_target);
      EXPECT_GT(farthestShift(sweep), 0.5);
    }
  }
}

TEST_F(Sweeps, StayWithinTheScalesAskedFor)
{
  for (const Mode mode : {Mode::AUTOMATIC, Mode::GLOBAL_GLOBAL, Mode::PARTIAL_GLOBAL,
                          Mode::PARTIAL_PARTIAL})
    for (const ScaleRange& range :
         {one, ScaleRange{0.7, 0.9}, ScaleRange{1.1, 2.0}, ScaleRange{0.05, 0.1},
          ScaleRange{5.0, 5.0},
          ScaleRange{0.0, std::numeric_limits<double>::infinity()}})
      for (const Sweep& sweep : of(few(mode), range)) {
        ASSERT_GT(sweep.candidates.size(), 0u);
        for (std::size_t i = 0; i < sweep.candidates.size(); ++i) {
          const double scale = sweep.candidates.pose(i).scale;
          EXPECT_GE(scale, range.smallest * (1.0 - 1e-9));
          EXPECT_LE(scale, range.largest * (1.0 + 1e-9));
        }
      }
}

TEST_F(Sweeps, LieAsCloseAsTheGrainSays)
{
  const auto sweepsAt = [&](const Grain& grain) {
    return sweepsOf(few(Mode::AUTOMATIC), source_, target_, one, grain);
  };
  const auto usual = sweepsAt(coarse);
  Grain grain = coarse;
  grain.two_parts.step *= 0.5;
  const auto fine = sweepsAt(grain);
  ASSERT_EQ(usual.size(), fine.size());
  for (std::size_t i = 0; i < fine.size(); ++i) {
    EXPECT_GT(fine[i].candidates.size(), 4 * usual[i].candidates.size());
    EXPECT_NEAR(farthestShift(fine[i]), farthestShift(usual[i]), 1e-6);
  }
  // and no more of them than it allows
  grain.most_candidates = 3.0 * 200.0;
  for (const Sweep& sweep : sweepsAt(grain)) {
    EXPECT_LE(sweep.candidates.size(), 600u);
    EXPECT_GT(sweep.candidates.size(), 100u);
  }
}

TEST_F(Sweeps, LookForTheSmallerCloudInAScene)
{
  Grain grain = coarse;
  grain.in_scene = true;
  for (const float size : {0.2f, 5.0f}) {
    const auto sweeps =
        sweepsOf(few(Mode::IN_SCENE), size * source_, target_, one, grain);
    ASSERT_EQ(1u, sweeps.size());
    ASSERT_EQ(1u, sweeps[0].energies.size());
    const Weights& weights = sweeps[0].energies.front();
    const bool source_is_small = size < 1.0f;
    // it is asked alone, and the centres are the scene's
    EXPECT_EQ(source_is_small ? 1.0f : 0.0f, weights.source_to_target);
    EXPECT_EQ(source_is_small ? 0.0f : 1.0f, weights.target_to_source);
    EXPECT_EQ(source_is_small ? Role::TARGET : Role::SOURCE,
              sweeps[0].candidates.centered());
    EXPECT_EQ((std::set<long>{1000}), scalesOf(sweeps[0]));
    EXPECT_GT(farthestShift(sweeps[0]), source_is_small ? 1.0 : 5.0);
  }
}

TEST_F(Sweeps, AreThePapersIfAskedFor)
{
  const Settings settings = paperSettings(few(Mode::PARTIAL_GLOBAL));
  EXPECT_EQ(Mode::PARTIAL_GLOBAL, settings.mode);
  EXPECT_EQ(Mode::GLOBAL_GLOBAL, paperSettings(Settings()).mode);
  const auto sweeps = of(settings, one);
  ASSERT_EQ(2u, sweeps.size());
  for (const Sweep& sweep : sweeps)
    EXPECT_EQ(125u * 1728u, sweep.candidates.size());
  // E_cd of (e122) is directed: from the part alone
  EXPECT_EQ(1.0f, sweeps[0].energies.front().source_to_target);
  EXPECT_EQ(0.0f, sweeps[0].energies.front().target_to_source);
  EXPECT_EQ(0.0f, sweeps[1].energies.front().source_to_target);
  EXPECT_EQ(1.0f, sweeps[1].energies.front().target_to_source);
  // and it is the part that is given centres
  EXPECT_EQ(Role::SOURCE, sweeps[0].candidates.centered());
  EXPECT_EQ(Role::TARGET, sweeps[1].candidates.centered());
}

TEST_F(Sweeps, HoldACandidateNearTheTruth)
{
  // the source is six tenths of the target: where has its centre gone?
  const PreShape whole = preShape(sampled(lump(), 900, 2));
  const PreShape rest = preShape(part(sampled(lump(), 900, 1), {1, 0, 0}, 0.6));
  const Eigen::Matrix4d truth =
      (whole.T_cloud_shape().inverse() * rest.T_cloud_shape()).matrix();
  Settings settings;
  for (const Mode mode :
       {Mode::AUTOMATIC, Mode::PARTIAL_GLOBAL, Mode::PARTIAL_PARTIAL}) {
    settings.mode = mode;
    double nearest = 10.0;
    for (const Sweep& sweep : of(settings, wide))
      for (std::size_t i = 0; i < sweep.candidates.size(); ++i)
        nearest = std::min(nearest, (sweep.candidates.pose(i).matrix() - truth).norm());
    // half a diagonal of the grid of centres (0.31), a gap of the rotations (20
    // degrees: 0.5) and half a step of scale (0.2) at once
    EXPECT_LT(nearest, 0.65);
  }
}

} // namespace
