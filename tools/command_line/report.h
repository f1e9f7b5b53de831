/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "io/geometry.h"
#include "options.h"
#include "registration.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace tool {

/** \brief How to register, as the report has it. */
nlohmann::ordered_json
settingsAsJSON(const Options& options);

/** \brief What was registered, how, and all results, but no times. */
nlohmann::ordered_json
reportOf(const Result& result,
         const Options& options,
         const Geometry& source,
         const Geometry& target);

/** \brief JSON as text; names of devices and files may hold anything.
 * \param[in] indent -1: all on one line
 */
std::string
textOf(const nlohmann::ordered_json& json, int indent);

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
