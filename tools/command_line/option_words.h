/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "option_values.h"

#include <boost/program_options/options_description.hpp>
#include <boost/program_options/variables_map.hpp>

#include <string>
#include <vector>

/** \file
 * How programs take their options from the command line, and what --help says of them.
 */

namespace tool {

/** \brief Options, and what they are for. */
struct OptionGroup {
  std::string caption;
  boost::program_options::options_description options = {};
};

/** \brief Add what all programs have: --quiet, --version, --help. */
void
addProgramOptions(boost::program_options::options_description& options);

/** \brief The words of a command line: options, each of them a word, and files.
 * \throws std::exception naming what is wrong
 */
boost::program_options::variables_map
valuesOf(const std::vector<OptionGroup>& groups, int argc, const char* const* argv);

/** \brief The words that belong to no option. */
std::vector<std::string>
filesOf(const boost::program_options::variables_map& values);

/** \brief The file that an option names; empty if it was not given.
 * \throws UsageError where it names none
 */
std::string
fileName(const boost::program_options::variables_map& values,
         const std::string& option);

/** \brief All options with what they are, in lines. */
std::string
helpOn(const std::vector<OptionGroup>& groups);

} // namespace tool
