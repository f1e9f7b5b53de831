/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "losses.h"

#include "fields.h"

#include <algorithm>
#include <set>

namespace tool {
namespace {

bool
holdsFaces(FileFormat format)
{
  return format == FileFormat::PLY || format == FileFormat::OBJ ||
         format == FileFormat::STL || format == FileFormat::OFF;
}

/** Whether a format has room for a field of a cloud. */
bool
holds(FileFormat format, const Geometry& geometry, const pcl::PCLPointField& field)
{
  const auto& cloud = geometry.cloud;
  const auto is_one_of = [&](const std::set<std::string>& names) {
    return names.count(field.name) > 0;
  };
  if (is_one_of({"x", "y", "z"}))
    return true;
  const bool is_normal = is_one_of({"normal_x", "normal_y", "normal_z"});
  switch (format) {
  case FileFormat::OBJ:
    return is_normal || isPackedColour(field);
  case FileFormat::OFF:
    return is_normal || isPackedColour(field) ||
           is_one_of({"texture_u", "texture_v"}) ||
           (is_one_of({"red", "green", "blue", "alpha"}) && findField(cloud, "red") &&
            findField(cloud, "green") && findField(cloud, "blue"));
  case FileFormat::PTS:
    return (is_normal && areNormalsByLength(geometry)) || isPackedColour(field) ||
           is_one_of({"intensity"});
  case FileFormat::PTX:
    return isPackedColour(field) || is_one_of({"intensity"});
  case FileFormat::STL:
    return false;
  default:
    return true;
  }
}

/** Whether colours are transparent, and not all of them in the same way, as nobody sets
 * alpha who does not need it. */
bool
hasTransparency(const pcl::PCLPointCloud2& cloud)
{
  const auto* colour = findField(cloud, "rgba");
  if (!colour || !isPackedColour(*colour))
    return false;
  const auto alpha = [&](std::size_t i) {
    return getColour(*colour, &cloud.data[i * cloud.point_step])[3];
  };
  for (std::size_t i = 0; i < numberOfPoints(cloud); ++i)
    if (alpha(i) != alpha(0) || (alpha(i) != 0 && alpha(i) != 255))
      return true;
  return false;
}

/** Whether some points are corners of no face. */
bool
hasLoosePoints(const Geometry& geometry)
{
  std::vector<bool> is_used(numberOfPoints(geometry.cloud));
  for (const auto& face : geometry.faces)
    for (const auto vertex : face.vertices)
      is_used[vertex] = true;
  return std::find(is_used.begin(), is_used.end(), false) != is_used.end();
}

} // namespace

std::vector<std::string>
lossesOf(const Geometry& geometry, FileFormat format)
{
  std::vector<std::string> losses = geometry.left_out;
  if (format != FileFormat::OBJ)
    losses.insert(losses.end(), geometry.statements.others.begin(),
                  geometry.statements.others.end());
  for (const auto& field : geometry.cloud.fields)
    if (!isPadding(field) && !holds(format, geometry, field))
      losses.push_back("field '" + field.name.substr(0, 40) + "'");
  const bool holds_alpha = format != FileFormat::OBJ && format != FileFormat::PTS &&
                           format != FileFormat::PTX;
  if (!holds_alpha && hasTransparency(geometry.cloud))
    losses.push_back("alpha of colours");
  if (!geometry.faces.empty() && !holdsFaces(format))
    losses.push_back("faces");
  if (format == FileFormat::STL) {
    if (hasLoosePoints(geometry))
      losses.push_back("points that no face uses");
    if (std::any_of(geometry.faces.begin(), geometry.faces.end(),
                    [](const auto& face) { return face.vertices.size() > 3; }))
      losses.push_back("faces of more than three corners, which become triangles");
  }
  const bool has_sensor =
      !geometry.sensor_origin.isZero(0.0f) ||
      geometry.sensor_orientation.coeffs() != Eigen::Quaternionf::Identity().coeffs();
  if (has_sensor && format != FileFormat::PCD)
    losses.push_back("where the sensor stood");
  return losses;
}

} // namespace tool
