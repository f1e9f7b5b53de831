/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "opencl_faults.h"

#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>

#include <cstdio>
#include <cstdlib>
#include <map>
#include <mutex>
#include <set>
#include <type_traits>

#include <dlfcn.h>

namespace {

struct State {
  std::mutex mutex;
  long calls = 0, fail_at = 0, live = 0;
  int code = 0;
  std::string failed;
  std::set<const void*> kept;
  std::map<std::string, int> fail_always;
  std::map<std::string, long> calls_of;
  bool has_broken_platform = false;
  std::size_t largest_buffer = 0;
};

State&
state()
{
  static auto& the_state = *new State; // drivers release objects when the program ends
  return the_state;
}

/** The code to return instead of calling; 0: call. */
cl_int
faultOf(const char* function)
{
  State& s = state();
  const std::lock_guard<std::mutex> lock(s.mutex);
  ++s.calls_of[function];
  const auto always = s.fail_always.find(function);
  if (++s.calls != s.fail_at && always == s.fail_always.end())
    return CL_SUCCESS;
  s.failed = function;
  return always != s.fail_always.end() ? always->second : s.code;
}

void
countObjects(long more)
{
  const std::lock_guard<std::mutex> lock(state().mutex);
  state().live += more;
}

/** An object that was to be released, but was not, is no leak of the library's. That of
 * a device is not tried again, since others refer to it. */
void
keep(const void* object, bool is_tried_again)
{
  const std::lock_guard<std::mutex> lock(state().mutex);
  if (!is_tried_again || state().kept.insert(object).second)
    --state().live;
}

void
release(const void* object)
{
  const std::lock_guard<std::mutex> lock(state().mutex);
  if (state().kept.erase(object) == 0)
    --state().live;
}

/** The function that this file stands before. */
template <typename Function>
Function*
real(Function*, const char* name)
{
  static void* const library = dlopen("libOpenCL.so.1", RTLD_NOW);
  auto* function =
      library ? reinterpret_cast<Function*>(dlsym(library, name)) : nullptr;
  if (!function) {
    std::fprintf(stderr, "There is no %s in libOpenCL.so.1.\n", name);
    std::abort();
  }
  return function;
}

cl_platform_id
brokenPlatform()
{
  static int something;
  return reinterpret_cast<cl_platform_id>(&something);
}

} // namespace

