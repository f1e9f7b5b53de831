/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * What the tool for many scans leaves in a folder.
 */

#include "hand_made_model.h"
#include "tool_files.h"

#include "command_line/transformation_file.h"
#include "multiview/folder.h"
#include "multiview/html.h"
#include "multiview/merged_cloud.h"
#include "multiview/page.h"
#include "multiview/summary.h"
#include "multiview/texts.h"

#include <nlohmann/json.hpp>

#include <map>

namespace {

using namespace kss_test;
using nlohmann::json;

class MultiviewFiles : public kss_test::ToolFiles {
protected:
  Model model_ = handMadeModel(300);
  std::vector<std::string> names_ = scanNames(model_.files);

  /** The merged cloud of a group, written and read again. */
  Geometry
  merged(const std::vector<std::size_t>& group)
  {
    std::vector<ScanLook> looks(model_.files.size());
    for (const std::size_t scan : group)
      looks[scan] = lookAt(pointsOf(model_.read(scan), model_.samples),
                           model_.result.scans[scan].transformation, 0);
    std::ofstream stream(path("merged.ply"), std::ios::binary);
    points_ = writeMergedCloud(model_, group, looks, {}, stream);
    stream.close();
    return readGeometry(path("merged.ply"));
  }

  std::string
  page()
  {
    return pageText(model_, names_,
                    std::vector<GroupShow>(connectedGroups(model_.result).size()));
  }

