/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/detail/stopping.h>

#include "opencl/program.h"

#include <cstddef>
#include <future>
#include <memory>
#include <string>
#include <vector>

namespace pcl {
namespace kss {

/** \brief One worker for each of the devices that a name stands for, each of which does
 * its share of the work: neighbouring candidates, so that the results of all follow
 * each other as if one had done everything.
 */
template <typename Worker>
class SeveralDevices {
public:
  /** \param[in] name see openCLPrograms()
   * \param[in] threads see openCLPrograms()
   * \param[in] arguments what a worker needs beside its program
   * \throws DeviceError
   */
  template <typename... Arguments>
  SeveralDevices(const std::string& name,
                 unsigned int threads,
                 const Arguments&... arguments)
  {
    for (const auto& program : openCLPrograms(name, threads)) {
      name_ += (name_.empty() ? "" : " + ") + program->deviceName();
      call(
          [&] { workers_.push_back(std::make_unique<Worker>(program, arguments...)); });
    }
  }

  SeveralDevices(const SeveralDevices&) = delete;
  SeveralDevices&
  operator=(const SeveralDevices&) = delete;

  /** \brief Not in a forked child: what the workers hold belongs to the parent. */
  ~SeveralDevices()
  {
    if (isForkedFromOpenCL())
      for (auto& worker : workers_)
        static_cast<void>(worker.release());
  }

  /** \brief Have each worker do something, one after the other. */
  template <typename Task>
  void
  forEach(const Task& task)
  {
    for (const auto& worker : workers_)
      call([&] { task(*worker); });
  }

  /** \brief Have all workers do their shares at once: task(worker, begin, end). A share
   * for which there is no more thread is done last.
   */
  template <typename Task>
  void
  share(std::size_t size, const Task& task)
  {
    const std::size_t n = workers_.size();
    const StopSignal* const signal = heededSignal();
    std::vector<std::future<void>> others;
    for (std::size_t w = 1; w < n; ++w)
      others.push_back(std::async(std::launch::async | std::launch::deferred, [&, w] {
        const HeedingSignal heeding(signal);
        call([&] { task(*workers_[w], w * size / n, (w + 1) * size / n); });
      }));
    call([&] { task(*workers_[0], 0, size / n); });
    for (auto& other : others)
      other.get();
  }

  /** \brief The names of all devices. */
  const std::string&
  name() const
  {
    return name_;
  }

private:
  /** Buffers that are replaced call OpenCL, too. */
  template <typename Work>
  void
  call(const Work& work) const
  {
    callOpenCL("The OpenCL device \"" + name_ + "\"", work);
  }

  std::vector<std::unique_ptr<Worker>> workers_;
  std::string name_;
};

} // namespace kss
} // namespace pcl
