/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "written_clouds.h"

#include "clouds.h"
#include "scans.h"
#include "sizes.h"

#include <filesystem>
#include <fstream>
#include <iostream>

namespace benchmarks {
namespace {

/** \brief Binary PCD, by hand: PCL's writer would bring VTK along. */
bool
writeCloud(const std::string& path, const Cloud& cloud)
{
  std::ofstream file(path, std::ios::binary);
  file
      << "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n"
      << "WIDTH " << cloud.size() << "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\n"
      << "POINTS " << cloud.size() << "\nDATA binary\n";
  for (const pcl::PointXYZ& point : cloud)
    file.write(reinterpret_cast<const char*>(point.data), 3 * sizeof(float));
  return static_cast<bool>(file.flush());
}

bool
writePair(const std::string& stem, const Pair& pair)
{
  std::ofstream truth(stem + "_truth.txt");
  truth.precision(17);
  truth << pair.truth.matrix() << '\n';
  return writeCloud(stem + "_source.pcd", *pair.source) &&
         writeCloud(stem + "_target.pcd", *pair.target) &&
         static_cast<bool>(truth.flush());
}

} // namespace

bool
writeClouds(const std::string& folder)
{
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  bool written = true;
  for (const int size : sizes)
    written &= writePair(folder + "/surface_" + std::to_string(size), pairOf(size));
  for (const int seed : seeds) {
    const std::string number = std::to_string(seed);
    written &= writePair(folder + "/street_" + number, streetPair(seed));
    written &= writePair(folder + "/room_" + number, roomPair(seed));
  }
  if (!written)
    std::cerr << "cannot write to " << folder << '\n';
  return written;
}

} // namespace benchmarks
