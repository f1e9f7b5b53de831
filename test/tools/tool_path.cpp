/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * main() of the tests that run the command line tool, whose path is the last argument.
 */

#include "tool_path.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <iostream>

namespace {

std::string tool_path;

} // namespace

const std::string&
kss_test::toolPath()
{
  return tool_path;
}

int
main(int argc, char** argv)
{
  ::testing::InitGoogleTest(&argc, argv);
  if (argc != 2) {
    std::cerr << "usage: " << argv[0] << " TOOL\n";
    return 2;
  }
  tool_path = std::filesystem::absolute(argv[1]).string();
  return RUN_ALL_TESTS();
}
