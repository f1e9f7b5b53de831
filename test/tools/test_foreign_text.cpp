/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * Columns of text as other programs write them.
 */

#include "io/losses.h"
#include "tool_files.h"

#include <utility>
#include <vector>

using namespace kss_test;

namespace {

using Names = std::vector<std::string>;
/** Names of files and what they hold. */
using Files = std::vector<std::pair<std::string, std::string>>;

std::string
inUTF16(const std::string& text, bool is_big_endian, bool has_mark)
{
  std::string bytes = !has_mark ? "" : is_big_endian ? "\xFE\xFF" : "\xFF\xFE";
  for (const char c : text) {
    bytes += is_big_endian ? '\0' : c;
    bytes += is_big_endian ? c : '\0';
  }
  return bytes;
}

std::string
withLineEnds(std::string text, const std::string& end)
{
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos;
       at += end.size())
    text.replace(at, 1, end);
  return text;
}

class ForeignText : public ToolFiles {
protected:
  /** All files hold the same two points; and again when they are written again. */
  void
  expectPoints(const Files& files) const
  {
    for (const auto& [name, content] : files) {
      SCOPED_TRACE(name + "\n" + content);
      try {
        const Geometry geometry = read(name, content);
        expectEqual(points_, positionsOf(geometry), 0.0);
        const Geometry again = readGeometry(write(againOf(name), geometry));
        expectEqual(points_, positionsOf(again), 0.0);
        EXPECT_EQ(geometry.cloud.fields.size(), again.cloud.fields.size());
      }
      catch (const std::runtime_error& problem) {
        ADD_FAILURE() << problem.what();
      }
    }
  }

  /** The name for what is written again of a file. */
  static std::string
  againOf(const std::string& name)
  {
    const auto extension = std::filesystem::path(name).extension();
    const bool is_known =
        extension != "" && extension != ".cloud" && extension != ".001";
    return "again_" + name + (is_known ? "" : ".txt");
  }

  const Points points_{{1.5, -2.25, 3000}, {4.5, 5, -6.125}};
};

} // namespace

TEST_F(ForeignText, Delimiters)
{
  const std::string rows = "1.5 -2.25 3000\n4.5 5 -6.125\n";
  expectPoints(
      {{"spaces.xyz", "  1.5   -2.25 3000\n  4.5    5.00 -6.125  \n\n\n"},
       {"tabs.txt", "1.5\t-2.25\t3000\n4.5\t5\t-6.125\n"},
       {"mixed.txt", "1.5\t-2.25  3000\n4.5 5\t-6.125\n"},
       {"commas.csv", "1.5,-2.25,3000\n4.5,5,-6.125\n"},
       {"end.csv", "1.5,-2.25,3000,\n4.5,5,-6.125,\n"},
       {"semicolons.csv", "1.5;-2.25;3000\n4.5;5;-6.125\n"},
       {"ended.asc", "1.5; -2.25; 3000;\n4.5; 5; -6.125;\n"},
       {"quotes.csv", "\"1.5\",\"-2.25\",\"3000\"\n\"4.5\",\"5\",\"-6.125\"\n"},
       {"no_ending", rows},
       {"other.cloud", rows},
       {"number.001", rows},
       {"windows.txt", withLineEnds(rows, "\r\n")},
       {"mac.txt", withLineEnds(rows, "\r")},
       {"mac.csv", "x,y,z\r1.5,-2.25,3000\r4.5,5,-6.125"},
       {"twice.txt", withLineEnds(rows, "\r\r\n")},
       {"mark.csv", "\xEF\xBB\xBFx,y,z\n1.5,-2.25,3000\n4.5,5,-6.125\n"},
       {"mark.txt", "\xEF\xBB\xBF" + rows},
       {"excel.txt", inUTF16(withLineEnds("X\tY\tZ\n" + rows, "\r\n"), false, true)},
       {"utf16.csv", inUTF16("1.5,-2.25,3000\n4.5,5,-6.125\n", false, true)},
       {"big.xyz", inUTF16(rows, true, true)},
       {"markless.xyz", inUTF16(rows, false, false)},
       {"markless_big.xyz", inUTF16(rows, true, false)}});
  std::string umlaut = inUTF16("# Hohe und Breite, gemessen\n1 2 3\n", false, false);
  umlaut[6] = '\x51';
  umlaut[7] = '\x01';
  expectEqual({{1, 2, 3}}, positionsOf(read("a.txt", umlaut)), 0.0);
  EXPECT_NE(std::string::npos,
            refusal("a.txt", std::string("\xFF\xFE\0\0001\0\0\0", 8)).find("UTF-32"));
  EXPECT_NE(std::string::npos,
            refusal("a.txt", inUTF16(rows, false, true) + "1").find("UTF-16"));
}

