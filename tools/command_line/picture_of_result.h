/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "io/geometry.h"
#include "options.h"
#include "registration.h"

#include <ostream>

namespace tool {

/** \brief Check that pictures can be drawn at all.
 * \throws std::runtime_error where the tool was built without what draws them
 */
void
checkPictures();

/** \brief Draw a result, or what was refused, as PNG. */
void
writePicture(const Result& result,
             const Options& options,
             const Geometry& source,
             const Geometry& target,
             std::ostream& stream);

} // namespace tool
