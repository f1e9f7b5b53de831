/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * OpenCL as the library sees it where a test links opencl_faults.cpp: every call passes
 * through here, and any can be made to fail.
 */

#pragma once

#include <cstddef>
#include <string>

namespace kss_test {

/** \brief Makes one call fail: the n-th from now on, with some code; 0: none. */
void
failAt(long call, int code = -5); // CL_OUT_OF_RESOURCES

/** \brief The calls since failAt(). */
long
callsMade();

/** \brief The name of the call that was made to fail; empty: none was. */
std::string
failedCall();

/** \brief Makes all calls of one function fail; 0: none. */
void
failAlways(const std::string& function, int code);

/** \brief The calls of one function in all. */
long
callsOf(const std::string& function);

/** \brief Objects that have been created or retained and not released. */
long
liveObjects();

/** \brief Whether there is one more platform, the first one, all of whose calls fail.
 */
void
showBrokenPlatform(bool is_shown);

/** \brief What devices say their largest buffer is; 0: the truth. */
void
claimLargestBuffer(std::size_t bytes);

} // namespace kss_test