  std::size_t points_ = 0;
};

bool
has(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}

std::size_t
timesIn(const std::string& text, const std::string& part)
{
  std::size_t times = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++times;
  return times;
}

Eigen::MatrixXd
matrixOf(const json& rows)
{
  Eigen::MatrixXd matrix(rows.size(), rows.at(0).size());
  for (Eigen::Index i = 0; i < matrix.rows(); ++i)
    for (Eigen::Index j = 0; j < matrix.cols(); ++j)
      matrix(i, j) = rows.at(i).at(j).get<double>();
  return matrix;
}

TEST_F(MultiviewFiles, NamesOfScansAreThoseOfTheirFilesWhereTheyAreUnique)
{
  EXPECT_EQ(
      (std::vector<std::string>{"one", "a_two", "b_two", "c_4", "c_5"}),
      scanNames({"x/one.ply", "x/a/two.ply", "x/b/two.ply", "y/c.ply", "y/c.pcd"}));
  // whatever they are called, no two have one name, and all can be names of files
  const std::vector<std::string> files{"a.ply",
                                       "a.ply",
                                       "a_2.ply",
                                       "a_2.xyz",
                                       "a_1.pts",
                                       std::string(255, 'l'),
                                       std::string(255, 'l')};
  const auto names = scanNames(files);
  EXPECT_EQ(files.size(), std::set<std::string>(names.begin(), names.end()).size());
  for (const auto& name : names)
    EXPECT_TRUE(!name.empty() && name.size() < 230 && !has(name, "/")) << name;
}

TEST_F(MultiviewFiles, HeadlineHasTheAnswer)
{
  const auto headline = [](std::vector<std::vector<std::size_t>> groups,
                           std::set<std::size_t> unusable = {}) {
    pcl::kss::Multiview result;
    for (const auto& group : groups)
      result.scans.resize(result.scans.size() + group.size());
    for (const std::size_t scan : unusable)
      result.scans[scan].failure.cause = pcl::kss::FailureCause::INPUT;
    result.groups = std::move(groups);
    return headlineOf(result);
  };
  EXPECT_EQ("3 scans: one group", headline({{0, 1, 2}}));
  EXPECT_EQ("4 scans in 2 groups", headline({{0, 1}, {2, 3}}));
  EXPECT_EQ("5 scans: 4 in 2 groups, 1 alone", headline({{0, 1}, {2, 3}, {4}}));
  EXPECT_EQ("3 scans: 2 in one group, 1 could not be used",
            headline({{0, 1}, {2}}, {2}));
  EXPECT_EQ("2 scans: none lies on another", headline({{0}, {1}}));
  EXPECT_EQ("1 scan: 1 could not be used", headline({{0}}, {0}));
}

TEST_F(MultiviewFiles, PosesKeepAllDigits)
{
  const json poses = json::parse(posesText(model_, names_));
  ASSERT_EQ(12u, poses["scans"].size());
  for (std::size_t i = 0; i < 11; ++i) {
    const json& scan = poses["scans"][i];
    EXPECT_EQ(i + 1, scan["scan"]);
    EXPECT_EQ(model_.files[i], scan["file"]);
    EXPECT_EQ(Eigen::MatrixXd(model_.result.scans[i].transformation),
              matrixOf(scan["transformation"]));
    EXPECT_TRUE(scan["reason"].is_null());
  }
  EXPECT_EQ(2, poses["scans"][8]["group"]);
  EXPECT_EQ((json{8, 9, 10}), poses["groups"][1]["scans"]);
  EXPECT_EQ("merged_2.ply", poses["groups"][1]["merged"]);
  EXPECT_FALSE(poses["groups"][2].contains("merged"));
  EXPECT_TRUE(poses["scans"][11]["transformation"].is_null());
  EXPECT_EQ("has 3 points on a line", poses["scans"][11]["reason"]);
  EXPECT_TRUE(poses["complete"]);
}

TEST_F(MultiviewFiles, LinksOfGroupsCountFromOne)
{
  EXPECT_EQ(json::array(), json::parse(posesText(model_, names_))["links"]);
  pcl::kss::GroupLink link;
  link.source = 1;
  link.transformation *= 2.0;
  link.confidence = 0.75;
  model_.result.links = {link};
  const json links = json::parse(posesText(model_, names_))["links"];
  ASSERT_EQ(1u, links.size());
  EXPECT_EQ(2, links[0]["source"]);
  EXPECT_EQ(1, links[0]["target"]);
  EXPECT_EQ(Eigen::MatrixXd(link.transformation), matrixOf(links[0]["transformation"]));
  EXPECT_EQ(0.75, links[0]["confidence"]);
  EXPECT_TRUE(has(modelSummary(model_, names_, "out"),
                  "Scales:    group 2 fits group 1 at 2 times its size, with"));
  EXPECT_TRUE(has(page(), "<li>group 2 fits group 1 at 2 times its size, with "
                          "confidence 0.75</li>"));
}

TEST_F(MultiviewFiles, GraphHasThePoseThatTheModelGoesBy)
{
  auto& pair = model_.result.pairs.front(); // scan 2 on scan 1, kept
  pair.pose = 1;
  pair.result.poses[1].transformation(0, 3) = 77.25;
  const json pairs = json::parse(graphText(model_))["pairs"];
  ASSERT_EQ(66u, pairs.size());
  EXPECT_EQ(2, pairs[0]["source"]);
  EXPECT_EQ(1, pairs[0]["target"]);
  EXPECT_EQ("kept", pairs[0]["verdict"]);
  EXPECT_EQ(77.25, pairs[0]["transformation"][0][3]);
  EXPECT_EQ(2u, pairs[0]["poses"].size());
  EXPECT_EQ(Eigen::MatrixXd(pair.result.poses[1].information),
            matrixOf(pairs[0]["information"]));
  EXPECT_EQ(pair.result.confidence, pairs[0]["confidence"]);
  EXPECT_EQ("failed", pairs[65]["verdict"]);
  EXPECT_TRUE(pairs[65]["transformation"].is_null());
  std::map<std::string, int> verdicts;
  for (const auto& entry : pairs)
    ++verdicts[entry["verdict"]];
  EXPECT_EQ((std::map<std::string, int>{
                {"kept", 14}, {"rejected", 8}, {"refused", 33}, {"failed", 11}}),
            verdicts);
}

TEST_F(MultiviewFiles, NamesThatAreNoUTF8AreNoErrors)
{
  model_.files[0] = "\xff\xfe.ply";
  EXPECT_NO_THROW(json::parse(posesText(model_, names_)));
  EXPECT_NO_THROW(json::parse(graphText(model_)));
}

TEST_F(MultiviewFiles, PairsAreRowsWithCommas)
{
  model_.files[0] = "a \"b\", c.ply";
  std::istringstream text(pairsText(model_));
  std::string line;
  std::getline(text, line);
  EXPECT_EQ("source,target,source_file,target_file,verdict,confidence,ambiguous,loops,"
            "deviation,overlap_source,overlap_target,score,reason,of_groups,log_odds",
            line);
  std::getline(text, line);
  EXPECT_EQ("2,1,\"scans/body_2.ply\",\"a \"\"b\"\", c.ply\",kept,0.96,false,2,0.0021,"
            "0.75,0.7,1.2,\"\",false,4",
            line);
}

/** What g2o makes of an edge: the translation and the vector part of the quaternion of
 * the measurement's inverse times the pose. */
Eigen::Matrix<double, 6, 1>
g2oError(const Eigen::Matrix4d& measured, const Eigen::Matrix4d& pose)
{
  const Eigen::Affine3d difference(measured.inverse() * pose);
  const Eigen::Quaterniond turn(difference.rotation());
  Eigen::Matrix<double, 6, 1> error;
  error << difference.translation(),
      (turn.w() < 0.0 ? -1.0 : 1.0) * Eigen::Vector3d(turn.vec());
  return error;
}

TEST_F(MultiviewFiles, G2oWeighsDeviationsAsTheInformationDoes)
{
  const auto& pose = model_.result.pairs[4].result.poses[0];
  const Eigen::Vector3d centroid(1.5, -2.0, 0.7);
  const Eigen::Affine3d transformation{Eigen::Matrix4d(pose.transformation)};
  std::srand(3);
  for (int trial = 0; trial < 20; ++trial) {
    const Eigen::Matrix<double, 6, 1> small =
        1e-5 * Eigen::Matrix<double, 6, 1>::Random();
    const Eigen::Vector3d turn = small.head<3>(), shift = small.tail<3>();
    // turned about the target's axes round the source's centroid, and moved
    const Eigen::Vector3d middle = transformation * centroid;
    const Eigen::Affine3d moved = Eigen::Translation3d(middle + shift) *
                                  Eigen::AngleAxisd(turn.norm(), turn.normalized()) *
                                  Eigen::Translation3d(-middle) * transformation;
    const auto error = g2oError(transformation.matrix(), moved.matrix());
    const Eigen::Matrix<double, 6, 6> information = pose.information;
    const double expected = small.dot(information * small);
    EXPECT_NEAR(expected, error.dot(g2oInformation(pose, centroid) * error),
                1e-3 * expected);
  }
}

TEST_F(MultiviewFiles, G2oHasTheScansAndKeptPairsOfAGroup)
{
  std::istringstream text(g2oText(model_, {7, 8, 9}));
  std::map<int, Eigen::Affine3d> vertices;
  std::size_t edges = 0;
  for (std::string line; std::getline(text, line);) {
    std::istringstream words(line);
    std::string kind;
    words >> kind;
    const auto pose = [&] {
      Eigen::Vector3d place;
      double x, y, z, w;
      words >> place.x() >> place.y() >> place.z() >> x >> y >> z >> w;
      return Eigen::Affine3d(Eigen::Translation3d(place) *
                             Eigen::Quaterniond(w, x, y, z));
    };
    if (kind == "VERTEX_SE3:QUAT") {
      int id;
      words >> id;
      vertices[id] = pose();
    }
    else if (kind == "EDGE_SE3:QUAT") {
      int from, to;
      words >> from >> to;
      const Eigen::Affine3d measured = pose();
      const Eigen::Affine3d between = vertices.at(from).inverse() * vertices.at(to);
      EXPECT_TRUE(measured.isApprox(between, 1e-9)) << line;
      int numbers = 0;
      for (double number; words >> number;)
        ++numbers;
      EXPECT_EQ(21, numbers);
      ++edges;
    }
    else
      EXPECT_EQ("FIX 8", line);
  }
  EXPECT_EQ(3u, vertices.size());
  EXPECT_TRUE(vertices.count(8) && vertices.count(9) && vertices.count(10));
  EXPECT_EQ(3u, edges);
}

TEST_F(MultiviewFiles, MergedCloudsHaveAllPointsInOneFrame)
{
  const Geometry cloud = merged({7, 8, 9});
  EXPECT_EQ(900u, points_);
  EXPECT_EQ(900u, numberOfPoints(cloud.cloud));
  EXPECT_TRUE(hasSinglePrecision(cloud));
  EXPECT_EQ(nullptr, findField(cloud.cloud, "normal_x"));
  Points expected;
  for (const std::size_t scan : {7, 8, 9})
    for (const auto& point : positionsOf(model_.read(scan)))
      expected.push_back(
          Eigen::Affine3d(Eigen::Matrix4d(model_.result.scans[scan].transformation)) *
          point);
  expectEqual(expected, positionsOf(cloud), 1e-6);
  for (const std::size_t point : {0, 299, 300, 899})
    EXPECT_EQ(8.0 + point / 300, numberAt(cloud, "scan", point));
}

TEST_F(MultiviewFiles, MergedCloudsKeepWhatAllScansHave)
{
  const auto body = model_.read;
  bool have_all_colours = true;
  model_.read = [&](std::size_t scan) {
    Geometry geometry = fieldsOfAllKinds();
    if (scan == 9)
      for (auto& field : geometry.cloud.fields) {
        if (field.name == "rgb" && !have_all_colours)
          field.name = "other";
        if (field.name == "label")
          field.name = "intensity";
      }
    return geometry;
  };
  Geometry cloud = merged({8, 9});
  EXPECT_EQ(10u, points_); // without the two that are not finite
  EXPECT_NE(nullptr, findField(cloud.cloud, "rgb"));
  EXPECT_EQ(nullptr, findField(cloud.cloud, "intensity")); // of one of them
  const Eigen::Vector3d turned =
      Eigen::Matrix4d(model_.result.scans[8].transformation).topLeftCorner<3, 1>();
  EXPECT_NEAR(turned.y(), numberAt(cloud, "normal_y", 0), 1e-6);
  const auto colour = getColour(*findField(cloud.cloud, "rgb"),
                                &cloud.cloud.data[1 * cloud.cloud.point_step]);
  EXPECT_EQ(10, colour[0]);
  EXPECT_EQ(20, colour[1]);
  EXPECT_EQ(254, colour[2]);

  have_all_colours = false;
  cloud = merged({8, 9});
  EXPECT_EQ(nullptr, findField(cloud.cloud, "rgb"));
}

TEST_F(MultiviewFiles, MergedCloudsAreDoublesWhereFloatsAreTooCoarse)
{
  model_.read = [](std::size_t) {
    Geometry geometry = farTetrahedron();
    geometry.faces.clear();
    return geometry;
  };
  for (auto& scan : model_.result.scans)
    scan.transformation.setIdentity();
  const Geometry cloud = merged({0, 1});
  EXPECT_FALSE(hasSinglePrecision(cloud));
  EXPECT_EQ(4000000.1234567, positionsOf(cloud)[4].x());
}

TEST_F(MultiviewFiles, PointsThatStrayDoNotMakeMergedCloudsCoarse)
{
  // as scanners write rays that hit nothing, among coordinates of maps
  std::vector<double> numbers = {0.0, 0.0, 0.0};
  for (int i = 0; i < 9; ++i)
    numbers.insert(numbers.end(), {4e5 + i, 5.4e6 + 0.001 * i, 300.0 - i});
  model_.read = [&](std::size_t) {
    Geometry geometry;
    geometry.cloud = cloudOfDoubles(numbers, {"x", "y", "z"});
    return geometry;
  };
  for (auto& scan : model_.result.scans)
    scan.transformation.setIdentity();
  const Geometry cloud = merged({0, 1});
  EXPECT_FALSE(hasSinglePrecision(cloud));
  EXPECT_EQ(5.4e6 + 0.003, positionsOf(cloud)[4].y());
}

TEST_F(MultiviewFiles, MergedCloudsAreThinned)
{
  for (auto& scan : model_.result.scans)
    scan.transformation.setIdentity();
  model_.read = [](std::size_t scan) {
    Geometry geometry;
    geometry.cloud = cloudOfDoubles(
        {0.1, 0.1, 0.1, 0.2, 0.3, 0.4, 1.6, 0.2, 0.2, 0.3, 0.3, 0.5 + scan},
        {"x", "y", "z"});
    return geometry;
  };
  model_.spacing = 1.0;
  const Geometry cloud = merged({0, 1});
  EXPECT_EQ(3u, points_);
  ASSERT_EQ(3u, numberOfPoints(cloud.cloud));
  EXPECT_EQ(1.0, numberAt(cloud, "scan", 1));
  EXPECT_EQ(2.0, numberAt(cloud, "scan", 2));
  model_.spacing = 1e-300; // however far a point may stray
  merged({0, 1});
  EXPECT_EQ(5u, points_);
}

TEST_F(MultiviewFiles, MergedMeshesAreSampled)
{
  model_.read = [](std::size_t) { return nearTetrahedron(); };
  model_.samples = 50;
  const Geometry cloud = merged({0, 1});
  EXPECT_EQ(100u, numberOfPoints(cloud.cloud));
  EXPECT_NE(nullptr, findField(cloud.cloud, "normal_x"));
}

TEST_F(MultiviewFiles, ScansThatChangeMeanwhileAreErrors)
{
  std::size_t reads = 0;
  const auto body = model_.read;
  model_.read = [&](std::size_t scan) {
    return ++reads > 4 ? scanOfBody(0.0, 299, Eigen::Matrix4d::Identity()) : body(scan);
  };
  try {
    merged({7, 8, 9});
    ADD_FAILURE();
  }
  catch (const std::runtime_error& error) {
    EXPECT_EQ("scans/body_9.ply: has changed since it was read",
              std::string(error.what()));
  }
}

TEST_F(MultiviewFiles, PageNeedsNothingElse)
{
  const std::string text = page();
  EXPECT_TRUE(has(text, "<h1 class=\"part\">12 scans: 10 in 2 groups, 1 alone, 1 could "
                        "not be used</h1>"));
  for (const char* part : {"http", "<script", "<link", "url(", "@import"})
    EXPECT_FALSE(has(text, part)) << part;
  EXPECT_EQ(timesIn(text, " src="), timesIn(text, " src=\"data:image/png;base64,"));
  EXPECT_EQ(timesIn(text, "<section"), timesIn(text, "</section>"));
  EXPECT_EQ(timesIn(text, "<table"), timesIn(text, "</table>"));
  EXPECT_EQ(timesIn(text, "<svg"), timesIn(text, "</svg>"));
  EXPECT_EQ(timesIn(text, "<tr"), timesIn(text, "</tr>"));
  EXPECT_EQ(14u + 1u, timesIn(text, "line class=\"kept\"")); // one is the key
  EXPECT_EQ(8u + 1u, timesIn(text, "line class=\"rejected\""));
  EXPECT_EQ(12u, timesIn(text, "<g class=\"node"));
}

TEST_F(MultiviewFiles, PageEscapesWhatFilesAreCalled)
{
  model_.files[0] = "x/<script>alert(1)</script>\"'&\xff.ply";
  model_.result.scans[11].failure.reason = "<img src=x>";
  model_.result.pairs[5].reason = "<b>no</b>";
  model_.settings.emplace_back("<i>", "<u>");
  names_ = scanNames(model_.files);
  const std::string text = page();
  for (const char* part : {"<script", "<img src=x", "<b>no", "<i>", "<u>", "\xff"})
    EXPECT_FALSE(has(text, part)) << part;
  EXPECT_EQ("&lt;a&gt; &quot;&#39;&amp;?", escaped("<a> \"'&\xff"));
}

TEST_F(MultiviewFiles, PageAdvisesWhereGroupsDoNotConnect)
{
  EXPECT_TRUE(has(page(), "What connects the groups"));
  EXPECT_TRUE(has(page(), "--upright"));
  auto& result = model_.result;
  result.groups = {{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}};
  for (auto& scan : result.scans) {
    scan.group = 0;
    scan.failure = {};
  }
  EXPECT_FALSE(has(page(), "What connects the groups"));
  EXPECT_TRUE(has(page(), "<h1>12 scans: one group</h1>"));
}

TEST_F(MultiviewFiles, PageOfThousandsStaysSmall)
{
  Model many;
  const std::size_t number = 3000;
  many.result.scans.resize(number);
  many.result.groups.resize(1);
  for (std::size_t i = 0; i < number; ++i) {
    many.result.groups[0].push_back(i);
    many.files.push_back("scan_" + std::to_string(i) + ".ply");
    for (std::size_t j = 1; j <= std::min<std::size_t>(i, 8); ++j) {
      pcl::kss::GraphPair pair;
      pair.result.source = i;
      pair.result.target = i - j;
      pair.verdict = static_cast<pcl::kss::PairVerdict>(j % 4);
      pair.result.poses.resize(1);
      many.result.pairs.push_back(pair);
    }
  }
  const std::string text = pageText(many, scanNames(many.files), {GroupShow()});
  EXPECT_LT(text.size(), 1000000u);
  EXPECT_TRUE(has(text, "and 2500 more scans, which poses.json lists"));
  EXPECT_TRUE(has(text, "more pairs, which pairs.csv lists"));
  EXPECT_TRUE(has(text, "Not drawn: more than 400 scans"));
}

TEST_F(MultiviewFiles, Base64IsThatOfRFC4648)
{
  EXPECT_EQ("", base64(""));
  EXPECT_EQ("Zg==", base64("f"));
  EXPECT_EQ("Zm8=", base64("fo"));
  EXPECT_EQ("Zm9v", base64("foo"));
  EXPECT_EQ("Zm9vYg==", base64("foob"));
  EXPECT_EQ("//79", base64("\xff\xfe\xfd"));
}

TEST_F(MultiviewFiles, SummaryFitsTerminals)
{
  model_.result.failure = {pcl::kss::FailureCause::STOPPED,
                           "the time limit has passed"};
  const std::string text = modelSummary(model_, names_, "out");
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    EXPECT_LE(line.size(), 79u) << line;
  for (const char* part :
       {"12 scans: 10 in 2 groups, 1 alone, 1 could not be used\n",
        "Stopped:   the time limit has passed\n",
        "Group 2:   body_8, body_9, body_10\n", "Alone:     body_11\n",
        "Not used:  body_12: has 3 points on a line\n",
        "Pairs:     14 kept, 8 rejected, 33 refused, 11 failed\n", "out/index.html"})
    EXPECT_TRUE(has(text, part)) << part << text;
}

TEST_F(MultiviewFiles, FolderHasAllFiles)
{
  const std::string folder = path("out");
  prepareFolder(folder, {});
  double done = 0.0;
  writeFolder(model_, folder, [&](double share) {
    EXPECT_GT(share, done);
    done = share;
  });
  EXPECT_EQ(1.0, done);
  std::set<std::string> found;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    found.insert(entry.path().filename().string());
  EXPECT_EQ((std::set<std::string>{"graph.json", "graph_1.g2o", "graph_2.g2o",
                                   "index.html", "merged_1.ply", "merged_2.ply",
                                   "pairs.csv", "poses", "poses.json", "times.json"}),
            found);
  EXPECT_EQ(Eigen::Matrix4d(model_.result.scans[4].transformation),
            readTransformation(folder + "/poses/body_5.txt"));
  EXPECT_FALSE(std::filesystem::exists(folder + "/poses/body_12.txt"));
  const std::string page = contentOf(folder + "/index.html");
  EXPECT_TRUE(has(page, "2,100 points in the frame of body_1"));
  EXPECT_EQ(canDrawGroups() ? 6u : 0u, timesIn(page, "data:image/png;base64,iVBOR"));
}

TEST_F(MultiviewFiles, TimesAreThoseOfTheStages)
{
  const json times = json::parse(timesText(model_));
  ASSERT_EQ(3u, times["stages"].size());
  EXPECT_EQ("pairs", times["stages"][1]["stage"]);
  EXPECT_EQ(40.0, times["stages"][1]["seconds"]);
  EXPECT_EQ((json{{"scans", 12}, {"quick pairs", 30}}), times["tasks"]);
  EXPECT_EQ(42.5, times["seconds"]);
}

TEST_F(MultiviewFiles, GroupsAreDrawnWhateverIsFarOut)
{
  if (!canDrawGroups())
    GTEST_SKIP() << "no cairo";
  const Points points = positionsOf(model_.read(0));
  const auto pictures = drawGroup({{0, points}, {1, points}}, 120, 90);
  ASSERT_EQ(3u, pictures.size());
  EXPECT_EQ("From above", pictures[0].side);
  Points more = points;
  for (const double far : {1e6, 1e25, 1e300})
    more.insert(more.begin() + 5, {far, 0.0, -far});
  const auto others = drawGroup({{0, more}, {1, points}}, 120, 90);
  for (int side = 0; side < 3; ++side) {
    EXPECT_EQ(pictures[side].png, others[side].png) << side;
    EXPECT_GT(pictures[side].ruler_share, 0.08);
    EXPECT_LT(pictures[side].ruler_share, 0.26);
  }
  EXPECT_TRUE(drawGroup({}, 120, 90).empty());
  EXPECT_TRUE(drawGroup({{0, {}}}, 120, 90).empty());
}

TEST_F(MultiviewFiles, FolderLosesWhatAnEarlierRunHasLeft)
{
  const std::string folder = path("out");
  prepareFolder(folder, {});
  writeFolder(model_, folder);
  write("out/merged_7.ply", "somebody else's");
  write("kept.txt", "outside");
  // a single group of two now
  model_.result.groups = {{7, 8}};
  for (auto& scan : model_.result.scans) {
    scan.failure.cause = pcl::kss::FailureCause::INPUT;
    scan.group = 1;
  }
  for (const std::size_t scan : {7, 8}) {
    model_.result.scans[scan].failure = {};
    model_.result.scans[scan].group = 0;
  }
  writeFolder(model_, folder);
  EXPECT_FALSE(std::filesystem::exists(folder + "/merged_2.ply"));
  EXPECT_FALSE(std::filesystem::exists(folder + "/graph_2.g2o"));
  EXPECT_FALSE(std::filesystem::exists(folder + "/poses/body_1.txt"));
  EXPECT_TRUE(std::filesystem::exists(folder + "/poses/body_9.txt"));
  EXPECT_TRUE(std::filesystem::exists(folder + "/merged_7.ply"));

  // a poses.json that names what is elsewhere, or is none
  for (const char* text :
       {R"({"groups": [{"merged": "../kept.txt"}, 3]})",
        R"({"scans": [{"pose_file": "poses/../../kept.txt"}]})",
        R"({"scans": [{"pose_file": "poses/.."}]})", "[1", R"({"groups": 4})"}) {
    write("out/poses.json", text);
    EXPECT_NO_THROW(writeFolder(model_, folder));
    EXPECT_TRUE(std::filesystem::exists(path("kept.txt")));
  }
}

TEST_F(MultiviewFiles, ScansAreNotReplacedByResults)
{
  std::filesystem::create_directories(path("out/poses"));
  for (const char* name : {"merged_1.ply", "merged_12.ply", "pairs.csv", "poses/a.txt",
                           "../out/./graph_1.g2o"})
    EXPECT_THROW(prepareFolder(path("out"), {path("s.ply"), path("out/") + name}),
                 std::runtime_error)
        << name;
  EXPECT_NO_THROW(prepareFolder(
      path("out"), {path("merged_1.ply"), path("poses/a.txt"), path("out/scan_1.ply"),
                    path("out/merged_.ply"), path("out/merged_1b.ply"),
                    path("out/more/merged_1.ply"), path("out/poses/a.ply")}));
}

TEST_F(MultiviewFiles, FoldersThatCannotBeAreErrors)
{
  const std::string file = write("file", "");
  try {
    prepareFolder(file, {});
    ADD_FAILURE();
  }
  catch (const std::runtime_error& error) {
    EXPECT_EQ(0u, std::string(error.what()).find(file)) << error.what();
  }
}

} // namespace
