/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "evaluation_cases.h"

#include "models.h"
#include "neighbour_distances.h"

#include <algorithm>
#include <gtest/gtest.h>

#include <set>
#include <tuple>

using namespace evaluation;
using namespace kss_test;

namespace {

using EvaluationSurface = FolderTest;
using EvaluationModels = FolderTest;

using Position = std::tuple<double, double, double>;

std::set<Position>
distinct(const SurfacePoints& points)
{
  std::set<Position> positions;
  for (const auto& point : points)
    positions.insert({point.position.x(), point.position.y(), point.position.z()});
  return positions;
}

std::string
refusalOf(const std::string& path)
{
  try {
    Surface surface(path);
  }
  catch (const std::runtime_error& problem) {
    return problem.what();
  }
  return "";
}

std::vector<std::string>
namesOf(const std::vector<Model>& models)
{
  std::vector<std::string> names;
  for (const auto& model : models)
    names.push_back(model.name);
  return names;
}

} // namespace

TEST_F(EvaluationSurface, IsCentredAndHasDiagonalOne)
{
  const Eigen::Vector3d half(30.0, 20.0, 10.0);
  const auto surface = surfaceOf(folder, box({4000.0, -500.0, 70.0}, half));
  EXPECT_TRUE(surface.isMesh());
  Random random = randomFor("box");
  Eigen::AlignedBox3d bounds;
  for (const auto& point : surface.draw(3000, random))
    bounds.extend(point.position);
  const Eigen::Vector3d expected = half / (2.0 * half.norm());
  EXPECT_LT((bounds.max() - expected).norm(), 1e-5);
  EXPECT_LT((bounds.min() + expected).norm(), 1e-5);
}

TEST_F(EvaluationSurface, DrawsByAreaAndKnowsTheNormals)
{
  const Eigen::Vector3d half(3.0, 2.0, 1.0);
  const auto surface = surfaceOf(folder, box({0.0, 0.0, 0.0}, half));
  const Eigen::Vector3d h = half / (2.0 * half.norm());
  Random random = randomFor("box");
  Eigen::Vector3d on_faces = Eigen::Vector3d::Zero();
  const SurfacePoints points = surface.draw(10000, random);
  for (const auto& point : points) {
    int axis = 0;
    point.normal.cwiseAbs().maxCoeff(&axis);
    EXPECT_NEAR(1.0, std::abs(point.normal[axis]), 1e-9);
    EXPECT_NEAR(h[axis], std::abs(point.position[axis]), 1e-9);
    on_faces[axis] += 1e-4;
  }
  // 2 * 1, 3 * 1 and 3 * 2 of 11
  EXPECT_LT((on_faces - Eigen::Vector3d(2, 3, 6) / 11.0).norm(), 0.02);
}

TEST_F(EvaluationSurface, TwoSamplingsOfACloudShareNoPoint)
{
  const Surface surface(folder.write("cloud.pcd", pcdOf(scattered(1000, 1))));
  EXPECT_FALSE(surface.isMesh());
  Random random = randomFor("cloud");
  for (const auto& [first, second] :
       {surface.drawTwo(300, 300, random), surface.drawTwo(500, 500, random)}) {
    auto all = first;
    all.insert(all.end(), second.begin(), second.end());
    EXPECT_EQ(first.size(), second.size());
    EXPECT_EQ(first.size() + second.size(), distinct(all).size());
  }
  // each time others
  EXPECT_NE(distinct(surface.draw(300, random)), distinct(surface.draw(300, random)));
}

TEST_F(EvaluationSurface, TwoSamplingsShareASmallCloudInEqualParts)
{
  const Surface surface(folder.write("cloud.pcd", pcdOf(scattered(301, 1))));
  Random random = randomFor("cloud");
  const auto [first, second] = surface.drawTwo(1000, 1000, random);
  EXPECT_EQ(150u, first.size());
  EXPECT_EQ(151u, second.size());
  EXPECT_EQ(301u, distinct(surface.draw(5000, random)).size());
  EXPECT_EQ(301u, surface.draw(5000, random).size());
}

TEST_F(EvaluationSurface, EstimatesNormalsOfCloudsOutwards)
{
  const Mesh ball = ellipsoid({5.0, 0.0, 0.0}, {2.0, 2.0, 2.0});
  const Surface surface(folder.write("ball.pcd", pcdOf(sampled(ball, 3000, 1))));
  Random random = randomFor("ball");
  double mean = 0.0;
  for (const auto& point : surface.draw(3000, random)) {
    EXPECT_NEAR(1.0, point.normal.norm(), 1e-5);
    EXPECT_GT(point.normal.dot(point.position), 0.0);
    mean += point.normal.dot(point.position.normalized()) / 3000.0;
  }
  EXPECT_GT(mean, std::cos(0.15));
}

