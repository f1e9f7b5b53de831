/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * Where nothing fits: what would.
 */

#include <pcl/registration/kss/detail/misfit.h>

#include "support/short_text.h"
#include "support/units.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace pcl {
namespace kss {
namespace {

/** The score of the overlap of clouds that resemble each other: different objects score
 * 0.33 at most, mirror images 0.41 and more. */
constexpr double resembling = 0.36;

/** Clouds whose sizes are no farther apart than this are in one unit. */
constexpr double same_size = 1.5;

/** The axes that make all mirror images of a cloud, but for how it is turned. */
std::vector<int>
mirrorsFor(RotationAxis axis)
{
  switch (axis) {
  case RotationAxis::X:
    return {0, 1};
  case RotationAxis::Y:
    return {1, 2};
  case RotationAxis::Z:
    return {2, 0};
  case RotationAxis::ANY:
    break;
  }
  return {0};
}

std::string
misfitButScaled(double fitting, double given)
{
  const double factor = fitting / given;
  const bool target_is_large = factor > 1.0;
  return "The clouds do not fit at the scale " + shortText(given) + ", but at " +
         shortText(fitting) + ": " +
         (target_is_large ? questionOfUnits("target", "source", factor)
                          : questionOfUnits("source", "target", 1.0 / factor)) +
         ", or is the scale to be estimated?";
}

constexpr const char* misfit_but_metric =
    "The clouds do not fit at an unknown scale, but at scale 1, as an object in a "
    "scene: if that is known, use setScaleEstimation(false), on the command line "
    "--rigid.";

/** Whether one of the clouds may be an object in the other one, at scale 1: where the
 * scale is estimated, none is looked for. */
bool
mayBeAnObjectInAScene(const Settings& settings, double given_scale)
{
  return settings.mode == Mode::AUTOMATIC && given_scale == 1.0 &&
         settings.smallest_scale <= 1.0 && settings.largest_scale >= 1.0;
}

} // namespace

std::string
whatWouldFit(const Settings& settings,
             const Overlap& overlap,
             double given_scale,
             double size_ratio,
             const ScaleOfFit& scale_of_fit)
{
  const std::vector<int> mirrors = mirrorsFor(settings.rotation_axis);
  if (overlap.score >= resembling &&
      std::any_of(mirrors.begin(), mirrors.end(),
                  [&](int axis) { return scale_of_fit(axis, settings).has_value(); }))
    return "The source fits the target only as its mirror image: is an axis of one of "
           "them turned round, or is it a counterpart, as a left hand is of a right "
           "one?";
  if (std::abs(std::log(size_ratio / given_scale)) < std::log(same_size) ||
      (settings.estimate_scale && !mayBeAnObjectInAScene(settings, given_scale)))
    return "";
  Settings other = settings;
  other.estimate_scale = !settings.estimate_scale;
  const std::optional<double> fitting = scale_of_fit({}, other);
  if (!fitting)
    return "";
  return settings.estimate_scale ? misfit_but_metric
                                 : misfitButScaled(*fitting, given_scale);
}

} // namespace kss
} // namespace pcl
