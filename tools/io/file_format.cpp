/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "file_format.h"

#include <boost/algorithm/string/case_conv.hpp>

#include <filesystem>
#include <map>
#include <stdexcept>

namespace tool {

FileFormat
fileFormatOf(const std::string& path)
{
  static const std::map<std::string, FileFormat> formats{
      {".pcd", FileFormat::PCD},  {".ply", FileFormat::PLY}, {".obj", FileFormat::OBJ},
      {".stl", FileFormat::STL},  {".off", FileFormat::OFF}, {".xyz", FileFormat::TEXT},
      {".txt", FileFormat::TEXT}, {".pts", FileFormat::TEXT}};
  const auto extension = std::filesystem::path(path).extension().string();
  const auto format = formats.find(boost::algorithm::to_lower_copy(extension));
  if (format == formats.end())
    throw std::runtime_error(
        path +
        ": unknown extension; use .pcd, .ply, .obj, .stl, .off, .xyz, .txt or .pts");
  return format->second;
}

} // namespace tool
