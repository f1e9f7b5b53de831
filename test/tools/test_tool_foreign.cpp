/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * The command line tool on files that other people's programs wrote: a folder with a
 * list of what a careful tool does with each.
 */

#include "io/losses.h"
#include "io/read_geometry.h"
#include "tool_path.h"

#include "own_folder.h"

#include <Eigen/LU>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <sys/wait.h>

namespace {

/** A row of the list. */
struct Row {
  std::string file, trait, expected, statuses;
  std::size_t points;
  std::string pose;
};

/** The cells of a line, of which some are quoted. */
std::vector<std::string>
cellsOf(const std::string& line)
{
  std::vector<std::string> cells{""};
  bool is_quoted = false;
  for (const char c : line)
    if (c == '"')
      is_quoted = !is_quoted;
    else if (c == ',' && !is_quoted)
      cells.emplace_back();
    else if (c != '\r')
      cells.back() += c;
  return cells;
}

std::vector<Row>
rowsOf(const std::filesystem::path& list)
{
  std::vector<Row> rows;
  std::ifstream stream(list);
  std::string line;
  std::getline(stream, line); // the names of the columns
  while (std::getline(stream, line)) {
    const auto cells = cellsOf(line);
    if (cells.size() == 6)
      rows.push_back({cells[0], cells[1], cells[2], cells[3],
                      static_cast<std::size_t>(std::stoul(cells[4])), cells[5]});
  }
  return rows;
}

Eigen::Matrix4d
matrixIn(const std::filesystem::path& path)
{
  std::ifstream stream(path);
  Eigen::Matrix4d matrix;
  for (int i = 0; i < 16; ++i)
    stream >> matrix(i / 4, i % 4);
  return matrix;
}

std::size_t
finitePoints(const tool::Points& points)
{
  return static_cast<std::size_t>(
      std::count_if(points.begin(), points.end(),
                    [](const auto& point) { return point.allFinite(); }));
}

class ForeignFiles : public kss_test::OwnFolder {
protected:
  int
  run(const std::string& arguments) const
  {
    const std::string command = "cd '" + directory_.string() + "' && '" +
                                kss_test::toolPath() + "' --device host " + arguments +
                                " > output 2> errors";
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  std::string
  content(const std::string& name) const
  {
    std::ostringstream content;
    content << std::ifstream(path(name)).rdbuf();
    return content.str();
  }
};

TEST_F(ForeignFiles, DataForDevelopment)
{
  const char* data = std::getenv("PCL_KSS_ICP_TEST_DATA");
  const auto folder = std::filesystem::path(data ? data : "") / "files";
  if (!data || !std::filesystem::exists(folder / "expected.csv"))
    GTEST_SKIP() << "Set PCL_KSS_ICP_TEST_DATA to a folder with files of others";
  const auto rows = rowsOf(folder / "expected.csv");
  EXPECT_GT(rows.size(), 30u);
  for (const auto& row : rows) {
    SCOPED_TRACE(row.file + ": " + row.trait + ": " + row.expected);
    const std::string source = (folder / row.file).string();
    const std::string aligned =
        "aligned" + std::filesystem::path(row.file).extension().string();
    // a coarse model of the object has about its size
    const bool is_coarse = row.file == "manycorners.ply";
    const int status = run(std::string(is_coarse ? "" : "--rigid ") + source + ' ' +
                           (folder / "target.pcd").string() + ' ' + aligned +
                           " --transform transform.txt --report report.json");
    ASSERT_EQ(0, status) << content("errors");

    // the points come where the pose that is known brings them
    const tool::Geometry before = tool::readGeometry(source);
    const tool::Geometry after = tool::readGeometry(path(aligned));
    EXPECT_EQ(row.points, finitePoints(tool::positionsOf(before)));
    EXPECT_EQ(row.points, finitePoints(tool::positionsOf(after)));
    EXPECT_EQ(before.faces.size(), after.faces.size());
    const Eigen::Affine3d known(matrixIn(folder / row.pose));
    const Eigen::Affine3d found(matrixIn(path("transform.txt")));
    const Eigen::Vector3d center = tool::boundingBox(before).center();
    EXPECT_LT((known * center - found * center).norm(), is_coarse ? 5.0 : 0.1);

    // what is written is what the transformation says, to the millimetre
    const auto from = tool::positionsOf(before), to = tool::positionsOf(after);
    ASSERT_EQ(from.size(), to.size());
    for (std::size_t i = 0; i < from.size(); ++i)
      if (from[i].allFinite()) {
        ASSERT_LT((found * from[i] - to[i]).norm(), 1e-3) << i;
      }
    const auto normals = tool::normalsOf(before), turned = tool::normalsOf(after);
    if (row.expected.find("normals") != std::string::npos) {
      EXPECT_EQ(from.size(), normals.size());
    }
    if (row.expected.find("left out") != std::string::npos) {
      EXPECT_NE(std::string::npos, content("errors").find("left out"))
          << content("errors");
    }
    ASSERT_EQ(normals.size(), turned.size());
    for (std::size_t i = 0; i < normals.size(); ++i) {
      ASSERT_LT((found.linear() * normals[i] - turned[i]).norm(), 1e-4) << i;
    }
    for (std::size_t i = 0; i < before.faces.size(); ++i)
      ASSERT_EQ(before.faces[i].vertices, after.faces[i].vertices) << i;

    // nothing is lost in silence
    const auto losses = tool::lossesOf(before, tool::fileFormatOf(aligned));
    for (const auto& loss : losses)
      EXPECT_NE(std::string::npos, content("errors").find(loss)) << loss;
    EXPECT_EQ(losses.empty() && before.assumed.empty(), content("errors").empty())
        << content("errors");
    EXPECT_EQ(0, run("--rigid " + aligned + ' ' + (folder / "target.pcd").string() +
                     (is_coarse ? " --confidence 0" : "")))
        << content("errors");
  }
}

} // namespace