TEST_F(EvaluationSurface, MeasuresTheDistancesOfTwelveNeighbours)
{
  SurfacePoints points;
  const Points positions = scattered(500, 1);
  for (Eigen::Index i = 0; i < positions.cols(); ++i)
    points.push_back({positions.col(i).cast<double>(), Eigen::Vector3d::UnitX()});
  double sum = 0.0;
  for (const auto& point : points) {
    std::vector<double> distances;
    for (const auto& other : points)
      distances.push_back((other.position - point.position).norm());
    std::sort(distances.begin(), distances.end());
    for (int i = 1; i <= 12; ++i)
      sum += distances[i];
  }
  EXPECT_NEAR(sum / (12.0 * 500.0), meanNeighbourDistance(points), 1e-6);
}

TEST_F(EvaluationSurface, RefusesWhatCannotBeSampled)
{
  EXPECT_NE("", refusalOf(folder.path("missing.off")));
  EXPECT_NE("", refusalOf(folder.write("broken.off", "OFF\n3 1 0\n0 0 0\n")));
  EXPECT_NE("", refusalOf(folder.write("empty.off", "OFF\n0 0 0\n")));
  EXPECT_NE("", refusalOf(folder.write("nothing.ply", "")));
  const auto flat =
      refusalOf(folder.write("line.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n2 0 0\n3 0 1 2\n"));
  EXPECT_NE(std::string::npos, flat.find("no area")) << flat;
  const auto few = refusalOf(folder.write("few.pcd", pcdOf(scattered(199, 1))));
  EXPECT_NE(std::string::npos, few.find("199 points")) << few;
  EXPECT_NE(std::string::npos, few.find("200")) << few;
  EXPECT_EQ("", refusalOf(folder.write("enough.pcd", pcdOf(scattered(200, 1)))));
  const auto same =
      refusalOf(folder.write("same.pcd", pcdOf(Points::Constant(3, 300, 1.0f))));
  EXPECT_NE(std::string::npos, same.find("same")) << same;
}

TEST_F(EvaluationModels, AreFoundInAllFoldersAndNamedApart)
{
  const std::string mesh = offOf(creature());
  folder.write("b.off", mesh);
  folder.write("a/b.OFF", mesh);
  folder.write("a/c.off", mesh);
  folder.write("a/c.obj", objOf(creature()));
  folder.write("a/cloud.pcd", pcdOf(scattered(300, 1)));
  const ModelFolder found = modelsOf(folder.path());
  EXPECT_EQ((std::vector<std::string>{"a/b", "a/c.obj", "a/c.off", "a/cloud", "b"}),
            namesOf(found.models));
  EXPECT_TRUE(found.models[0].is_mesh);
  EXPECT_FALSE(found.models[3].is_mesh);
  EXPECT_TRUE(found.skipped.empty());
}

TEST_F(EvaluationModels, SaysWhyFilesArePassedOver)
{
  folder.write("good.off", offOf(creature()));
  folder.write("broken.off", "OFF\n3 1 0\n0 0 0\n");
  folder.write("few.pcd", pcdOf(scattered(50, 1)));
  folder.write("notes.txt", "0 0 0\n");
  const ModelFolder found = modelsOf(folder.path());
  EXPECT_EQ(std::vector<std::string>{"good"}, namesOf(found.models));
  ASSERT_EQ(3u, found.skipped.size());
  const std::vector<std::pair<std::string, std::string>> expected = {
      {"broken.off", ""}, {"few.pcd", "50 points"}, {"notes.txt", "no model"}};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& [path, reason] = found.skipped[i];
    EXPECT_EQ(folder.path(expected[i].first), path);
    EXPECT_NE("", reason);
    EXPECT_NE(std::string::npos, reason.find(expected[i].second)) << reason;
    EXPECT_EQ(std::string::npos, reason.find(path)) << reason;
    EXPECT_EQ(std::string::npos, reason.find('\n')) << reason;
  }
}

TEST_F(EvaluationModels, AreChosenEvenly)
{
  std::vector<Model> models;
  for (const char c : std::string("abcdefghi"))
    models.push_back({std::string(1, c), "", true});
  EXPECT_EQ((std::vector<std::string>{"b", "e", "g"}),
            namesOf(evenlyChosen(models, 3)));
  EXPECT_EQ(std::vector<std::string>{"e"}, namesOf(evenlyChosen(models, 1)));
  EXPECT_EQ(namesOf(models), namesOf(evenlyChosen(models, 0)));
  EXPECT_EQ(namesOf(models), namesOf(evenlyChosen(models, 20)));
  for (std::size_t number = 2; number < 9; ++number) { // more only add
    const auto more = namesOf(evenlyChosen(models, number)),
               fewer = namesOf(evenlyChosen(models, number - 1));
    EXPECT_EQ(number, more.size());
    EXPECT_TRUE(std::includes(more.begin(), more.end(), fewer.begin(), fewer.end()));
  }
}

TEST_F(EvaluationModels, NeedAFolder)
{
  try {
    modelsOf(folder.path("missing"));
    FAIL();
  }
  catch (const std::runtime_error& problem) {
    EXPECT_EQ(folder.path("missing") + ": is no folder; name one that holds models",
              problem.what());
  }
}
