/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * Meshes and clouds of OFF, STL, PLY, OBJ and PCD as other programs write them.
 */

#include "io/losses.h"
#include "io/lzf.h"
#include "tool_files.h"

#include <pcl/io/lzf.h>
#include <pcl/io/pcd_io.h>

#include <cstring>
#include <random>
#include <utility>
#include <vector>

using namespace kss_test;

namespace {

using Files = std::vector<std::pair<std::string, std::string>>;
using Names = std::vector<std::string>;

template <typename Number>
std::string
bytesOf(Number number, bool is_reversed = false)
{
  std::string bytes(sizeof number, '\0');
  std::memcpy(&bytes[0], &number, sizeof number);
  return is_reversed ? std::string(bytes.rbegin(), bytes.rend()) : bytes;
}

class ForeignMeshes : public ToolFiles {
protected:
  /** All files hold the same square of two triangles, and again when written again. */
  void
  expectSquare(const Files& files) const
  {
    for (const auto& [name, content] : files) {
      SCOPED_TRACE(name + "\n" + content);
      try {
        const Geometry mesh = read(name, content);
        expectMesh(mesh);
        const auto extension = std::filesystem::path(name).extension();
        const bool is_text = extension == ".txt" || extension == ".dat";
        expectMesh(
            readGeometry(write("again_" + name + (is_text ? ".ply" : ""), mesh)));
      }
      catch (const std::runtime_error& problem) {
        ADD_FAILURE() << problem.what();
      }
    }
  }

  void
  expectMesh(const Geometry& mesh) const
  {
    expectEqual(points_, positionsOf(mesh), 0.0);
    ASSERT_EQ(2u, mesh.faces.size());
    EXPECT_EQ((pcl::Indices{0, 1, 2}), mesh.faces[0].vertices);
    EXPECT_EQ((pcl::Indices{0, 2, 3}), mesh.faces[1].vertices);
  }