TEST_F(ForeignText, Numbers)
{
  expectPoints(
      {{"fortran.dat", " 0.15D+01 -0.225d1   3.0D3\n  4.5D0 5.D0 -0.6125D+01\n"},
       {"long.dat", "1.5D+000 -2.25 3000.0\n 4.5 5.0 -6.125D+000\n"},
       {"plus.xyz", "+1.5 -2.25 +3e+3\n+4.5 +5 -6.125\n"},
       {"short.xyz", "1.5 -2.25 3000.\n4.5 5. -6.125\n"},
       {"german.csv", "1,5;-2,25;3000\n4,5;5;-6,125\n"},
       {"german_head.csv", "x;y;z\n1,5;-2,25;3000\n4,5;5;-6,125\n"},
       {"german.txt", "1,5\t-2,25\t3000\n4,5\t5\t-6,125\n"},
       {"german.xyz", "1,5 -2,25 3000,0\n4,5 5,0 -6,125\n"},
       {"exponents.xyz", "1,5E+00 -2,25E+00 3,0E+03\n4,5 5,0 -6,125\n"},
       {"quoted.csv", "\"1,5\",\"-2,25\",\"3000\"\n\"4,5\",\"5\",\"-6,125\"\n"},
       {"qnan.txt", "1.5 -2.25 3000\n1.#QNAN 1.#QNAN 1.#QNAN\n4.5 5 -6.125\n"},
       {"ind.txt", "1.5 -2.25 3000\n-1.#IND 0 0\n-1.#IND00 1 1\n4.5 5 -6.125\n"},
       {"j.txt", "1.5 -2.25 3000\n-1.#J 0 0\n1.#INF 1 1\n4.5 5 -6.125\n"},
       {"nan.csv", "1.5,-2.25,3000\nNaN,NaN,NaN\n-nan(ind),inf,1\n4.5,5,-6.125\n"},
       {"r.csv", "\"x\",\"y\",\"z\"\n1.5,-2.25,3000\nNA,NA,NA\n4.5,5,-6.125\n"},
       {"pandas.csv", "x,y,z\n1.5,-2.25,3000\n,,\n4.5,5,-6.125\n"},
       {"tiny.dat", "1.5 -2.25 3000\n 4.5 5 -6.125\n"}});
  expectEqual({{0, 0, 0.5}}, positionsOf(read("a.dat", "0.1234-301 -0.5-200 0.5\n")),
              1e-150);
  // decimal signs that contradict each other may be anything
  EXPECT_NE("", refusal("a.csv", "1,5;2,5;3,5\n1.234;5,5;6,5\n"));
  EXPECT_NE("", refusal("a.csv", "1.5;2.5;3.5\n1,5;5.5;6.5\n"));
  for (const std::string word : {"1.#FOO", "1.5D", "D5", "1.5D+", "1,5,0", "2024-05"})
    EXPECT_NE("", refusal("a.xyz", "0.5 0 0\n" + word + " 0 0\n")) << word;
}

