/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "command_line/job_options.h"

#include <string>

namespace tool {

/** \brief What the command line asks for. */
struct BatchOptions : JobOptions {
  /** \brief The list of pairs. */
  std::string manifest;
};

/** \brief Read the command line.
 * \throws std::exception naming the option that is wrong
 */
BatchOptions
parseBatchOptions(int argc, const char* const* argv);

/** \brief What --help shows. */
std::string
batchHelpText();

} // namespace tool
