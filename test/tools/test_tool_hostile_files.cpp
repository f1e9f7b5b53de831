/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "command_line/local_frame.h"
#include "command_line/output_file.h"
#include "io/fields.h"
#include "io/mesh_sampling.h"
#include "io/read_geometry.h"
#include "io/write_geometry.h"
#include "own_folder.h"

#include <gtest/gtest.h>

#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

/** \file
 * What readers make of files that are wrong in one place: they refuse them, say where,
 * and lose nothing of files that are only unusual.
 */

using namespace tool;

namespace {

class HostileFiles : public kss_test::OwnFolder {
protected:
  Geometry
  read(const std::string& name, const std::string& content) const
  {
    return readGeometry(write(name, content));
  }

  /** What is said about a file, without its name; empty where it is taken. */
  std::string
  refusal(const std::string& name, const std::string& content) const
  {
    try {
      read(name, content);
    }
    catch (const std::runtime_error& error) {
      return std::string(error.what()).substr(path(name).size() + 2);
    }
    return "";
  }

private:
};

#define EXPECT_SAYS(words, refusal)                                                    \
  EXPECT_NE(std::string::npos, std::string(refusal).find(words)) << refusal

const std::vector<std::string> pcd_header{
    "VERSION 0.7", "FIELDS x y z", "SIZE 4 4 4", "TYPE F F F",
    "COUNT 1 1 1", "WIDTH 2",      "HEIGHT 1",   "VIEWPOINT 0 0 0 1 0 0 0",
    "POINTS 2",    "DATA ascii"};

/** A PCD file with one line of its header replaced, or one more before it. */
std::string
pcd(std::size_t line = -1,
    const std::string& words = "",
    bool insert = false,
    const std::string& data = "1 2 3\n4 5 6\n")
{
  std::string file;
  for (std::size_t i = 0; i < pcd_header.size(); ++i) {
    if (i == line)
      file += words + '\n';
    if (i != line || insert)
      file += pcd_header[i] + '\n';
  }
  return file + data;
}

std::string
ply(const std::string& header, const std::string& data)
{
  return "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
         "property float z\n" +
         header + "end_header\n0 0 0\n1 0 0\n0 1 0\n" + data;
}

const std::string face = "element face 1\nproperty list uchar int vertex_indices\n";

} // namespace

TEST_F(HostileFiles, UnknownWordsInHeadersOfPCD)
{
  EXPECT_EQ("", refusal("a.pcd", pcd()));
  for (std::size_t line = 0; line < pcd_header.size(); ++line)
    for (const std::string words : {"NOTE me", "VERSIO 0.7", "fields x y z", "\x16"})
      EXPECT_SAYS("line " + std::to_string(line + 1),
                  refusal("a.pcd", pcd(line, words, true)));
  EXPECT_SAYS("byte order mark", refusal("a.pcd", "\xEF\xBB\xBF" + pcd()));
  EXPECT_SAYS("twice", refusal("a.pcd", pcd(6, "WIDTH 2", true)));
}

TEST_F(HostileFiles, WrongNumbersInHeadersOfPCD)
{
  for (const auto& [line, words] :
       std::vector<std::pair<std::size_t, std::string>>{{1, "FIELDS"},
                                                        {1, "FIELDS x y"},
                                                        {1, "FIELDS x y x"},
                                                        {2, "SIZE 4 4"},
                                                        {2, "SIZE 4 4 4294967300"},
                                                        {2, "SIZE 3 4 4"},
                                                        {3, "TYPE F F FF"},
                                                        {3, "TYPE F F B"},
                                                        {4, "COUNT 1 1 0"},
                                                        {4, "COUNT 1 1 -1"},
                                                        {4, "COUNT 1 1 2147483647"},
                                                        {5, "WIDTH 1.5"},
                                                        {5, "WIDTH 0"},
                                                        {5, "WIDTH 4294967298"},
                                                        {6, "HEIGHT 2147483648"},
                                                        {6, "HEIGHT"},
                                                        {7, "VIEWPOINT 0 0 0"},
                                                        {7, "VIEWPOINT 0 0 0 1 0 0 a"},
                                                        {8, "POINTS 4294967298"},
                                                        {8, "POINTS 3"},
                                                        {9, "DATA asci"},
                                                        {9, "DATA"}})
    EXPECT_NE("", refusal("a.pcd", pcd(line, words))) << words;
  // sizes of which 64 bits hold only a part
  std::string file = pcd(4, "COUNT 1 1 2147483647", false, "");
  file.replace(file.find("WIDTH 2"), 7, "WIDTH 2147483647");
  file.replace(file.find("POINTS 2"), 8, "POINTS 2147483647");
  for (const std::string data : {"ascii", "binary", "binary_compressed"}) {
    std::string other = file;
    other.replace(other.find("ascii"), 5, data);
    EXPECT_NE("", refusal("a.pcd", other + std::string(1000, '\0'))) << data;
  }
}

