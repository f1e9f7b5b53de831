/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "fields.h"
#include "format_writers.h"
#include "vector_field.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>

/** \file
 * The formats that are text: columns, OBJ and OFF. Numbers have as many digits as it
 * takes to read the same numbers again.
 */

namespace tool {
namespace {

/** One line of a text file. */
class Row {
public:
  explicit Row(std::string keyword = "")
  : text_(std::move(keyword))
  {
  }

  template <typename T>
  void
  addNumber(T number)
  {
    if constexpr (std::is_floating_point_v<T>)
      number = std::isnan(number) ? std::abs(number) : number; // no "-nan"
    char digits[32];
    const auto end = std::to_chars(digits, digits + sizeof digits, number).ptr;
    if (!text_.empty())
      text_ += ' ';
    text_.append(digits, end);
  }

  void
  addWord(const std::string& word)
  {
    text_ += ' ' + word;
  }

  /** Add the numbers of a field of a point. */
  void
  addField(const pcl::PCLPointField& field, const std::uint8_t* point)
  {
    if (isPackedColour(field)) {
      const auto colour = getColour(field, point);
      for (std::size_t i = 0; i < (field.name == "rgba" ? 4 : 3); ++i)
        addNumber(static_cast<int>(colour[i]));
      return;
    }
    for (std::size_t i = 0; i < std::max<std::size_t>(field.count, 1); ++i)
      if (field.datatype == pcl::PCLPointField::FLOAT32)
        addNumber(static_cast<float>(getNumber(field, point, i)));
      else
        addNumber(getNumber(field, point, i));
  }

  void
  writeTo(std::ostream& stream) const
  {
    stream << text_ << '\n';
  }

private:
  std::string text_;
};

using Fields = std::vector<const pcl::PCLPointField*>;

/** Those of the named fields that a cloud has. */
template <typename Names>
Fields
select(const pcl::PCLPointCloud2& cloud, const Names& names)
{
  Fields fields;
  for (const char* name : names)
    if (const auto* field = findField(cloud, name))
      fields.push_back(field);
  return fields;
}

/** The normals, if they are complete. */
Fields
normalsOf(const pcl::PCLPointCloud2& cloud)
{
  const Fields fields = select(cloud, VectorField::NORMAL);
  return fields.size() == 3 ? fields : Fields{};
}

Row
rowOf(const std::string& keyword, const Fields& fields, const std::uint8_t* point)
{
  Row row(keyword);
  for (const auto* field : fields)
    row.addField(*field, point);
  return row;
}

} // namespace

void
writeText(std::ostream& stream, const Geometry& geometry)
{
  const auto& cloud = geometry.cloud;
  Fields fields = select(cloud, VectorField::POSITION); // where readers expect them
  for (const auto& field : cloud.fields)
    if (!isPadding(field) && std::count(fields.begin(), fields.end(), &field) == 0)
      fields.push_back(&field);
  for (std::size_t i = 0; i < numberOfPoints(cloud); ++i)
    rowOf("", fields, &cloud.data[i * cloud.point_step]).writeTo(stream);
}

void
writeOBJ(std::ostream& stream, const Geometry& geometry)
{
  const auto& cloud = geometry.cloud;
  const Fields position = select(cloud, VectorField::POSITION);
  const Fields normal = normalsOf(cloud);
  const auto colours = select(cloud, std::array<const char*, 2>{"rgb", "rgba"});
  for (std::size_t i = 0; i < numberOfPoints(cloud); ++i) {
    const std::uint8_t* point = &cloud.data[i * cloud.point_step];
    Row row = rowOf("v", position, point);
    if (!colours.empty() && isPackedColour(*colours[0]))
      for (std::size_t k = 0; k < 3; ++k)
        row.addNumber(getColour(*colours[0], point)[k] / 255.0f);
    row.writeTo(stream);
    if (!normal.empty())
      rowOf("vn", normal, point).writeTo(stream);
  }
  for (const auto& face : geometry.faces) {
    Row row("f");
    for (const auto vertex : face.vertices) {
      const std::string number = std::to_string(vertex + 1);
      row.addWord(normal.empty() ? number : number + "//" + number);
    }
    row.writeTo(stream);
  }
}

void
writeOFF(std::ostream& stream, const Geometry& geometry)
{
  const auto& cloud = geometry.cloud;
  Fields fields = select(cloud, VectorField::POSITION);
  const Fields normal = normalsOf(cloud);
  const Fields colour =
      select(cloud, std::array<const char*, 6>{"rgb", "rgba", "red", "green", "blue",
                                               "alpha"});
  fields.insert(fields.end(), normal.begin(), normal.end());
  fields.insert(fields.end(), colour.begin(), colour.end());

  stream << (colour.empty() ? "" : "C") << (normal.empty() ? "" : "N") << "OFF\n"
         << numberOfPoints(cloud) << ' ' << geometry.faces.size() << " 0\n";
  for (std::size_t i = 0; i < numberOfPoints(cloud); ++i)
    rowOf("", fields, &cloud.data[i * cloud.point_step]).writeTo(stream);
  for (const auto& face : geometry.faces) {
    Row row;
    row.addNumber(face.vertices.size());
    for (const auto vertex : face.vertices)
      row.addNumber(vertex);
    row.writeTo(stream);
  }
}

} // namespace tool
