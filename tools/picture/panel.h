/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "canvas.h"
#include "io/geometry.h"
#include "view.h"

#include <cstdint>
#include <vector>

namespace tool {

/** \brief A rectangle of the sheet, in pixels from its upper left corner. */
struct Area {
  double x, y, width, height;
};

/** \brief Points that are drawn alike. */
struct Layer {
  /** \brief See seenFrom(). */
  Points seen;
  /** \brief How far they are from each other. */
  double spacing;
  /** \brief One for all of them, or one for each; see packed(). */
  std::vector<std::uint32_t> colours;
};

/** \brief An image of points, clear where there are none.
 * \param[in] relief see drawSplats()
 */
Image
imageOf(int width,
        int height,
        const Frame& frame,
        const std::vector<const Layer*>& layers,
        double relief);

/** \brief Draw points.
 * \param[in] relief see drawSplats()
 */
void
drawLayers(Canvas& canvas,
           const Area& area,
           const Frame& frame,
           const std::vector<const Layer*>& layers,
           double relief);

/** \brief The longest of 1, 2 and 5 times a power of ten that is not longer. */
double
roundLength(double most);

/** \brief Draw a line in the lower left corner, and how long it is. */
void
drawRuler(Canvas& canvas, const Area& area, const Frame& frame);

} // namespace tool