  const Points points_{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
};

std::string
ply(const std::string& format, const std::string& more = "")
{
  return "ply\nformat " + format +
         " 1.0\ncomment made by hand\nobj_info and by a program\n"
         "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n" +
         more;
}

const std::string rows = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
const std::string faces =
    "element face 2\nproperty list uchar int vertex_indices\nend_header\n";
const std::string two_faces = "3 0 1 2\n3 0 2 3\n";

} // namespace

TEST_F(ForeignMeshes, OFF)
{
  expectSquare(
      {{"a.off", "OFF4 2 0\n" + rows + two_faces},
       {"b.off", "OFF\n4 2\n" + rows + two_faces},
       {"c.off", "off\n4 2 5\n\n# points\n" + rows + "\n# faces\n" + two_faces},
       {"d.off", "OFF\n4 2 0\n0 0 0 1 0 0\n1 1 0 0 1 0\n" + two_faces},
       {"e.off", "OFF 4 2 0 0 0 0 1 0 0 1 1 0 0 1 0 3 0 1 2 3 0 2 3"},
       {"f.off",
        "OFF\n4\n2\n0\n0\n0\n0\n1\n0\n0\n1\n1\n0\n0\n1\n0\n3\n0 1 2\n3 0\n2\n3\n"},
       {"g.off", "OFF\n4 2 0\n0 0 0 1\n0 0 1 1\n0 0 1 0\n3 0 1 2 3 0 2 3\n"},
       {"h.off",
        "OFF\r\n4 2 0\r\n0 0 0\r\n1 0 0\r\n1 1 0\r\n0 1 0\r\n3  0 1 2\r\n3  0 2 "
        "3\r\n"},
       {"i.off", "COFF\n4 2 0\n0 0 0 255 0 0 255\n1 0 0 255 0 0 255\n1 1 0 0 0 9 255\n"
                 "0 1 0 0 0 0 255\n" +
                     two_faces},
       {"j.off", "COFF4 2 0\n0 0 0 1 0 0\n1 0 0 0.5 0 0\n1 1 0 0 0 1\n0 1 0 0 0 0\n" +
                     two_faces},
       {"k.off",
        "NOFF\n4 2 0\n0 0 0 0 0 1 1 0 0 0 0 1\n1 1 0 0 0 1 0 1 0 0 0 1\n" + two_faces},
       {"l.off",
        "STOFF\n4 2 0\n0 0 0 0 0\n1 0 0 1 0\n1 1 0 1 1\n0 1 0 0 1\n" + two_faces},
       {"m.txt", "OFF\n4 2 0\n" + rows + two_faces}});
  const Geometry coloured =
      read("a.off", "OFF\n4 2 0\n" + rows + "3 0 1 2 255 0 0\n3 0 2 3 9\n");
  EXPECT_EQ(2u, coloured.faces.size());
  EXPECT_EQ(Names{"colours of faces"}, coloured.left_out);
  const Geometry texture = readGeometry(path("again_l.off"));
  EXPECT_EQ(1.0, numberAt(texture, "texture_v", 3));
  EXPECT_EQ(0.5, numberAt(readGeometry(path("again_j.off")), "red", 1));
  const Geometry bytes = readGeometry(path("again_i.off"));
  EXPECT_EQ((std::array<std::uint8_t, 4>{255, 0, 0, 255}),
            getColour(*findField(bytes.cloud, "rgba"), bytes.cloud.data.data()));
  EXPECT_EQ(Names{}, lossesOf(readGeometry(path("i.off")), FileFormat::OFF));
  EXPECT_EQ(1.0, numberAt(readGeometry(path("again_k.off")), "normal_z", 3));

  // normals and colours in any order
  for (const std::string file :
       {"CNOFF\n1 0 0\n0 0 0 0 0 1 9 8 7\n", "NCOFF\n1 0 0\n0 0 0 9 8 7 0 0 1\n"}) {
    const Geometry point = read("a.off", file);
    EXPECT_EQ(1.0, numberAt(point, "normal_z", 0)) << file;
    EXPECT_EQ((std::array<std::uint8_t, 4>{9, 8, 7, 0}),
              getColour(*findField(point.cloud, "rgb"), point.cloud.data.data()));
  }

  EXPECT_NE(
      std::string::npos,
      refusal("a.off", "OFF\n4 2 0\n" + rows + "3 0 1\n3 0 2 3\n").find("line 7"));
  for (const std::string& wrong :
       Names{"OFF\n4 2 0\n0 0 0 1 0 0\n1 1 0 0 1\n" + two_faces, "OFF4\n",
             "OFF BINARY\n", "OFF\n4 2 0 0 0 0 1 0 0 1 1 0 0 1 0 3 0 1 2 3 0 2",
             "OFF\n4 2 0 0 0 0 1 0 0 1 1 0 0 1 0 3 0 1 2 3 0 2 3 1"})
    EXPECT_NE("", refusal("a.off", wrong)) << wrong;
}

TEST_F(ForeignMeshes, LongWordsAndLines)
{
  EXPECT_NE("", refusal("a.off", "OFF" + std::string(1000000, '1') + " 1 0\n"));
  EXPECT_NE("", refusal("a.off", "ABC\n4 2 0\n" + rows + two_faces));
  std::string joined = "v 1 2 3 ";
  for (int i = 0; i < 300000; ++i)
    joined += "\\\n";
  EXPECT_EQ(1u, numberOfPoints(read("a.obj", joined + '\n').cloud));
  std::string elements;
  for (int i = 0; i < 100000; ++i)
    elements += "element a" + std::to_string(i) + " 0\n";
  EXPECT_NE(std::string::npos,
            refusal("a.ply", ply("ascii") + elements + "end_header\n" + rows)
                .find("more than can be read"));
}

TEST_F(ForeignMeshes, STLInText)
{
  const auto facet = [](const std::string& corners) {
    return "facet normal 0 0 1\nouter loop\n" + corners + "endloop\nendfacet\n";
  };
  const std::string first = facet("vertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\n");
  const std::string second = facet("vertex 0 0 0\nvertex 1 1 0\nvertex 0 1 0\n");
  const std::string text = "solid square\n" + first + second + "endsolid square\n";
  std::string upper = text, spaced, windows;
  for (auto& c : upper)
    c = static_cast<char>(std::toupper(c));
  for (const char c : text) {
    spaced += c == '\n' ? "\n \n\t" : std::string(1, c);
    windows += c == '\n' ? "\r\n" : std::string(1, c);
  }
  expectSquare({{"a.stl", text},
                {"b.stl", upper},
                {"c.stl", spaced + std::string(2000, '\n')},
                {"d.stl", windows},
                {"e.stl", "solid " + std::string(5000, 'n') + text.substr(12)},
                {"f.stl", "solid" + text.substr(12)},
                {"g.stl", "\n  " + text},
                {"h.stl", "\xEF\xBB\xBF" + text},
                {"i.stl", "Solid M\xFCller\n" + first + second + "EndSolid\n"},
                {"j.stl", "solid a\n" + first + "endsolid a\n\nsolid b\n" + second +
                              "endsolid b\n"},
                {"k.txt", text}});
  EXPECT_EQ(0u,
            contentOf(path("again_a.stl")).find("solid square\nfacet normal 0 0 1\n"));
  EXPECT_EQ(Names{"the division into 2 solids"}, readGeometry(path("j.stl")).left_out);

  // text keeps digits that floats do not have
  const Geometry far = readGeometry(write("far.stl", farTetrahedron()));
  EXPECT_EQ(positionsOf(farTetrahedron())[0], positionsOf(far)[0]);
}

TEST_F(ForeignMeshes, BinarySTL)
{
  const auto file = [](std::string header, std::uint16_t attribute,
                       const std::string& tail) {
    header.resize(80, header.find("solid") == 0 ? ' ' : '\0');
    std::string bytes = header + bytesOf(std::uint32_t(2));
    for (const std::vector<float>& corners :
         {std::vector<float>{0, 0, 0, 1, 0, 0, 1, 1, 0},
          std::vector<float>{0, 0, 0, 1, 1, 0, 0, 1, 0}}) {
      for (const float number : {0.0f, 0.0f, 1.0f})
        bytes += bytesOf(number);
      for (const float number : corners)
        bytes += bytesOf(number);
      bytes += bytesOf(attribute);
    }
    return bytes + tail;
  };
  expectSquare({{"a.stl", file("", 0, "")},
                {"b.stl", file("solid like text", 0, "")},
                {"c.stl", file("solid like text", 0, std::string(128, '\0'))},
                {"d.stl", file("some program", 0, "tail")},
                {"e.stl", file("COLOR=\x01\x02\x03\x04", 31744, "")},
                {"f.dat", file("", 0, "")}});
  EXPECT_EQ(Names{}, readGeometry(path("a.stl")).left_out);
  EXPECT_EQ(Names{"4 bytes behind the triangles"},
            readGeometry(path("d.stl")).left_out);
  EXPECT_EQ(Names{"attributes (colours) of triangles"},
            readGeometry(path("e.stl")).left_out);
  EXPECT_EQ(0u, contentOf(path("again_d.stl")).find("some program"));
  EXPECT_NE(0u, contentOf(path("again_b.stl")).find("solid"));
}

TEST_F(ForeignMeshes, PLY)
{
  Files files;
  for (const std::string length : {"char", "uchar", "short", "ushort", "int", "uint"})
    for (const std::string index : {"uchar", "short", "int", "uint", "int32", "uint16"})
      files.push_back({length + index + ".ply",
                       ply("ascii") + "element face 2\nproperty list " + length + ' ' +
                           index + " vertex_index\nend_header\n" + rows + two_faces});
  std::string upper = ply("ascii") + faces + rows + two_faces;
  for (const std::string axis : {"x", "y", "z"})
    upper.replace(upper.find("float " + axis), 7,
                  "float " + std::string(1, static_cast<char>(std::toupper(axis[0]))));
  files.push_back({"upper.ply", upper});
  files.push_back({"content.txt", ply("ascii") + faces + rows + two_faces});
  for (const bool is_big : {false, true}) {
    std::string binary =
        ply(is_big ? "binary_big_endian" : "binary_little_endian") + faces;
    for (const auto& point : points_)
      for (const double number : point)
        binary += bytesOf(static_cast<float>(number), is_big);
    for (const auto& face : {std::vector<int>{0, 1, 2}, std::vector<int>{0, 2, 3}}) {
      binary += '\3';
      for (const int index : face)
        binary += bytesOf(index, is_big);
    }
    files.push_back({is_big ? "big.ply" : "little.ply", binary});
  }
  expectSquare(files);
  // what is written again is as it was, to the byte
  for (const std::string name : {"big.ply", "little.ply", "ucharint.ply"}) {
    std::string content = contentOf(path(name));
    if (content.find("vertex_index\n") != std::string::npos)
      content.replace(content.find("vertex_index\n"), 12, "vertex_indices");
    EXPECT_EQ(content, contentOf(path("again_" + name))) << name;
  }
}

TEST_F(ForeignMeshes, WhatPLYHoldsBesides)
{
  const auto points = [](const std::string& property, const std::string& value) {
    std::string file = ply("ascii", property + "end_header\n");
    for (const std::string row : {"0 0 0 ", "1 0 0 ", "1 1 0 ", "0 1 0 "})
      file += row + value + '\n';
    return file;
  };
  const Geometry lists =
      read("a.ply", points("property list uchar uint views\n", "2 7 8"));
  expectEqual(points_, positionsOf(lists), 0.0);
  EXPECT_EQ(Names{"property 'views' of points"}, lists.left_out);

  for (const std::string property :
       {"uchar alpha", "uchar red", "float s", "uchar Red"}) {
    const std::string name = property.substr(property.find(' ') + 1);
    const Geometry again = readGeometry(
        write("b.ply", read("a.ply", points("property " + property + "\n", "7"))));
    EXPECT_EQ(7.0, numberAt(again, name, 3)) << name;
  }
  const std::string colours =
      "property uchar red\nproperty uchar green\nproperty uchar "
      "blue\n";
  std::string more = colours;
  for (std::size_t at = 0; (at = more.find("uchar ", at)) != std::string::npos;
       at += 14)
    more.insert(at + 6, "diffuse_");
  const Geometry two = read("c.ply", points(colours + more, "1 2 3 4 5 6"));
  EXPECT_EQ(5.0, numberAt(two, "diffuse_green", 0));
  EXPECT_EQ(2, getColour(*findField(two.cloud, "rgb"), two.cloud.data.data())[1]);

  const Geometry mesh = read(
      "d.ply", ply("ascii") +
                   "element face 2\nproperty list uchar int vertex_indices\nproperty "
                   "list uchar float texcoord\nproperty uchar flags\nelement edge 1\n"
                   "property int vertex1\nproperty int vertex2\nelement none 0\n"
                   "property int nothing\nend_header\n" +
                   rows + "3 0 1 2 6 0 0 1 0 1 1 9\n3 0 2 3 0 9\n0 1\n");
  expectMesh(mesh);
  EXPECT_EQ((Names{"property 'texcoord' of faces", "property 'flags' of faces",
                   "element 'edge'"}),
            lossesOf(mesh, FileFormat::PLY));
  EXPECT_EQ((Names{"made by hand", "obj_info and by a program"}), mesh.comments);
  EXPECT_EQ(mesh.comments, readGeometry(write("e.ply", mesh)).comments);
}

TEST_F(ForeignMeshes, FacesOfManyCorners)
{
  Geometry mesh;
  std::vector<double> numbers;
  for (int i = 0; i < 300; ++i)
    numbers.insert(numbers.end(), {std::cos(0.01 * i), std::sin(0.01 * i), 0.5});
  mesh.cloud = cloudOfDoubles(numbers, {"x", "y", "z"});
  mesh.faces.resize(1);
  for (int i = 0; i < 300; ++i)
    mesh.faces[0].vertices.push_back(i);
  for (const auto storage : {Storage::TEXT, Storage::BINARY, Storage::BINARY_BIG}) {
    mesh.storage = storage;
    for (const std::string name : {"a.ply", "a.off", "a.obj"})
      EXPECT_EQ(mesh.faces[0].vertices,
                readGeometry(write(name, mesh)).faces[0].vertices);
  }
}

TEST_F(ForeignMeshes, FacesOfFewCorners)
{
  const Geometry mesh = read("a.off", "OFF\n4 3 0\n" + rows + "1 0\n2 0 1\n3 0 1 2\n");
  ASSERT_EQ(3u, mesh.faces.size());
  EXPECT_NE(std::string::npos,
            contentOf(write("b.obj", mesh)).find("p 1\nl 1 2\nf 1 2 3\n"));
  EXPECT_EQ(1u, readGeometry(path("b.obj")).faces.size());
}

TEST_F(ForeignMeshes, OBJKeepsAllStatements)
{
  const std::string points = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
  for (const std::string& content :
       Names{"mtllib a b.mtl\no square\n" + points +
                 "vt 0 0\nvt 0.5 1\nvn 0 0 1\nvn 0 1 0\ng one two\nusemtl skin\ns 1\n"
                 "f 1/1/1 2/2/1 3/1/1\ns off\nf 1/1/2 3/1/2 4/2/2\nl 1 2 3\np 4\n",
             points + "f -4 -3 -2\nf -4 -2 -1\n",
             "g\n" + points + "f 1 2 3\nf 1 3 4\n"}) {
    SCOPED_TRACE(content);
    const Geometry mesh = read("a.obj", content);
    EXPECT_EQ(content, contentOf(write("b.obj", mesh)));
    EXPECT_EQ(Names{}, lossesOf(mesh, FileFormat::OBJ));
    ASSERT_EQ(2u, mesh.faces.size());
  }
  // points and normals are where the transformation brings them
  const Geometry mesh = read("a.obj", "v 1 2 3\nv 1 0 0\nv 0 1 0\nvn 1 0 0\nvt 0 1\n"
                                      "f 1/1/1 2/1/1 3/1/1\n");
  EXPECT_EQ("v 6 22 36\nv 10 22 30\nv 8 20 30\nvn 0 1 0\nvt 0 1\nf 1/1/1 2/1/1 3/1/1\n",
            contentOf(write("b.obj", transformed(mesh, quarterTurn()))));
  EXPECT_EQ(Names{"texture coordinates"}, lossesOf(mesh, FileFormat::PLY));

  // objects and groups of points alone, points that no face uses, and large coordinates
  EXPECT_EQ(4u, numberOfPoints(read("c.obj", "o cloud\n" + points).cloud));
  EXPECT_EQ(4u,
            numberOfPoints(read("d.obj", "mtllib m\ng c\nusemtl s\n" + points).cloud));
  const Geometry loose = read("e.obj", points + "f 1 2 3\n");
  EXPECT_EQ(4u, numberOfPoints(readGeometry(write("f.obj", loose)).cloud));
  EXPECT_EQ((Names{"points that no face uses"}), lossesOf(loose, FileFormat::STL));
  const std::string far = "v 399508.041 5462813.681 749.51\n";
  EXPECT_EQ(far, contentOf(write("h.obj", read("g.obj", far))));
  // by its content
  EXPECT_EQ(
      2u,
      read("i.txt", "# Blender\no a\n" + points + "f 1 2 3\nf 1 3 4\n").faces.size());
  EXPECT_NE(std::string::npos,
            contentOf(write("k.obj", read("j.obj", points))).find("v 1 1 0\n"));
}

TEST_F(ForeignMeshes, ColoursOfOBJ)
{
  using Colour = std::array<std::uint8_t, 3>;
  const auto colour = [](const Geometry& mesh, std::size_t point) -> Colour {
    const auto& fields = mesh.cloud.fields;
    const auto field = std::find_if(fields.begin(), fields.end(), isPackedColour);
    if (field == fields.end())
      throw std::runtime_error("lost its colour");
    const auto parts =
        getColour(*field, &mesh.cloud.data[point * mesh.cloud.point_step]);
    return {parts[0], parts[1], parts[2]};
  };
  const std::string fractions = "v 0 0 0 0.5 0.25 0.125\nv 1 0 0 1 0 0\n";
  const Geometry by_fractions = read("a.obj", fractions);
  EXPECT_EQ((Colour{128, 64, 32}), colour(by_fractions, 0));
  EXPECT_EQ(fractions, contentOf(write("b.obj", by_fractions)));
  const std::string bytes = "v 0 0 0 0 128 1\nv 1 0 0 255 1 0\nv 1 1 1\n";
  const Geometry by_bytes = read("a.obj", bytes);
  EXPECT_EQ((Colour{0, 128, 1}), colour(by_bytes, 0));
  EXPECT_EQ((Colour{255, 255, 255}), colour(by_bytes, 2));
  EXPECT_EQ(bytes, contentOf(write("b.obj", by_bytes)));
  // colours are what they were in all formats that have some
  for (const std::string name : {"a.pts", "a.ptx", "a.xyz", "a.ply", "a.off", "a.pcd"})
    EXPECT_EQ((Colour{0, 128, 1}), colour(readGeometry(write(name, by_bytes)), 0))
        << name;
  Geometry transparent = by_bytes;
  const auto& packed = *findField(transparent.cloud, "rgba");
  transparent.cloud.data[packed.offset + 3] = 100;
  EXPECT_EQ(Names{"alpha of colours"}, lossesOf(transparent, FileFormat::PTS));
  EXPECT_EQ(Names{}, lossesOf(transparent, FileFormat::PLY));
  EXPECT_EQ((Colour{0, 128, 1}), colour(readGeometry(write("c.pts", transparent)), 0));
  const Geometry again = readGeometry(write("c.csv", transparent));
  EXPECT_EQ(100,
            getColour(*findField(again.cloud, "rgba"), again.cloud.data.data())[3]);
}

TEST_F(ForeignMeshes, HeadersOfPCD)
{
  const auto pcd = [](const std::string& sizes, const std::string& more = "") {
    return "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n" + sizes +
           "DATA ascii\n" + rows + more;
  };
  for (const std::string& content :
       Names{pcd("WIDTH 4\nHEIGHT 1\nPOINTS 4\n"), pcd("WIDTH 4\nHEIGHT 1\n"),
             pcd("POINTS 4\n"), pcd("HEIGHT 1\nPOINTS 4\n"), pcd("WIDTH 2\nPOINTS 4\n"),
             pcd("WIDTH 4\n"), pcd("HEIGHT 2\nPOINTS 4\n"),
             pcd("WIDTH 4\n", "# the end\n"), pcd("WIDTH 4\n", "\n#\n# end\n\n")}) {
    SCOPED_TRACE(content);
    for (const std::string name : {"a.pcd", "a.txt"})
      expectEqual(points_, positionsOf(read(name, content)), 0.0);
  }
  for (const std::string sizes :
       {"", "HEIGHT 1\n", "WIDTH 2\nPOINTS 5\n", "HEIGHT 3\nPOINTS 4\n", "WIDTH 5\n"})
    EXPECT_NE("", refusal("a.pcd", pcd(sizes))) << sizes;
  std::string upper = pcd("WIDTH 4\n");
  upper.replace(upper.find("x y z"), 5, "X Y Z");
  expectEqual(points_, positionsOf(read("a.pcd", upper)), 0.0);
  const Geometry noted = read("a.pcd", "# .PCD v0.7\n# of a car\n" + pcd("WIDTH 4\n"));
  EXPECT_EQ(Names{"of a car"}, readGeometry(write("b.pcd", noted)).comments);
}

TEST_F(ForeignMeshes, PCDKeepsItsStorage)
{
  Geometry cloud = fieldsOfAllKinds();
  cloud.sensor_origin << 1, 2, 3, 0;
  for (const auto& [storage, word] :
       {std::make_pair(Storage::TEXT, "ascii"),
        std::make_pair(Storage::BINARY, "binary"),
        std::make_pair(Storage::COMPRESSED, "binary_compressed")}) {
    SCOPED_TRACE(word);
    cloud.storage = storage;
    const Geometry again = readGeometry(write("a.pcd", cloud));
    EXPECT_NE(std::string::npos,
              contentOf(path("a.pcd")).find(std::string("DATA ") + word + '\n'));
    EXPECT_EQ(storage, again.storage);
    EXPECT_EQ(cloud.sensor_origin, again.sensor_origin);
    EXPECT_EQ(cloud.cloud.data, again.cloud.data);
    // as PCL reads it
    pcl::PCLPointCloud2 by_pcl;
    ASSERT_EQ(0, pcl::io::loadPCDFile(path("a.pcd"), by_pcl));
    EXPECT_EQ(cloud.cloud.data, by_pcl.data);
  }
}

TEST_F(ForeignMeshes, TellsWhatFormatsCannotHold)
{
  Geometry cloud = fieldsOfAllKinds();
  EXPECT_EQ(Names{}, lossesOf(cloud, FileFormat::PLY));
  EXPECT_EQ(Names{}, lossesOf(cloud, FileFormat::CSV));
  EXPECT_EQ((Names{"field 'curvature'", "field 'label'", "field 'time'"}),
            lossesOf(cloud, FileFormat::OBJ));
  cloud.faces.resize(1);
  cloud.faces[0].vertices = {0, 1, 2, 3};
  EXPECT_EQ(Names{"faces"}, lossesOf(cloud, FileFormat::PCD));
  EXPECT_EQ(Names{"faces"}, lossesOf(cloud, FileFormat::TEXT));
  EXPECT_EQ("faces of more than three corners, which become triangles",
            lossesOf(cloud, FileFormat::STL).back());
  cloud.sensor_origin << 1, 2, 3, 0;
  EXPECT_EQ(Names{"where the sensor stood"}, lossesOf(cloud, FileFormat::PLY));
}

TEST(LZF, CompressesWhatPCLDecompresses)
{
  std::mt19937 random(3);
  for (std::size_t size = 0; size < 30000; size = size * 2 + random() % 9) {
    for (const unsigned int letters : {1u, 2u, 5u, 256u}) {
      std::vector<std::uint8_t> bytes(size);
      for (auto& byte : bytes)
        byte = static_cast<std::uint8_t>(random() % letters);
      for (std::size_t i = 9000; i + 500 < size; i += 9000) // far behind, and long
        std::copy_n(bytes.begin() + (i - 8192), 500, bytes.begin() + i);
      const auto small = compressLZF(bytes.data(), size);
      std::vector<std::uint8_t> ours(size), theirs(size);
      EXPECT_TRUE(decompressLZF(small.data(), small.size(), ours.data(), size));
      EXPECT_EQ(bytes, ours);
      if (size > 0) {
        EXPECT_EQ(size, pcl::lzfDecompress(small.data(), small.size(), theirs.data(),
                                           theirs.size()));
        EXPECT_EQ(bytes, theirs);
      }
      if (letters == 1 && size > 1000) {
        EXPECT_LT(small.size(), size / 50);
      }
    }
  }
}
