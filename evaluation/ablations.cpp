/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "ablations.h"

#include "kss_icp_methods.h"
#include "preparation/simplification.h"

#include <cmath>
#include <limits>

namespace evaluation {
namespace {

using pcl::kss::Settings;

Method
variant(const std::string& name, const std::function<void(Settings&)>& change)
{
  return kssICPMethod(name, [change](const Task&) {
    Settings settings;
    change(settings);
    return settings;
  });
}

Method
eulerGrid(int degrees)
{
  return variant("Euler, " + std::to_string(degrees) + "° steps",
                 [degrees](Settings& settings) {
                   settings.rotation_set = pcl::kss::RotationSet::EULER;
                   settings.angle_step = degrees * M_PI / 180.0;
                 });
}

Method
evenRotations(unsigned int number)
{
  return variant(std::to_string(number) + " even rotations",
                 [number](Settings& settings) { settings.even_rotations = number; });
}

Method
samplePoints(unsigned int k)
{
  return variant("k = " + std::to_string(k),
                 [k](Settings& settings) { settings.sample_points = k; });
}

Method
icpPoints(unsigned int number)
{
  return variant(number == 0 ? "all points in ICP"
                             : std::to_string(number) + " points in ICP",
                 [number](Settings& settings) { settings.icp_points = number; });
}

} // namespace

std::vector<Ablation>
ablations()
{
  using namespace pcl::kss;
  return {
      {"rotations",
       "rotation set and step",
       {evenRotations(500), evenRotations(1000), evenRotations(4000), eulerGrid(45),
        eulerGrid(30), eulerGrid(20)}},
      {"energy",
       "energy",
       {variant("Hausdorff",
                [](Settings& settings) {
                  settings.energy = Energy::HAUSDORFF;
                  settings.search = Search::EXACT;
                })}},
      {"additional-process",
       "additional process",
       {variant("no additional process",
                [](Settings& settings) {
                  settings.additional_process_threshold =
                      std::numeric_limits<double>::infinity();
                })}},
      {"points",
       "number of points k",
       {samplePoints(250), samplePoints(500), samplePoints(1000), samplePoints(4000)}},
      {"simplification",
       "simplification",
       {variant("quotas of (e5)",
                [](Settings& settings) { settings.density = Density::PAPER; }),
        variant("random points",
                [](Settings& settings) { settings.density = random_points; }),
        variant("farthest points, no cleaning",
                [](Settings& settings) { settings.clean = false; }),
        variant("quotas, no cleaning",
                [](Settings& settings) {
                  settings.density = Density::PAPER;
                  settings.clean = false;
                })}},
      {"centers",
       "centres",
       {variant("centres of (e123)",
                [](Settings& settings) {
                  settings.center_set = CenterSet::PAPER;
                  settings.search = Search::EXACT;
                })}},
      {"search",
       "search",
       {variant("exact search",
                [](Settings& settings) { settings.search = Search::EXACT; })}},
      {"icp-points",
       "points in the final ICP",
       {icpPoints(2500), icpPoints(5000), icpPoints(0)}}};
}

} // namespace evaluation