TEST_F(HostileFiles, DataOfPCDThatAreNotThoseOfTheHeader)
{
  const std::string zeros(24, '\0');
  EXPECT_EQ("", refusal("a.pcd", pcd(9, "DATA binary", false, zeros)));
  EXPECT_EQ("", refusal("a.pcd", pcd(9, "DATA binary", false, zeros + zeros)));
  EXPECT_NE("", refusal("a.pcd", pcd(9, "DATA binary", false, zeros + "more")));
  EXPECT_NE("", refusal("a.pcd", pcd(9, "DATA binary", false, zeros.substr(1))));
  // 24 zeros compressed: one as it is, and 23 like the one before
  const auto compressed = [](std::uint32_t size, std::uint32_t full, std::string data) {
    std::string sizes(8, '\0');
    std::memcpy(&sizes[0], &size, 4);
    std::memcpy(&sizes[4], &full, 4);
    return pcd(9, "DATA binary_compressed", false, sizes + data);
  };
  const std::string data{'\0', '\0', '\xE0', '\x0E', '\0'};
  EXPECT_EQ("", refusal("a.pcd", compressed(5, 24, data)));
  EXPECT_NE("", refusal("a.pcd", compressed(5, 25, data)));
  EXPECT_NE("", refusal("a.pcd", compressed(6, 24, data)));
  EXPECT_NE("", refusal("a.pcd", compressed(4, 24, data)));
  EXPECT_NE("", refusal("a.pcd", compressed(4294967295u, 24, data)));
  EXPECT_NE("",
            refusal("a.pcd", compressed(5, 24, {'\0', '\0', '\xE0', '\x0F', '\0'})));
  EXPECT_NE("",
            refusal("a.pcd", compressed(5, 24, {'\0', '\0', '\xE0', '\x0E', '\1'})));
  EXPECT_SAYS("line 12", refusal("a.pcd", pcd(-1, "", false, "1 2 3\n4 1e39 6\n")));
  EXPECT_SAYS("line 12",
              refusal("a.pcd", pcd(3, "TYPE F I F", false, "1 2 3\n4 5.5 6\n")));
}

TEST_F(HostileFiles, NumbersOfPointsInPLYThatAreNone)
{
  EXPECT_EQ("", refusal("a.ply", ply(face, "3 0 1 2\n")));
  for (const std::string index :
       {"1.5", "4294967296", "2147483648", "-1", "3", "1e300", "nan", "", "0x1", "1,5"})
    EXPECT_SAYS(index == "3" ? "only 3" : "line 13",
                refusal("a.ply", ply(face, "3 0 " + index + " 2\n")));
  for (const std::string row :
       {"2 0 1 2", "4 0 1 2", "-3 0 1 2", "256 0 1 2", "3.5 0 1 2"})
    EXPECT_SAYS("line 13", refusal("a.ply", ply(face, row + "\n")));
  EXPECT_SAYS("line 14", refusal("a.ply", ply(face, "3 0 1 2\n3 0 1 2\n")));
  // lists of every type are read, and checked
  for (const std::string type : {"char", "ushort", "uint", "float", "double"}) {
    const std::string header =
        "element face 1\nproperty list uint " + type + " vertex_index\n";
    EXPECT_EQ("", refusal("a.ply", ply(header, "3 0 1 2\n"))) << type;
    EXPECT_SAYS("line 13", refusal("a.ply", ply(header, "3 0 -1 2\n")));
  }
  EXPECT_SAYS("line 13", refusal("a.ply", ply("element face 1\nproperty list int float "
                                              "vertex_indices\n",
                                              "3 0 1.5 2\n")));
}

