/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "command_line/options.h"
#include "manifest.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

/** \file
 * One pair, as the single tool does it, and what has come of it as JSON: \c status, the
 * columns of results.csv that follow it (\c row), the \c report, the \c seconds that it
 * took, and what tells whether its files have changed since (\c inputs).
 */

namespace tool {

/** \brief The words for what has come of a pair. */
constexpr const char *REGISTERED = "registered", *AMBIGUOUS = "ambiguous",
                     *REFUSED = "refused", *FAILED_PAIR = "failed";

/** \brief The columns of results.csv that \c row has. */
std::string
rowHeader();

/** \brief A pair as the bytes of a job.
 * \param[in] folder that relative paths begin at
 */
std::string
jobOf(const Pair& pair, const std::string& folder);

/** \brief Do such a job in this thread; what there is to say of files that are broken,
 * and of pairs that do not fit, are answers like others.
 * \param[in] how to register
 */
std::string
answerTo(const std::string& job, const Options& how);

/** \brief What has come of a pair that was not done to its end.
 * \param[in] reason in words
 */
nlohmann::ordered_json
failedPair(const Pair& pair, const std::string& folder, const std::string& reason);

/** \brief What tells whether the files of a pair have changed. */
nlohmann::ordered_json
stateOfInputs(const Pair& pair, const std::string& folder);

} // namespace tool
