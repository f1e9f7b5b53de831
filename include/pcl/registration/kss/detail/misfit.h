/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/export.h>

#include <string>

namespace pcl {
namespace kss {

/** \brief The score of the overlap of clouds that resemble each other: different
 * objects score 0.33 at most, mirror images 0.41 and more. */
constexpr double resembling = 0.36;

/** \brief Clouds whose sizes are no farther apart than this are in one unit. */
constexpr double same_size = 1.5;

/** \brief One sentence on a source that fits only as its mirror image. */
PCL_KSS_ICP_EXPORT std::string
misfitButMirrored();

/** \brief One sentence on clouds that fit, but not at the scale that was given.
 * \param[in] fitting the scale at which they do
 * \param[in] given the scale that they were said to have
 */
PCL_KSS_ICP_EXPORT std::string
misfitButScaled(double fitting, double given);

} // namespace kss
} // namespace pcl
