/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <string>

/** What the program is told on the command line beside Google Benchmark's options. */
namespace benchmarks {

struct Options {
  unsigned int threads = 0;  ///< of every KSSICP; 0: as many as there are cores
  std::string clouds_folder; ///< where all pairs are to be written; empty: nowhere
};

/** \brief The options of this run. */
Options&
options();

/** \brief Take \c --threads=N and \c --write-clouds=FOLDER out of the command line.
 * \return whether their values make sense
 */
bool
takeOptions(int& argc, char** argv);

} // namespace benchmarks
