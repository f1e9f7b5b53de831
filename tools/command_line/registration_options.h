/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "options.h"

#include <boost/program_options/options_description.hpp>
#include <boost/program_options/variables_map.hpp>

namespace tool {

/** \brief The options that say how files are registered, but for those of experts. */
boost::program_options::options_description
registrationOptions();

/** \brief Take how files are registered from the command line.
 * \throws UsageError naming the option that is wrong
 */
void
readRegistrationOptions(const boost::program_options::variables_map& values,
                        Options& options);

} // namespace tool
