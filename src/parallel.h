/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>

namespace pcl {
namespace kss {

/** \brief The number of threads to use where the user asked for \a threads, 0 meaning
 * as many as there are cores.
 */
inline unsigned int
threadCount(unsigned int threads)
{
  return threads > 0 ? threads : std::max(1u, std::thread::hardware_concurrency());
}

/** \brief Call work(i) for every i below \a size, some of them at once.
 *
 * The threads end with the loop. Those of OpenMP go on spinning for a while, which
 * costs a fifth of the CPU time of a registration that has many short loops. \param[in]
 * size how many \param[in] threads 0: as many as there are cores \param[in] piece how
 * many a thread does in a row \param[in] work must not throw
 */
template <typename Work>
void
inParallel(std::ptrdiff_t size,
           unsigned int threads,
           std::ptrdiff_t piece,
           const Work& work)
{
  std::atomic<std::ptrdiff_t> next{0};
  const auto worker = [&] {
    for (std::ptrdiff_t begin; (begin = next.fetch_add(piece)) < size;)
      for (std::ptrdiff_t i = begin; i < std::min(begin + piece, size); ++i)
        work(i);
  };
  const std::ptrdiff_t pieces = (size + piece - 1) / piece;
  std::vector<std::thread> others;
  for (std::ptrdiff_t t = 1; t < std::min<std::ptrdiff_t>(threadCount(threads), pieces);
       ++t)
    others.emplace_back(worker);
  worker();
  for (std::thread& other : others)
    other.join();
}

} // namespace kss
} // namespace pcl
