/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "io/geometry.h"
#include "options.h"
#include "registration.h"

#include <string>

namespace tool {

/** \brief What was registered, how, and all results, as JSON; numbers that there are
 * none of are null. docs/report.md lists what is in it.
 */
std::string
reportText(const Result& result,
           const Options& options,
           const Geometry& source,
           const Geometry& target);

/** \brief The results in a few lines for people.
 * \pre result.converged
 */
std::string
summaryText(const Result& result, const Options& options);

} // namespace tool
