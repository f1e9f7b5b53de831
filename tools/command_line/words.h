/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "options.h"
#include "registration.h"

#include <cstddef>
#include <string>

/** \file
 * What results mean, in sentences for people.
 */

namespace tool {

/** \brief How sure a result is, and what that means. */
std::string
sureText(const Result& result);

/** \brief The scale in a few digits. */
std::string
scaleText(const Result& result);

/** \brief How many poses, the first one aside, fit about as well as it does. */
std::size_t
numberOfRivals(const Result& result);

/** \brief That other poses fit as well, and how to choose; empty where none does. */
std::string
ambiguityText(const Result& result);

/** \brief What to say where the scale was estimated and may as well be 1; empty where
 * not. */
std::string
scaleHint(const Result& result, const pcl::kss::Settings& settings);

/** \brief What to try where nothing has been registered; empty where nothing is known
 * to help. */
std::string
whatToTry(const Result& result, const Options& options);

} // namespace tool