TEST_F(ForeignText, NamesOfColumns)
{
  const std::string rows = "1.5 -2.25 3000\n4.5 5 -6.125\n";
  const std::string numbered = "7 1.5 -2.25 3000\n8 4.5 5 -6.125\n";
  const std::string reversed = "3000 -2.25 1.5\n-6.125 5 4.5\n";
  expectPoints(
      {{"a.txt", "x y z\n" + rows},
       {"b.txt", "//X Y Z\n" + rows},
       {"c.txt", "# x y z\n" + rows},
       {"d.txt", "% X Y Z\n" + rows},
       {"e.txt", "#X,Y,Z\n" + rows},
       {"count.txt", "//X Y Z\n2\n" + rows},
       {"before.txt", "2\n//X Y Z\n" + rows},
       {"units.txt", "x [m] y [m] z [m]\n" + rows},
       {"units.csv", "x (m),y (m),z (m)\n1.5,-2.25,3000\n4.5,5,-6.125\n"},
       {"two.txt", "Scan of the site\nX Y Z\n" + rows},
       {"below.txt", "X;Y;Z\nm;m;m\n1.5;-2.25;3000\n4.5;5;-6.125\n"},
       {"digit.txt", "3D scan of the site\nX Y Z\n" + rows},
       {"excel.csv", "sep=;\nX;Y;Z\n1,5;-2,25;3000\n4,5;5;-6,125\n"},
       {"id.txt", "id X Y Z\n" + numbered},
       {"number.csv", "PointNo,Easting,Northing,Height\n7,1.5,-2.25,3000\n8,4.5,5,-"
                      "6.125\n"},
       {"survey.csv", "ID,E,N,H\n7,1.5,-2.25,3000\n8,4.5,5,-6.125\n"},
       {"north.csv", "Northing;Easting;Elevation\n-2.25;1.5;3000\n5;4.5;-6.125\n"},
       {"german.csv", "Punkt;Rechtswert;Hochwert;H\xF6he\n7;1,5;-2,25;3000\n8;4,5;5;-"
                      "6,125\n"},
       {"utf8.csv", "Punkt;Rechtswert;Hochwert;H\xC3\xB6he\n7;1,5;-2,25;3000\n8;4,5;5;-"
                    "6,125\n"},
       {"gis.csv", "fid,X,Y,elevation\n7,1.5,-2.25,3000\n8,4.5,5,-6.125\n"},
       {"zyx.txt", "z y x\n" + reversed},
       {"paraview.csv", "\"intensity\",\"Points:0\",\"Points:1\",\"Points:2\"\n7,1.5,-"
                        "2.25,3000\n8,4.5,5,-6.125\n"},
       {"paraview5.csv",
        "intensity,Points_0,Points_1,Points_2\n7,1.5,-2.25,3000\n8,4.5,"
        "5,-6.125\n"},
       {"index.csv", ",x,y,z\n0,1.5,-2.25,3000\n1,4.5,5,-6.125\n"},
       {"r.txt", "\"x\" \"y\" \"z\"\n\"1\" 1.5 -2.25 3000\n\"2\" 4.5 5 -6.125\n"},
       {"coords.csv", "x_coord,y_coord,z_coord\n1.5,-2.25,3000\n4.5,5,-6.125\n"},
       {"position.csv", "Position X, Position Y, Position Z\n1.5,-2.25,3000\n4.5,5,-"
                        "6.125\n"},
       {"cartesian.csv", "cartesianX,cartesianY,cartesianZ\n1.5,-2.25,3000\n4.5,5,-"
                         "6.125\n"},
       {"tabs.tsv", "Point name\tX [m]\tY [m]\tZ [m]\n7\t1.5\t-2.25\t3000\n8\t4.5\t5\t-"
                    "6.125\n"},
       {"columns.txt", "x y z\n1.5 -2.25 3000 9 8\n4.5 5 -6.125 9 8\n"},
       {"quoted.csv", "\"X\";\"Y\";\"Z\"\n\"1,5\";\"-2,25\";\"3000\"\n\"4,5\";\"5\";"
                      "\"-6,125\"\n"},
       {"colon.txt", "# columns: x y z\n" + rows},
       {"colon_id.txt", "# columns: id x y z\n" + numbered},
       {"este.csv", "Punto;Norte;Este;Cota\n7;-2,25;1,5;3000\n8;5;4,5;-6,125\n"},
       {"comments.txt",
        "# made by a scanner\n# at noon, 12:00\n# x y z\n" + rows + "# the end\n"}});
  for (const std::string title : {"made by hand", "a b c", "Scan 12", "C1 C2 C3"}) {
    const Geometry guessed = read("a.txt", title + "\n1 2 3\n");
    ASSERT_EQ(1u, guessed.assumed.size()) << title;
    EXPECT_NE(std::string::npos, guessed.assumed[0].find(title));
    EXPECT_NE(std::string::npos, guessed.assumed[0].find("line 1"));
  }
  EXPECT_EQ(1u, read("a.txt", "# id lat lon h\n1 2 3 4\n").assumed.size());
  EXPECT_EQ(0u, read("a.txt", "# made by hand\n1 2 3\n").assumed.size());
  EXPECT_NE(
      std::string::npos,
      refusal("a.csv", "id,x,y\n1,2,3\n").find("line 1: names 'x' and 'y' alone"));
  EXPECT_NE("", refusal("a.csv", "lat,lon,height\n1,2,3\n"));
  EXPECT_NE(
      std::string::npos,
      refusal("a.asc", "ncols 3\nnrows 2\n1 2 3\n4 5 6\n").find("grid of heights"));
}

