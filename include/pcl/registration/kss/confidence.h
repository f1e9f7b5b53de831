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
 * The best poses of different objects score up to 0.43, of smooth lumps up to 0.53;
 * right ones 0.57 and more, which is two fifths of each cloud lying on the other;
 * between them, at 0.55, the confidence is 0.5.
 */
double
confidenceOf(const Overlap& overlap);

/** \brief Whether the second of the alternatives is about as good as the first, and the
 * first one rather sure than not: without a pose there is no choice of poses. */
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
