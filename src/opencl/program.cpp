/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "opencl/program.h"

#include "kernels.h"

#include "opencl/discovery.h"
#include "opencl/kernel_cache.h"

#include <algorithm>
#include <map>
#include <mutex>
#include <utility>

namespace pcl {
namespace kss {
namespace {

/** The kernels do not build on a device: they will not the next time. */
class BuildFailure : public DeviceError {
public:
  using DeviceError::DeviceError;
};

/** What the buffers of one dispatch take at most: the candidates of the paper, 1728 of
 * 2000 points, take 14 MB. */
constexpr cl_ulong most_bytes = 64 << 20;

} // namespace

OpenCLProgram::OpenCLProgram(const cl::Device& device, const std::string& name)
: name_(name)
, device_(device)
{
  call([&] {
    context_ = cl::Context(device_);
    queue_ = cl::CommandQueue(context_, device_);
    // A CPU fills its vectors within a work-item, and a group per candidate spreads the
    // work over its cores; a GPU fills its units with work-items.
    group_ = device_.getInfo<CL_DEVICE_TYPE>() & CL_DEVICE_TYPE_CPU ? 1 : 64;
    largest_buffer_ = device_.getInfo<CL_DEVICE_MAX_MEM_ALLOC_SIZE>();
    limits_.bytes =
        std::min({most_bytes, device_.getInfo<CL_DEVICE_MAX_MEM_ALLOC_SIZE>(),
                  device_.getInfo<CL_DEVICE_GLOBAL_MEM_SIZE>() / 4});
    limits_.at_once = group_ * device_.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>();
    build();
  });
}

cl::Buffer
OpenCLProgram::buffer(std::size_t bytes, cl_mem_flags flags, const void* values)
{
  if (bytes > largest_buffer_)
    throw tooLarge(bytes);
  return call([&] {
    return cl::Buffer(context_, CL_MEM_READ_WRITE | flags, bytes,
                      const_cast<void*>(values)); // which are only read
  });
}

void
OpenCLProgram::build()
{
  program_ = cl::Program(context_, std::string(kernels));
  const cl_int code =
      clBuildProgram(program_(), 1, &device_(), "-cl-std=CL1.2", nullptr, nullptr);
  if (code == CL_SUCCESS)
    return;
  const cl::Error error(code, "clBuildProgram");
  if (code != CL_BUILD_PROGRAM_FAILURE)
    throw error;
  const cl::Platform platform(device_.getInfo<CL_DEVICE_PLATFORM>());
  std::string why = kernelCacheProblem(platform.getInfo<CL_PLATFORM_NAME>());
  if (why.empty())
    why = " " + buildLog();
  throw BuildFailure(failureOf("The OpenCL device \"" + name_ + "\"", error) +
                     ": it cannot build the kernels. Choose another device, or "
                     "\"host\"." +
                     why);
}

std::string
OpenCLProgram::buildLog() const
{
  try {
    return program_.getBuildInfo<CL_PROGRAM_BUILD_LOG>(device_);
  }
  catch (const cl::Error&) {
    return ""; // that it does not build is all that is known
  }
}

DeviceError
OpenCLProgram::tooLarge(std::size_t bytes) const
{
  return DeviceError("The OpenCL device \"" + name_ + "\" takes buffers of " +
                     std::to_string(largest_buffer_) + " bytes at most, not of " +
                     std::to_string(bytes) +
                     ". Choose another device, or \"host\", or fewer points.");
}

std::vector<std::shared_ptr<OpenCLProgram>>
openCLPrograms(const std::string& name, unsigned int threads)
{
  struct Known {
    std::vector<std::shared_ptr<OpenCLProgram>> programs;
    // The last ones that were lost: PoCL's threads may still be about to let go of the
    // last command after it has been waited for, and need its context for that.
    std::vector<std::shared_ptr<OpenCLProgram>> lost;
    std::string build_failure;
  };
  enterOpenCL(); // before the lock, which a child may have inherited
  static std::mutex mutex;
  // never destroyed: the OpenCL driver may be gone before static objects are
  static auto& all_known = *new std::map<std::pair<std::string, unsigned int>, Known>;
  const std::lock_guard<std::mutex> lock(mutex);
  Known& known = all_known[{name, threads}];
  if (!known.build_failure.empty())
    throw DeviceError(known.build_failure);
  if (std::any_of(known.programs.begin(), known.programs.end(),
                  [](const auto& program) { return program->isLost(); }))
    known.lost = std::exchange(known.programs, {});
  if (known.programs.empty()) {
    decltype(known.programs) built;
    try {
      callOpenCL("OpenCL", [&] {
        for (const NamedDevice& found : findDevices(name))
          built.push_back(
              std::make_shared<OpenCLProgram>(partOf(found, threads), found.name));
      });
    }
    catch (const BuildFailure& failure) {
      known.build_failure = failure.what();
      throw;
    }
    known.programs = built;
  }
  return known.programs;
}

} // namespace kss
} // namespace pcl