TEST_F(ForeignText, WhatColumnsMean)
{
  // the rotation turns normals, wherever they stand, and nothing else
  for (const auto& [name, content] : Files{
           {"a.txt", "//X Y Z R G B Nx Ny Nz\n1 2 3 255 128 0 1 0 0\n"},
           {"b.csv", "x,y,z,nx,ny,nz,red,green,blue\n1,2,3,1,0,0,255,128,0\n"},
           {"c.csv", "NormalX;NormalY;NormalZ;R;G;B;X;Y;Z\n1;0;0;255;128;0;1;2;3\n"},
           {"d.txt", "x y z normal_x normal_y normal_z r g b\n1 2 3 1 0 0 255 128 0\n"},
           {"e.csv", "Points:0,Points:1,Points:2,Normals:0,Normals:1,Normals:2,RGB:0,"
                     "RGB:1,RGB:2\n1,2,3,1,0,0,255,128,0\n"}}) {
    SCOPED_TRACE(content);
    const Geometry turned = readGeometry(
        write("again_" + name, transformed(read(name, content), quarterTurn())));
    expectEqual({{6, 22, 36}}, positionsOf(turned), 0.0);
    expectEqual({{0, 1, 0}}, normalsOf(turned), 1e-15);
    const auto* rgb = findField(turned.cloud, "rgb");
    ASSERT_TRUE(rgb);
    EXPECT_EQ((std::array<std::uint8_t, 4>{255, 128, 0, 0}),
              getColour(*rgb, turned.cloud.data.data()));
  }
  // columns keep their names and numbers
  const Geometry named =
      read("i.csv", "x,y,z,Scalar field,Intensity [dB],x\n1,2,3,0.1,-7,9\n");
  EXPECT_EQ("x,y,z,Scalar_field,Intensity_[dB],x_2\n6,22,36,0.1,-7,9\n",
            contentOf(write("j.csv", transformed(named, quarterTurn()))));
  // colours that are no bytes stay numbers
  EXPECT_EQ(0.5, numberAt(read("k.txt", "x y z r g b\n1 2 3 0.5 1 0\n"), "red", 0));
}

TEST_F(ForeignText, NormalsWithoutNames)
{
  // some could not be estimated
  EXPECT_EQ(3u,
            normalsOf(read("a.xyz", "1 2 3 1 0 0\n4 5 6 0 0 0\n7 8 9 0 1 0\n")).size());
  EXPECT_EQ(1u, normalsOf(read("b.xyz", "1 2 3 9 8 7 0.6 0 0.8\n")).size());
  EXPECT_EQ(0u,
            normalsOf(read("c.xyz", "1 2 3 0 0 0\n4 5 6 0 0 0\n7 8 9 0 1 0\n")).size());
  EXPECT_EQ(0u, normalsOf(read("d.xyz", "1 2 3 9 0 0 1\n4 5 6 9 0 1 0\n")).size());
  EXPECT_EQ(0u, normalsOf(read("e.xyz", "1 2 3 1 0 0\n4 5 6 1 1 0\n")).size());
}

