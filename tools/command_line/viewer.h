/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "options.h"

#include <string>

namespace tool {

/** \brief Check that results can be shown in a window, before minutes of work.
 * \throws std::runtime_error saying what is missing
 */
void
checkViewer();

/** \brief Show a result in a window of pcl_kss_icp_view, a programme of its own, since
 * PCL's visualiser takes long to load, and wait until that is closed.
 * \param[in] report see reportText()
 * \throws std::runtime_error where it cannot be started, or fails
 */
void
showInWindow(const Options& options, const std::string& report);

} // namespace tool
