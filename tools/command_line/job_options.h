/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "option_words.h"
#include "options.h"

#include <string>

namespace tool {

/** \brief What the command line of a program asks for that does many jobs and leaves
 * what has come of them in a folder. */
struct JobOptions {
  enum class Action { WORK, SHOW_HELP, SHOW_VERSION };

  Action action = Action::WORK;
  /** \brief The folder of the results. */
  std::string folder;
  /** \brief Whether to begin anew. */
  bool restart = false;
  /** \brief No messages but errors. */
  bool quiet = false;
  /** \brief Of each process; 0: its share of the cores. */
  unsigned int threads = 0;
  /** \brief How each pair is registered, in one thread, and what stands for a mesh. */
  Options how;
};

/** \brief --out and --restart. */
boost::program_options::options_description
folderOptions();

/** \brief --threads, and what all programs have. */
boost::program_options::options_description
otherJobOptions();

/** \brief Take all of it but the folder from the command line.
 * \return whether there is work to be done, and so more to be read
 * \throws std::exception naming the option that is wrong
 */
bool
readJobOptions(const boost::program_options::variables_map& values,
               JobOptions& options);

/** \brief The folder of --out.
 * \throws std::runtime_error where there is none
 */
std::string
folderOf(const boost::program_options::variables_map& values);

} // namespace tool
