/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/scan_work.h>

#include <cstddef>
#include <functional>
#include <future>
#include <list>
#include <map>
#include <memory>
#include <mutex>

namespace pcl {
namespace kss {

/** \brief Scans that have been made ready, as many as there is room for: those that
 * have not been asked for for longest make place for others.
 *
 * Each is made once however many threads ask for it at the same time.
 */
class ScanStore {
public:
  using Scan = std::shared_ptr<const PreparedScan>;

  /** \param[in] make makes a scan ready; what it throws, everyone who asks gets
   * \param[in] room in bytes; the scans that are in use may take more
   */
  ScanStore(std::function<Scan(std::size_t)> make, std::size_t room);

  /** \brief A scan that has been made ready; from any thread. */
  Scan
  get(std::size_t number);

private:
  struct Kept {
    std::shared_future<Scan> scan;
    std::list<std::size_t>::iterator turn;
    std::size_t bytes = 0; ///< 0: not made yet, or none
  };

  /** \brief Count what a scan takes, and let go of others. */
  void
  account(std::size_t number, std::size_t bytes);

  std::function<Scan(std::size_t)> make_;
  std::size_t room_;
  std::mutex mutex_;
  std::list<std::size_t> turns_; ///< asked for last first
  std::map<std::size_t, Kept> kept_;
  std::size_t taken_ = 0;
};

/** \brief The memory that a scan takes, in bytes, about. */
std::size_t
bytesOf(const PreparedScan& scan);

} // namespace kss
} // namespace pcl
