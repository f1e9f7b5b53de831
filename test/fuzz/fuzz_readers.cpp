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

/** The positions of the points that have one. */
tool::Points
placesOf(const tool::Geometry& geometry)
{
  tool::Points places = tool::positionsOf(geometry);
  places.erase(std::remove_if(places.begin(), places.end(),
                              [](const auto& place) { return !place.allFinite(); }),
               places.end());
  return places;
}

/** What is written again holds the same points, but for the digits that floats lack, of
 * those that have a place. STL is left out, as it joins points and drops those that no
 * face has. */
void
checkWritten(const tool::Geometry& geometry, const std::string& path)
{
  using tool::FileFormat;
  const tool::Points places = placesOf(geometry);
  double size = 0.0;
  for (const auto& place : places)
    size = std::max(size, place.cwiseAbs().maxCoeff());
  for (const auto& [format, extension] : {std::make_pair(FileFormat::PCD, ".pcd"),
                                          std::make_pair(FileFormat::PLY, ".ply"),
                                          std::make_pair(FileFormat::TEXT, ".txt"),
                                          std::make_pair(FileFormat::CSV, ".csv"),
                                          std::make_pair(FileFormat::PTS, ".pts"),
                                          std::make_pair(FileFormat::PTX, ".ptx"),
                                          std::make_pair(FileFormat::OFF, ".off"),
                                          std::make_pair(FileFormat::OBJ, ".obj")}) {
    const std::string again = path + extension;
    std::ofstream stream(again, std::ios::binary);
    tool::writeGeometry(geometry, format, stream);
    stream.close();
    const tool::Points found = placesOf(tool::readGeometry(again));
    KSS_FUZZ_REQUIRE(found.size() == places.size());
    for (std::size_t i = 0; i < places.size(); ++i)
      KSS_FUZZ_REQUIRE((found[i] - places[i]).cwiseAbs().maxCoeff() <= 1e-6 * size);
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
