/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "levels.h"

#include "candidates/numbers.h"
#include "candidates/rotations.h"
#include "geometry/clouds.h"
#include "geometry/relative_size.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace pcl {
namespace kss {
namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();

/** Log odds of poses that convince: the wrong ones of what is nearly symmetric stay
 * below. The few points of the coarse level show little of an object in a scene: there
 * only odds of ten to one do. */
constexpr double likely = 1.0, doubtless = 2.3;

/** Few rotations lie farther apart, and leave points farther off: see reachOf(). */
double
widening(const Settings& settings)
{
  return search_numbers::reachOf(numberOfRotations(settings)) /
         search_numbers::reachOf(numberOfRotations(Settings()));
}

/** Steps as wide as ICP on many starts closes; what they leave open is what counts.
 * \param[in] ratio of the clouds' sizes
 */
SearchLevel
coarse(const Settings& settings, double ratio)
{
  const double reach = search_numbers::reachOf(numberOfRotations(settings));
  return {
      "",
      {search_numbers::of_two_parts, unbounded, static_cast<float>(reach), 8000, 80},
      {reach, 60, 16, most_alternatives, 0.15, 0.1},
      mayBeInScene(ratio) ? doubtless : likely};
}

/** A third of the steps: candidates whose distances count up to as much leave few
 * points near by chance. The right one is then known by a tenth of the surface, but
 * many more come close to it, and so many more are looked into.
 */
SearchLevel
fine(const Settings& settings)
{
  const double reach = search_numbers::reachOf(numberOfRotations(settings));
  const double wide = widening(settings);
  return {"finer ",
          {{search_numbers::of_two_parts.reach, 0.12 * wide},
           2e7,
           static_cast<float>(0.12 * wide),
           40000,
           400},
          {reach, 300, 60, most_alternatives, 0.06, 0.05},
          unbounded};
}

/** Finer still, from no farther off than an object's own size, and with as many poses
 * in the end as there are other things that it resembles.
 * \param[in] unit radius of the scene, in radii of the target
 */
SearchLevel
inScene(const Settings& settings, double unit)
{
  const double wide = unit * widening(settings);
  return {"scene ",
          {{search_numbers::of_two_parts.reach, 0.1 * wide},
           2e7,
           static_cast<float>(0.08 * wide),
           60000,
           1600,
           true},
          {0.12 * wide, 500, 120, 3 * most_alternatives, 0.06 * unit, 0.04 * unit, unit,
           true},
          unbounded};
}

/** How many times as large the source is as the target. */
double
sizeRatio(const ShapePair& shapes)
{
  const auto radiusOf = [](const Shape& shape) {
    return rootMeanSquareRadius(shape.simplified.points, Eigen::Vector3f::Zero());
  };
  return radiusOf(shapes.source) / radiusOf(shapes.target);
}

} // namespace

std::vector<SearchLevel>
levelsFor(const Settings& settings, const ShapePair& shapes)
{
  const double ratio = sizeRatio(shapes), larger = std::max(1.0, ratio);
  const bool scale_is_known = shapes.scales.smallest >= shapes.scales.largest;
  if (settings.mode == Mode::IN_SCENE) {
    if (!scale_is_known)
      throw std::invalid_argument(
          "An object in a scene can be found at a known scale only: use "
          "setScaleEstimation(false), on the command line --rigid.");
    return {inScene(settings, larger)};
  }
  std::vector<SearchLevel> levels{coarse(settings, ratio)};
  const bool may_lack_parts =
      settings.mode == Mode::AUTOMATIC || settings.mode == Mode::PARTIAL_PARTIAL;
  if (!may_lack_parts || !scale_is_known || searchOf(settings) != Search::SCREENED)
    return levels;
  const bool is_scene = settings.mode == Mode::AUTOMATIC && mayBeInScene(ratio);
  levels.push_back(is_scene ? inScene(settings, larger) : fine(settings));
  return levels;
}

} // namespace kss
} // namespace pcl
