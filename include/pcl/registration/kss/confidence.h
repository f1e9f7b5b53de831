/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/alignment.h>
#include <pcl/registration/kss/overlap.h>
#include <pcl/registration/kss/settings.h>

#include <string>

namespace pcl {
namespace kss {

/** \brief How sure it is that two clouds show one object at a pose, in [0, 1]: the
 * logistic function of the overlap's score.
 *
 * The best poses of different objects score below 0.45, right ones above 0.65, which is
 * a third of each cloud lying on the other; between them, at 0.55, the confidence is
 * 0.5.
 */
double
confidenceOf(const Overlap& overlap);

/** \brief Whether the second of the alternatives is about as good as the first. */
bool
isAmbiguous(const Alternatives& alternatives);

/** \brief The mode that an overlap speaks for: complete is what lies on the other cloud
 * almost entirely. */
Mode
modeOf(const Overlap& overlap);

/** \brief A share in words: "42 %". */
std::string
percent(double share);

} // namespace kss
} // namespace pcl
