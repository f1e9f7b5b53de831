/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * What the command line tool finds and writes.
 */

#include "tool_run.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <limits>
#include <sstream>
#include <string>

namespace {

using namespace kss_test;

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

/** The transformation in a text file. */
Eigen::Matrix4d
matrixIn(const std::string& content)
{
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Zero();
  std::istringstream numbers(content);
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      EXPECT_TRUE(numbers >> matrix(i, j));
  EXPECT_EQ("", std::string(std::istreambuf_iterator<char>(numbers >> std::ws), {}));
  return matrix;
}

double
meanSquaredDistance(const Points& points, const Points& others)
{
  double sum = 0.0;
  for (const auto& point : points) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto& other : others)
      nearest = std::min(nearest, (other - point).squaredNorm());
    sum += nearest;
  }
  return sum / points.size();
}

/** The alternatives are the result, then others, here by falling score. */
void
expectAlternatives(const nlohmann::json& report)
{
  const auto& alternatives = report.at("alternatives");
  ASSERT_GE(alternatives.size(), 1u);
  EXPECT_EQ(report.at("transformation"), alternatives[0].at("transformation"));
  EXPECT_EQ(report.at("score"), alternatives[0].at("score"));
  EXPECT_EQ(report.at("overlap"), alternatives[0].at("overlap"));
  for (std::size_t i = 1; i < alternatives.size(); ++i) {
    EXPECT_LE(alternatives[i].at("score"), alternatives[i - 1].at("score"));
    EXPECT_EQ(2u, alternatives[i].at("overlap").size());
    // in the coordinates of the files, too
    EXPECT_GT(toMatrix(alternatives[i].at("transformation"))(0, 3), 4e6);
  }
}

/** What was registered, by which program, and how. */
void
expectInputsAndSettings(const nlohmann::json& report)
{
  EXPECT_NE("", report.at("version").get<std::string>());
  const auto& source = report.at("inputs").at("source");
  EXPECT_EQ("source.xyz", source.at("file"));
  EXPECT_EQ(blob_points, source.at("points"));
  EXPECT_EQ(0, source.at("faces"));
  EXPECT_EQ("target.xyz", report.at("inputs").at("target").at("file"));
  EXPECT_EQ("unit of target", report.at("units").at("lengths"));
  // in the words and units of the command line
  const auto& settings = report.at("settings");
  EXPECT_EQ("auto", settings.at("mode"));
  EXPECT_EQ(true, settings.at("estimate_scale"));
  EXPECT_TRUE(settings.at("largest_scale").is_null());
  EXPECT_EQ(300, settings.at("sample_points"));
  EXPECT_EQ(30.0, settings.at("angle_step"));
  EXPECT_EQ(0.5, settings.at("minimum_confidence"));
  EXPECT_EQ("host", settings.at("device"));
  EXPECT_EQ(10000, settings.at("samples"));
  EXPECT_EQ(300, settings.at("iterations"));
  EXPECT_TRUE(settings.at("guess").is_null());
}

/** The stages took some time, and no more than the whole. */
void
expectSeconds(const nlohmann::json& report)
{
  double sum = 0.0;
  for (const auto& [stage, seconds] : report.at("seconds").items())
    if (stage != "total")
      sum += seconds.get<double>();
  EXPECT_GT(report.at("seconds").size(), 2u);
  EXPECT_GT(sum, 0.0);
  EXPECT_LE(sum, report.at("seconds").at("total").get<double>());
}

TEST_F(ToolRun, TakesAGuess)
{
  // of poses as good as each other the one nearest to the guess is the result
  const auto plank = [](const Eigen::Affine3d& turn) {
    Points points = moved(blob(), turn);
    for (Eigen::Vector3d& point : points)
      point = Eigen::Vector3d(3.0, 1.0, 0.4)
                  .cwiseProduct(point / point.cwiseAbs().maxCoeff());
    return points;
  };
  write("plank.xyz", plank(Eigen::Affine3d::Identity()));
  write("other.xyz", plank(Eigen::Affine3d(Eigen::AngleAxisd(
                         1.0, Eigen::Vector3d(1, 2, 3).normalized()))));
  for (const double angle : {0.0, M_PI}) {
    const Eigen::Affine3d turn(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()));
    std::ofstream guess(directory_ / "guess.txt");
    guess << turn.matrix() << '\n';
    guess.close();
    const Outcome result =
        search("plank.xyz other.xyz --rigid --guess guess.txt --transform t.txt");
    ASSERT_EQ(0, result.status) << result.errors;
    EXPECT_LT((matrixIn(content("t.txt")) - turn.matrix()).norm(), 0.2) << angle;
  }
}

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

  const Eigen::Matrix4d written = matrixIn(content("t.txt"));
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
  const double fitness = meanSquaredDistance(read("aligned.xyz"), read("target.xyz"));
  EXPECT_NEAR(fitness, report.at("fitness").get<double>(), 0.01 * fitness + 1e-12);
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
  expectAlternatives(report);
  expectSeconds(report);
  expectInputsAndSettings(report);
}