TEST_F(ForeignText, ColumnsOfWordsAreLeftOut)
{
  for (const std::string content :
       {"name,x,y,z,kind\ntree 1,1.5,-2.25,3000,oak\ntree 2,4.5,5,-6.125,\n",
        "name,x,y,z,kind\n,1.5,-2.25,3000,\n\"a, b\",4.5,5,-6.125,oak\n"}) {
    const Geometry geometry = read("a.csv", content);
    expectEqual(points_, positionsOf(geometry), 0.0);
    EXPECT_EQ((std::vector<std::string>{"column 'name'", "column 'kind'"}),
              geometry.left_out);
  }
  EXPECT_EQ(Names{"column 'column_4'"},
            read("a.txt", "1 2 3 tree\n4 5 6 house\n").left_out);
  // prose is no table, however much there is of it
  std::string prose;
  for (int i = 0; i < 100000; ++i)
    prose += "three more words\n";
  EXPECT_NE(std::string::npos, refusal("a.txt", prose).find("line 101"));
  // words among numbers are wrong in a point, and told of elsewhere
  EXPECT_NE(std::string::npos,
            refusal("a.csv", "x,y,z,i\n1,2,3,4\n1,2,four,4\n").find("line 3: 'four'"));
  EXPECT_EQ(Names{"column 'i' (line 3: 'P3' is not a number)"},
            read("a.csv", "x,y,z,i\n1,2,3,4\n1,2,3,P3\n").left_out);
}

TEST_F(ForeignText, TitlesThatNameFewerColumns)
{
  // a column that counts the rows often has no name
  const std::string rows = "1 1.5 -2.25 3000\n2 4.5 5 -6.125\n";
  expectPoints(
      {{"tabs.tsv", "\tx\ty\tz\n0\t1.5\t-2.25\t3000\n1\t4.5\t5\t-6.125\n"},
       {"r.txt", "x y z\n" + rows},
       {"frame.txt", "     x     y      z\n0  1.5 -2.25 3000\n1 4.5 5 -6.125\n"},
       {"r.csv", "\"x\",\"y\",\"z\"\n\"a\",1.5,-2.25,3000\n\"b\",4.5,5,-6.125\n"},
       {"pandas.csv", ",0,1,2\n0,1.5,-2.25,3000\n1,4.5,5,-6.125\n"},
       {"names.txt", "x y z\nP1 1.5 -2.25 3000\nP2 4.5 5 -6.125\n"}});
  EXPECT_EQ(1u, read("a.txt", "x y z\n" + rows).assumed.size());
  // else they are the first columns, which is told, if they can be
  const Geometry first = read("a.txt", "x y z\n1.5 2 3 7\n");
  expectEqual({{1.5, 2, 3}}, positionsOf(first), 0.0);
  EXPECT_NE(std::string::npos, first.assumed.at(0).find("line 1 names 3 of 4 columns"));
  for (const std::string content :
       {"x,y,z\n1,5,2,5,3,5\n", "id,x,y,z\n7,1,2,3,4\n8,2,3,4,5\n", "x,y,z,i\n1,2,3\n"})
    EXPECT_NE(std::string::npos, refusal("a.csv", content).find("line 1: names "))
        << content;
}

TEST_F(ForeignText, NumbersBeforePoints)
{
  const std::string file = "7,4.5,5.5,6.5,TREE\n8,1.5,2,3,TREE\n";
  for (const std::string& content : {file, std::string("0 0 1.5 2 3\n0 1 4 5 6\n")}) {
    const auto assumed = read("a.txt", content).assumed;
    ASSERT_EQ(1u, assumed.size()) << content;
    EXPECT_NE(std::string::npos, assumed[0].find("column 1 looks like numbers"));
  }
  EXPECT_EQ(0u, read("a.txt", "0 0 0 1\n0 0 1 2\n1 0 0 3\n").assumed.size()); // voxels
  EXPECT_EQ(0u, read("a.txt", "id x y z\n1 1.5 2.5 3.5\n2 1 2 3\n").assumed.size());
  // numbers of columns are no point
  const Geometry numbered = read("a.csv", "0,1,2\n1.5,2.5,3.5\n");
  expectEqual({{1.5, 2.5, 3.5}}, positionsOf(numbered), 0.0);
  EXPECT_EQ(1u, numbered.assumed.size());
  for (const std::string name : {"b.xyz", "b.pts"}) { // but of the tool they may be one
    Geometry points = read("a.csv", "x,y,z\n0,1,2\n1.5,2.5,3.5\n");
    points.header_mark.reset(); // as if of another format
    expectEqual(positionsOf(points), positionsOf(readGeometry(write(name, points))),
                0.0);
  }
  expectEqual({{0, 1, 2}, {1, 2, 3}}, positionsOf(read("a.csv", "0,1,2\n1,2,3\n")),
              0.0);
}