// What returns a code, what creates an object, what retains one, and what releases one.
#define KSS_CALL(name, parameters, arguments)                                          \
  extern "C" cl_int CL_API_CALL name parameters                                        \
  {                                                                                    \
    const cl_int fault = faultOf(#name);                                               \
    return fault != CL_SUCCESS ? fault : real(&name, #name) arguments;                 \
  }
#define KSS_CREATE(type, name, parameters, arguments)                                  \
  extern "C" type CL_API_CALL name parameters                                          \
  {                                                                                    \
    if (const cl_int fault = faultOf(#name)) {                                         \
      if (error)                                                                       \
        *error = fault;                                                                \
      return nullptr;                                                                  \
    }                                                                                  \
    type object = real(&name, #name) arguments;                                        \
    countObjects(object ? 1 : 0);                                                      \
    return object;                                                                     \
  }
#define KSS_RETAIN(type, name)                                                         \
  extern "C" cl_int CL_API_CALL name(type object)                                      \
  {                                                                                    \
    if (const cl_int fault = faultOf(#name))                                           \
      return fault;                                                                    \
    countObjects(1);                                                                   \
    return real(&name, #name)(object);                                                 \
  }
#define KSS_RELEASE(type, name)                                                        \
  extern "C" cl_int CL_API_CALL name(type object)                                      \
  {                                                                                    \
    if (const cl_int fault = faultOf(#name)) {                                         \
      keep(object, !std::is_same_v<type, cl_device_id>);                               \
      return fault;                                                                    \
    }                                                                                  \
    release(object);                                                                   \
    return real(&name, #name)(object);                                                 \
  }

extern "C" cl_int CL_API_CALL
clGetPlatformIDs(cl_uint room, cl_platform_id* platforms, cl_uint* number)
{
  if (const cl_int fault = faultOf("clGetPlatformIDs"))
    return fault;
  auto* function = real(&clGetPlatformIDs, "clGetPlatformIDs");
  if (!state().has_broken_platform)
    return function(room, platforms, number);
  cl_uint others = 0;
  if (function(0, nullptr, &others) != CL_SUCCESS)
    others = 0;
  if (platforms && room > 0) {
    platforms[0] = brokenPlatform();
    if (room > 1 && others > 0)
      function(room - 1, platforms + 1, nullptr);
  }
  if (number)
    *number = others + 1;
  return CL_SUCCESS;
}

extern "C" cl_int CL_API_CALL
clGetPlatformInfo(cl_platform_id platform,
                  cl_platform_info what,
                  size_t room,
                  void* value,
                  size_t* size)
{
  const cl_int fault = faultOf("clGetPlatformInfo");
  if (platform == brokenPlatform())
    return CL_INVALID_PLATFORM;
  return fault != CL_SUCCESS ? fault
                             : real(&clGetPlatformInfo, "clGetPlatformInfo")(
                                   platform, what, room, value, size);
}

extern "C" cl_int CL_API_CALL
clGetDeviceInfo(
    cl_device_id device, cl_device_info what, size_t room, void* value, size_t* size)
{
  if (const cl_int fault = faultOf("clGetDeviceInfo"))
    return fault;
  const cl_int code =
      real(&clGetDeviceInfo, "clGetDeviceInfo")(device, what, room, value, size);
  if (what == CL_DEVICE_MAX_MEM_ALLOC_SIZE && value && state().largest_buffer > 0)
    *static_cast<cl_ulong*>(value) = state().largest_buffer;
  return code;
}

KSS_CALL(clGetDeviceIDs,
         (cl_platform_id platform,
          cl_device_type type,
          cl_uint room,
          cl_device_id* devices,
          cl_uint* number),
         (platform, type, room, devices, number))
KSS_CALL(
    clGetProgramInfo,
    (cl_program program, cl_program_info what, size_t room, void* value, size_t* size),
    (program, what, room, value, size))
KSS_CALL(clGetProgramBuildInfo,
         (cl_program program,
          cl_device_id device,
          cl_program_build_info what,
          size_t room,
          void* value,
          size_t* size),
         (program, device, what, room, value, size))
KSS_CALL(clBuildProgram,
         (cl_program program,
          cl_uint number,
          const cl_device_id* devices,
          const char* options,
          void(CL_CALLBACK* notify)(cl_program, void*),
          void* data),
         (program, number, devices, options, notify, data))
KSS_CALL(clSetKernelArg,
         (cl_kernel kernel, cl_uint index, size_t size, const void* value),
         (kernel, index, size, value))
KSS_CALL(clEnqueueNDRangeKernel,
         (cl_command_queue queue,
          cl_kernel kernel,
          cl_uint dimensions,
          const size_t* offset,
          const size_t* global,
          const size_t* local,
          cl_uint events,
          const cl_event* before,
          cl_event* event),
         (queue, kernel, dimensions, offset, global, local, events, before, event))
KSS_CALL(clEnqueueReadBuffer,
         (cl_command_queue queue,
          cl_mem buffer,
          cl_bool blocking,
          size_t offset,
          size_t size,
          void* data,
          cl_uint events,
          const cl_event* before,
          cl_event* event),
         (queue, buffer, blocking, offset, size, data, events, before, event))
KSS_CALL(clEnqueueWriteBuffer,
         (cl_command_queue queue,
          cl_mem buffer,
          cl_bool blocking,
          size_t offset,
          size_t size,
          const void* data,
          cl_uint events,
          const cl_event* before,
          cl_event* event),
         (queue, buffer, blocking, offset, size, data, events, before, event))
KSS_CALL(clFinish, (cl_command_queue queue), (queue))

extern "C" cl_int CL_API_CALL
clCreateSubDevices(cl_device_id device,
                   const cl_device_partition_property* properties,
                   cl_uint room,
                   cl_device_id* devices,
                   cl_uint* number)
{
  if (const cl_int fault = faultOf("clCreateSubDevices"))
    return fault;
  cl_uint made = 0;
  const cl_int code = real(&clCreateSubDevices, "clCreateSubDevices")(
      device, properties, room, devices, &made);
  if (code == CL_SUCCESS && devices)
    countObjects(made);
  if (number)
    *number = made;
  return code;
}

KSS_CREATE(cl_context,
           clCreateContext,
           (const cl_context_properties* properties,
            cl_uint number,
            const cl_device_id* devices,
            void(CL_CALLBACK* notify)(const char*, const void*, size_t, void*),
            void* data,
            cl_int* error),
           (properties, number, devices, notify, data, error))
KSS_CREATE(cl_command_queue,
           clCreateCommandQueue,
           (cl_context context,
            cl_device_id device,
            cl_command_queue_properties properties,
            cl_int* error),
           (context, device, properties, error))
KSS_CREATE(
    cl_mem,
    clCreateBuffer,
    (cl_context context, cl_mem_flags flags, size_t size, void* data, cl_int* error),
    (context, flags, size, data, error))
KSS_CREATE(cl_program,
           clCreateProgramWithSource,
           (cl_context context,
            cl_uint number,
            const char** texts,
            const size_t* sizes,
            cl_int* error),
           (context, number, texts, sizes, error))
KSS_CREATE(cl_kernel,
           clCreateKernel,
           (cl_program program, const char* name, cl_int* error),
           (program, name, error))

KSS_RETAIN(cl_device_id, clRetainDevice)
KSS_RETAIN(cl_mem, clRetainMemObject)
KSS_RELEASE(cl_command_queue, clReleaseCommandQueue)
KSS_RELEASE(cl_context, clReleaseContext)
KSS_RELEASE(cl_device_id, clReleaseDevice)
KSS_RELEASE(cl_kernel, clReleaseKernel)
KSS_RELEASE(cl_mem, clReleaseMemObject)
KSS_RELEASE(cl_program, clReleaseProgram)

namespace kss_test {

void
failAt(long call, int code)
{
  State& s = state();
  const std::lock_guard<std::mutex> lock(s.mutex);
  s.fail_at = call;
  s.code = code;
  s.calls = 0;
  s.failed.clear();
}

long
callsMade()
{
  return state().calls;
}

std::string
failedCall()
{
  return state().failed;
}

void
failAlways(const std::string& function, int code)
{
  State& s = state();
  const std::lock_guard<std::mutex> lock(s.mutex);
  if (code == CL_SUCCESS)
    s.fail_always.erase(function);
  else
    s.fail_always[function] = code;
}

long
callsOf(const std::string& function)
{
  return state().calls_of[function];
}

long
liveObjects()
{
  return state().live;
}

void
showBrokenPlatform(bool is_shown)
{
  state().has_broken_platform = is_shown;
}

void
claimLargestBuffer(std::size_t bytes)
{
  state().largest_buffer = bytes;
}

} // namespace kss_test
