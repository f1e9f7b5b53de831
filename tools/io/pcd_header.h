/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "text_lines.h"

#include <pcl/PCLPointField.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cstdint>
#include <vector>

namespace tool {

/** \brief The header of a PCD file, in which every line is understood. */
struct PCDHeader {
  enum class Encoding { ASCII, BINARY, COMPRESSED };

  /** \brief Read a header up to and with its line DATA.
   * \throws std::runtime_error where it is wrong or cut short
   */
  explicit PCDHeader(TextLines& lines);

  /** \brief The fields, one behind the other. */
  std::vector<pcl::PCLPointField> fields;
  /** \brief The bytes of a point. */
  std::uint64_t point_step = 0;
  std::uint64_t width = 0, height = 0;
  /** \brief How many points there are; fits into 31 bits. */
  std::uint64_t points = 0;
  Eigen::Vector4f sensor_origin = Eigen::Vector4f::Zero();
  Eigen::Quaternionf sensor_orientation = Eigen::Quaternionf::Identity();
  Encoding encoding = Encoding::ASCII;
  /** \brief What somebody has written into it. */
  std::vector<std::string> comments;
};

} // namespace tool
