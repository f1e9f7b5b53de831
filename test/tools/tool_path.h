/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <string>

namespace kss_test {

/** \brief The tool to run: the argument of the test program, see tool_path.cpp. */
const std::string&
toolPath();

} // namespace kss_test
