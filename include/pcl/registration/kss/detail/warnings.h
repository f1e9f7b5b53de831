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

/** \brief Who shows them; null: standard error. */
PCL_KSS_ICP_EXPORT WarningSink
warningSink();

/** \brief Have them shown as PCL's own, unless somebody else shows them. */
PCL_KSS_ICP_EXPORT void
showWarningsByPCL();

} // namespace kss
} // namespace pcl
