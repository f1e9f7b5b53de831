/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "fields.h"
#include "numbers.h"
#include "vector_field.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <ostream>
#include <string>
#include <type_traits>
#include <vector>

namespace tool {

/** \brief One line of a text file, whose numbers have as many digits as it takes to
 * read the same numbers again.
 */
class Row {
public:
  explicit Row(std::string keyword = "", char separator = ' ')
  : text_(std::move(keyword))
  , separator_(separator)
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
      text_ += separator_;
    text_.append(digits, end);
  }

  void
  addWord(const std::string& word)
  {
    if (!text_.empty())
      text_ += separator_;
    text_ += word;
  }

  /** \brief Add the numbers of a field of a point; of colours perhaps not alpha. */
  void
  addField(const pcl::PCLPointField& field,
           const std::uint8_t* point,
           bool with_alpha = true)
  {
    if (isPackedColour(field)) {
      const auto colour = getColour(field, point);
      for (std::size_t i = 0; i < (field.name == "rgba" && with_alpha ? 4 : 3); ++i)
        addNumber(static_cast<int>(colour[i]));
      return;
    }
    for (std::size_t i = 0; i < std::max<std::size_t>(field.count, 1); ++i)
      withType(field.datatype, [&](auto value) {
        std::memcpy(&value, point + field.offset + i * sizeof value, sizeof value);
        addNumber(value);
      });
  }

  void
  writeTo(std::ostream& stream) const
  {
    stream << text_ << '\n';
  }

private:
  std::string text_;
  char separator_;
};

using Fields = std::vector<const pcl::PCLPointField*>;

/** \brief Those of the named fields that a cloud has. */
template <typename Names>
Fields
selectFields(const pcl::PCLPointCloud2& cloud, const Names& names)
{
  Fields fields;
  for (const char* name : names)
    if (const auto* field = findField(cloud, name))
      fields.push_back(field);
  return fields;
}

/** \brief The fields of the normals, if they are complete. */
inline Fields
normalFields(const pcl::PCLPointCloud2& cloud)
{
  const Fields fields = selectFields(cloud, VectorField::NORMAL);
  return fields.size() == 3 ? fields : Fields{};
}

/** \brief The packed colour, or null. */
inline const pcl::PCLPointField*
colourField(const pcl::PCLPointCloud2& cloud)
{
  for (const auto& field : cloud.fields)
    if (isPackedColour(field))
      return &field;
  return nullptr;
}

/** \brief A line with the numbers of a point. */
inline Row
rowOf(const std::string& keyword,
      const Fields& fields,
      const std::uint8_t* point,
      char separator = ' ',
      bool with_alpha = true)
{
  Row row(keyword, separator);
  for (const auto* field : fields)
    row.addField(*field, point, with_alpha);
  return row;
}

} // namespace tool
