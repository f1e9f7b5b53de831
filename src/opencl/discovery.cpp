/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "opencl/discovery.h"

#include "opencl/kernel_cache.h"
#include "opencl/signal_handlers.h"

#include <algorithm>
#include <atomic>
#include <future>
#include <system_error>
#include <thread>
#include <vector>

namespace pcl {
namespace kss {
namespace {

constexpr cl_int no_platform = -1001; // CL_PLATFORM_NOT_FOUND_KHR, of the ICD loader

/** Throw where the system does not start a thread for each core and some processes
 * more: drivers for CPUs do, when they come up and link kernels, and PoCL ends the
 * process where it cannot. */
void
throwIfThreadsAreShort()
{
  static std::atomic<bool> driver_is_up{false};
  if (driver_is_up)
    return;
  std::promise<void> all_started;
  const std::shared_future<void> end = all_started.get_future();
  std::vector<std::thread> threads;
  bool is_short = false;
  try {
    constexpr unsigned int processes = 4;
    for (unsigned int t = 0; t < processes + std::thread::hardware_concurrency(); ++t)
      threads.emplace_back([end] { end.wait(); });
  }
  catch (const std::system_error&) {
    is_short = true;
  }
  all_started.set_value();
  for (std::thread& thread : threads)
    thread.join();
  if (is_short)
    throw DeviceError("The system starts no more threads, which OpenCL drivers need. "
                      "Raise its limit (ulimit -u), or choose the device \"host\".");
  driver_is_up = true;
}

struct Discovery {
  std::vector<NamedDevice> devices;
  std::string problems; ///< sentences; one that has a problem hides no other
};

void
addDevicesOf(const cl::Platform& platform, Discovery& found)
{
  std::string who = "An OpenCL platform";
  try {
    const std::string name = platform.getInfo<CL_PLATFORM_NAME>();
    who = "The OpenCL platform \"" + name + "\"";
    std::vector<cl::Device> devices;
    platform.getDevices(CL_DEVICE_TYPE_ALL, &devices);
    if (devices.empty())
      found.problems += " " + who + " has no device." + kernelCacheProblem(name);
    for (const cl::Device& device : devices) {
      const cl_device_type type = device.getInfo<CL_DEVICE_TYPE>();
      found.devices.push_back(
          {device, device.getInfo<CL_DEVICE_NAME>() + " (" + name + ")", name,
           (type & CL_DEVICE_TYPE_CPU) != 0, (type & CL_DEVICE_TYPE_GPU) != 0});
    }
  }
  catch (const cl::Error& error) {
    found.problems += " " + failureOf(who, error) + ".";
  }
}

/** All devices of all platforms; none where there is no platform. */
Discovery
discover()
{
  enterOpenCL();
  throwIfThreadsAreShort();
  const KeptSignalHandlers kept; // drivers come up here
  Discovery found;
  std::vector<cl::Platform> platforms;
  try {
    cl::Platform::get(&platforms);
  }
  catch (const cl::Error& error) {
    if (error.err() != no_platform)
      found.problems = " " + failureOf("OpenCL", error) + ".";
  }
  for (const cl::Platform& platform : platforms)
    addDevicesOf(platform, found);
  return found;
}

std::string
inQuotes(const std::vector<NamedDevice>& devices)
{
  std::string text;
  for (const NamedDevice& device : devices)
    text += (text.empty() ? "\"" : ", \"") + device.name + "\"";
  return text.empty() ? "none" : text;
}

} // namespace

std::vector<NamedDevice>
findDevices(const std::string& wanted)
{
  const auto [devices, problems] = discover();
  if (wanted == "auto") {
    if (devices.empty())
      throw DeviceError(problems.empty()
                            ? "There is no OpenCL device; install a driver, for "
                              "example pocl-opencl-icd."
                            : "There is no OpenCL device that works." + problems);
    const auto gpu = std::find_if(devices.begin(), devices.end(),
                                  [](const NamedDevice& d) { return d.is_gpu; });
    return {gpu != devices.end() ? *gpu : devices.front()};
  }
  const auto holdsWanted = [&](const std::string& name) {
    return name.find(wanted) != std::string::npos;
  };
  std::vector<NamedDevice> found;
  for (const NamedDevice& device : devices)
    if (holdsWanted(device.platform) &&
        (found.empty() || found.front().platform == device.platform))
      found.push_back(device);
  for (const NamedDevice& device : devices)
    if (found.empty() && holdsWanted(device.name))
      found.push_back(device);
  if (found.empty())
    throw DeviceError("There is no OpenCL device \"" + wanted +
                      "\"; there are: " + inQuotes(devices) + "." + problems);
  return found;
}

cl::Device
partOf(const NamedDevice& whole, unsigned int threads)
{
  return callOpenCL("The OpenCL device \"" + whole.name + "\"", [&] {
    if (threads == 0 || !whole.is_cpu ||
        threads >= whole.device.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>())
      return whole.device;
    try {
      const cl_device_partition_property by_counts[] = {
          CL_DEVICE_PARTITION_BY_COUNTS,
          static_cast<cl_device_partition_property>(threads),
          CL_DEVICE_PARTITION_BY_COUNTS_LIST_END, 0};
      std::vector<cl::Device> parts;
      cl::Device(whole.device).createSubDevices(by_counts, &parts);
      return parts.empty() ? whole.device : parts.front();
    }
    catch (const cl::Error& error) {
      // what a device says that cannot be divided, or not so
      const cl_int undivided[] = {CL_INVALID_VALUE, CL_DEVICE_PARTITION_FAILED,
                                  CL_INVALID_DEVICE_PARTITION_COUNT};
      if (std::find(std::begin(undivided), std::end(undivided), error.err()) ==
          std::end(undivided))
        throw;
      return whole.device;
    }
  });
}

std::vector<std::string>
openCLDeviceNames()
{
  std::vector<std::string> names;
  if (!isForkedFromOpenCL())
    for (const NamedDevice& device : discover().devices)
      names.push_back(device.name);
  return names;
}

} // namespace kss
} // namespace pcl
