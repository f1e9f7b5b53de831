/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "own_folder.h"

#include <nlohmann/json.hpp>

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <random>
#include <set>
#include <sstream>

#include <sys/wait.h>
#include <unistd.h>

/** \file
 * Runs the command line tool, whose path is the last argument of this program.
 */

namespace {

std::string tool_path;

using Points = std::vector<Eigen::Vector3d>;

constexpr int blob_points = 1500;

/** A point of a closed surface without any symmetry. */
Eigen::Vector3d
onBlob(double z, double angle)
{
  const double radius = std::sqrt(1.0 - z * z);
  const Eigen::Vector3d p(radius * std::cos(angle), radius * std::sin(angle), z);
  return p * (1.0 + 0.5 * p.x() * p.y() + 0.4 * std::pow(p.z(), 3) + 0.3 * p.x());
}

/** Random points of it: ICP would lock into the regular pattern of a lattice, a few
 * points beside the right place. */
Points
blob()
{
  std::mt19937 random(1);
  const auto uniform = [&] { return random() / 4294967296.0; };
  Points points;
  for (int i = 0; i < blob_points; ++i) {
    const double z = 2.0 * uniform() - 1.0;
    points.push_back(onBlob(z, 2.0 * M_PI * uniform()));
  }
  return points;
}

/** A lattice of it: the points 13 and 21 places on are neighbours. */
Points
latticeOfBlob()
{
  Points points;
  for (int i = 0; i < blob_points; ++i)
    points.push_back(
        onBlob(1.0 - (2.0 * i + 1.0) / blob_points, i * M_PI * (3.0 - std::sqrt(5.0))));
  return points;
}

Points
moved(const Points& points, const Eigen::Affine3d& transform)
{
  Points result;
  for (const auto& point : points)
    result.push_back(transform * point);
  return result;
}

/** A large rotation, a scale, and a place in the world. */
Eigen::Affine3d
similarity(double scale)
{
  return Eigen::Translation3d(4512345.678, 512345.678, 1234.5) *
         Eigen::AngleAxisd(2.2, Eigen::Vector3d(1, -2, 3).normalized()) *
         Eigen::Scaling(scale);
}

double
largestDistance(const Points& a, const Points& b)
{
  EXPECT_EQ(a.size(), b.size());
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size() && i < b.size(); ++i)
    largest = std::max(largest, (a[i] - b[i]).norm());
  return largest;
}

std::string
contentOf(const std::filesystem::path& path)
{
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream content;
  content << stream.rdbuf();
  return content.str();
}

struct Outcome {
  int status;
  std::string output, errors;
};

class ToolRun : public kss_test::OwnFolder {
protected:
  using OwnFolder::write;

  void
  SetUp() override
  {
    std::filesystem::create_directories(directory_ / "console");
    // a source near the origin, a target far away
    write("source.xyz", blob());
    write("target.xyz", moved(blob(), similarity(2.5)));
    write("rigid.xyz", moved(blob(), similarity(1.0)));
    write("line.xyz", Points{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}});
    write("triangle.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
    write("short.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n");
    write("binary.xyz", "1 2 3\n4 \x1b[31m\v\a\r 6\n");
    std::filesystem::create_directory(directory_ / "a_directory.ply");
  }

  void
  write(const std::string& name, const Points& points) const
  {
    std::ofstream stream(directory_ / name);
    stream.precision(17);
    for (const auto& point : points)
      stream << point.x() << ' ' << point.y() << ' ' << point.z() << '\n';
  }

  Points
  read(const std::string& name) const
  {
    std::ifstream stream(directory_ / name);
    Points points;
    for (Eigen::Vector3d p; stream >> p.x() >> p.y() >> p.z();)
      points.push_back(p);
    return points;
  }

  std::filesystem::path
  path(const std::string& name) const
  {
    return directory_ / name;
  }

  std::string
  content(const std::string& name) const
  {
    return contentOf(directory_ / name);
  }

  bool
  exists(const std::string& name) const
  {
    return std::filesystem::exists(directory_ / name);
  }

  /** Run the tool in the directory with its files. */
  Outcome
  run(const std::string& arguments) const
  {
    const std::string command = "cd '" + directory_.string() + "' && '" + tool_path +
                                "' " + arguments +
                                " > console/output 2> console/errors";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content("console/output"),
            content("console/errors")};
  }

  /** Run a small search on the CPU, which is quick and the same everywhere. */
  Outcome
  search(const std::string& arguments) const
  {
    return run("--device host --points 300 " + arguments);
  }

private:
};

