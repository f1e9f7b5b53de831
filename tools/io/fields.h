/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/PCLPointCloud2.h>

#include <array>
#include <string>
#include <vector>

namespace tool {

/** \brief The number of points of a cloud. */
std::size_t
numberOfPoints(const pcl::PCLPointCloud2& cloud);

/** \brief The field of that name, or null. */
const pcl::PCLPointField*
findField(const pcl::PCLPointCloud2& cloud, const std::string& name);

/** \brief Whether a field is float or double. */
bool
isFloatingPoint(const pcl::PCLPointField& field);

/** \brief Whether a field holds red, green, blue and perhaps alpha in four bytes, as
 * PCL packs them.
 */
bool
isPackedColour(const pcl::PCLPointField& field);

/** \brief Red, green, blue and alpha of a packed colour. */
std::array<std::uint8_t, 4>
getColour(const pcl::PCLPointField& field, const std::uint8_t* point);

/** \brief Whether a field only fills the room between others. */
bool
isPadding(const pcl::PCLPointField& field);

/** \brief The bytes that a field takes in a point. */
std::size_t
sizeOf(const pcl::PCLPointField& field);

/** \brief Read a number of any type.
 * \param[in] point the first byte of the point
 * \param[in] element which one, for fields with a count
 */
double
getNumber(const pcl::PCLPointField& field,
          const std::uint8_t* point,
          std::size_t element = 0);

/** \brief Write a floating point number.
 * \param[in] point the first byte of the point
 */
void
setNumber(const pcl::PCLPointField& field, std::uint8_t* point, double value);

/** \brief Check the names of the fields in a file.
 * \throws std::runtime_error where there are too many, or two of one name
 */
void
checkNames(const std::vector<std::string>& names);

/** \brief Add a field at the end of a cloud that has no points yet. */
void
addField(pcl::PCLPointCloud2& cloud, const std::string& name, std::uint8_t datatype);

/** \brief Give a cloud room for points in one row; all their numbers are 0. */
void
setNumberOfPoints(pcl::PCLPointCloud2& cloud, std::size_t points);

/** \brief A new cloud of one row, all its fields doubles.
 * \param[in] values of all points, point by point
 * \param[in] names of the fields
 */
pcl::PCLPointCloud2
cloudOfDoubles(const std::vector<double>& values,
               const std::vector<std::string>& names);

} // namespace tool
