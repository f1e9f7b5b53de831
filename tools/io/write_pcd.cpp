/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "fields.h"
#include "format_writers.h"
#include "numbers.h"

#include <algorithm>
#include <array>
#include <charconv>
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

} // namespace

void
writePCD(std::ostream& stream, const Geometry& geometry)
{
  const auto& cloud = geometry.cloud;
  FieldLines fields;
  std::size_t end = 0; // of the fields so far
  for (const auto& field : fieldsInOrder(cloud)) {
    fields.addPadding(field.offset - end);
    const std::size_t count = std::max<std::size_t>(field.count, 1);
    fields.add(field.name, sizeOf(field) / count, letterOf(field.datatype), count);
    end = field.offset + sizeOf(field);
  }
  fields.addPadding(cloud.point_step - end);

  const auto& origin = geometry.sensor_origin;
  const auto& turn = geometry.sensor_orientation;
  stream << "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\n"
         << fields.text() << "WIDTH " << cloud.width << "\nHEIGHT " << cloud.height
         << "\nVIEWPOINT"
         << wordsOf(std::array<float, 7>{origin.x(), origin.y(), origin.z(), turn.w(),
                                         turn.x(), turn.y(), turn.z()})
         << "\nPOINTS " << numberOfPoints(cloud) << "\nDATA binary\n";
  stream.write(reinterpret_cast<const char*>(cloud.data.data()),
               static_cast<std::streamsize>(cloud.data.size()));
}

} // namespace tool
