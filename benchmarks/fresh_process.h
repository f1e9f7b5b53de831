/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/settings.h>

#include <cstddef>
#include <string>

/** Registrations in a process of their own: this program, started anew, in which
 * nothing has touched OpenCL yet.
 */
namespace benchmarks {

/** \brief What one registration cost, from the construction of the object on. */
struct FirstCall {
  bool solved = false;
  double wall_seconds = 0.0, cpu_seconds = 0.0;
  double peak_bytes = 0.0; ///< beyond what was in use before: clouds, libraries
};

/** \brief Start this program anew and register once in it.
 * \param[in] cache folder for all compiled kernels; empty for the one in use
 */
FirstCall
registerInFreshProcess(pcl::kss::Mode mode, std::size_t size, const std::string& cache);

/** \brief The other side of registerInFreshProcess(): whether the command line comes
 * from it, and if so, do what it asks for.
 */
bool
isFreshProcess(int argc, char** argv);

} // namespace benchmarks