Eigen::Matrix4d
toMatrix(const nlohmann::json& rows)
{
  Eigen::Matrix4d matrix;
  EXPECT_EQ(4u, rows.size());
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      matrix(i, j) = rows.at(i).at(j).get<double>();
  return matrix;
}

} // namespace

TEST_F(ToolRun, RegistersAcrossScaleAndWorld)
{
  const Outcome result =
      search("source.xyz target.xyz aligned.xyz --transform t.txt --report r.json");
  ASSERT_EQ(0, result.status) << result.errors;
  EXPECT_EQ("", result.errors);
  for (const char* word : {"Transformation", "Scale", "Overlap", "Sure", "host"})
    EXPECT_NE(std::string::npos, result.output.find(word)) << word;

  // The scale comes from the search alone, which is the coarser part.
  EXPECT_LT(largestDistance(read("target.xyz"), read("aligned.xyz")), 2.5 * 0.1);

  Eigen::Matrix4d written;
  std::istringstream numbers(content("t.txt"));
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      ASSERT_TRUE(numbers >> written(i, j));
  EXPECT_EQ("", std::string(std::istreambuf_iterator<char>(numbers >> std::ws), {}));
  EXPECT_LT(
      largestDistance(moved(blob(), Eigen::Affine3d(written)), read("aligned.xyz")),
      1e-8);

  const auto report = nlohmann::json::parse(content("r.json"));
  EXPECT_EQ(written, toMatrix(report.at("transformation")));
  EXPECT_EQ(true, report.at("converged"));
  EXPECT_FALSE(report.contains("reason"));
  EXPECT_NEAR(2.5, report.at("scale").get<double>(), 0.1);
  EXPECT_NEAR(std::cbrt(written.topLeftCorner<3, 3>().determinant()),
              report.at("scale").get<double>(), 1e-9);
  EXPECT_GE(report.at("fitness").get<double>(), 0.0);
  EXPECT_LT(report.at("fitness").get<double>(), 1.0);
  for (const char* key : {"energy", "residual"})
    EXPECT_FALSE(report.contains(key)) << key;
  // the same points on both sides
  EXPECT_EQ("global", report.at("mode"));
  ASSERT_EQ(2u, report.at("overlap").size());
  for (const auto& share : report.at("overlap")) {
    EXPECT_GT(share.get<double>(), 0.9);
    EXPECT_LE(share.get<double>(), 1.0);
  }
  EXPECT_GT(report.at("score").get<double>(), 1.3);
  EXPECT_LE(report.at("score").get<double>(), 2.0);
  EXPECT_GT(report.at("confidence").get<double>(), 0.9);
  EXPECT_LE(report.at("confidence").get<double>(), 1.0);
  EXPECT_EQ(false, report.at("ambiguous"));
  EXPECT_EQ("host", report.at("device"));
  const auto& alternatives = report.at("alternatives");
  ASSERT_GE(alternatives.size(), 1u);
  EXPECT_EQ(written, toMatrix(alternatives[0].at("transformation")));
  EXPECT_EQ(report.at("score"), alternatives[0].at("score"));
  EXPECT_EQ(report.at("overlap"), alternatives[0].at("overlap"));
  for (std::size_t i = 1; i < alternatives.size(); ++i) {
    EXPECT_LE(alternatives[i].at("score"), alternatives[i - 1].at("score"));
    EXPECT_EQ(2u, alternatives[i].at("overlap").size());
    // in the coordinates of the files, too
    EXPECT_GT(toMatrix(alternatives[i].at("transformation"))(0, 3), 4e6);
  }
  double sum = 0.0;
  for (const auto& [stage, seconds] : report.at("seconds").items())
    if (stage != "total")
      sum += seconds.get<double>();
  EXPECT_GT(report.at("seconds").size(), 2u);
  EXPECT_GT(sum, 0.0);
  EXPECT_LE(sum, report.at("seconds").at("total").get<double>());
}

TEST_F(ToolRun, KeepsTheScaleAndAllDigitsIfRigid)
{
  const Outcome result =
      search("--rigid source.xyz rigid.xyz aligned.xyz --report r.json");
  ASSERT_EQ(0, result.status) << result.errors;
  // Floats would be good to half a unit there.
  EXPECT_LT(largestDistance(read("rigid.xyz"), read("aligned.xyz")), 1e-3);
  const auto report = nlohmann::json::parse(content("r.json"));
  EXPECT_NEAR(1.0, report.at("scale").get<double>(), 1e-9);
}

