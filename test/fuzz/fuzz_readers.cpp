/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

/** \file
 * Arbitrary bytes as files of all formats: they are read, or refused with a reason; and
 * what is written of them is read again.
 */

#include "require.h"

#include <pcl/console/print.h>

#include "io/read_geometry.h"
#include "io/write_geometry.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <utility>

#include <unistd.h>

namespace {

/** In memory, where there is such a folder; gone when the process ends. */
class Folder {
public:
  Folder()
  {
    namespace fs = std::filesystem;
    const fs::path memory = "/dev/shm";
    path_ = (fs::is_directory(memory) ? memory : fs::temp_directory_path()) /
            ("kss_icp_fuzz_" + std::to_string(getpid()));
    fs::create_directories(path_);
  }

  ~Folder()
  {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }

  std::string
  file(const std::string& name) const
  {
    return (path_ / name).string();
  }

private:
  std::filesystem::path path_;
};

/** What is written again holds as many points, of those that have a place. */
void
checkWritten(const tool::Geometry& geometry, const std::string& path)
{
  using tool::FileFormat;
  const auto finite = [](const tool::Geometry& points) {
    const auto positions = tool::positionsOf(points);
    return std::count_if(positions.begin(), positions.end(),
                         [](const auto& position) { return position.allFinite(); });
  };
  for (const auto& [format, extension] : {std::make_pair(FileFormat::PCD, ".pcd"),
                                          std::make_pair(FileFormat::PLY, ".ply"),
                                          std::make_pair(FileFormat::TEXT, ".txt"),
                                          std::make_pair(FileFormat::CSV, ".csv")}) {
    const std::string again = path + extension;
    std::ofstream stream(again, std::ios::binary);
    tool::writeGeometry(geometry, format, stream);
    stream.close();
    KSS_FUZZ_REQUIRE(finite(tool::readGeometry(again)) == finite(geometry));
  }
}

void
checkRead(const tool::Geometry& geometry)
{
  const std::size_t points = tool::positionsOf(geometry).size();
  KSS_FUZZ_REQUIRE(points > 0);
  KSS_FUZZ_REQUIRE(geometry.cloud.data.size() == points * geometry.cloud.point_step);
  for (const auto& face : geometry.faces)
    for (const auto vertex : face.vertices)
      KSS_FUZZ_REQUIRE(static_cast<std::size_t>(vertex) < points);
}

} // namespace

extern "C" int
LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  static const Folder folder;
  static const char* const extensions[] = {"pcd", "ply", "off", "xyz", "obj",
                                           "stl", "pts", "csv", "ptx", "none"};
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  if (size == 0)
    return 0;
  const std::string path =
      folder.file(std::string("input.") + extensions[data[0] % std::size(extensions)]);
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(data + 1), size - 1);
  tool::Geometry geometry;
  try {
    geometry = tool::readGeometry(path);
  }
  catch (const std::runtime_error& problem) {
    const std::string message = problem.what();
    KSS_FUZZ_REQUIRE(message.size() > path.size() + 2);
    KSS_FUZZ_REQUIRE(message.compare(0, path.size(), path) == 0);
    return 0;
  }
  checkRead(geometry);
  checkWritten(geometry, path);
  return 0;
}
