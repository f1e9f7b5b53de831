/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "support/parallel.h"

#include <future>
#include <memory>
#include <system_error>
#include <utility>

namespace pcl {
namespace kss {

/** \brief What takes a while to be made, and is not needed at once: it is made by
 * another thread beside what goes on, where there may be one.
 */
template <typename Value>
class Beside {
public:
  /** \param[in] threads 0: as many as there are cores; 1: it is made when it is needed
   * \param[in] make returns a std::unique_ptr<Value>; what it throws is thrown by get()
   */
  template <typename Make>
  Beside(unsigned int threads, const Make& make)
  {
    const auto policy =
        threadCount(threads) > 1 ? std::launch::async : std::launch::deferred;
    try {
      future_ = std::async(policy, make);
    }
    catch (const std::system_error&) { // no more threads
      future_ = std::async(std::launch::deferred, make);
    }
  }

  /** \brief The value; waits for it the first time. */
  Value&
  get()
  {
    if (!value_)
      value_ = future_.get();
    return *value_;
  }

private:
  std::future<std::unique_ptr<Value>> future_;
  std::unique_ptr<Value> value_;
};

} // namespace kss
} // namespace pcl