TEST_F(ToolRun, TakesTheModeTheScalesAndThePapersSettings)
{
  // seven tenths of the blob, along x
  Points part;
  for (const auto& point : blob())
    if (point.x() > -0.3)
      part.push_back(point);
  write("part.xyz", part);
  for (const std::string mode : {"auto", "partial"}) {
    const Outcome result =
        search("--mode " + mode + " --rigid part.xyz rigid.xyz a.xyz --report r.json");
    ASSERT_EQ(0, result.status) << result.errors;
    EXPECT_LT(largestDistance(moved(part, similarity(1.0)), read("a.xyz")), 0.05);
    const auto report = nlohmann::json::parse(content("r.json"));
    EXPECT_EQ("partial", report.at("mode"));
    EXPECT_GT(report.at("overlap")[0].get<double>(), 0.95);
    EXPECT_LT(report.at("overlap")[1].get<double>(), 0.95);
  }
  ASSERT_EQ(
      0, search("--scale-range 2.4 2.6 source.xyz target.xyz --report r.json").status);
  EXPECT_NEAR(2.5, nlohmann::json::parse(content("r.json")).at("scale").get<double>(),
              0.1);
  // out of the truth's reach
  search("--scale-range 3.5 4 source.xyz target.xyz --report r.json");
  const auto report = nlohmann::json::parse(content("r.json"));
  EXPECT_GE(report.at("scale").get<double>(), 3.5 - 1e-3);
  EXPECT_LE(report.at("scale").get<double>(), 4.0 + 1e-3);
  const Outcome paper =
      search("--paper --no-cleaning source.xyz target.xyz a.xyz --report r.json");
  ASSERT_EQ(0, paper.status) << paper.errors;
  EXPECT_LT(largestDistance(read("target.xyz"), read("a.xyz")), 2.5 * 0.1);
  EXPECT_EQ("global", nlohmann::json::parse(content("r.json")).at("mode"));
}

TEST_F(ToolRun, TakesTheSettingsOfExperts)
{
  const auto searchWith = [&](const std::string& options) {
    const Outcome result =
        search(options + " --mode global source.xyz target.xyz a.xyz --report r.json");
    EXPECT_EQ(0, result.status) << result.errors;
    EXPECT_LT(largestDistance(read("target.xyz"), read("a.xyz")), 2.5 * 0.1);
    const auto report = nlohmann::json::parse(content("r.json"));
    const std::string searched = report.at("search");
    EXPECT_NE(std::string::npos, result.output.find("search " + searched));
    return searched;
  };
  EXPECT_EQ("screened", searchWith("--rotations even:1000 --search-points 64"));
  EXPECT_EQ("screened", searchWith("--rotations even --kernel 4 --icp-points 0"));
  EXPECT_EQ("screened", searchWith("--angle-step 45 --density paper"));
  EXPECT_EQ("exact", searchWith("--search exact --additional-process 0.5"));
  // what screening is not for
  EXPECT_EQ("exact", searchWith("--energy hausdorff"));
  EXPECT_EQ("exact", searchWith("--search screened --centers paper"));
  // nothing is that sure
  const Outcome unsure = search("--confidence 1 --rigid source.xyz rigid.xyz");
  EXPECT_EQ(1, unsure.status);
  // words override the paper's
  EXPECT_EQ("screened",
            searchWith("--paper --search screened --energy mean --centers spread"));
}

TEST_F(ToolRun, MovesMeshes)
{
  // strips of neighbours are enough to be sampled
  const Points points = latticeOfBlob();
  std::ostringstream off;
  off.precision(17);
  off << "OFF\n" << points.size() << ' ' << points.size() - 21 << " 0\n";
  for (const auto& point : points)
    off << point.transpose() << '\n';
  for (std::size_t i = 0; i + 21 < points.size(); ++i)
    off << "3 " << i << ' ' << i + 13 << ' ' << i + 21 << '\n';
  write("mesh.off", off.str());
  for (const std::string aligned : {"aligned.off", "aligned.stl", "aligned.obj"}) {
    const Outcome result =
        search("mesh.off target.xyz " + aligned + " --samples 3000 --quiet");
    ASSERT_EQ(0, result.status) << result.errors;
    EXPECT_EQ("", result.output + result.errors);
  }
  EXPECT_EQ(0u, content("aligned.off").find("OFF\n1500 1479 0\n"));
  EXPECT_EQ(84u + 50u * 1479u, content("aligned.stl").size());
  EXPECT_NE(std::string::npos, content("aligned.obj").find("\nf 1 14 22\n"));
}

