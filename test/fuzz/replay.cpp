/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

/** \file
 * Runs a fuzz target on files, for builds without libFuzzer.
 */

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <vector>

extern "C" int
LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

using Path = std::filesystem::path;

/** All files that are named, or lie in folders that are; options of libFuzzer aside. */
std::vector<Path>
filesOf(int argc, char** argv)
{
  std::vector<Path> files;
  for (int i = 1; i < argc; ++i)
    if (std::filesystem::is_directory(argv[i]))
      for (const auto& entry : std::filesystem::directory_iterator(argv[i]))
        files.push_back(entry.path());
    else if (argv[i][0] != '-')
      files.push_back(argv[i]);
  std::sort(files.begin(), files.end());
  return files;
}

} // namespace

int
main(int argc, char** argv)
{
  const std::vector<Path> files = filesOf(argc, argv);
  for (const Path& file : files) {
    std::cout << file.string() << std::endl; // before it may crash
    std::ifstream stream(file, std::ios::binary);
    const std::vector<char> bytes{std::istreambuf_iterator<char>(stream), {}};
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()),
                           bytes.size());
  }
  std::cout << files.size() << " inputs" << std::endl;
  return files.empty(); // nothing run is no success
}