TEST_F(HostileFiles, WrongHeadersOfPLY)
{
  EXPECT_EQ("", refusal("a.ply", ply("comment c\nobj_info i\n", "")));
  for (const std::string line :
       {"propert float a", "property float", "property real a", "property list a b",
        "property list float int a", "element e", "element e -1", "element vertex 3",
        "element e 99999999999999999999", "property float x", "format ascii 1.0",
        "obj_info num_cols 2147483648\nobj_info num_rows 2147483648",
        "obj_info num_cols 65536\nobj_info num_rows 65536",
        "obj_info num_cols -1\nobj_info num_rows 3", "end_header now"})
    EXPECT_NE("", refusal("a.ply", ply(line + '\n', ""))) << line;
  std::string binary = ply("", "");
  binary = binary.substr(0, binary.find("0 0 0\n"));
  for (const std::string format :
       {"binary_little_endian 1.0", "binary_big_endian 1.0"}) {
    std::string header = binary;
    header.replace(header.find("ascii 1.0"), 9, format);
    EXPECT_EQ("", refusal("a.ply", header + std::string(36, '\0')));
    EXPECT_NE("", refusal("a.ply", header + std::string(35, '\0')));
    // misdeclared types leave something over
    EXPECT_NE("", refusal("a.ply", header + std::string(48, '\0')));
  }
  for (const std::string format : {"binary 1.0", "ascii 2.0", "ascii"}) {
    std::string header = ply("", "");
    header.replace(header.find("ascii 1.0"), 9, format);
    EXPECT_NE("", refusal("a.ply", header)) << format;
  }
  // grids are not larger than the file lets them be
  EXPECT_NE("",
            refusal("a.ply", ply("element range_grid 2000000000\nproperty list uchar "
                                 "int vertex_indices\n",
                                 "0\n")));
}

TEST_F(HostileFiles, BrokenRowsOfText)
{
  for (const std::string row :
       {"a b c", "1 2", "1e39 0 0", "1e400 0 0", "1,5 2,5 3,5", "1.2.3 0 0", "x y z",
        "1 2 three", "--1 2 3", "0x1 2 3"}) {
    for (const std::string start : {"", "x y z\n", "3\n"})
      for (const std::string name : {"a.xyz", "a.txt", "a.pts"}) {
        const std::string line = start.empty() ? "line 2" : "line 3";
        EXPECT_SAYS(line, refusal(name, start + "0 0 0\n" + row + "\n1 1 1\n")) << row;
      }
    EXPECT_SAYS("line 4", refusal("a.off", "OFF\n3 0 0\n0 0 0\n" + row + "\n1 1 1\n"));
    EXPECT_SAYS("line 2", refusal("a.obj", "v 0 0 0\nv " + row + "\nv 1 1 1\n"));
    EXPECT_SAYS("line 5",
                refusal("a.stl", "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n"
                                 "vertex " +
                                     row +
                                     "\nvertex 1 1 1\nendloop\nendfacet\nendsolid\n"));
  }
  // a first row with numbers is no title
  EXPECT_SAYS("line 1", refusal("a.xyz", "1,5x 2 3\n0 0 0\n"));
  EXPECT_SAYS("line 1", refusal("a.xyz", "1e400 2 3\n0 0 0\n"));
  // what is too small for a number is nearly zero, which is no harm
  EXPECT_EQ("", refusal("a.xyz", "1e-400 -1e-330 0.5\n0 0 0\n"));
}

TEST_F(HostileFiles, BrokenStatementsOfOBJ)
{
  const std::string points = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\n";
  for (const std::string line :
       {"f 1 2", "f 1 2 5", "f 0 1 2", "f -4 1 2", "f 1 2 a", "f 1.5 2 3",
        "f 1//2 2//1 3//1", "v", "v 1 2", "v 1 2 3 4 5", "v 1 2 3 0", "vn 1 2",
        "vertex 1 2 3", "V 1 2 3", "1 2 3", "v 1 2 3 nan 0 0"})
    EXPECT_SAYS("line 5", refusal("a.obj", points + line + "\nv 0 0 1\n")) << line;
}

TEST_F(HostileFiles, UnusualOBJIsRead)
{
  const Geometry mesh = read(
      "a.obj", "mtllib /dev/zero\no a\ng b c\nusemtl m\ns off\nf 1 2 3 # before them\n"
               "v 0 0 0\nv 2 0 \\\n 0\nv 0 4 0 2\nv 1 1 1\nvt 0 1\nvn 0 0 1\nvn 0 1 0\n"
               "f -4//1 -3/1/-2 -2//1 4\nf 1//2 2//2 3//2\nl 1 2\np 1\n");
  ASSERT_EQ(3u, mesh.faces.size());
  EXPECT_EQ((pcl::Indices{0, 1, 2}), mesh.faces[0].vertices);
  EXPECT_EQ((pcl::Indices{0, 1, 2, 3}), mesh.faces[1].vertices);
  // these have another normal there
  EXPECT_EQ((pcl::Indices{4, 5, 6}), mesh.faces[2].vertices);
  const Points points = positionsOf(mesh);
  ASSERT_EQ(7u, points.size());
  EXPECT_EQ(Eigen::Vector3d(2, 0, 0), points[1]);
  EXPECT_EQ(Eigen::Vector3d(0, 2, 0), points[2]);
  EXPECT_EQ(points[2], points[6]);
}

