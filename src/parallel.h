/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <omp.h>

namespace pcl {
namespace kss {

/** \brief The number of threads to use where the user asked for \a threads, 0 meaning
 * as many as there are cores.
 */
inline int
threadCount(unsigned int threads)
{
  return threads > 0 ? static_cast<int>(threads) : omp_get_num_procs();
}

} // namespace kss
} // namespace pcl
