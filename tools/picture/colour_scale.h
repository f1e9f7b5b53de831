/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <cstddef>
#include <cstdint>

namespace tool {

/** \brief A colour as screens show it (sRGB), each part in [0, 1]. */
struct Colour {
  double red, green, blue;
};

/** \brief What SOURCE and TARGET are drawn in: told apart by every kind of sight. */
constexpr Colour SOURCE_COLOUR{0.95, 0.52, 0.13}, TARGET_COLOUR{0.27, 0.52, 0.82};

/** \brief The colour that stands for a share of the largest value: from a dark blue by
 * green to a light yellow.
 *
 * Equal steps look equally large, and lightness alone tells the order, so that it reads
 * the same to the colour-blind and in grey: a curve in OKLab (B. Ottosson, 2020), in
 * which distances are differences as people see them, by the length of its arc.
 * \param[in] share in [0, 1]; what is beyond counts as the nearer end
 */
Colour
colourOf(double share);

/** \brief The colour of one of many things that have no order: neighbours in number
 * differ most, all are about as light, and a dark text on them is legible.
 */
Colour
colourOfNumber(std::size_t number);

/** \brief Opaque and packed, as images have it: alpha, red, green, blue. */
std::uint32_t
packed(const Colour& colour);

} // namespace tool
