/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "tool_files.h"

#include <pcl/io/pcd_io.h>

using namespace kss_test;

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
  // rows without a point are left out, and told of
  const Geometry gaps = read("a.xyz", "1 2 3\nnan nan nan\n4 5 nan\n");
  expectEqual({{1, 2, 3}}, positionsOf(gaps), 0.0);
  ASSERT_EQ(1u, gaps.assumed.size());
  EXPECT_EQ("2 rows hold no point (line 2 first) and are left out", gaps.assumed[0]);
}

TEST_F(ToolFiles, KeepColumnsOfText)
{
  const Geometry colours = read("c.xyz", "1 2 3 255 128 0 0.5\n4 5 6 7 8 9 0.25\n");
  const Geometry turned = transformed(colours, quarterTurn());
  EXPECT_EQ("6 22 36 255 128 0 0.5\n0 28 42 7 8 9 0.25\n",
            contentOf(write("d.xyz", turned)));
  // what has unit length is a normal, and takes the rotation
  const Geometry normals = read("n.xyz", "1 2 3 1 0 0\n4 5 6 nan nan nan\n");
  EXPECT_EQ("6 22 36 0 1 0\n0 28 42 nan nan nan\n",
            contentOf(write("m.xyz", transformed(normals, quarterTurn()))));
}

TEST_F(ToolFiles, RefuseWrongText)
{
  EXPECT_NE(std::string::npos,
            refusal("a.xyz", "1 2 3\n4 5 six\n").find("line 2: 'six'"));
  EXPECT_NE(std::string::npos, refusal("a.xyz", "1 2 3\n4 5\n").find("line 2"));
  EXPECT_NE("", refusal("a.xyz", "1 2 3\n4 5 6 7\n"));
  EXPECT_NE("", refusal("a.xyz", "1 2\n4 5\n"));
  EXPECT_NE("", refusal("a.xyz", "1.5 2.5 3.5\n4,5 5,5 6,5\n")); // decimal commas
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
  EXPECT_EQ("", refusal("cloud", "1 2 3\n"));
  EXPECT_NE("", refusal("cloud", std::string("1 2 3\0\1", 7)));
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
  // PCL crashes on this
  EXPECT_NE("", refusal("a.ply", file("property list uint float f\n",
                                      "0 0 0 2 1 1\n1 0 0 2 1 1\n0 1 0 2 1\n")));
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
