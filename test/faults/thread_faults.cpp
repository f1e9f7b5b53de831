/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "thread_faults.h"

#include <atomic>
#include <cerrno>
#include <dlfcn.h>
#include <limits>
#include <pthread.h>

namespace {

constexpr int any = std::numeric_limits<int>::max();
std::atomic<int> allowed{any}, refused{0};

} // namespace

extern "C" int
pthread_create(pthread_t* thread,
               const pthread_attr_t* attributes,
               void* (*start)(void*),
               void* argument) noexcept
{
  if (allowed != any && allowed.fetch_sub(1) <= 0) {
    ++refused;
    return EAGAIN;
  }
  using Create = int (*)(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*);
  static const auto create =
      reinterpret_cast<Create>(dlsym(RTLD_NEXT, "pthread_create"));
  return create(thread, attributes, start, argument);
}

namespace kss_test {

ThreadFaults::ThreadFaults(int most)
{
  ::refused = 0;
  ::allowed = most;
}

ThreadFaults::~ThreadFaults()
{
  allowed = any;
}

int
ThreadFaults::refused() const
{
  return ::refused;
}

} // namespace kss_test