TEST_F(ForeignText, NamesOfTwoKinds)
{
  expectEqual({{3, 4, 5}},
              positionsOf(read("a.csv", "x,y,Easting,Northing,Elevation\n1,2,3,4,5\n")),
              0.0);
  expectEqual({{4, 5, 6}},
              positionsOf(read("a.txt", "v_x v_y v_z x y z\n1 2 3 4 5 6\n")), 0.0);
  for (const std::string title :
       {"range azimuth elevation x y", "v_x v_y v_z x y", "a b x_coord y z"})
    EXPECT_NE("", refusal("a.txt", title + "\n1 2 3 4 5\n")) << title;
  // what is no title is told of
  for (const std::string content :
       {"x1,y1,z1,x2,y2,z2,x3,y3,z3\n1,2,3,4,5,6,7,8,9\n",
        "# x east y north z up\n1 2 3 10 20 30\n",
        "# X right, Y up, Z forward\n1 2 3 0 0 1\n", "Church north facade\n1 2 3\n"}) {
    const Geometry points = read("a.txt", content);
    expectEqual({{1, 2, 3}}, positionsOf(points), 0.0);
    EXPECT_EQ(1u, points.assumed.size()) << content;
  }
}

TEST_F(ForeignText, MarksOfCommentsInRows)
{
  const Geometry coloured =
      read("a.csv", "id,x,y,z,color,label\n7,1,2,3,#ff0000,5\n8,2,3,4,#00ff00,6\n");
  expectEqual({{1, 2, 3}, {2, 3, 4}}, positionsOf(coloured), 0.0);
  EXPECT_EQ(5.0, numberAt(coloured, "label", 0));
  expectEqual({{1, 2, 3}}, positionsOf(read("a.txt", "name x y z\nP#1 1 2 3 # 4, 5\n")),
              0.0);
  for (const std::string rows : {"#1,1,2,3\n2,2,3,4\n", "2,2,3,4\n#1,1,2,3\n"}) {
    const Geometry marked = read("a.csv", "id,x,y,z\n" + rows);
    expectEqual({{2, 3, 4}}, positionsOf(marked), 0.0);
    ASSERT_EQ(1u, marked.assumed.size());
    EXPECT_NE(std::string::npos, marked.assumed[0].find("starts with #"));
  }
}

TEST_F(ForeignText, WhatIsNoRow)
{
  expectPoints(
      {{"names.csv", "P1,1.5,-2.25,3000\nP2,4.5,5,-6.125\n"},
       {"markers.txt", "#Label,X/East,Y/North,Z/Altitude\npoint 0,1.5,-2.25,3000\n"
                       "point 1,4.5,5,-6.125\n"},
       {"german.csv", "X-Koordinate;Y-Koordinate;Z-Koordinate\n1,5;-2,25;3000\n"
                      "4,5;5;-6,125\n"},
       {"empty.tsv", "id\tx\ty\tz\n1\t1.5\t-2.25\t3000\n2\t\t\t\n"
                     "3\t4.5\t5\t-6.125\n"}});
  for (const std::string content : {"1|2|3\n4|5|6\n", "[1 2 3]\n", "#1,2,3,4\n"})
    EXPECT_NE(std::string::npos,
              refusal("a.txt", content).find("line 1 ('" + content.substr(0, 5)))
        << content;
}

TEST_F(ForeignText, LongTitlesCostNoTime)
{
  std::string line = "a";
  for (int i = 0; i < 100000; ++i)
    line += " 1";
  std::string file;
  for (int i = 0; i < 50; ++i)
    file += line + '\n';
  expectEqual({{1, 2, 3}}, positionsOf(read("a.txt", file + "1 2 3\n")), 0.0);
}

