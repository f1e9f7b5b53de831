/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "method.h"

#include <pcl/registration/kss/settings.h>

#include <functional>

namespace evaluation {

/** \brief KSS-ICP with settings of its own.
 * \param[in] settings what differs from the defaults; takes the task, since the paper
 * leaves it to the user to say whether a cloud is incomplete
 */
Method
kssICPMethod(const std::string& name,
             const std::function<pcl::kss::Settings(const Task&)>& settings);

} // namespace evaluation
