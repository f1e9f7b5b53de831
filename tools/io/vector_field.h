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
    if (!all_float_)
      return getNumbers(point);
    Eigen::Vector3f floats; // what nearly all clouds have
    for (int i = 0; i < 3; ++i)
      std::memcpy(&floats[i], point + fields_[i]->offset, sizeof(float));
    return floats.cast<double>();
  }

  /** \brief Write the vector, if isFloatingPoint().
   * \param[in] point the first byte of the point
   */
  void
  set(std::uint8_t* point, const Eigen::Vector3d& value) const;

private:
  /** \brief Read the vector, whatever types its components have. */
  Eigen::Vector3d
  getNumbers(const std::uint8_t* point) const;

  std::array<const pcl::PCLPointField*, 3> fields_;
  bool all_float_;
};

} // namespace tool