TEST_F(ForeignText, BlocksWithCounts)
{
  expectPoints(
      {{"a.pts", "1\n1.5 -2.25 3000 -1042 90 80 70\n1\n4.5 5 -6.125 3 1 2 3\n"},
       {"b.pts", "2\n1.5 -2.25 3000 0.5\n4.5 5 -6.125 0.25\n"},
       {"c.pts", "2\n1.5 -2.25 3000 1 2 3\n4.5 5 -6.125 4 5 6\n"},
       {"d.pts", "2\r\n1.5 -2.25 3000 1 0 0\r\n4.5 5 -6.125 0 1 0\r\n"},
       {"e.pts", "1\n1.5 -2.25 3000\n0\n1\n4.5 5 -6.125\n"}});
  const Geometry points = read("a.pts", "1\n1.5 -2.25 3000 -1042 90 80 70\n");
  EXPECT_EQ(-1042, numberAt(points, "intensity", 0));
  EXPECT_TRUE(findField(points.cloud, "rgb"));
  EXPECT_EQ("1\n1.5 -2.25 3000 -1042 90 80 70\n", contentOf(write("b.pts", points)));
  EXPECT_NE("", refusal("a.pts", "1\n1 2 3\n2\n1 2 3\n"));
  EXPECT_NE("", refusal("a.pts", "2\n1 2 3\n1\n1 2 3\n"));
  EXPECT_NE("", refusal("a.pts", "-1\n1 2 3\n"));
  EXPECT_NE("", refusal("a.pts", "1.5\n1 2 3\n"));
}

TEST_F(ForeignText, PTSReadsWhatItWrites)
{
  // a point and its normal, with intensity, colour, or both
  for (const std::string row :
       {"1.5 2 3", "1.5 2 3 7", "1.5 2 3 9 8 7", "1.5 2 3 7 9 8 7", "1.5 2 3 0 0.6 0.8",
        "1.5 2 3 7 0 0.6 0.8", "1.5 2 3 9 8 7 0 0 1", "1.5 2 3 7 9 8 7 0 0.6 0.8"}) {
    const std::string file = "1\n" + row + '\n';
    const Geometry points = read("a.pts", file);
    EXPECT_EQ(Names{}, lossesOf(points, FileFormat::PTS)) << row;
    EXPECT_EQ(file, contentOf(write("b.pts", points)));
    for (const auto& field : points.cloud.fields)
      EXPECT_NE(0u, field.name.find("column_")) << row;
  }
  // what it would not know again is not written, which is told
  const Geometry other = read("a.txt", "x y z column_4\n1 2 3 9\n");
  EXPECT_EQ(Names{"field 'column_4'"}, lossesOf(other, FileFormat::PTS));
  EXPECT_EQ("1\n1 2 3\n", contentOf(write("b.pts", other)));
  const Geometry longer = read("a.txt", "x y z nx ny nz\n1 2 3 0 0 2\n");
  EXPECT_EQ(3u, lossesOf(longer, FileFormat::PTS).size());
  EXPECT_EQ("1\n1 2 3\n", contentOf(write("b.pts", longer)));
}

