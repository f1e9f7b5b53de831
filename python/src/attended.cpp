/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "attended.h"

#include <chrono>
#include <exception>
#include <thread>

namespace pcl_kss_icp {
namespace {

namespace py = pybind11;

/** How often signals are looked for. */
constexpr std::chrono::milliseconds between_looks(50);

} // namespace

Attended::Attended(py::object progress,
                   const std::atomic<bool>& cancelled,
                   std::function<void()> cancel)
: progress_(std::move(progress))
, cancelled_(cancelled)
, cancel_(std::move(cancel))
{
}

void
Attended::run(const std::function<void()>& work)
{
  std::exception_ptr thrown; // by the work
  std::thread worker([&] {
    try {
      work();
    }
    catch (...) {
      thrown = std::current_exception();
    }
    const std::lock_guard<std::mutex> lock(mutex_);
    is_done_ = true;
    changed_.notify_all();
  });

  std::exception_ptr raised; // by Python
  while (true) {
    std::optional<Told> told;
    {
      const py::gil_scoped_release released;
      std::unique_lock<std::mutex> lock(mutex_);
      changed_.wait_for(lock, between_looks, [&] { return is_done_ || told_; });
      if (is_done_)
        break;
      told = told_;
    }
    try {
      if (!raised)
        attend(told);
    }
    catch (...) {
      raised = std::current_exception();
    }
    if (raised || cancelled_)
      cancel_();
    if (told) {
      const std::lock_guard<std::mutex> lock(mutex_);
      told_.reset();
      changed_.notify_all();
    }
  }
  worker.join();
  if (raised)
    std::rethrow_exception(raised);
  if (thrown)
    std::rethrow_exception(thrown);
}

void
Attended::attend(const std::optional<Told>& told) const
{
  if (PyErr_CheckSignals() != 0)
    throw py::error_already_set();
  if (told && !progress_.is_none())
    progress_(told->first, told->second);
}

void
Attended::told(const std::string& stage, double done)
{
  if (progress_.is_none())
    return;
  std::unique_lock<std::mutex> lock(mutex_);
  told_ = {stage, done};
  changed_.notify_all();
  changed_.wait(lock, [&] { return !told_; });
}

} // namespace pcl_kss_icp
