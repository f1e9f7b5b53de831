/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "fields.h"
#include "file_bytes.h"
#include "format_readers.h"
#include "lzf.h"
#include "numbers.h"
#include "pcd_header.h"

#include <algorithm>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <type_traits>

/** \file
 * PCL 1.13 crashes on headers with a word that it does not know, and takes rows and
 * compressed data that are cut short for complete ones.
 */

namespace tool {
namespace {

using Bytes = std::vector<std::uint8_t>;

[[noreturn]] void
failIncomplete(const PCDHeader& header)
{
  throw std::runtime_error("holds fewer or more data than the " +
                           std::to_string(header.points) +
                           " points of its header; the file is damaged or incomplete");
}

Bytes
readRows(const PCDHeader& header, TextLines& lines)
{
  // by the file, not by what its header says
  Bytes data;
  std::uint64_t columns = 0;
  for (const auto& field : header.fields)
    columns += field.count;
  std::uint64_t rows = 0;
  for (; lines.next(); ++rows) {
    while (lines.text()[0] == '#') // somebody's note
      if (!lines.next())
        break;
    if (lines.text().empty())
      break;
    const auto& words = lines.words();
    if (words.size() != columns)
      lines.fail("has " + std::to_string(words.size()) + " numbers instead of " +
                 std::to_string(columns) + "; the file is damaged or incomplete");
    if (rows == header.points)
      failIncomplete(header);
    data.resize(data.size() + header.point_step);
    std::uint8_t* to = &data[rows * header.point_step];
    auto word = words.begin();
    for (const auto& field : header.fields)
      for (std::uint32_t i = 0; i < field.count; ++i, ++word) {
        if (!parseNumber(*word, field.datatype, to))
          lines.failAt(*word, "is not a number, or none that the type of field '" +
                                  field.name + "' can hold");
        to += sizeOf(field) / field.count;
      }
  }
  if (rows != header.points)
    failIncomplete(header);
  return data;
}

/** Writers may fill a file up with zeros, but not with anything else. */
void
expectOnlyZeros(const PCDHeader& header, std::istream& stream)
{
  for (int byte = stream.get(); stream; byte = stream.get())
    if (byte != 0)
      failIncomplete(header);
}

Bytes
readBinary(const PCDHeader& header, std::istream& stream)
{
  if (header.points > remainingBytes(stream) / header.point_step)
    failIncomplete(header);
  Bytes data(header.points * header.point_step);
  stream.read(reinterpret_cast<char*>(data.data()), data.size());
  if (!stream)
    failIncomplete(header);
  expectOnlyZeros(header, stream);
  return data;
}

/** Bytes that nobody has filled: to fill them takes as long as to read them. */
std::unique_ptr<std::uint8_t[]>
roomFor(std::size_t bytes)
{
  return std::unique_ptr<std::uint8_t[]>(new std::uint8_t[bytes]);
}

/** Bring values that stand one behind the other to where points have them. */
template <typename Size>
void
scatter(const std::uint8_t* from,
        std::size_t points,
        Size size, // known to the compiler for most
        std::uint8_t* to,
        std::size_t step)
{
  for (std::size_t i = 0; i < points; ++i)
    std::memcpy(to + i * step, from + i * size, size);
}

/** The points, of data in which all values of a field stand together. */
Bytes
rowsOf(const PCDHeader& header, const std::uint8_t* columns)
{
  constexpr std::uint64_t at_once = 1024; // what the processor's cache holds
  Bytes rows(header.points * header.point_step);
  for (std::uint64_t first = 0; first < header.points; first += at_once) {
    const std::uint64_t points = std::min(at_once, header.points - first);
    for (const auto& field : header.fields) {
      const std::size_t size = sizeOf(field);
      // the columns before take as many bytes as the fields before, for all points
      const std::uint8_t* from = columns + field.offset * header.points + first * size;
      std::uint8_t* to = &rows[first * header.point_step + field.offset];
      if (size == 4)
        scatter(from, points, std::integral_constant<std::size_t, 4>(), to,
                header.point_step);
      else
        scatter(from, points, size, to, header.point_step);
    }
  }
  return rows;
}

/** Read compressed data, in which all values of a field stand together. */
Bytes
readCompressed(const PCDHeader& header, std::istream& stream)
{
  std::uint32_t sizes[2] = {}; // compressed and not
  stream.read(reinterpret_cast<char*>(sizes), sizeof sizes);
  // Three bytes stand for 264 at most.
  constexpr std::uint64_t highest_ratio = 88;
  if (!stream || sizes[0] > remainingBytes(stream) ||
      sizes[1] > sizes[0] * highest_ratio ||
      sizes[1] != header.points * header.point_step)
    failIncomplete(header);
  const auto compressed = roomFor(sizes[0]);
  stream.read(reinterpret_cast<char*>(compressed.get()), sizes[0]);
  if (!stream)
    failIncomplete(header);
  expectOnlyZeros(header, stream);
  const auto columns = roomFor(sizes[1]);
  if (!decompressLZF(compressed.get(), sizes[0], columns.get(), sizes[1]))
    throw std::runtime_error("its compressed data are damaged");
  return rowsOf(header, columns.get());
}

} // namespace

Geometry
readPCD(std::istream& stream)
{
  TextLines lines(stream, TextLines::Style::STRICT);
  const PCDHeader header(lines);
  // A last line without its end may be cut short.
  if (stream.eof())
    throw std::runtime_error("the file ends within its header");

  Geometry geometry;
  auto& cloud = geometry.cloud;
  cloud.fields = header.fields;
  cloud.width = static_cast<pcl::uindex_t>(header.width);
  cloud.height = static_cast<pcl::uindex_t>(header.height);
  cloud.point_step = static_cast<pcl::uindex_t>(header.point_step);
  cloud.row_step = cloud.point_step * cloud.width;
  geometry.sensor_origin = header.sensor_origin;
  geometry.sensor_orientation = header.sensor_orientation;
  geometry.comments = header.comments;
  switch (header.encoding) {
  case PCDHeader::Encoding::ASCII:
    geometry.storage = Storage::TEXT;
    cloud.data = readRows(header, lines);
    break;
  case PCDHeader::Encoding::BINARY:
    geometry.storage = Storage::BINARY;
    cloud.data = readBinary(header, stream);
    break;
  case PCDHeader::Encoding::COMPRESSED:
    geometry.storage = Storage::COMPRESSED;
    cloud.data = readCompressed(header, stream);
    break;
  }
  return geometry;
}

} // namespace tool
