/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "file_format.h"

#include "file_bytes.h"
#include "numbers.h"
#include "text_encoding.h"
#include "text_lines.h"

#include <boost/algorithm/string/case_conv.hpp>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <stdexcept>

namespace tool {
namespace {

constexpr const char* USE = "use .pcd, .ply, .obj, .stl, .off, .xyz, .txt, .csv, .asc, "
                            ".pts or .ptx";

std::string
extensionOf(const std::string& path)
{
  return boost::algorithm::to_lower_copy(
      std::filesystem::path(path).extension().string());
}

std::optional<FileFormat>
byExtension(const std::string& path)
{
  static const std::map<std::string, FileFormat> formats{
      {".pcd", FileFormat::PCD},   {".ply", FileFormat::PLY},
      {".obj", FileFormat::OBJ},   {".stl", FileFormat::STL},
      {".off", FileFormat::OFF},   {".coff", FileFormat::OFF},
      {".noff", FileFormat::OFF},  {".cnoff", FileFormat::OFF},
      {".csv", FileFormat::CSV},   {".pts", FileFormat::PTS},
      {".ptx", FileFormat::PTX},   {".xyz", FileFormat::TEXT},
      {".txt", FileFormat::TEXT},  {".asc", FileFormat::TEXT},
      {".xyzn", FileFormat::TEXT}, {".xyzrgb", FileFormat::TEXT},
      {".xyzi", FileFormat::TEXT}, {".neu", FileFormat::TEXT},
      {".dat", FileFormat::TEXT},  {".tsv", FileFormat::TEXT},
      {".tab", FileFormat::TEXT},  {".ascii", FileFormat::TEXT},
      {".3d", FileFormat::TEXT},   {".xyb", FileFormat::TEXT},
      {".prn", FileFormat::TEXT}};
  const auto format = formats.find(extensionOf(path));
  if (format == formats.end())
    return std::nullopt;
  return format->second;
}

/** Whether files of that extension hold points or meshes in another way, even if a look
 * at them does not tell. */
bool
isForeign(const std::string& extension)
{
  static const std::set<std::string> extensions{
      ".las", ".laz", ".e57", ".gltf", ".glb",  ".dae",  ".fbx", ".3ds",
      ".3mf", ".vtk", ".vtp", ".vtu",  ".step", ".stp",  ".igs", ".iges",
      ".fls", ".rcp", ".ptg", ".x3d",  ".wrl",  ".json", ".xml", ".amf"};
  return extensions.count(extension) > 0;
}

bool
startsWith(std::string_view text, std::string_view start)
{
  return text.substr(0, start.size()) == start;
}

bool
holdsNumbers(TextLines& lines, std::size_t number)
{
  const auto& words = lines.words();
  double ignored;
  return words.size() == number &&
         std::all_of(words.begin(), words.end(),
                     [&](std::string_view word) { return parseNumber(word, ignored); });
}

/** Whether a file starts as a PTX file does: two counts, where the scanner stood, and a
 * matrix. */
bool
isPTX(TextLines& lines)
{
  for (const std::size_t numbers : {1, 1, 3, 3, 3, 3, 4, 4, 4, 4})
    if (!lines.next() || !holdsNumbers(lines, numbers))
      return false;
  return true;
}

/** Whether the lines of a text are statements of OBJ, up to the first point. */
bool
isOBJ(TextLines& lines)
{
  static const std::set<std::string_view> before{"mtllib", "usemtl", "o",  "g",
                                                 "s",      "vn",     "vt", "v"};
  while (lines.next()) {
    const auto& words = lines.words();
    double ignored;
    if (words.empty() || before.count(words[0]) == 0)
      return false;
    if (words[0] == "v")
      return words.size() >= 4 && parseNumber(words[1], ignored);
  }
  return false;
}

/** Whether a binary STL file with so many triangles as it says is as long. */
bool
isBinarySTL(const std::string& start, std::uint64_t size)
{
  constexpr std::size_t header_size = 84, triangle_size = 50;
  std::uint32_t triangles = 0;
  if (start.size() < header_size + triangle_size)
    return false;
  std::memcpy(&triangles, &start[header_size - sizeof triangles], sizeof triangles);
  return size == header_size + triangle_size * std::uint64_t(triangles);
}

/** What the first bytes of a file say, if anything. */
std::optional<FileFormat>
byContent(const std::string& start, std::uint64_t size)
{
  if (isBinarySTL(start, size))
    return FileFormat::STL;
  std::istringstream stream(start);
  const auto from_start = [&](TextLines::Style style) {
    stream.clear();
    stream.seekg(0);
    return TextLines(stream, style);
  };
  try {
    TextLines first = from_start(TextLines::Style::RAW);
    if (!first.next())
      return std::nullopt;
    const std::string line = boost::algorithm::to_lower_copy(first.text());
    const std::string all = boost::algorithm::to_lower_copy(start);
    if (line == "ply")
      return FileFormat::PLY;
    if (startsWith(line, "# .pcd") || (all.find("\nfields ") < all.find("\ndata ") &&
                                       all.find("\ndata ") != std::string::npos))
      return FileFormat::PCD;
    if (startsWith(line, "solid") && all.find("facet") != std::string::npos)
      return FileFormat::STL;
    TextLines off = from_start(TextLines::Style::COMMENTED);
    if (off.next()) {
      const std::string word = off.takeWord();
      const auto off_at = word.find("OFF");
      if (off_at <= 4 && word.find_first_not_of("STCN4n") >= off_at &&
          word.find_first_not_of("0123456789", off_at + 3) == std::string::npos)
        return FileFormat::OFF;
    }
    TextLines ptx = from_start(TextLines::Style::RAW);
    if (isPTX(ptx))
      return FileFormat::PTX;
    TextLines obj = from_start(TextLines::Style::COMMENTED);
    if (isOBJ(obj))
      return FileFormat::OBJ;
  }
  catch (const std::runtime_error&) { // no text
  }
  return std::nullopt;
}

bool
isText(const std::string& start)
{
  return std::none_of(start.begin(), start.end(), [](unsigned char c) {
    return c < ' ' && !(c >= '\t' && c <= '\r');
  });
}

} // namespace

FileFormat
fileFormatOf(const std::string& path)
{
  if (const auto format = byExtension(path))
    return *format;
  throw std::runtime_error(path + ": unknown extension; " + USE);
}

FileFormat
fileFormatOf(const std::string& path, std::istream& stream)
{
  constexpr std::size_t enough = 4096;
  std::string start(enough, '\0');
  start.resize(static_cast<std::size_t>(stream.read(&start[0], enough).gcount()));
  stream.clear();
  stream.seekg(0);
  if (const auto format = byContent(start, remainingBytes(stream)))
    return *format;
  if (const auto format = byExtension(path))
    return *format;
  if (isForeign(extensionOf(path)) || !isText(start) ||
      start.find_first_of("0123456789") == std::string::npos)
    throw std::runtime_error(
        path + ": unknown extension, and no format that can be read; " + USE);
  return FileFormat::TEXT;
}

FileFormat
fileFormatLike(const std::string& path, const std::string& source)
{
  if (byExtension(path) || extensionOf(path) != extensionOf(source) ||
      !std::filesystem::is_regular_file(source))
    return fileFormatOf(path);
  std::ifstream file(source, std::ios::binary);
  const auto decoded = decodedUTF16(file);
  return fileFormatOf(source, decoded ? *decoded : file);
}

} // namespace tool
