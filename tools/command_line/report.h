/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "registration.h"

#include <string>

namespace tool {

/** \brief The 4x4 numbers of a transformation, a row per line, with all their digits.
 */
std::string
transformationText(const Eigen::Matrix4d& transformation);

/** \brief All results as JSON; numbers that there are none of are null. */
std::string
reportText(const Result& result);

/** \brief The results in a few lines for people.
 * \pre result.converged
 */
std::string
summaryText(const Result& result);

} // namespace tool