TEST_F(ToolRun, SaysWhyItIsNotRegistered)
{
  const Outcome result =
      search("line.xyz target.xyz aligned.ply --transform t.txt --report r.json");
  EXPECT_EQ(1, result.status);
  EXPECT_EQ("", result.output);
  EXPECT_EQ(0u, result.errors.find("pcl_kss_icp: not registered: "));
  EXPECT_EQ(1, std::count(result.errors.begin(), result.errors.end(), '\n'));
  EXPECT_FALSE(exists("aligned.ply"));
  EXPECT_FALSE(exists("t.txt"));
  const auto report = nlohmann::json::parse(content("r.json"));
  EXPECT_EQ(false, report.at("converged"));
  EXPECT_NE("", report.at("reason").get<std::string>());
  for (const char* key :
       {"transformation", "scale", "mode", "overlap", "score", "fitness"})
    EXPECT_TRUE(report.at(key).is_null()) << key;
  EXPECT_LT(report.at("confidence").get<double>(), 1e-3);
  EXPECT_EQ(false, report.at("ambiguous"));
  EXPECT_EQ(0u, report.at("alternatives").size());
  EXPECT_TRUE(report.at("seconds").contains("total"));
}

TEST_F(ToolRun, NamesWhatIsWrong)
{
  const auto before = files();
  const std::vector<std::pair<std::string, std::string>> cases{
      {"", "needs SOURCE"},
      {"source.xyz", "needs SOURCE"},
      {"source.xyz target.xyz a.ply b.ply", "needs SOURCE"},
      {"source.xyz target.xyz --unknown", "--unknown"},
      {"source.xyz target.xyz --rep r.json", "--rep"},
      {"source.xyz target.xyz --report", "--report"},
      {"source.xyz target.xyz --report ''", "--report"},
      {"source.xyz target.xyz ''", "empty"},
      {"source.xyz target.xyz --points 19", "--points 19"},
      {"source.xyz target.xyz --points many", "--points many"},
      {"source.xyz target.xyz --points=-300", "--points -300"},
      {"source.xyz target.xyz --points 300.5", "--points 300.5"},
      {"source.xyz target.xyz --angle-step 0", "--angle-step 0"},
      {"source.xyz target.xyz --angle-step nan", "--angle-step nan"},
      {"source.xyz target.xyz --angle-step 30x", "--angle-step 30x"},
      {"source.xyz target.xyz --rotations odd", "--rotations odd"},
      {"source.xyz target.xyz --rotations even:", "--rotations"},
      {"source.xyz target.xyz --rotations even:0", "--rotations"},
      {"source.xyz target.xyz --mode whole", "--mode whole"},
      {"source.xyz target.xyz --mode", "--mode"},
      {"source.xyz target.xyz --scale-range 1", "--scale-range"},
      {"source.xyz target.xyz --scale-range 2 1", "--scale-range 1"},
      {"source.xyz target.xyz --scale-range 0 1", "--scale-range 0"},
      {"source.xyz target.xyz --scale-range a b", "--scale-range a"},
      {"source.xyz target.xyz --density high", "--density high"},
      {"source.xyz target.xyz --density random", "use uniform or paper"},
      {"source.xyz target.xyz --points 1000001", "20 to 1000000 points"},
      {"source.xyz target.xyz --angle-step 2.9", "3 to 180 degrees"},
      {"source.xyz target.xyz --angle-step 181", "3 to 180 degrees"},
      {"source.xyz target.xyz --rotations euler:9", "--rotations euler:9"},
      {"source.xyz target.xyz --rotations even:100001", "1 to 100000 rotations"},
      {"source.xyz target.xyz --mode whole", "use auto, global, partial or overlap"},
      {"source.xyz target.xyz --scale-range 1e-7 1", "--scale-range 1e-7"},
      {"source.xyz target.xyz --scale-range 1 1e7", "--scale-range 1e7"},
      {"source.xyz target.xyz --centers none", "--centers none"},
      {"source.xyz target.xyz --energy ''", "--energy ''"},
      {"source.xyz target.xyz --search brute", "use screened or exact"},
      {"source.xyz target.xyz --search-points 129", "--search-points 129"},
      {"source.xyz target.xyz --kernel 2", "--kernel 2"},
      {"source.xyz target.xyz --additional-process=-1", "--additional-process -1"},
      {"source.xyz target.xyz --icp-points all", "--icp-points all"},
      {"source.xyz target.xyz --icp-points 4294967296", "--icp-points 4294967296"},
      {"source.xyz target.xyz --confidence 1.1", "--confidence 1.1"},
      {"source.xyz target.xyz --time-limit 0.0009", "0.001 to 1e+09 seconds"},
      {"source.xyz target.xyz --device nonesuch", "--device nonesuch"},
      {"source.xyz target.xyz --device ''", "--device"},
      {"source.xyz target.xyz --threads 2000", "--threads 2000"},
      {"source.xyz target.xyz --samples 1", "--samples 1"},
      {"missing.ply target.xyz", "missing.ply"},
      {"source.xyz missing.xyz", "missing.xyz"},
      {"a_directory.ply target.xyz", "a_directory.ply"},
      {"short.off target.xyz", "short.off"},
      {"binary.xyz target.xyz", "binary.xyz"},
      {"source.las target.xyz", "source.las"},
      {"source.xyz target.xyz aligned.las", "aligned.las"},
      {"source.xyz target.xyz aligned", "aligned"},
      {"source.xyz target.xyz aligned.stl", "aligned.stl"},
      {"source.xyz target.xyz no_directory/aligned.ply", "no_directory/aligned.ply"},
      {"source.xyz target.xyz --transform no_directory/t", "no_directory/t"},
      {"source.xyz target.xyz --report a_directory.ply", "a_directory.ply"},
      {"source.xyz target.xyz source.xyz", "source.xyz"},
      {"source.xyz target.xyz --report r --transform ./r", "r: is named twice"}};
  for (const auto& [arguments, name] : cases) {
    SCOPED_TRACE(arguments);
    const Outcome result = run(arguments);
    EXPECT_EQ(2, result.status);
    EXPECT_EQ("", result.output);
    EXPECT_EQ(0u, result.errors.find("pcl_kss_icp: ")) << result.errors;
    EXPECT_NE(std::string::npos, result.errors.find(name)) << result.errors;
    EXPECT_EQ(1, std::count_if(result.errors.begin(), result.errors.end(),
                               [](unsigned char c) { return std::iscntrl(c); }))
        << result.errors; // the end of the only line
  }
  EXPECT_EQ(before, files());
}

