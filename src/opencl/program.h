/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "opencl/calls.h"
#include "opencl/dispatches.h"

#include <atomic>
#include <memory>
#include <string>
#include <vector>

namespace pcl {
namespace kss {

/** \brief The kernels, built for one device, with a queue of their own.
 *
 * Every call that fails throws a DeviceError that names the call and the device. What
 * has failed once is lost, and fails from then on: all of an alignment's evaluators
 * leave a device together.
 */
class OpenCLProgram {
public:
  /** \throws DeviceError */
  OpenCLProgram(const cl::Device& device, const std::string& name);

  /** \brief A buffer on the device with a copy of \a values. */
  template <typename Value>
  cl::Buffer
  upload(const Value* values, std::size_t size)
  {
    // a buffer that begins as a copy needs no command, which a CPU's threads would have
    // to be woken for
    return buffer(size * sizeof(Value), CL_MEM_COPY_HOST_PTR, values);
  }

  /** \brief A buffer for so many values. */
  template <typename Value>
  cl::Buffer
  allocate(std::size_t size)
  {
    return buffer(size * sizeof(Value), 0, nullptr);
  }

  /** \brief Copy the first values of a buffer to the host. */
  template <typename Value>
  void
  download(const cl::Buffer& buffer, Value* values, std::size_t size)
  {
    call([&] {
      queue_.enqueueReadBuffer(buffer, CL_TRUE, 0, size * sizeof(Value), values);
    });
  }

  /** \brief Run a kernel and wait for it.
   * \param[in] kernel its name
   * \param[in] work_items how many are needed; the kernel guards against more
   * \param[in] arguments of the kernel, in order
   */
  template <typename... Arguments>
  void
  run(const char* kernel, std::size_t work_items, const Arguments&... arguments)
  {
    call([&] {
      cl::Kernel entry(program_, kernel);
      cl_uint index = 0;
      (entry.setArg(index++, arguments), ...);
      const std::size_t padded = (work_items + group_ - 1) / group_ * group_;
      queue_.enqueueNDRangeKernel(entry, cl::NullRange, cl::NDRange(padded),
                                  cl::NDRange(group_));
      try {
        queue_.finish();
      }
      catch (const cl::Error&) {
        clFinish(queue_()); // once more, since buffers in use must not be released
        throw;
      }
    });
  }

  /** \brief What one dispatch takes. */
  const DispatchLimits&
  limits() const
  {
    return limits_;
  }

  /** \brief Whether a call has failed. */
  bool
  isLost() const
  {
    return is_lost_;
  }

  /** \brief The device's name. */
  const std::string&
  deviceName() const
  {
    return name_;
  }

private:
  template <typename Work>
  auto
  call(const Work& work);

  cl::Buffer
  buffer(std::size_t bytes, cl_mem_flags flags, const void* values);

  void
  build();

  std::string
  buildLog() const;

  DeviceError
  tooLarge(std::size_t bytes) const;

  std::string name_;
  cl::Device device_;
  cl::Context context_;
  cl::CommandQueue queue_;
  cl::Program program_;
  std::size_t group_ = 1;
  std::size_t largest_buffer_ = 0;
  DispatchLimits limits_{};
  std::atomic<bool> is_lost_{false};
};

template <typename Work>
auto
OpenCLProgram::call(const Work& work)
{
  const std::string who = "The OpenCL device \"" + name_ + "\"";
  if (is_lost_)
    throw DeviceError(who + " failed before. Choose another device, or \"host\".");
  return callOpenCL(who, [&] {
    try {
      return work();
    }
    catch (const cl::Error&) {
      is_lost_ = true;
      throw;
    }
  });
}

/** \brief The programs for the devices that a name stands for, at least one; built at
 * the first call and kept for later ones until one is lost. A build that has failed is
 * not tried again.
 * \param[in] name part of a platform's name: all its devices; part of a device's name:
 * the first such device; "auto": the first GPU, else the first device
 * \param[in] threads compute units to use of a CPU device; 0: all
 * \throws DeviceError
 */
std::vector<std::shared_ptr<OpenCLProgram>>
openCLPrograms(const std::string& name, unsigned int threads);

} // namespace kss
} // namespace pcl
