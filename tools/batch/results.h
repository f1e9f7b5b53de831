/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "journal.h"
#include "manifest.h"

#include <map>
#include <string>

namespace tool {

/** \brief Their names: a table, reports, and what pairs took. */
constexpr const char *TABLE_FILE = "results.csv", *REPORTS_FILE = "results.jsonl",
                     *TIMES_FILE = "times.csv";

/** \brief How many pairs have come to what. */
using Counts = std::map<std::string, std::size_t>;

/** \brief Write the files of a folder that tell what has come of all pairs, in the
 * order of the manifest: results.csv, results.jsonl, and times.csv. All of them are put
 * in place, or none.
 * \throws std::runtime_error naming the file that cannot be written
 */
Counts
writeResults(const std::string& folder,
             const Manifest& manifest,
             const Journal& journal);

} // namespace tool
