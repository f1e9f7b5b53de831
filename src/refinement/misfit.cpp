/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include <pcl/registration/kss/detail/misfit.h>

#include "support/short_text.h"
#include "support/units.h"

namespace pcl {
namespace kss {

std::string
misfitButMirrored()
{
  return "The source fits the target only as its mirror image: is an axis of one of "
         "them turned round, or is it a counterpart, as a left hand is of a right one?";
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

} // namespace kss
} // namespace pcl
