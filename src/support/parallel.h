/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/detail/stopping.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
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
 * costs a fifth of the CPU time of a registration that has many short loops. Where the
 * system has no more threads, those that there are do the work.
 * \param[in] size how many
 * \param[in] threads 0: as many as there are cores
 * \param[in] piece how many a thread does in a row, a tenth of a second of work at most
 * \param[in] work what it throws first is thrown here, when all threads have ended
 * \throws Stopped where the signal that this thread heeds is set
 */
template <typename Work>
void
inParallel(std::ptrdiff_t size,
           unsigned int threads,
           std::ptrdiff_t piece,
           const Work& work)
{
  std::atomic<std::ptrdiff_t> next{0};
  std::exception_ptr error;
  std::mutex mutex;
  const StopSignal* const signal = heededSignal();
  const auto worker = [&] {
    const HeedingSignal heeding(signal);
    try {
      for (std::ptrdiff_t begin; (begin = next.fetch_add(piece)) < size;) {
        throwIfStopped();
        for (std::ptrdiff_t i = begin; i < std::min(begin + piece, size); ++i)
          work(i);
      }
    }
    catch (...) {
      next = size; // nobody needs the rest
      const std::lock_guard<std::mutex> lock(mutex);
      if (!error)
        error = std::current_exception();
    }
  };
  const std::ptrdiff_t pieces = (size + piece - 1) / piece;
  const auto count = std::min<std::ptrdiff_t>(threadCount(threads), pieces);
  std::vector<std::thread> others;
  try {
    for (std::ptrdiff_t t = 1; t < count; ++t)
      others.emplace_back(worker);
  }
  catch (const std::exception&) {
    // no more threads or memory for them: those that there are go on
  }
  worker();
  for (std::thread& other : others)
    other.join();
  if (error)
    std::rethrow_exception(error);
}

} // namespace kss
} // namespace pcl
