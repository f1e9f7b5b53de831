/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/export.h>

namespace pcl {
namespace kss {

/** \brief Shows a warning, of one sentence or two. */
using WarningSink = void (*)(const char* warning);

/** \brief Set who shows the warnings of the stages, which are none of a result: that
 * the search runs on the host for want of a device.
 * \param[in] sink for all of the process; null: standard error
 */
PCL_KSS_ICP_EXPORT void
setWarningSink(WarningSink sink);

} // namespace kss
} // namespace pcl
