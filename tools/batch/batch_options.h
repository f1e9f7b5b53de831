/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "command_line/options.h"

#include <string>

namespace tool {

/** \brief What the command line asks for. */
struct BatchOptions {
  enum class Action { REGISTER, SHOW_HELP, SHOW_VERSION };

  Action action = Action::REGISTER;
  /** \brief The list of pairs, and the folder of the results. */
  std::string manifest, folder;
  /** \brief Whether to begin anew. */
  bool restart = false;
  /** \brief No messages but errors. */
  bool quiet = false;
  /** \brief Of each process; 0: its share of the cores. */
  unsigned int threads = 0;
  /** \brief How each pair is registered, in one thread. */
  Options how;
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
