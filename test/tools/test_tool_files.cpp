/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "tool_files.h"

#include <pcl/io/pcd_io.h>

#include <unistd.h>

using namespace kss_test;

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
