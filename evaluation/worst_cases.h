/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "plan.h"
#include "run_log.h"

#include <string>

namespace evaluation {

/** \brief Write the clouds of KSS-ICP's worst cases, for whoever wants to look at them:
 * a folder each with source.ply, target.ply and meta.json, which holds both poses.
 */
void
writeWorstCases(const Plan& plan,
                const Protocol& protocol,
                const RunLog& log,
                const std::string& folder);

} // namespace evaluation
