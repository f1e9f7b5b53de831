/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <string>

namespace tool {

/** \brief The text with a question mark for what is no UTF-8, and for control
 * characters: names of files may hold anything, and cairo draws nothing more after such
 * a text. */
std::string
legible(const std::string& text);

} // namespace tool