TEST_F(HostileFiles, BrokenFacetsOfSTL)
{
  const std::vector<std::string> lines{
      "solid a b",    "facet normal 0 0 1", "outer loop",
      "vertex 0 0 0", "vertex 1 0 0",       "vertex 0 1 0",
      "endloop",      "endfacet",           "endsolid a b"};
  const auto file = [&](std::size_t without, const std::string& instead) {
    std::string text;
    for (std::size_t i = 0; i < lines.size(); ++i)
      text += (i == without ? instead : lines[i] + '\n');
    return text;
  };
  EXPECT_EQ("", refusal("a.stl", file(-1, "")));
  for (std::size_t i = 0; i < lines.size(); ++i) {
    EXPECT_NE("", refusal("a.stl", file(i, ""))) << lines[i];
    EXPECT_NE("", refusal("a.stl", file(i, "vertex 1 1\n"))) << lines[i];
    EXPECT_NE("", refusal("a.stl", file(i, "words\n"))) << lines[i];
  }
  EXPECT_SAYS("line 7", refusal("a.stl", file(6, "vertex 1 1 1\nendloop\n")));
}

TEST_F(HostileFiles, WhatIsNoFile)
{
  const auto said = [](const std::string& path) {
    try {
      readGeometry(path);
    }
    catch (const std::runtime_error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  for (const std::string extension : {".pcd", ".ply", ".obj", ".stl", ".off", ".xyz"}) {
    const std::string pipe = path("pipe" + extension);
    ASSERT_EQ(0, mkfifo(pipe.c_str(), 0600));
    EXPECT_SAYS("not a regular file", said(pipe));
    std::filesystem::create_symlink("/dev/zero", path("zero" + extension));
    EXPECT_SAYS("not a regular file", said(path("zero" + extension)));
    std::filesystem::create_directory(path("folder" + extension));
    EXPECT_SAYS("not a regular file", said(path("folder" + extension)));
  }
}

TEST_F(HostileFiles, CoordinatesThatSinglePrecisionCannotCarry)
{
  std::string file =
      "ply\nformat ascii 1.0\nelement vertex 2\nproperty double x\nproperty "
      "double y\nproperty double z\nend_header\n0 0 0\n0 -1e300 0\n";
  EXPECT_SAYS("point 2 has the coordinate -1e+300", refusal("a.ply", file));
  file.replace(file.find("-1e300"), 6, "1e30");
  EXPECT_EQ("", refusal("a.ply", file));
  file.replace(file.find("1e30"), 4, "nan");
  EXPECT_EQ("", refusal("a.ply", file));
}

TEST_F(HostileFiles, FarPointsDoNotMoveTheLocalFrame)
{
  Points points;
  for (int i = 0; i < 1000; ++i)
    points.push_back(Eigen::Vector3d(4e6, 5e5, 100) + Eigen::Vector3d::Random());
  points.insert(points.end(), 5, Eigen::Vector3d(1e12, -1e12, 1e12));
  points.push_back(Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN()));
  const Eigen::Vector3d origin = localOrigin(cloudOf({points, {}}));
  EXPECT_LT((origin - Eigen::Vector3d(4e6, 5e5, 100)).norm(), 2.0);
}

TEST_F(HostileFiles, DisksThatAreFull)
{
  // files of this process may be no longer than this
  const auto before = std::signal(SIGXFSZ, SIG_IGN);
  rlimit old, small;
  ASSERT_EQ(0, getrlimit(RLIMIT_FSIZE, &old));
  small = old;
  small.rlim_cur = 20000;
  Geometry points;
  points.cloud = cloudOfDoubles(std::vector<double>(30000, 1.0), {"x", "y", "z"});
  points.faces.resize(2000);
  for (auto& face : points.faces)
    face.vertices = {0, 1, 2};
  ASSERT_EQ(0, setrlimit(RLIMIT_FSIZE, &small));
  for (const auto format : {FileFormat::PCD, FileFormat::PLY, FileFormat::OBJ,
                            FileFormat::STL, FileFormat::OFF, FileFormat::TEXT}) {
    OutputFile file(path("output"));
    EXPECT_THROW(file.write([&](std::ostream& stream) {
      writeGeometry(points, format, stream);
    }),
                 std::runtime_error);
  }
  setrlimit(RLIMIT_FSIZE, &old);
  std::signal(SIGXFSZ, before);
  EXPECT_TRUE(
      std::filesystem::is_empty(std::filesystem::path(path("x")).parent_path()));
}
