/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * Candidates split over all devices of a platform that has several. PoCL shows two
 * where the environment says POCL_DEVICES="pthread basic", as ctest does.
 */

#include "shapes.h"

#include <pcl/registration/kss/alignment.h>
#include <pcl/registration/kss/devices.h>

#include "evaluators/evaluator_choice.h"

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

namespace {

using namespace kss_test;
using namespace pcl::kss;

/** The platform of a device, "device (platform)". */
std::string
platformOf(const std::string& name)
{
  const std::size_t begin = name.rfind(" (") + 2;
  return name.substr(begin, name.size() - begin - 1);
}

/** Those of the first platform that has several; none where none has. */
std::vector<std::string>
devices()
{
  std::map<std::string, std::vector<std::string>> devices_of;
  for (const std::string& name : openCLDeviceNames())
    devices_of[platformOf(name)].push_back(name);
  for (const auto& [platform, names] : devices_of)
    if (names.size() > 1)
      return names;
  return {};
}

class SeveralDevices : public testing::Test {
protected:
  void
  SetUp() override
  {
    const auto found = devices();
    if (found.empty())
      GTEST_SKIP() << "No platform has two devices: set POCL_DEVICES=\"pthread basic\"";
    one_ = found.front();
    all_ = platformOf(one_);
  }

  std::string one_, all_; ///< what to ask for
};

std::vector<Placement>
somePlacements(std::size_t number)
{
  std::vector<Placement> placements;
  for (std::size_t i = 0; i < number; ++i) {
    Placement placement;
    placement << Eigen::AngleAxisf(0.01f * i, Eigen::Vector3f(1, 2, i % 5).normalized())
                     .toRotationMatrix(),
        Eigen::Vector3f(0.001f * i, 0.1f, -0.1f);
    placements.push_back(placement);
  }
  return placements;
}

TEST_F(SeveralDevices, ShareTheCandidatesWithoutATrace)
{
  const Points source = sampled(creature(), 300, 1),
               target = sampled(creature(), 300, 2);
  for (const auto& make : {&makeLookUps, &makePairDistances})
    for (const std::size_t number : {0, 1, 2, 7, 501}) {
      Settings settings;
      settings.device = one_;
      const auto alone = make(settings);
      settings.device = all_;
      const auto together = make(settings);
      EXPECT_NE(std::string::npos, together->deviceName().find(" + "));
      alone->setClouds(source, target, 0.4f);
      together->setClouds(source, target, 0.4f);
      const auto placements = somePlacements(number);
      const auto a = alone->evaluate(placements), b = together->evaluate(placements);
      ASSERT_EQ(a.size(), b.size());
      for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(a[i].source_to_target, b[i].source_to_target);
        EXPECT_EQ(a[i].mean_source_to_target, b[i].mean_source_to_target);
        EXPECT_EQ(a[i].target_to_source, b[i].target_to_source);
        EXPECT_EQ(a[i].mean_target_to_source, b[i].mean_target_to_source);
      }
    }
}

TEST_F(SeveralDevices, FindThePoseThatOneFinds)
{
  const LocalCloud source{sampled(creature(), 2000, 3), Eigen::Vector3d::Zero()};
  const LocalCloud target{sampled(creature(), 2000, 4), Eigen::Vector3d::Zero()};
  for (const Search search : {Search::SCREENED, Search::EXACT}) {
    Settings settings;
    settings.sample_points = 500;
    settings.search = search;
    if (search == Search::EXACT)
      settings.mode = Mode::GLOBAL_GLOBAL;
    std::vector<Eigen::Matrix4d> found;
    for (const std::string& device : {one_, all_}) {
      settings.device = device;
      Alignment alignment(settings);
      Stages stages;
      found.push_back(alignment.align(source, target, {}, stages)
                          .alternatives.front()
                          .transformation);
    }
    EXPECT_EQ(found[0], found[1]);
  }
}

} // namespace
