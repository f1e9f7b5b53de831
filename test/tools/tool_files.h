/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "own_folder.h"

#include "command_line/output_file.h"
#include "io/fields.h"
#include "io/read_geometry.h"
#include "io/vector_field.h"
#include "io/write_geometry.h"

#include <pcl/console/print.h>
#include <pcl/conversions.h>
#include <pcl/point_types.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

namespace kss_test {

using namespace tool;

constexpr double NOT_A_NUMBER = std::numeric_limits<double>::quiet_NaN();

class ToolFiles : public kss_test::OwnFolder {
protected:
  using OwnFolder::write;

  void
  SetUp() override
  {
    pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  }

  std::string
  write(const std::string& name, const Geometry& geometry) const
  {
    std::ofstream stream(path(name), std::ios::binary);
    writeGeometry(geometry, fileFormatOf(name), stream);
    return path(name);
  }

  Geometry
  read(const std::string& name, const std::string& content) const
  {
    return readGeometry(write(name, content));
  }

  /** What is said about a file; empty where it is taken. */
  std::string
  refusal(const std::string& name, const std::string& content) const
  {
    const std::string file = write(name, content);
    try {
      readGeometry(file);
    }
    catch (const std::runtime_error& error) {
      EXPECT_EQ(0u, std::string(error.what()).find(file + ": ")) << error.what();
      EXPECT_GT(std::string(error.what()).size(), file.size() + 10) << error.what();
      return error.what();
    }
    return "";
  }

private:
};

inline std::string
contentOf(const std::string& path)
{
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream content;
  content << stream.rdbuf();
  return content.str();
}

inline void
expectEqual(const Points& expected, const Points& actual, double tolerance)
{
  ASSERT_EQ(expected.size(), actual.size());
  for (std::size_t i = 0; i < expected.size(); ++i)
    if (expected[i].allFinite())
      EXPECT_LE((expected[i] - actual[i]).norm(), tolerance) << "point " << i;
    else
      EXPECT_FALSE(actual[i].allFinite()) << "point " << i;
}

/** Four points of text with digits that floats cannot hold. */
inline Geometry
farTetrahedron()
{
  Geometry geometry;
  geometry.cloud =
      cloudOfDoubles({4000000.1234567, 500000.7654321, 100.0000001, 4000001.1234567,
                      500000.7654321, 100.0000001, 4000000.1234567, 500001.7654321,
                      100.0000001, 4000000.1234567, 500000.7654321, 101.0000001},
                     {"x", "y", "z"});
  for (const auto& corners : {pcl::Indices{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}) {
    geometry.faces.emplace_back();
    geometry.faces.back().vertices = corners;
  }
  return geometry;
}

inline Geometry
nearTetrahedron()
{
  Geometry geometry = farTetrahedron();
  geometry.cloud =
      cloudOfDoubles({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, {"x", "y", "z"});
  return geometry;
}

/** Organised, with colours, normals, an intensity and a point that is missing. */
inline Geometry
fieldsOfAllKinds()
{
  pcl::PointCloud<pcl::PointXYZRGBNormal> cloud(3, 2);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    auto& point = cloud[i];
    point.x = 1.0f + i;
    point.y = 0.5f * i;
    point.z = 0.25f * i * i;
    point.r = 10 * i;
    point.g = 20 * i;
    point.b = 255 - i;
    point.normal_x = 1.0f;
    point.normal_y = point.normal_z = 0.0f;
    point.curvature = 0.125f * i;
  }
  cloud[4].x = cloud[4].y = cloud[4].z = NOT_A_NUMBER;
  cloud.is_dense = false;
  pcl::PCLPointCloud2 padded;
  pcl::toPCLPointCloud2(cloud, padded);

  // as files have it, without the room between the fields, and with some more fields
  Geometry geometry;
  for (const auto& field : padded.fields)
    addField(geometry.cloud, field.name, field.datatype);
  addField(geometry.cloud, "label", pcl::PCLPointField::UINT16);
  addField(geometry.cloud, "time", pcl::PCLPointField::FLOAT64);
  setNumberOfPoints(geometry.cloud, cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    std::uint8_t* point = &geometry.cloud.data[i * geometry.cloud.point_step];
    for (const auto& field : padded.fields)
      memcpy(point + findField(geometry.cloud, field.name)->offset,
             &padded.data[i * padded.point_step + field.offset], sizeOf(field));
    const std::uint16_t label = 1000 + i;
    memcpy(point + findField(geometry.cloud, "label")->offset, &label, sizeof label);
    setNumber(*findField(geometry.cloud, "time"), point, 1e9 + 1e-6 * i);
  }
  geometry.cloud.width = 3;
  geometry.cloud.height = 2;
  return geometry;
}

/** A quarter turn about z, twice as large, and moved. */
inline Eigen::Matrix4d
quarterTurn()
{
  Eigen::Matrix4d similarity;
  similarity << 0, -2, 0, 10, 2, 0, 0, 20, 0, 0, 2, 30, 0, 0, 0, 1;
  return similarity;
}

inline double
numberAt(const Geometry& geometry, const std::string& field, std::size_t point)
{
  const auto* found = findField(geometry.cloud, field);
  if (!found)
    throw std::runtime_error("lost " + field);
  return getNumber(*found, &geometry.cloud.data[point * geometry.cloud.point_step]);
}

} // namespace kss_test
