/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/PCLPointCloud2.h>

#include <Eigen/Core>

#include <array>
#include <cstring>

namespace tool {

/** \brief Three fields of a cloud that are the components of one vector.
 *
 * Refers to the cloud's fields, which must stay as they are.
 */
class VectorField {
public:
  static constexpr std::array<const char*, 3> POSITION{"x", "y", "z"};
  static constexpr std::array<const char*, 3> NORMAL{"normal_x", "normal_y",
                                                     "normal_z"};

  VectorField(const pcl::PCLPointCloud2& cloud,
              const std::array<const char*, 3>& names);

  /** \brief Whether the cloud has all three fields. */
  bool
  exists() const;

  /** \brief Whether the cloud has all three fields as floating point numbers. */
  bool
  isFloatingPoint() const;

  /** \brief Read the vector.
   * \param[in] point the first byte of the point
   */
  Eigen::Vector3d
  get(const std::uint8_t* point) const
  {
    switch (common_type_) { // those that nearly all clouds have
    case pcl::PCLPointField::FLOAT32:
      return getAs<float>(point);
    case pcl::PCLPointField::FLOAT64:
      return getAs<double>(point);
    default:
      return getNumbers(point);
    }
  }

  /** \brief Write the vector, if isFloatingPoint().
   * \param[in] point the first byte of the point
   */
  void
  set(std::uint8_t* point, const Eigen::Vector3d& value) const;

private:
  template <typename Number>
  Eigen::Vector3d
  getAs(const std::uint8_t* point) const
  {
    Eigen::Matrix<Number, 3, 1> numbers;
    for (int i = 0; i < 3; ++i)
      std::memcpy(&numbers[i], point + fields_[i]->offset, sizeof(Number));
    return numbers.template cast<double>();
  }

  /** \brief Read the vector, whatever types its components have. */
  Eigen::Vector3d
  getNumbers(const std::uint8_t* point) const;

  std::array<const pcl::PCLPointField*, 3> fields_;
  /** \brief The type of all three; 0 where there is none. */
  std::uint8_t common_type_;
};

} // namespace tool
