/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "canvas.h"
#include "distances.h"
#include "panel.h"

namespace tool {

/** \brief Draw how many points are how far away, in the colours that stand for that,
 * over the scale of these.
 */
void
drawHistogram(Canvas& canvas, const Area& area, const Distances& distances);

} // namespace tool
