/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "ablations.h"
#include "protocol.h"

#include <string>
#include <vector>

namespace evaluation {

/** \brief What the command line asks for. */
struct Options {
  std::string models; ///< folder
  std::string out;    ///< folder
  Protocol protocol;
  std::vector<std::string> tables;  ///< see tableNames()
  std::size_t number_of_models = 4; ///< evenly chosen; 0: all
  std::size_t size_models = 1;      ///< meshes whose clouds grow to a million points
  std::vector<std::string> methods; ///< by name; empty: all
  std::vector<std::string> ablate;  ///< flags of the ablations
  double time_limit = 20.0;         ///< seconds of CPU time
  unsigned int jobs = 0;            ///< 0: as many as cores
};

/** \brief Read the command line; shows help, or what is wrong with it, by itself.
 * \return whether there is something to do; otherwise \a exit_code is set
 */
bool
parse(int argc, char** argv, Options& options, int& exit_code);

} // namespace evaluation
