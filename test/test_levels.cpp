/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * The levels of the search, and what the finer ones find.
 */

#include "local_cloud.h"
#include "poses.h"

#include <pcl/registration/kss/alignment.h>

#include "levels.h"
#include "preparation/preparation.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace {

using namespace kss_test;
using namespace pcl::kss;

Settings
rigid(Mode mode)
{
  Settings settings;
  settings.mode = mode;
  settings.estimate_scale = false;
  settings.threads = 1;
  return settings;
}

/** The levels for two clouds of which the source is so many times as large. */
std::vector<SearchLevel>
levelsOf(const Settings& settings, float size = 1.0f)
{
  const PreparedPair clouds =
      Preparation(settings).prepared(local(size * sampled(lump(), 3000, 1)),
                                     local(sampled(lump(), 3000, 2)), [](double) {});
  return levelsFor(settings, *shapePair(clouds, {}, settings, nullptr));
}

/** A creature half as large, and a room with furniture, several times as large. */
Mesh
object()
{
  Mesh mesh = creature();
  for (Triangle& t : mesh)
    t = {0.5 * t.a, 0.5 * t.b, 0.5 * t.c};
  return mesh;
}

Mesh
furniture()
{
  return together(
      {panel({0, 0, 0}, {5, 0, 0}, {0, 4, 0}), panel({0, 0, 0}, {5, 0, 0}, {0, 0, 2.5}),
       panel({0, 0, 0}, {0, 4, 0}, {0, 0, 2.5}), box({1.2, 3.2, 0.4}, {0.7, 0.4, 0.05}),
       box({4.4, 1.0, 0.9}, {0.2, 0.5, 0.9}), box({2.5, 0.4, 0.5}, {0.5, 0.2, 0.5}),
       ellipsoid({3.5, 3.0, 0.4}, {0.5, 0.3, 0.4})});
}

TEST(Levels, AreOneWhereNoFinerOneHelps)
{
  Settings free;
  EXPECT_EQ(1u, levelsOf(free).size());
  EXPECT_EQ(1u, levelsOf(rigid(Mode::GLOBAL_GLOBAL)).size());
  EXPECT_EQ(1u, levelsOf(rigid(Mode::PARTIAL_GLOBAL)).size());
  Settings exact = rigid(Mode::AUTOMATIC);
  exact.search = Search::EXACT;
  EXPECT_EQ(1u, levelsOf(exact).size());
}

TEST(Levels, GoFromCoarseToFineWhereTheScaleIsKnown)
{
  for (const Mode mode : {Mode::AUTOMATIC, Mode::PARTIAL_PARTIAL}) {
    const auto levels = levelsOf(rigid(mode));
    ASSERT_EQ(2u, levels.size());
    EXPECT_EQ("", std::string(levels[0].prefix));
    EXPECT_LT(levels[1].grain.two_parts.step, 0.5 * levels[0].grain.two_parts.step);
    EXPECT_LT(levels[1].grain.limit, 0.5f * levels[0].grain.limit);
    EXPECT_GT(levels[1].grain.minima, levels[0].grain.minima);
    EXPECT_FALSE(levels[1].grain.in_scene);
  }
}

TEST(Levels, TellAnObjectInASceneByItsSize)
{
  for (const float size : {0.3f, 3.0f}) {
    EXPECT_TRUE(levelsOf(rigid(Mode::AUTOMATIC), size).at(1).grain.in_scene);
    EXPECT_FALSE(levelsOf(rigid(Mode::PARTIAL_PARTIAL), size).at(1).grain.in_scene);
  }
  EXPECT_FALSE(levelsOf(rigid(Mode::AUTOMATIC), 0.9f).at(1).grain.in_scene);
  const auto asked = levelsOf(rigid(Mode::IN_SCENE), 0.9f);
  ASSERT_EQ(1u, asked.size());
  EXPECT_TRUE(asked[0].grain.in_scene);
  Settings free;
  free.mode = Mode::IN_SCENE;
  EXPECT_THROW(levelsOf(free), std::invalid_argument);
}

TEST(Levels, WidenWhereThereAreFewRotations)
{
  Settings few = rigid(Mode::AUTOMATIC);
  few.even_rotations /= 8;
  const auto usual = levelsOf(rigid(Mode::AUTOMATIC)), wide = levelsOf(few);
  for (std::size_t i = 0; i < usual.size(); ++i) {
    EXPECT_NEAR(2.0, wide[i].grain.limit / usual[i].grain.limit, 1e-5);
    EXPECT_NEAR(2.0, wide[i].selection.reach / usual[i].selection.reach, 1e-5);
  }
}

TEST(Levels, FindAnObjectInAScene)
{
  const Eigen::Matrix4d truth =
      similarity(Eigen::Quaterniond(Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitZ())),
                 1.0, {2.4, 1.8, 0.5});
  const Points placed = transformed(sampled(object(), 4000, 3), truth);
  const Points room = sampled(furniture(), 60000, 4);
  Points scene(3, room.cols() + placed.cols());
  scene << room, placed;
  for (unsigned int seed = 5; seed < 8; ++seed) {
    const Eigen::Matrix4d moved = randomRigid(seed);
    const Points source = transformed(sampled(object(), 4000, seed), moved);
    const Eigen::Matrix4d right = truth * moved.inverse();
    for (const Mode mode : {Mode::IN_SCENE, Mode::AUTOMATIC}) {
      Stages stages;
      const Alternatives found = Alignment(rigid(mode))
                                     .align(local(source), local(scene), {}, stages)
                                     .alternatives;
      EXPECT_LT(displacement(found.front().transformation, right, source), 0.05)
          << seed;
      if (mode == Mode::IN_SCENE) {
        EXPECT_EQ("scene refinement", stages.seconds().back().stage);
      }
    }
    // and the scene upon the object
    Stages stages;
    const Alternatives found = Alignment(rigid(Mode::IN_SCENE))
                                   .align(local(scene), local(source), {}, stages)
                                   .alternatives;
    EXPECT_LT(displacement(found.front().transformation.inverse(), right, source), 0.05)
        << seed;
  }
}

} // namespace
