/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

namespace kss_test {

/** \brief While it lives, the system starts only so many threads more: as where a limit
 * on processes is reached. Linking thread_faults.cpp puts its pthread_create() before
 * that of the C library.
 */
class ThreadFaults {
public:
  explicit ThreadFaults(int allowed);

  ~ThreadFaults();

  ThreadFaults(const ThreadFaults&) = delete;
  ThreadFaults&
  operator=(const ThreadFaults&) = delete;

  /** \brief How many threads have been refused so far. */
  int
  refused() const;
};

} // namespace kss_test
