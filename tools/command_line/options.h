/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/settings.h>

#include <stdexcept>
#include <string>

namespace tool {

/** \brief What the command line asks for. */
struct Options {
  enum class Action { REGISTER, SHOW_HELP, SHOW_VERSION, LIST_DEVICES };

  Action action = Action::REGISTER;
  /** \brief The files to be registered. */
  std::string source, target;
  /** \brief The file of a transformation to begin with; empty: none. */
  std::string guess;
  /** \brief The files to be written; empty: none. */
  std::string aligned, transform, report, picture;
  /** \brief Whether to show the result in a window. */
  bool view = false;
  /** \brief How many points stand for a mesh. */
  std::size_t samples = 10000;
  /** \brief No messages but errors. */
  bool quiet = false;
  /** \brief How to register. */
  pcl::kss::Settings settings;
  /** \brief Iterations of the final ICP at most. */
  int iterations = 300;
};

/** \brief Read the command line.
 * \throws std::exception naming the option that is wrong
 */
Options
parseOptions(int argc, const char* const* argv);

/** \brief What --help shows. */
std::string
helpText();

} // namespace tool