TEST_F(ToolRun, LeavesNoPartsOfOutputs)
{
  if (!std::filesystem::exists("/dev/full"))
    GTEST_SKIP() << "needs /dev/full";
  const auto before = files();
  const Outcome result = search("source.xyz target.xyz aligned.ply --report /dev/full");
  EXPECT_EQ(2, result.status);
  EXPECT_NE(std::string::npos, result.errors.find("/dev/full"));
  EXPECT_EQ(before, files());
  // the summary is an output, too
  EXPECT_EQ(
      2, search("source.xyz target.xyz > /dev/full 2> /dev/null ; exit $? #").status);
}

TEST_F(ToolRun, ReplacesOutputsAsAWhole)
{
  write("report", "an old report that is longer than nothing");
  std::filesystem::create_symlink("report", path("link"));
  EXPECT_EQ(2, search("source.xyz missing.xyz --report link").status);
  EXPECT_EQ("an old report that is longer than nothing", content("report"));
  EXPECT_EQ(0, search("source.xyz target.xyz --report link").status);
  EXPECT_EQ('{', content("report")[0]);
  EXPECT_TRUE(std::filesystem::is_symlink(path("link")));
}

TEST_F(ToolRun, ShowsHelpVersionAndDevices)
{
  for (const std::string arguments : {"--help", "-h", "--version", "--list-devices"}) {
    const Outcome result = run(arguments);
    EXPECT_EQ(0, result.status) << arguments;
    EXPECT_EQ("", result.errors) << arguments;
  }
  // in one line
  std::istringstream words(run("--help").output);
  std::string help;
  for (std::string word; words >> word;)
    help += word + ' ';
  for (const char* option : {"--transform",
                             "--report",
                             "--mode",
                             "--scale-range",
                             "--paper",
                             "--no-cleaning",
                             "--rigid",
                             "--points",
                             "--angle-step",
                             "--rotations",
                             "--density",
                             "--device",
                             "--list-devices",
                             "--threads",
                             "--samples",
                             "--quiet",
                             "--version",
                             "--help",
                             "Example",
                             "--centers",
                             "--energy",
                             "--search",
                             "--search-points",
                             "--kernel",
                             "--additional-process",
                             "--icp-points",
                             "--confidence",
                             "--time-limit",
                             "default 2000",
                             "3 to 180 degrees",
                             "default 30)",
                             "(default even)",
                             "1 to 100000 rotations; default 1728"})
    EXPECT_NE(std::string::npos, help.find(option)) << option;
  EXPECT_EQ(0u, run("--version").output.find("pcl_kss_icp "));
}

int
main(int argc, char** argv)
{
  ::testing::InitGoogleTest(&argc, argv);
  if (argc != 2) {
    std::cerr << "usage: " << argv[0] << " TOOL\n";
    return 2;
  }
  tool_path = std::filesystem::absolute(argv[1]).string();
  return RUN_ALL_TESTS();
}
