/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "io/fields.h"
#include "io/mesh_sampling.h"
#include "command_line/output_file.h"
#include "own_folder.h"
#include "io/read_geometry.h"
#include "io/vector_field.h"
#include "io/write_geometry.h"

#include <pcl/console/print.h>
#include <pcl/conversions.h>
#include <pcl/io/pcd_io.h>
#include <pcl/point_types.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <unistd.h>

using namespace tool;

namespace {

const double NOT_A_NUMBER = std::numeric_limits<double>::quiet_NaN();

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

std::string
contentOf(const std::string& path)
{
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream content;
  content << stream.rdbuf();
  return content.str();
}

void
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
Geometry
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

Geometry
nearTetrahedron()
{
  Geometry geometry = farTetrahedron();
  geometry.cloud =
      cloudOfDoubles({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, {"x", "y", "z"});
  return geometry;
}

/** Organised, with colours, normals, an intensity and a point that is missing. */
Geometry
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
Eigen::Matrix4d
quarterTurn()
{
  Eigen::Matrix4d similarity;
  similarity << 0, -2, 0, 10, 2, 0, 0, 20, 0, 0, 2, 30, 0, 0, 0, 1;
  return similarity;
}

double
numberAt(const Geometry& geometry, const std::string& field, std::size_t point)
{
  const auto* found = findField(geometry.cloud, field);
  if (!found)
    throw std::runtime_error("lost " + field);
  return getNumber(*found, &geometry.cloud.data[point * geometry.cloud.point_step]);
}

} // namespace

TEST_F(ToolFiles, KeepPositionsAndFaces)
{
  for (const std::string name : {"a.ply", "a.obj", "a.off", "a.stl"}) {
    const Geometry written = nearTetrahedron();
    const Geometry result = readGeometry(write(name, written));
    ASSERT_EQ(4u, result.faces.size()) << name;
    ASSERT_EQ(4u, numberOfPoints(result.cloud)) << name;
    const Points before = positionsOf(written), after = positionsOf(result);
    // points may change their order, but the corners of the faces do not move
    for (std::size_t f = 0; f < 4; ++f)
      for (std::size_t i = 0; i < 3; ++i)
        EXPECT_EQ(before[written.faces[f].vertices[i]],
                  after[result.faces[f].vertices[i]])
            << name << " face " << f;
  }
}

TEST_F(ToolFiles, KeepPointsWithoutFaces)
{
  Geometry points = nearTetrahedron();
  points.faces.clear();
  for (const std::string name :
       {"a.pcd", "a.ply", "a.obj", "a.off", "a.xyz", "a.TXT", "a.pts"}) {
    const Geometry result = readGeometry(write(name, points));
    EXPECT_TRUE(result.faces.empty()) << name;
    expectEqual(positionsOf(points), positionsOf(result), 0.0);
  }
}

TEST_F(ToolFiles, KeepDoubles)
{
  for (const std::string name : {"a.pcd", "a.ply", "a.off", "a.xyz"}) {
    SCOPED_TRACE(name);
    const Geometry result = readGeometry(write(name, farTetrahedron()));
    expectEqual(positionsOf(farTetrahedron()), positionsOf(result), 0.0);
  }
}

TEST_F(ToolFiles, ReadDoublesAndIntegersOfPLY)
{
  const std::string format = "ply\nformat ascii 1.0\nelement vertex 2\n";
  const std::string end = "end_header\n";
  const Geometry doubles = read(
      "d.ply", format + "property double x\nproperty double y\nproperty double z\n" +
                   end + "4000000.1234567 2 3\n4 nan 6\n");
  expectEqual({{4000000.1234567, 2, 3}, {4, NOT_A_NUMBER, 6}}, positionsOf(doubles),
              0.0);
  const Geometry integers =
      read("i.ply", format + "property int x\nproperty short y\nproperty uchar z\n" +
                        end + "4000000 -2 3\n4 5 255\n");
  expectEqual({{4000000, -2, 3}, {4, 5, 255}}, positionsOf(integers), 0.0);
  Eigen::Matrix4d half = Eigen::Matrix4d::Identity();
  half.topLeftCorner<3, 3>() *= 0.5;
  expectEqual({{2000000, -1, 1.5}, {2, 2.5, 127.5}},
              positionsOf(transformed(integers, half)), 0.0);
}

TEST_F(ToolFiles, TransformKeepsAllFields)
{
  const Geometry source = fieldsOfAllKinds();
  const Points before = positionsOf(source);
  const Eigen::Affine3d similarity(quarterTurn());
  for (const std::string name : {"a.pcd", "a.ply"}) {
    SCOPED_TRACE(name);
    const Geometry result = readGeometry(
        write(name, transformed(readGeometry(write(name, source)), quarterTurn())));
    EXPECT_EQ(3u, result.cloud.width);
    EXPECT_EQ(2u, result.cloud.height);
    const Points after = positionsOf(result);
    ASSERT_EQ(before.size(), after.size());
    for (std::size_t i = 0; i < before.size(); ++i) {
      if (i == 4)
        EXPECT_TRUE(after[i].array().isNaN().all());
      else
        EXPECT_LE((similarity * before[i] - after[i]).norm(), 1e-5);
      EXPECT_NEAR(0.0, numberAt(result, "normal_x", i), 1e-7);
      EXPECT_NEAR(1.0, numberAt(result, "normal_y", i), 1e-7);
      EXPECT_NEAR(0.0, numberAt(result, "normal_z", i), 1e-7);
      EXPECT_EQ(0.125 * i, numberAt(result, "curvature", i));
      EXPECT_EQ(1000.0 + i, numberAt(result, "label", i));
      EXPECT_EQ(1e9 + 1e-6 * i, numberAt(result, "time", i));
      const auto* rgb = findField(result.cloud, "rgb");
      ASSERT_TRUE(rgb);
      const auto colour =
          getColour(*rgb, &result.cloud.data[i * result.cloud.point_step]);
      EXPECT_EQ(10 * i, colour[0]);
      EXPECT_EQ(20 * i, colour[1]);
      EXPECT_EQ(255 - i, colour[2]);
    }
    EXPECT_TRUE(hasSinglePrecision(result));
  }
}

TEST_F(ToolFiles, TransformKeepsDoubleNormals)
{
  // PCL writes such files with floats in the header and doubles in the data
  const Geometry source = read(
      "n.ply",
      "ply\nformat ascii 1.0\nelement vertex 2\nproperty double x\nproperty double "
      "y\nproperty double z\nproperty double nx\nproperty double ny\nproperty double "
      "nz\nend_header\n1 2 3 1 0 0\n4 5 6 0 0.6 0.8\n");
  const Geometry result =
      readGeometry(write("m.ply", transformed(source, quarterTurn())));
  expectEqual({{6, 22, 36}, {0, 28, 42}}, positionsOf(result), 1e-14);
  EXPECT_FALSE(hasSinglePrecision(result));
  EXPECT_DOUBLE_EQ(1.0, numberAt(result, "normal_y", 0));
  EXPECT_DOUBLE_EQ(-0.6, numberAt(result, "normal_x", 1));
  EXPECT_DOUBLE_EQ(0.8, numberAt(result, "normal_z", 1));
}

TEST_F(ToolFiles, TransformMovesTheSensor)
{
  Geometry source = fieldsOfAllKinds();
  source.sensor_origin << 1, 2, 3, 0;
  const Geometry result =
      readGeometry(write("a.pcd", transformed(source, quarterTurn())));
  EXPECT_LE((result.sensor_origin - Eigen::Vector4f(6, 22, 36, 0)).norm(), 1e-5f);
  EXPECT_LE(
      (result.sensor_orientation * Eigen::Vector3f::UnitX() - Eigen::Vector3f::UnitY())
          .norm(),
      1e-5f);
}

TEST_F(ToolFiles, FloatsBecomeDoublesWhereTheyWouldBeCoarse)
{
  const Geometry source = fieldsOfAllKinds();
  Eigen::Matrix4d away = Eigen::Matrix4d::Identity();
  away(0, 3) = 4e6 + 0.1;
  const Geometry result = readGeometry(write("a.ply", transformed(source, away)));
  EXPECT_FALSE(hasSinglePrecision(result));
  EXPECT_NEAR(4e6 + 1.1, positionsOf(result)[0].x(), 1e-8);
}

TEST_F(ToolFiles, TextBecomesFloatsWhereTheyAreFineEnough)
{
  const Geometry near = read("near.xyz", "1.5 2 3\n4 5 6\n");
  EXPECT_TRUE(hasSinglePrecision(readGeometry(write("near.pcd", near))));
  const Geometry far = read("far.xyz", "4000000.5 2 3\n4000001 5 6\n");
  EXPECT_FALSE(hasSinglePrecision(readGeometry(write("far.pcd", far))));
  // doubles that a file has as such stay doubles
  EXPECT_FALSE(hasSinglePrecision(readGeometry(write("d.ply", nearTetrahedron()))));
}

TEST_F(ToolFiles, ReadColumnsOfText)
{
  const Points expected{{1, -2.5, 3e3}, {4, 5, 6}};
  for (const std::string content :
       {"1 -2.5 3e3\n4 5 6\n", "1\t-2.5  3e3\r\n\r\n 4 5 6", "1,-2.5, 3e3\n4,5,6,\n",
        "1;-2.5;3e3\n4;5;6\n", "x y z\n1 -2.5 +3e3\n4 5 6\n",
        "# a comment\n1 -2.5 3e3 # another\n//X Y Z\n4 5 6\n",
        "\xEF\xBB\xBF"
        "1 -2.5 3e3\n4 5 6\n",
        "2\n1 -2.5 3e3\n4 5 6\n"}) {
    SCOPED_TRACE(content);
    expectEqual(expected, positionsOf(read("a.xyz", content)), 0.0);
  }
  expectEqual({{1, 2, 3}, {NOT_A_NUMBER, 0, 0}},
              positionsOf(read("a.xyz", "1 2 3\nnan nan nan\n")), 0.0);
}

TEST_F(ToolFiles, KeepColumnsOfText)
{
  const Geometry colours = read("c.xyz", "1 2 3 255 128 0 0.5\n4 5 6 7 8 9 0.25\n");
  const Geometry turned = transformed(colours, quarterTurn());
  EXPECT_EQ("6 22 36 255 128 0 0.5\n0 28 42 7 8 9 0.25\n",
            contentOf(write("d.xyz", turned)));
  // what has unit length is a normal, and takes the rotation
  const Geometry normals = read("n.xyz", "1 2 3 1 0 0\nnan nan nan nan nan nan\n");
  EXPECT_EQ("6 22 36 0 1 0\nnan nan nan nan nan nan\n",
            contentOf(write("m.xyz", transformed(normals, quarterTurn()))));
}

TEST_F(ToolFiles, RefuseWrongText)
{
  EXPECT_NE(std::string::npos,
            refusal("a.xyz", "1 2 3\n4 5 six\n").find("line 2: 'six'"));
  EXPECT_NE(std::string::npos, refusal("a.xyz", "1 2 3\n4 5\n").find("line 2"));
  EXPECT_NE("", refusal("a.xyz", "1 2 3\n4 5 6 7\n"));
  EXPECT_NE("", refusal("a.xyz", "1 2\n4 5\n"));
  EXPECT_NE("", refusal("a.xyz", "1,5 2,5 3,5\n4,5 5,5 6,5\n")); // decimal commas
  EXPECT_NE("", refusal("a.xyz", "1,,3\n4,,6\n"));
  EXPECT_NE("", refusal("a.xyz", "words\nand words\n"));
  EXPECT_NE("", refusal("a.xyz", "# nothing\n"));
  EXPECT_NE("", refusal("a.xyz", "nan nan nan\n"));
  EXPECT_NE("", refusal("a.pts", "3\n1 2 3\n4 5 6\n"));
}

TEST_F(ToolFiles, RefuseWhatCannotBeRead)
{
  for (const std::string extension :
       {".pcd", ".ply", ".obj", ".stl", ".off", ".xyz", ".txt", ".pts"}) {
    EXPECT_NE("", refusal("empty" + extension, ""));
    EXPECT_NE("", refusal("words" + extension, "These are words.\nAnd these.\n"));
    EXPECT_THROW(readGeometry(path("missing" + extension)), std::runtime_error);
    std::filesystem::create_directory(path("directory" + extension));
    EXPECT_THROW(readGeometry(path("directory" + extension)), std::runtime_error);
  }
  EXPECT_NE("", refusal("cloud.las", "1 2 3\n"));
  EXPECT_NE("", refusal("cloud", "1 2 3\n"));
}

TEST_F(ToolFiles, RefuseWrongPCD)
{
  const auto file = [](const std::string& data, const std::string& points = "2") {
    return "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH " + points +
           "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + points + "\nDATA ascii\n" +
           data;
  };
  EXPECT_EQ("", refusal("a.pcd", file("1 2 3\n4 5 6\n")));
  EXPECT_EQ("", refusal("a.pcd", file("1 2 3\n4 5 6")));
  EXPECT_EQ("", refusal("a.pcd", file("1 2 3\nnan nan nan\n")));
  EXPECT_NE("", refusal("a.pcd", file("nan nan nan\nnan nan nan\n")));
  EXPECT_NE("", refusal("a.pcd", file("1 2 3\n4 five 6\n")));
  EXPECT_NE("", refusal("a.pcd", file("1 2 3\n4 5\n")));
  EXPECT_NE("", refusal("a.pcd", file("1 2 3\n4, 5, 6\n")));
  EXPECT_NE("", refusal("a.pcd", file("1 2 3\n4 5 6\n7 8 9\n")));
  EXPECT_NE("", refusal("a.pcd", file("", "0")));
  EXPECT_NE("", refusal("a.pcd", file("1 2 3\n", "4000000000")));
  EXPECT_NE("", refusal("a.pcd", file("1 2 3\n", "-1")));
  EXPECT_NE("", refusal("a.pcd", file("1 2 3\n", "one")));

  // a header that is not that of the data
  pcl::PCDWriter().writeBinaryCompressed(path("compressed.pcd"),
                                         fieldsOfAllKinds().cloud);
  std::string content = contentOf(path("compressed.pcd"));
  EXPECT_EQ("", refusal("a.pcd", content));
  content.replace(content.find("WIDTH 3"), 7, "WIDTH 9");
  content.replace(content.find("POINTS 6"), 8, "POINTS 18");
  EXPECT_NE(std::string::npos, refusal("a.pcd", content).find("18 points"));
}

TEST_F(ToolFiles, RefuseWrongPLY)
{
  const auto file = [](const std::string& header, const std::string& data) {
    return "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float "
           "y\n"
           "property float z\n" +
           header + "end_header\n" + data;
  };
  const std::string points = "0 0 0\n1 0 0\n0 1 0\n";
  const std::string face = "element face 1\n";
  const std::string indices = "property list uchar int vertex_indices\n";
  EXPECT_EQ("", refusal("a.ply", file("", points)));
  EXPECT_EQ("", refusal("a.ply", file(face + indices, points + "3 0 1 2\n")));
  EXPECT_EQ(
      "", refusal("a.ply", file("obj_info num_cols 3\nobj_info num_rows 1\n", points)));
  EXPECT_NE("", refusal("a.ply", file(face + indices, points + "3 0 1 3\n")));
  EXPECT_NE("", refusal("a.ply", file(face + indices, points + "3 0 -1 2\n")));
  EXPECT_NE("", refusal("a.ply", file(face + indices, points)));
  EXPECT_NE("", refusal("a.ply", file("", "0 0 0\n1 zero 0\n0 1 0\n")));
  // PCL crashes on these or takes them for something else
  EXPECT_NE("", refusal("a.ply", file("property list uint float f\n",
                                      "0 0 0 2 1 1\n1 0 0 2 1 1\n0 1 0 2 1 1\n")));
  EXPECT_NE("", refusal("a.ply",
                        file("property uchar alpha\n", "0 0 0 1\n1 0 0 1\n0 1 0 1\n")));
  EXPECT_NE("", refusal("a.ply", file("element face 4000000000\n" + indices, points)));
  EXPECT_NE(
      "", refusal("a.ply", file("obj_info num_cols 2\nobj_info num_rows 1\n", points)));
  EXPECT_NE("", refusal("a.ply", "ply\nformat ascii 1.0\nelement vertex 4000000000\n"
                                 "property float x\nend_header\n1\n"));
  EXPECT_NE("",
            refusal("a.ply", "ply\nformat ascii 1.0\nelement face 0\nend_header\n"));
  EXPECT_NE(std::string::npos,
            refusal("a.ply", file("", "").substr(0, 60)).find("header"));
}

TEST_F(ToolFiles, ReadRangeGridsOfPLY)
{
  const auto file = [](const std::string& grid, const std::string& lists) {
    return "ply\nformat ascii 1.0\nobj_info num_cols 2\nobj_info num_rows 2\nelement "
           "vertex 3\nproperty float x\nproperty float y\nproperty float z\n" +
           grid + "end_header\n0 0 1\n1 0 1\n0 1 1\n" + lists;
  };
  const Geometry organised = read(
      "a.ply", file("element range_grid 4\nproperty list uchar int vertex_indices\n",
                    "1 0\n0\n1 1\n1 2\n"));
  EXPECT_EQ(2u, organised.cloud.width);
  EXPECT_EQ(2u, organised.cloud.height);
  expectEqual({{0, 0, 1}, {NOT_A_NUMBER, 0, 0}, {1, 0, 1}, {0, 1, 1}},
              positionsOf(organised), 0.0);
  // without a grid there are only the points themselves
  expectEqual({{0, 0, 1}, {1, 0, 1}, {0, 1, 1}},
              positionsOf(read("b.ply", file("", ""))), 0.0);
}

TEST_F(ToolFiles, ReadOFF)
{
  const std::string points = "0 0 0\n1 0 0\n0 1 0\n";
  const Points expected{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  for (const std::string& content :
       {"OFF\n3 1 0\n" + points + "3 0 1 2\n",
        "# c\nOFF 3 1 0 # c\n" + points + "3 0 1 2 255 0 0",
        "3 1 0\n" + points + "3 0 1 2\n",
        std::string(
            "CNOFF\n3 1 0\n0 0 0 0 0 1 9 9 9 1\n1 0 0 0 0 1 9 9 9 1\n0 1 0 0 0 1 9 "
            "9 9 1\n3 0 1 2\n")}) {
    const Geometry mesh = read("a.off", content);
    expectEqual(expected, positionsOf(mesh), 0.0);
    ASSERT_EQ(1u, mesh.faces.size());
    EXPECT_EQ((pcl::Indices{0, 1, 2}), mesh.faces[0].vertices);
  }
  EXPECT_EQ(1.0, numberAt(read("n.off", "NOFF\n1 0 0\n0 0 0 0 0 1\n"), "normal_z", 0));
  EXPECT_NE("", refusal("a.off", "OFF\n3 1 0\n" + points + "3 0 1 3\n"));
  EXPECT_NE("", refusal("a.off", "OFF\n3 1 0\n" + points + "3 0 1 -1\n"));
  EXPECT_NE("", refusal("a.off", "OFF\n3 1 0\n" + points + "3 0 1\n"));
  EXPECT_NE("", refusal("a.off", "OFF\n3 2 0\n" + points + "3 0 1 2\n"));
  EXPECT_NE("", refusal("a.off", "OFF\n3 0 0\n0 0 0\n1 0\n0 1 0\n"));
  EXPECT_NE("", refusal("a.off", "OFF BINARY\n"));
  EXPECT_NE("", refusal("a.off", "4OFF\n1 0 0\n1 1 1 1\n"));
}

TEST_F(ToolFiles, ReadOBJ)
{
  const Geometry mesh =
      read("a.obj", "v 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 0 1 0 1 0 0\nvn 0 0 1\no "
                    "one\nf 1//1 2//1 3//1\no two\nf 3//1 2//1 1//1\n");
  EXPECT_EQ(2u, mesh.faces.size());
  EXPECT_EQ(3u, numberOfPoints(mesh.cloud)); // both objects share them
  const Points points = positionsOf(mesh);
  EXPECT_EQ(Eigen::Vector3d(0, 1, 0), points[mesh.faces[1].vertices[0]]);
  EXPECT_EQ(Eigen::Vector3d(1, 0, 0), points[mesh.faces[1].vertices[1]]);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_EQ(1.0, numberAt(mesh, "normal_z", i));
  const auto* rgba = findField(mesh.cloud, "rgba");
  ASSERT_TRUE(rgba);
  EXPECT_EQ((std::array<std::uint8_t, 4>{255, 0, 0, 255}),
            getColour(*rgba, mesh.cloud.data.data()));
  EXPECT_NE("", refusal("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n"));
}

/** Cuts a file at every byte: what is not complete must be refused. The last number of
 * a text may lose digits without a sign of it.
 */
TEST_F(ToolFiles, RefuseTruncatedFiles)
{
  const Geometry cloud = fieldsOfAllKinds();
  pcl::PCDWriter pcd;
  pcd.writeASCII(path("ascii.pcd"), cloud.cloud);
  pcd.writeBinary(path("binary.pcd"), cloud.cloud);
  pcd.writeBinaryCompressed(path("compressed.pcd"), cloud.cloud);
  Geometry points = nearTetrahedron();
  points.faces.clear();
  write("points.ply", cloud);
  write("mesh.ply", nearTetrahedron());
  write("ascii.ply",
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
        "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
        "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  write("binary.stl", nearTetrahedron());
  write(
      "ascii.stl",
      "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
      "0\nendloop\nendfacet\nendsolid");
  write("mesh.off", nearTetrahedron());
  write("points.off", points);

  // PCL rounds the length of binary files up
  for (const std::string name : {"binary.pcd", "compressed.pcd"}) {
    std::string content = contentOf(path(name));
    content.resize(content.find_last_not_of('\0') + 1);
    write(name, content);
  }

  // with how many bytes lost it cannot be noticed
  const std::vector<std::pair<std::string, std::size_t>> files{
      {"ascii.pcd", 9}, {"binary.pcd", 0}, {"compressed.pcd", 0}, {"points.ply", 0},
      {"mesh.ply", 0},  {"ascii.ply", 2},  {"binary.stl", 0},     {"ascii.stl", 0},
      {"mesh.off", 2},  {"points.off", 2}};
  for (const auto& [name, unnoticed] : files) {
    const std::string content = contentOf(path(name));
    EXPECT_EQ("", refusal("whole_" + name, content));
    for (std::size_t size = 0; size + unnoticed < content.size(); ++size)
      ASSERT_NE("", refusal("cut_" + name, content.substr(0, size)))
          << name << " cut to " << size << " of " << content.size();
  }
}

/** OBJ and text do not say how long they are, but a line that ends early does. */
TEST_F(ToolFiles, RefuseLinesCutShort)
{
  const std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  EXPECT_NE("", refusal("a.obj", obj.substr(0, obj.size() - 2)));
  EXPECT_NE("", refusal("a.obj", obj.substr(0, obj.size() - 4)));
  EXPECT_NE("", refusal("a.obj", obj.substr(0, obj.size() - 11)));
  const std::string text = "1 2 3\n4 5 6\n";
  EXPECT_NE("", refusal("a.xyz", text.substr(0, text.size() - 2)));
  EXPECT_NE("", refusal("a.xyz", text.substr(0, text.size() - 4)));
}

/** The mean number of samples in each of n parts of equal probability. */
void
expectEven(const std::vector<int>& counts)
{
  double total = 0.0, chi_squared = 0.0;
  for (const int count : counts)
    total += count;
  const double mean = total / counts.size();
  for (const int count : counts)
    chi_squared += (count - mean) * (count - mean) / mean;
  // far beyond any quantile, but near what an uneven distribution would give
  EXPECT_LT(chi_squared, 2.0 * counts.size()) << "of " << counts.size();
}

TEST_F(ToolFiles, SampleMeshesEvenlyByArea)
{
  // A square of one face and a rectangle of nine times its area, all of triangles and
  // quadrangles, with a face that has no place.
  Geometry mesh;
  mesh.cloud = cloudOfDoubles({0, 0, 5, 1, 0,  5, 1, 1,  5, 0, 1,
                               5, 1, 0, 5, 10, 0, 5, 10, 1, 5, NOT_A_NUMBER,
                               0, 0},
                              {"x", "y", "z"});
  for (const auto& corners :
       {pcl::Indices{0, 1, 2, 3}, {4, 5, 6}, {4, 6, 2}, {0, 1, 7}}) {
    mesh.faces.emplace_back();
    mesh.faces.back().vertices = corners;
  }
  const Points samples = sampleMesh(mesh, 20000);
  ASSERT_EQ(20000u, samples.size());
  std::vector<int> counts(10 * 4 * 4);
  for (const auto& sample : samples) {
    ASSERT_NEAR(5.0, sample.z(), 1e-14);
    ASSERT_TRUE(sample.x() >= 0 && sample.x() <= 10 && sample.y() >= 0 &&
                sample.y() <= 1);
    ++counts[std::min(39, static_cast<int>(sample.x() * 4)) * 4 +
             std::min(3, static_cast<int>(sample.y() * 4))];
  }
  expectEven(counts);
  EXPECT_EQ(samples, sampleMesh(mesh, 20000));
}

TEST_F(ToolFiles, SampleMeshesWithoutArea)
{
  Geometry mesh;
  mesh.cloud = cloudOfDoubles({0, 0, 0, 1, 1, 1, 2, 2, 2}, {"x", "y", "z"});
  mesh.faces.emplace_back();
  mesh.faces.back().vertices = {0, 1, 2};
  expectEqual(positionsOf(mesh), sampleMesh(mesh, 100), 0.0);
}

TEST_F(ToolFiles, WritingTellsOfFailure)
{
  EXPECT_THROW(OutputFile(path("no/such/directory")), std::runtime_error);
  if (!std::filesystem::exists("/dev/full"))
    GTEST_SKIP() << "needs /dev/full";
  for (const auto format : {FileFormat::PCD, FileFormat::PLY, FileFormat::OBJ,
                            FileFormat::STL, FileFormat::OFF, FileFormat::TEXT})
    EXPECT_THROW(OutputFile("/dev/full").write([&](std::ostream& stream) {
      writeGeometry(nearTetrahedron(), format, stream);
    }),
                 std::runtime_error);
}
