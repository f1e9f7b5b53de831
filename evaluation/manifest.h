/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "plan.h"

#include <string>

namespace evaluation {

/** \brief Write what is evaluated, and how and on what, beside the runs: run.json.
 * \throws std::runtime_error where the folder holds runs on other cases
 */
void
writeManifest(const std::string& path,
              const std::string& command,
              const Options& options,
              const ModelFolder& folder,
              const Plan& plan);

} // namespace evaluation
