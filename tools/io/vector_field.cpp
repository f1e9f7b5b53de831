/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "vector_field.h"

#include "fields.h"

#include <algorithm>

namespace tool {

VectorField::VectorField(const pcl::PCLPointCloud2& cloud,
                         const std::array<const char*, 3>& names)
{
  for (std::size_t i = 0; i < 3; ++i)
    fields_[i] = findField(cloud, names[i]);
  const bool have_one =
      exists() && std::all_of(fields_.begin(), fields_.end(), [&](const auto* field) {
        return field->datatype == fields_[0]->datatype;
      });
  common_type_ = have_one ? fields_[0]->datatype : 0;
}

bool
VectorField::exists() const
{
  return std::all_of(fields_.begin(), fields_.end(),
                     [](const auto* field) { return field != nullptr; });
}

bool
VectorField::isFloatingPoint() const
{
  return exists() && std::all_of(fields_.begin(), fields_.end(), [](const auto* field) {
           return tool::isFloatingPoint(*field);
         });
}

Eigen::Vector3d
VectorField::getNumbers(const std::uint8_t* point) const
{
  return {getNumber(*fields_[0], point), getNumber(*fields_[1], point),
          getNumber(*fields_[2], point)};
}

void
VectorField::set(std::uint8_t* point, const Eigen::Vector3d& value) const
{
  for (std::size_t i = 0; i < 3; ++i)
    setNumber(*fields_[i], point, value[i]);
}

} // namespace tool
