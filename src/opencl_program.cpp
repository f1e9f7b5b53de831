/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "opencl_program.h"

#include "kernels.h"

#include <algorithm>
#include <map>
#include <mutex>
#include <utility>

namespace pcl {
namespace kss {
namespace {

struct NamedDevice {
  cl::Device device;
  std::string name;
  std::string platform;
};

/** All devices of all platforms; none where there is no platform. */
std::vector<NamedDevice>
allDevices()
{
  std::vector<NamedDevice> found;
  try {
    std::vector<cl::Platform> platforms;
    cl::Platform::get(&platforms);
    for (const cl::Platform& platform : platforms) {
      std::vector<cl::Device> devices;
      platform.getDevices(CL_DEVICE_TYPE_ALL, &devices);
      for (const cl::Device& device : devices)
        found.push_back({device,
                         device.getInfo<CL_DEVICE_NAME>() + " (" +
                             platform.getInfo<CL_PLATFORM_NAME>() + ")",
                         platform.getInfo<CL_PLATFORM_NAME>()});
    }
  }
  catch (const cl::Error&) {
    // the ICD loader reports an error where no platform is installed
  }
  return found;
}

bool
isOfType(const cl::Device& device, cl_device_type type)
{
  return (device.getInfo<CL_DEVICE_TYPE>() & type) != 0;
}

std::string
inQuotes(const std::vector<NamedDevice>& devices)
{
  std::string text;
  for (const NamedDevice& device : devices)
    text += (text.empty() ? "\"" : ", \"") + device.name + "\"";
  return text.empty() ? "none" : text;
}

/** The devices that a name stands for, at least one. */
std::vector<NamedDevice>
findDevices(const std::string& wanted)
{
  const auto devices = allDevices();
  if (wanted == "auto") {
    if (devices.empty())
      throw DeviceError("There is no OpenCL device; install a driver, for example "
                        "pocl-opencl-icd.");
    const auto gpu =
        std::find_if(devices.begin(), devices.end(), [](const NamedDevice& d) {
          return isOfType(d.device, CL_DEVICE_TYPE_GPU);
        });
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
                      "\"; there are: " + inQuotes(devices) + ".");
  return found;
}

/** So many compute units of a CPU device; the whole device where it cannot be divided.
 */
cl::Device
partOf(const cl::Device& device, unsigned int threads)
{
  if (threads == 0 || !isOfType(device, CL_DEVICE_TYPE_CPU) ||
      threads >= device.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>())
    return device;
  try {
    const cl_device_partition_property by_counts[] = {
        CL_DEVICE_PARTITION_BY_COUNTS,
        static_cast<cl_device_partition_property>(threads),
        CL_DEVICE_PARTITION_BY_COUNTS_LIST_END, 0};
    std::vector<cl::Device> parts;
    cl::Device(device).createSubDevices(by_counts, &parts);
    return parts.at(0);
  }
  catch (const cl::Error&) {
    return device;
  }
}

} // namespace

OpenCLProgram::OpenCLProgram(const cl::Device& device, const std::string& name)
: name_(name)
, device_(device)
{
  checked([&] {
    context_ = cl::Context(device_);
    queue_ = cl::CommandQueue(context_, device_);
    // A CPU fills its vectors within a work-item, and a group per candidate spreads the
    // work over its cores; a GPU fills its units with work-items.
    group_ = isOfType(device_, CL_DEVICE_TYPE_CPU) ? 1 : 64;
    program_ = cl::Program(context_, std::string(kernels::distances) +
                                         kernels::look_ups + kernels::fields +
                                         kernels::shift_sums + kernels::bounds);
    try {
      program_.build({device_}, "-cl-std=CL1.2");
    }
    catch (const cl::BuildError& error) {
      throw DeviceError(
          "The OpenCL device \"" + name_ +
          "\" cannot build the kernels: " + error.getBuildLog().at(0).second);
    }
  });
}

std::size_t
OpenCLProgram::largestBuffer() const
{
  return device_.getInfo<CL_DEVICE_MAX_MEM_ALLOC_SIZE>();
}

void
OpenCLProgram::fail(const cl::Error& error) const
{
  throw DeviceError("The OpenCL device \"" + name_ + "\" failed in " + error.what() +
                    " with error " + std::to_string(error.err()) + ".");
}

std::vector<std::shared_ptr<OpenCLProgram>>
openCLPrograms(const std::string& name, unsigned int threads)
{
  using Programs = std::vector<std::shared_ptr<OpenCLProgram>>;
  static std::mutex mutex;
  // never destroyed: the OpenCL driver may be gone before static objects are
  static auto& known = *new std::map<std::pair<std::string, unsigned int>, Programs>;
  const std::lock_guard<std::mutex> lock(mutex);
  Programs& programs = known[{name, threads}];
  if (programs.empty()) {
    Programs built;
    for (const NamedDevice& found : findDevices(name))
      built.push_back(
          std::make_shared<OpenCLProgram>(partOf(found.device, threads), found.name));
    programs = built;
  }
  return programs;
}

std::vector<std::string>
openCLDeviceNames()
{
  std::vector<std::string> names;
  for (const NamedDevice& device : allDevices())
    names.push_back(device.name);
  return names;
}

} // namespace kss
} // namespace pcl
