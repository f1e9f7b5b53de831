/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "fields.h"

#include "numbers.h"

#include <pcl/common/io.h>

#include <algorithm>
#include <cstring>
#include <set>
#include <stdexcept>

namespace tool {
std::size_t
numberOfPoints(const pcl::PCLPointCloud2& cloud)
{
  return static_cast<std::size_t>(cloud.width) * cloud.height;
}

const pcl::PCLPointField*
findField(const pcl::PCLPointCloud2& cloud, const std::string& name)
{
  for (const auto& field : cloud.fields)
    if (field.name == name)
      return &field;
  return nullptr;
}

bool
isFloatingPoint(const pcl::PCLPointField& field)
{
  return field.datatype == pcl::PCLPointField::FLOAT32 ||
         field.datatype == pcl::PCLPointField::FLOAT64;
}

bool
isPackedColour(const pcl::PCLPointField& field)
{
  return (field.name == "rgb" || field.name == "rgba") && sizeOf(field) == 4;
}

std::array<std::uint8_t, 4>
getColour(const pcl::PCLPointField& field, const std::uint8_t* point)
{
  std::uint32_t colour;
  std::memcpy(&colour, point + field.offset, sizeof colour);
  return {static_cast<std::uint8_t>(colour >> 16),
          static_cast<std::uint8_t>(colour >> 8), static_cast<std::uint8_t>(colour),
          static_cast<std::uint8_t>(colour >> 24)};
}

bool
isPadding(const pcl::PCLPointField& field)
{
  return field.name == "_";
}

std::size_t
sizeOf(const pcl::PCLPointField& field)
{
  // A count of 0 stands for 1 in clouds from old files.
  return pcl::getFieldSize(field.datatype) * std::max<std::size_t>(field.count, 1);
}

double
getNumber(const pcl::PCLPointField& field,
          const std::uint8_t* point,
          std::size_t element)
{
  const std::uint8_t* bytes = point + field.offset;
  return withType(field.datatype, [&](auto value) {
    // Fields need not lie where their type may be read from.
    std::memcpy(&value, bytes + element * sizeof value, sizeof value);
    return static_cast<double>(value);
  });
}

void
setNumber(const pcl::PCLPointField& field, std::uint8_t* point, double value)
{
  if (field.datatype == pcl::PCLPointField::FLOAT32) {
    const auto narrow = static_cast<float>(value);
    std::memcpy(point + field.offset, &narrow, sizeof narrow);
  }
  else
    std::memcpy(point + field.offset, &value, sizeof value);
}

void
checkNames(const std::vector<std::string>& names)
{
  // More would be another file's data, and each takes room however short its name is.
  constexpr std::size_t most = 1000;
  if (names.size() > most)
    throw std::runtime_error("has " + std::to_string(names.size()) +
                             " fields or columns; " + std::to_string(most) +
                             " are the most that can be read");
  std::set<std::string> taken;
  for (const auto& name : names)
    if (name != "_" && !taken.insert(name).second)
      throw std::runtime_error("has two fields '" + name.substr(0, 40) + "'");
}

void
addField(pcl::PCLPointCloud2& cloud, const std::string& name, std::uint8_t datatype)
{
  pcl::PCLPointField field;
  field.name = name;
  field.datatype = datatype;
  field.count = 1;
  field.offset = cloud.point_step;
  cloud.point_step += sizeOf(field);
  cloud.fields.push_back(field);
}

void
setNumberOfPoints(pcl::PCLPointCloud2& cloud, std::size_t points)
{
  cloud.height = 1;
  cloud.width = points;
  cloud.row_step = cloud.point_step * cloud.width;
  cloud.data.assign(points * cloud.point_step, 0);
}

pcl::PCLPointCloud2
cloudOfDoubles(const std::vector<double>& values, const std::vector<std::string>& names)
{
  checkNames(names);
  pcl::PCLPointCloud2 cloud;
  for (const auto& name : names)
    addField(cloud, name, pcl::PCLPointField::FLOAT64);
  setNumberOfPoints(cloud, values.size() / names.size());
  if (!values.empty())
    std::memcpy(cloud.data.data(), values.data(), cloud.data.size());
  return cloud;
}

} // namespace tool