TEST_F(ToolRun, SaysHowSureItIsAndWhatMayBeRigid)
{
  const auto hint = "say --rigid";
  const auto sources = {std::pair{1.012, true}, std::pair{2.5, false}};
  for (const auto& [scale, has_hint] : sources) {
    write("scaled.xyz", moved(blob(), similarity(scale)));
    const Outcome result = search("source.xyz scaled.xyz");
    ASSERT_EQ(0, result.status) << result.errors;
    EXPECT_EQ(has_hint, result.output.find(hint) != std::string::npos)
        << scale << ' ' << result.output;
    EXPECT_NE(std::string::npos,
              result.output.find("% (of a hundred results as sure, "));
  }
  // it is given, or 1 is not among those asked for
  write("scaled.xyz", moved(blob(), similarity(1.012)));
  for (const std::string options : {"--rigid", "--scale-range 1.005 2"})
    EXPECT_EQ(std::string::npos,
              search(options + " source.xyz scaled.xyz").output.find(hint));
}

TEST_F(ToolRun, SaysThatARivalMayBeTheRightOne)
{
  // a rod of square section looks the same when turned
  const auto rod = [](const Points& points) {
    Points rod;
    for (const Eigen::Vector3d& point : points)
      rod.push_back(Eigen::Vector3d(3.0, 1.0, 1.0)
                        .cwiseProduct(point / point.cwiseAbs().maxCoeff()));
    return rod;
  };
  write("rod.xyz", rod(blob()));
  write("other.xyz", moved(rod(latticeOfBlob()), similarity(1.0)));
  const Outcome sure = search("source.xyz rigid.xyz --rigid");
  const Outcome ambiguous = search("rod.xyz other.xyz --rigid");
  EXPECT_EQ(0, ambiguous.status) << ambiguous.errors;
  EXPECT_NE(std::string::npos, ambiguous.output.find("Ambiguous:")) << ambiguous.output;
  for (const auto& [result, is_ambiguous] :
       {std::pair{sure, false}, {ambiguous, true}}) {
    std::string words;
    std::istringstream text(result.output);
    for (std::string word; text >> word;)
      words += word + ' ';
    EXPECT_NE(std::string::npos, words.find("% (of a hundred results as sure, "));
    EXPECT_EQ(is_ambiguous, words.find("are right, or as good as the right one)") !=
                                std::string::npos)
        << words;
  }
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

TEST_F(ToolRun, TakesAnAxisOrNone)
{
  const Eigen::Affine3d turn(Eigen::AngleAxisd(1.0, Eigen::Vector3d::UnitY()));
  write("turned.xyz", moved(blob(), turn));
  const std::string files = "source.xyz turned.xyz --rigid --report r.json";
  const std::pair<std::string, std::string> lines[] = {
      {"--upright " + files, "z"},         {files + " --upright", "z"},
      {"--upright y " + files, "y"},       {"--upright=y " + files, "y"},
      {"--upright --quiet " + files, "z"}, {"--upright any " + files, "any"}};
  for (const auto& [line, axis] : lines) {
    SCOPED_TRACE(line);
    EXPECT_EQ(axis == "z" ? 1 : 0, search(line).status);
    EXPECT_EQ(
        axis,
        nlohmann::json::parse(content("r.json")).at("settings").at("rotation_axis"));
  }
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
  // the target lies where floats are too coarse, so these are text
  const std::string facets = content("aligned.stl");
  std::size_t number = 0;
  for (std::size_t at = 0; (at = facets.find("endfacet", at)) != std::string::npos;
       ++at)
    ++number;
  EXPECT_EQ(1479u, number);
  EXPECT_NE(std::string::npos, content("aligned.obj").find("\nf 1 14 22\n"));
}

TEST_F(ToolRun, SaysWhichFacesOfEitherFileAreNotRead)
{
  std::ostringstream ply;
  ply << "ply\nformat ascii 1.0\nelement vertex " << blob_points
      << "\nproperty double x\nproperty double y\nproperty double z\n"
         "element tristrips 1\nproperty list int int vertex_indices\nend_header\n";
  for (const auto& point : blob())
    ply << point.transpose() << '\n';
  write("strips.ply", ply.str() + "4 0 1 2 -1\n");
  const std::string said = "strips.ply: its faces in the element 'tristrips' are not ";
  for (const std::string files : {"strips.ply target.xyz", "source.xyz strips.ply"}) {
    const Outcome result = search(files);
    EXPECT_EQ(0, result.status) << result.errors;
    EXPECT_NE(std::string::npos, result.errors.find(said)) << result.errors;
    EXPECT_EQ("", search(files + " --quiet").errors);
  }
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

TEST_F(ToolRun, SaysWhatToTryWhereItIsRefused)
{
  const std::string files = "--confidence 1 source.xyz target.xyz";
  const Outcome result = search(files);
  EXPECT_EQ(1, result.status);
  for (const char* advice :
       {"--rigid", "--mode overlap", "--guess", "--picture", "100 %"})
    EXPECT_NE(std::string::npos, result.errors.find(advice)) << result.errors;
  // not what is said already
  write("identity.txt", "1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n");
  const Outcome other = search(files + " --rigid --mode global --guess identity.txt");
  EXPECT_EQ(1, other.status);
  for (const char* advice : {"--rigid", "--mode", "--guess"})
    EXPECT_EQ(std::string::npos, other.errors.find(advice)) << other.errors;
  // the reason is said, the advice is not
  const Outcome quiet = search(files + " --quiet");
  EXPECT_EQ(0u, quiet.errors.find("pcl_kss_icp: not registered: "));
  EXPECT_EQ(1, std::count(quiet.errors.begin(), quiet.errors.end(), '\n'));
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

} // namespace
