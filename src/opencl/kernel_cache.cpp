/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "opencl/kernel_cache.h"

#include <cstdlib>
#include <filesystem>
#include <system_error>

#include <unistd.h>

namespace pcl {
namespace kss {
namespace {

/** Where PoCL keeps its programs. */
std::filesystem::path
folderOfPoCL()
{
  const auto variable = [](const char* name) -> std::filesystem::path {
    const char* value = std::getenv(name);
    return value ? value : "";
  };
  if (auto folder = variable("POCL_CACHE_DIR"); !folder.empty())
    return folder;
  if (const auto cache = variable("XDG_CACHE_HOME"); !cache.empty())
    return cache / "pocl" / "kcache";
  if (const auto home = variable("HOME"); !home.empty())
    return home / ".cache" / "pocl" / "kcache";
  return "/tmp/pocl/kcache";
}

/** What keeps a file from being written to a folder, which is made where there is none.
 */
std::error_code
writingTo(const std::filesystem::path& folder)
{
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    return error;
  std::string name = folder / "XXXXXX";
  const int file = mkstemp(name.data());
  if (file < 0)
    return {errno, std::generic_category()};
  const std::string some(4096, ' '); // a full disk takes a name, but no contents
  if (write(file, some.data(), some.size()) != static_cast<ssize_t>(some.size()))
    error = {errno ? errno : ENOSPC, std::generic_category()};
  close(file);
  unlink(name.c_str());
  return error;
}

} // namespace

std::string
kernelCacheProblem(const std::string& platform)
{
  if (platform != "Portable Computing Language")
    return "";
  const std::filesystem::path folder = folderOfPoCL();
  const std::error_code error = writingTo(folder);
  return error ? " It keeps built programs in " + folder.string() +
                     ", which cannot be written: " + error.message() +
                     ". Set POCL_CACHE_DIR to a folder that can."
               : "";
}

} // namespace kss
} // namespace pcl
