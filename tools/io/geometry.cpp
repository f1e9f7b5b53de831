/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "geometry.h"

#include "fields.h"
#include "normal_check.h"
#include "vector_field.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace tool {
namespace {

bool
isCoordinate(const pcl::PCLPointField& field)
{
  return field.name == "x" || field.name == "y" || field.name == "z";
}

Points
vectorsOf(const pcl::PCLPointCloud2& cloud, const VectorField& field)
{
  Points vectors;
  vectors.reserve(numberOfPoints(cloud));
  for (std::size_t i = 0; i < numberOfPoints(cloud); ++i)
    vectors.push_back(field.get(&cloud.data[i * cloud.point_step]));
  return vectors;
}

/** The box around all finite positions that a function makes of those of the points. */
template <typename Function>
Eigen::AlignedBox3d
boxOf(const pcl::PCLPointCloud2& cloud, Function&& function)
{
  const VectorField position(cloud, VectorField::POSITION);
  Eigen::AlignedBox3d box;
  for (std::size_t i = 0; i < numberOfPoints(cloud); ++i) {
    const Eigen::Vector3d point =
        function(position.get(&cloud.data[i * cloud.point_step]));
    if (point.allFinite())
      box.extend(point);
  }
  return box;
}

} // namespace

Points
positionsOf(const Geometry& geometry)
{
  return vectorsOf(geometry.cloud, VectorField(geometry.cloud, VectorField::POSITION));
}

Points
normalsOf(const Geometry& geometry)
{
  const VectorField normal(geometry.cloud, VectorField::NORMAL);
  return normal.exists() ? vectorsOf(geometry.cloud, normal) : Points();
}

bool
areNormalsByLength(const Geometry& geometry)
{
  NormalCheck check;
  const Points positions = positionsOf(geometry), normals = normalsOf(geometry);
  for (std::size_t i = 0; i < normals.size(); ++i)
    if (positions[i].allFinite()) // others are no rows when they are read again
      check.add(normals[i][0], normals[i][1], normals[i][2]);
  return check.areNormals();
}

Eigen::AlignedBox3d
boundingBox(const Geometry& geometry)
{
  return boxOf(geometry.cloud,
               [](const Eigen::Vector3d& position) { return position; });
}

double
singlePrecisionError(const Eigen::AlignedBox3d& box)
{
  const double size = box.diagonal().norm();
  const double farthest =
      std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
  // One position alone has no size to be coarse for.
  return size > 0.0 ? std::numeric_limits<float>::epsilon() * farthest / size : 0.0;
}

bool
singlePrecisionIsCoarse(const Eigen::AlignedBox3d& box)
{
  return singlePrecisionError(box) > 1e-5;
}

bool
hasSinglePrecision(const Geometry& geometry)
{
  const auto& fields = geometry.cloud.fields;
  return std::none_of(fields.begin(), fields.end(), [](const auto& field) {
    return isCoordinate(field) && field.datatype != pcl::PCLPointField::FLOAT32;
  });
}

void
setCoordinateType(Geometry& geometry, std::uint8_t datatype)
{
  const pcl::PCLPointCloud2 old = std::move(geometry.cloud);
  pcl::PCLPointCloud2 cloud;
  cloud.header = old.header;
  cloud.height = old.height;
  cloud.width = old.width;
  cloud.is_dense = old.is_dense;
  cloud.fields = old.fields;
  for (auto& field : cloud.fields) {
    if (isCoordinate(field))
      field.datatype = datatype;
    field.offset = cloud.point_step;
    cloud.point_step += sizeOf(field);
  }
  cloud.row_step = cloud.point_step * cloud.width;
  cloud.data.resize(numberOfPoints(cloud) * cloud.point_step);

  for (std::size_t i = 0; i < numberOfPoints(cloud); ++i) {
    const std::uint8_t* from = &old.data[i * old.point_step];
    std::uint8_t* to = &cloud.data[i * cloud.point_step];
    for (std::size_t f = 0; f < cloud.fields.size(); ++f)
      if (isCoordinate(cloud.fields[f]))
        setNumber(cloud.fields[f], to, getNumber(old.fields[f], from));
      else
        std::memcpy(to + cloud.fields[f].offset, from + old.fields[f].offset,
                    sizeOf(cloud.fields[f]));
  }
  geometry.cloud = std::move(cloud);
}

Geometry
transformed(Geometry geometry, const Eigen::Matrix4d& similarity)
{
  const Eigen::Affine3d transform(similarity);
  const Eigen::Matrix3d rotation =
      transform.linear() / std::cbrt(transform.linear().determinant());

  const auto place = [&](const Eigen::Vector3d& point) -> Eigen::Vector3d {
    return transform * point;
  };

  if (!hasSinglePrecision(geometry) ||
      singlePrecisionIsCoarse(boxOf(geometry.cloud, place)))
    setCoordinateType(geometry, pcl::PCLPointField::FLOAT64);

  auto& cloud = geometry.cloud;
  const VectorField position(cloud, VectorField::POSITION);
  const VectorField normal(cloud, VectorField::NORMAL);
  const bool has_normals = normal.isFloatingPoint();
  for (std::size_t i = 0; i < numberOfPoints(cloud); ++i) {
    std::uint8_t* point = &cloud.data[i * cloud.point_step];
    const Eigen::Vector3d before = position.get(point);
    if (before.allFinite())
      position.set(point, place(before));
    if (has_normals)
      normal.set(point, rotation * normal.get(point));
  }

  for (auto& direction : geometry.statements.normals)
    direction = rotation * direction;

  const Eigen::Vector3d origin = geometry.sensor_origin.head<3>().cast<double>();
  geometry.sensor_origin.head<3>() = (transform * origin).cast<float>();
  geometry.sensor_orientation = Eigen::Quaternionf(
      (rotation * geometry.sensor_orientation.toRotationMatrix().cast<double>())
          .cast<float>());
  return geometry;
}

} // namespace tool
