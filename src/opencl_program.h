/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#define CL_HPP_TARGET_OPENCL_VERSION 120
#define CL_HPP_MINIMUM_OPENCL_VERSION 120
#define CL_HPP_ENABLE_EXCEPTIONS
#include <pcl/registration/kss/opencl_devices.h>

#include <CL/opencl.hpp>

#include <memory>
#include <string>
#include <vector>

namespace pcl {
namespace kss {

/** \brief The kernels, built for one device, with a queue of their own.
 *
 * Every call that fails throws a DeviceError that names the call and the device.
 */
class OpenCLProgram {
public:
  OpenCLProgram(const cl::Device& device, const std::string& name);

  /** \brief A buffer on the device with a copy of \a values. */
  template <typename Value>
  cl::Buffer
  upload(const Value* values, std::size_t size)
  {
    const cl::Buffer buffer = allocate<Value>(size);
    checked([&] {
      queue_.enqueueWriteBuffer(buffer, CL_TRUE, 0, size * sizeof(Value), values);
    });
    return buffer;
  }

  /** \brief A buffer for so many values. */
  template <typename Value>
  cl::Buffer
  allocate(std::size_t size)
  {
    cl::Buffer buffer;
    checked([&] {
      buffer = cl::Buffer(context_, CL_MEM_READ_WRITE, size * sizeof(Value));
    });
    return buffer;
  }

  /** \brief Copy the first values of a buffer to the host. */
  template <typename Value>
  void
  download(const cl::Buffer& buffer, Value* values, std::size_t size)
  {
    checked([&] {
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
    checked([&] {
      cl::Kernel entry(program_, kernel);
      cl_uint index = 0;
      (entry.setArg(index++, arguments), ...);
      const std::size_t padded = (work_items + group_ - 1) / group_ * group_;
      queue_.enqueueNDRangeKernel(entry, cl::NullRange, cl::NDRange(padded),
                                  cl::NDRange(group_));
      queue_.finish();
    });
  }

  /** \brief Bytes of the largest buffer that the device takes. */
  std::size_t
  largestBuffer() const;

  /** \brief The device's name. */
  const std::string&
  deviceName() const
  {
    return name_;
  }

private:
  template <typename Work>
  void
  checked(const Work& work) const;

  [[noreturn]] void
  fail(const cl::Error& error) const;

  std::string name_;
  cl::Device device_;
  cl::Context context_;
  cl::CommandQueue queue_;
  cl::Program program_;
  std::size_t group_;
};

template <typename Work>
void
OpenCLProgram::checked(const Work& work) const
{
  try {
    work();
  }
  catch (const cl::Error& error) {
    fail(error);
  }
}

/** \brief The programs for the devices that a name stands for, at least one; built at
 * the first call and kept for later ones. \param[in] name part of a platform's name:
 * all its devices; part of a device's name: the first such device; "auto": the first
 * GPU, else the first device \param[in] threads compute units to use of a CPU device;
 * 0: all \throws DeviceError
 */
std::vector<std::shared_ptr<OpenCLProgram>>
openCLPrograms(const std::string& name, unsigned int threads);

} // namespace kss
} // namespace pcl
