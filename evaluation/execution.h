/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "models.h"
#include "options.h"
#include "run_log.h"

#include <vector>

namespace evaluation {

/** \brief Do the runs that the log does not hold yet, or whose time limit was shorter,
 * each registration in a process of its own. Of clouds of growing size, a method that
 * ran out of time on a smaller one is not tried again.
 * \param[in] jobs registrations at a time
 */
void
perform(const std::vector<Run>& runs,
        const std::vector<Model>& models,
        const Options& options,
        unsigned int jobs,
        RunLog& log);

} // namespace evaluation
