/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "picture/colour_scale.h"

#include <string>

namespace tool {

/** \brief A text as HTML and SVG show it, whatever is in it. */
std::string
escaped(const std::string& text);

/** \brief A number with so many digits behind the point. */
std::string
fixedText(double number, int digits);

/** \brief A number with commas between thousands. */
std::string
groupedText(std::size_t number);

/** \brief A colour as CSS has it: "#12ab9f". */
std::string
cssColour(const Colour& colour);

/** \brief Bytes as base64, as data URIs have them. */
std::string
base64(const std::string& bytes);

} // namespace tool
