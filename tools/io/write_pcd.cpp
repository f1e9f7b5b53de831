/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "fields.h"
#include "format_writers.h"
#include "lzf.h"
#include "numbers.h"
#include "value_output.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

/** \file
 * PCL would map the file into memory, where a full disk ends the program.
 */

namespace tool {
namespace {

/** The letter of a type of numbers. */
char
letterOf(std::uint8_t datatype)
{
  return withType(datatype, [](auto number) {
    using Number = decltype(number);
    return std::is_floating_point_v<Number> ? 'F'
           : std::is_signed_v<Number>       ? 'I'
                                            : 'U';
  });
}

/** The lines of the header that have a word for each field. */
class FieldLines {
public:
  void
  add(const pcl::PCLPointField& field, char letter)
  {
    const std::size_t count = std::max<std::size_t>(field.count, 1);
    add(field.name, sizeOf(field) / count, letter, count);
  }

  void
  add(const std::string& name, std::size_t size, char letter, std::size_t count)
  {
    names_ += ' ' + name;
    sizes_ += ' ' + std::to_string(size);
    letters_ += std::string(" ") + letter;
    counts_ += ' ' + std::to_string(count);
  }

  /** Bytes that are in no field. */
  void
  addPadding(std::size_t bytes)
  {
    if (bytes > 0)
      add("_", 1, 'U', bytes);
  }

  std::string
  text() const
  {
    return "FIELDS" + names_ + "\nSIZE" + sizes_ + "\nTYPE" + letters_ + "\nCOUNT" +
           counts_ + '\n';
  }

private:
  std::string names_, sizes_, letters_, counts_;
};

/** The fields that hold something, in the order of their places. */
std::vector<pcl::PCLPointField>
fieldsInOrder(const pcl::PCLPointCloud2& cloud)
{
  std::vector<pcl::PCLPointField> fields = cloud.fields;
  fields.erase(std::remove_if(fields.begin(), fields.end(), isPadding), fields.end());
  std::stable_sort(fields.begin(), fields.end(),
                   [](const auto& a, const auto& b) { return a.offset < b.offset; });
  return fields;
}

/** The numbers, as short as they can be read again. */
template <typename Numbers>
std::string
wordsOf(const Numbers& numbers)
{
  std::string words;
  for (const float number : numbers) {
    char digits[32];
    words += ' ';
    words.append(digits, std::to_chars(digits, digits + sizeof digits, number).ptr);
  }
  return words;
}

/** The header's lines, but for the last. */
void
writeHeader(std::ostream& stream, const Geometry& geometry, const FieldLines& fields)
{
  const auto& cloud = geometry.cloud;
  const auto& origin = geometry.sensor_origin;
  const auto& turn = geometry.sensor_orientation;
  stream << "# .PCD v0.7 - Point Cloud Data file format\n";
  for (const auto& comment : geometry.comments)
    stream << "# " << comment << '\n';
  stream << "VERSION 0.7\n"
         << fields.text() << "WIDTH " << cloud.width << "\nHEIGHT " << cloud.height
         << "\nVIEWPOINT"
         << wordsOf(std::array<float, 7>{origin.x(), origin.y(), origin.z(), turn.w(),
                                         turn.x(), turn.y(), turn.z()})
         << "\nPOINTS " << numberOfPoints(cloud) << '\n';
}

void
writeBinary(std::ostream& stream, const Geometry& geometry)
{
  const auto& cloud = geometry.cloud;
  FieldLines fields;
  std::size_t end = 0; // of the fields so far
  for (const auto& field : fieldsInOrder(cloud)) {
    fields.addPadding(field.offset - end);
    fields.add(field, letterOf(field.datatype));
    end = field.offset + sizeOf(field);
  }
  fields.addPadding(cloud.point_step - end);
  writeHeader(stream, geometry, fields);
  stream << "DATA binary\n";
  stream.write(reinterpret_cast<const char*>(cloud.data.data()),
               static_cast<std::streamsize>(cloud.data.size()));
}

/** Write compressed data, in which all values of a field stand together. */
void
writeCompressed(std::ostream& stream, const Geometry& geometry)
{
  const auto& cloud = geometry.cloud;
  const std::size_t points = numberOfPoints(cloud);
  FieldLines fields;
  std::vector<std::uint8_t> columns;
  columns.reserve(cloud.data.size());
  for (const auto& field : fieldsInOrder(cloud)) {
    fields.add(field, letterOf(field.datatype));
    for (std::size_t i = 0; i < points; ++i) {
      const std::uint8_t* from = &cloud.data[i * cloud.point_step + field.offset];
      columns.insert(columns.end(), from, from + sizeOf(field));
    }
  }
  const auto compressed = compressLZF(columns.data(), columns.size());
  constexpr std::size_t most = std::numeric_limits<std::uint32_t>::max();
  if (columns.size() > most || compressed.size() > most)
    return writeBinary(stream, geometry); // the format has no room for their sizes
  writeHeader(stream, geometry, fields);
  stream << "DATA binary_compressed\n";
  const std::uint32_t sizes[] = {static_cast<std::uint32_t>(compressed.size()),
                                 static_cast<std::uint32_t>(columns.size())};
  stream.write(reinterpret_cast<const char*>(sizes), sizeof sizes);
  stream.write(reinterpret_cast<const char*>(compressed.data()),
               static_cast<std::streamsize>(compressed.size()));
}

/** The type by which a field's numbers are written in text: a colour may be no number
 * as a float. */
std::uint8_t
textType(const pcl::PCLPointField& field)
{
  return isPackedColour(field) ? std::uint8_t(pcl::PCLPointField::UINT32)
                               : field.datatype;
}

void
writeRows(std::ostream& stream, const Geometry& geometry)
{
  const auto& cloud = geometry.cloud;
  const auto in_order = fieldsInOrder(cloud);
  FieldLines fields;
  for (const auto& field : in_order)
    fields.add(field, letterOf(textType(field)));
  writeHeader(stream, geometry, fields);
  stream << "DATA ascii\n";
  ValueOutput output(stream, Storage::TEXT);
  for (std::size_t i = 0; i < numberOfPoints(cloud); ++i) {
    for (const auto& field : in_order) {
      const std::uint8_t* from = &cloud.data[i * cloud.point_step + field.offset];
      for (std::size_t k = 0; k < std::max<std::size_t>(field.count, 1); ++k)
        withType(textType(field), [&](auto number) {
          std::memcpy(&number, from + k * sizeof number, sizeof number);
          output.write(number);
        });
    }
    output.endElement();
  }
}

} // namespace

void
writePCD(std::ostream& stream, const Geometry& geometry)
{
  switch (geometry.storage) {
  case Storage::TEXT:
    return writeRows(stream, geometry);
  case Storage::COMPRESSED:
    return writeCompressed(stream, geometry);
  default:
    return writeBinary(stream, geometry);
  }
}

} // namespace tool