TEST_F(ForeignText, ScansOfPTX)
{
  // a quarter turn about z, as rows that are multiplied from the left
  const std::string identity =
      "0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n";
  const std::string turn =
      "10 20 30\n0 1 0\n-1 0 0\n0 0 1\n0 1 0 0\n-1 0 0 0\n0 0 1 0\n10 20 30 1\n";
  const std::string scans = "1\n3\n" + identity + "1 2 3 0.5 9 8 7\n0 0 0 0.5 0 0 0\n" +
                            "4 5 6 0.25 1 2 3\n2\n1\n" + turn +
                            "1 2 3 0.75 4 5 6\n0 0 0 0 0 0 0\n";
  const Points expected{{1, 2, 3}, {4, 5, 6}, {8, 21, 33}};
  for (const std::string name : {"a.ptx", "a.txt", "a.xyz", "scan"}) {
    const Geometry points = read(name, scans);
    expectEqual(expected, positionsOf(points), 0.0);
    EXPECT_EQ(0.75, numberAt(points, "intensity", 2));
    EXPECT_TRUE(findField(points.cloud, "rgb"));
    ASSERT_EQ(1u, points.assumed.size());
    EXPECT_NE(std::string::npos, points.assumed[0].find("2 places"));
  }
  const std::string point = "1 2 3 0.5\n";
  EXPECT_EQ(
      Names{"the grids of the scans"},
      read("a.ptx", "2\n2\n" + identity + point + point + point + point).left_out);
  // points at 0 0 0 are points, too, once they have been placed
  expectEqual({{0, 0, 0}, {4512345.125, 0.5, -3}},
              positionsOf(readGeometry(
                  write("c.ptx", read("c.xyz", "0 0 0\n4512345.125 0.5 -3\n")))),
              0.0);
  const Geometry again = readGeometry(write("b.ptx", read("a.ptx", scans)));
  expectEqual(expected, positionsOf(again), 0.0);
  EXPECT_EQ(0.75, numberAt(again, "intensity", 2));
  EXPECT_EQ((std::array<std::uint8_t, 4>{1, 2, 3, 0}),
            getColour(*findField(again.cloud, "rgb"),
                      &again.cloud.data[again.cloud.point_step]));
  expectEqual({{1, 2, 3}},
              positionsOf(read("a.ptx", "1\r\n1\r\n" + identity + "1 2 3 0.5\r\n")),
              0.0);

  EXPECT_NE("", refusal("a.ptx", scans.substr(0, scans.size() - 16)));
  EXPECT_NE("", refusal("a.ptx", "2\n1\n" + identity + "1 2 3 0.5\n"));
  EXPECT_NE("", refusal("a.ptx", "1\n1\n" + identity + "1 2 3\n"));
  EXPECT_NE("", refusal("a.ptx", "1\n1\n" + identity + "0 0 0 0.5\n"));
  EXPECT_NE("", refusal("a.ptx", "2\n1\n" + identity + "1 2 3 0\n1 2 3 0 1 2 3\n"));
  EXPECT_NE("", refusal("a.ptx", "1\n1\n" + identity + "1 2 3 0 1 2 300\n"));
  std::string transposed = turn;
  transposed.replace(transposed.find("0 1 0 0"), 7, "0 1 0 9");
  EXPECT_NE(std::string::npos,
            refusal("a.ptx", "1\n1\n" + transposed + "1 2 3 0\n").find("line 7"));
}

TEST_F(ForeignText, WrittenAsTheFormatHasIt)
{
  const Geometry cloud = fieldsOfAllKinds();
  for (const std::string name : {"a.xyz", "a.csv", "a.txt", "a.asc"}) {
    SCOPED_TRACE(name);
    const Geometry again = readGeometry(write(name, cloud));
    EXPECT_EQ(5u, numberOfPoints(again.cloud)); // one has no place
    EXPECT_EQ(1005, numberAt(again, "label", 4));
    EXPECT_EQ(0.125, numberAt(again, "curvature", 1));
    EXPECT_EQ(1.0, numberAt(again, "normal_x", 0));
    EXPECT_EQ(254, getColour(*findField(again.cloud, "rgb"),
                             &again.cloud.data[again.cloud.point_step])[2]);
  }
  // names stand above normals that only their names tell
  const Geometry longer = read("b.txt", "x y z nx ny nz\n1 2 3 0 0 2\n");
  EXPECT_EQ(1u, normalsOf(readGeometry(write("b.xyz", longer))).size());
  // whole numbers of 64 bits keep their digits
  Geometry timed;
  for (const char* name : {"x", "y", "z"})
    addField(timed.cloud, name, pcl::PCLPointField::FLOAT64);
  addField(timed.cloud, "time", pcl::PCLPointField::INT64);
  setNumberOfPoints(timed.cloud, 1);
  const std::int64_t time = 1588291200123456789;
  memcpy(&timed.cloud.data[24], &time, sizeof time);
  EXPECT_EQ("x,y,z,time\n0,0,0,1588291200123456789\n",
            contentOf(write("b.csv", timed)));
  EXPECT_EQ(0u, contentOf(path("a.csv")).find("x,y,z,"));
  EXPECT_EQ(0u, contentOf(path("a.xyz")).find("# x y z "));
}
