/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#define CL_HPP_TARGET_OPENCL_VERSION 120
#define CL_HPP_MINIMUM_OPENCL_VERSION 120
#define CL_HPP_ENABLE_EXCEPTIONS
#include <pcl/registration/kss/devices.h>

#include <CL/opencl.hpp>

#include <string>

namespace pcl {
namespace kss {

/** \brief Whether this process was forked from one that had called OpenCL. The threads
 * of a driver are not there, so that it would be waited for without end.
 */
bool
isForkedFromOpenCL();

/** \brief Before anything that may call OpenCL.
 * \throws DeviceError where isForkedFromOpenCL()
 */
void
enterOpenCL();

/** \brief The call that failed and its code, as "<who> failed in <call> with error
 * <code>". */
std::string
failureOf(const std::string& who, const cl::Error& error);

/** \brief Do something that calls OpenCL.
 * \param[in] who does it, to begin a sentence with
 * \throws DeviceError where a call fails: which one, its code and what to do
 */
template <typename Work>
auto
callOpenCL(const std::string& who, const Work& work)
{
  enterOpenCL();
  try {
    return work();
  }
  catch (const cl::Error& error) {
    throw DeviceError(failureOf(who, error) + ". Choose another device, or \"host\".");
  }
}

} // namespace kss
} // namespace pcl
