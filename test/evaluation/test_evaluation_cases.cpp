/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "evaluation_cases.h"

#include "neighbour_distances.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <set>

using namespace evaluation;
using namespace kss_test;

namespace {

const Eigen::Vector3d sides(1.0, 0.8, 0.6);

/** The half sides of the box, its diagonal 1. */
Eigen::Vector3d
half()
{
  return sides / (2.0 * sides.norm());
}

double
distanceToBox(const Eigen::Vector3d& point)
{
  const Eigen::Vector3d beyond = point.cwiseAbs() - half();
  return beyond.maxCoeff() > 0.0 ? beyond.cwiseMax(0.0).norm() : -beyond.maxCoeff();
}

bool
same(const Cloud& a, const Cloud& b)
{
  return positionsOf(a) == positionsOf(b);
}

/** Cases of a box, whose distances and normals are known. */
class EvaluationCases : public FolderTest {
protected:
  Case
  caseOf(const std::string& condition,
         std::size_t points,
         unsigned int number = 0) const
  {
    return makeCase(box_, "box", conditionOf(condition, points, protocol), number,
                    protocol);
  }

  Protocol protocol;

private:
  Surface box_ = surfaceOf(folder, box({3.0, 2.0, 1.0}, sides));
};

/** How far along the surface's normals the truth places the source's points from the
 * surface, and that they were not moved in any other direction. */
std::vector<double>
displacements(const Case& work)
{
  const auto placed = placedSource(work);
  const Eigen::Matrix3d turn = work.truth.topLeftCorner<3, 3>() / scaleOf(work.truth);
  std::vector<double> result;
  for (std::size_t i = 0; i < placed.size(); ++i) {
    const Eigen::Vector3d normal = turn * work.source_normals[i].cast<double>();
    int axis = 0;
    EXPECT_NEAR(1.0, normal.cwiseAbs().maxCoeff(&axis), 1e-5);
    const double side = std::copysign(1.0, placed[i][axis]);
    const double outwards = side * placed[i][axis] - half()[axis];
    result.push_back(normal[axis] * side > 0.0 ? outwards : -outwards);
    for (const int other : {(axis + 1) % 3, (axis + 2) % 3})
      EXPECT_LT(std::abs(placed[i][other]), half()[other] + 1e-6);
  }
  return result;
}

/** The paper's l_k, of the target: as many points, without noise. */
double
neighbourDistance(const Case& work)
{
  SurfacePoints points;
  for (const auto& position : positionsOf(*work.target))
    points.push_back({position, Eigen::Vector3d::Zero()});
  return meanNeighbourDistance(points);
}

double
mean(const std::vector<double>& values, int power)
{
  double sum = 0.0;
  for (const double value : values)
    sum += std::pow(value, power);
  return sum / static_cast<double>(values.size());
}

/** Whether a plane has all of the one on one side, and all of the other on the other:
 * the perceptron finds it, then. */
bool
planeSeparates(const std::vector<Eigen::Vector3d>& one,
               const std::vector<Eigen::Vector3d>& other)
{
  Eigen::AlignedBox3d bounds;
  for (const auto& points : {one, other})
    for (const auto& point : points)
      bounds.extend(point);
  Eigen::Vector4d plane = Eigen::Vector4d::Zero();
  const auto learn = [&](const std::vector<Eigen::Vector3d>& points, double side) {
    bool right = true;
    for (const auto& point : points) {
      const Eigen::Vector3d place =
          2.0 * (point - bounds.center()).cwiseQuotient(bounds.sizes());
      const Eigen::Vector4d p = side * place.homogeneous();
      if (plane.dot(p) > 0.0)
        continue;
      plane += p;
      right = false;
    }
    return right;
  };
  for (int pass = 0; pass < 50000; ++pass) {
    const bool right = learn(one, 1.0);
    if (learn(other, -1.0) && right)
      return true;
  }
  return false;
}

} // namespace

TEST_F(EvaluationCases, FollowFromNamesAndSeed)
{
  for (const char* condition : {"similarity", "density", "gauss-0.66", "deleted-0.3"}) {
    const Case first = caseOf(condition, 300), again = caseOf(condition, 300);
    EXPECT_TRUE(same(*first.source, *again.source)) << condition;
    EXPECT_TRUE(same(*first.target, *again.target)) << condition;
    EXPECT_TRUE(same(*first.whole, *again.whole)) << condition;
    EXPECT_TRUE(same(*first.whole_again, *again.whole_again)) << condition;
    EXPECT_EQ(first.truth, again.truth) << condition;
    EXPECT_EQ(first.seed, again.seed) << condition;
  }
}

TEST_F(EvaluationCases, DifferByModelSeedConditionAndRepetition)
{
  std::vector<Case> cases = {caseOf("similarity", 300), caseOf("uniform-1", 300),
                             caseOf("similarity", 300, 1)};
  const Surface surface = surfaceOf(folder, box({3.0, 2.0, 1.0}, sides));
  const auto condition = conditionOf("similarity", 300, protocol);
  cases.push_back(makeCase(surface, "box2", condition, 0, protocol));
  protocol.seed = 1;
  cases.push_back(makeCase(surface, "box", condition, 0, protocol));
  for (std::size_t i = 0; i < cases.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_FALSE(same(*cases[i].target, *cases[j].target)) << i << ' ' << j;
      EXPECT_GT((cases[i].truth - cases[j].truth).norm(), 0.01) << i << ' ' << j;
      EXPECT_NE(cases[i].seed, cases[j].seed) << i << ' ' << j;
    }
}

TEST_F(EvaluationCases, StayTheSame)
{
  const Case work = caseOf("similarity", 300);
  EXPECT_EQ(85814038u, work.seed);
  EXPECT_NEAR(1.0, work.diagonal, 1e-6);
  EXPECT_LT((Eigen::RowVector4d(-0.244856551978, -0.526450672268, 0.689851154056,
                                0.353390064385) -
             work.truth.row(0))
                .norm(),
            1e-9);
  EXPECT_LT((Eigen::Vector3f(-0.147586286f, 0.282842726f, 0.0428438969f) -
             (*work.target)[0].getVector3fMap())
                .norm(),
            1e-6);
  EXPECT_LT((Eigen::Vector3f(-0.477480829f, 0.536795378f, -0.784606159f) -
             (*work.source)[0].getVector3fMap())
                .norm(),
            1e-6);
}

TEST_F(EvaluationCases, TruthPlacesTheSourceOnTheSurface)
{
  const Case work = caseOf("similarity", 2000);
  EXPECT_EQ(2000u, work.source->size());
  EXPECT_EQ(2000u, work.target->size());
  EXPECT_EQ(1.0, work.overlap);
  const auto target = positionsOf(*work.target);
  double nearest = 0.0;
  for (const auto& point : placedSource(work)) {
    EXPECT_LT(distanceToBox(point), 1e-6);
    nearest += distanceToNearest(point, target) / 2000.0;
  }
  for (const auto& point : target)
    EXPECT_LT(distanceToBox(point), 1e-6);
  for (const auto& cloud : {work.whole, work.whole_again})
    for (const auto& point : positionsOf(*cloud))
      ASSERT_LT(distanceToBox(point), 1e-6);
  // of independent points on this area
  const Eigen::Vector3d h = half();
  const double area = 8.0 * (h.x() * h.y() + h.y() * h.z() + h.z() * h.x());
  EXPECT_NEAR(0.5 * std::sqrt(area / 2000.0), nearest, 0.1 * nearest);
}

TEST_F(EvaluationCases, NormalsBelongToTheirPoints)
{
  for (const double displacement : displacements(caseOf("similarity", 500)))
    EXPECT_NEAR(0.0, displacement, 1e-6);
  const Case work = caseOf("similarity", 500);
  ASSERT_EQ(500u, work.target_normals.size());
  for (std::size_t i = 0; i < 500; ++i) {
    int axis = 0;
    EXPECT_NEAR(1.0, work.target_normals[i].cwiseAbs().maxCoeff(&axis), 1e-6);
    EXPECT_NEAR(half()[axis], std::abs((*work.target)[i].getVector3fMap()[axis]), 1e-6);
  }
}

TEST_F(EvaluationCases, SimilaritiesFillTheirRanges)
{
  const auto extremes = [&] {
    Eigen::AlignedBox4d range;
    for (unsigned int i = 0; i < 60; ++i) {
      const Eigen::Matrix4d similarity = caseOf("similarity", 200, i).truth.inverse();
      Eigen::Vector4d values;
      values << scaleOf(similarity), similarity.topRightCorner<3, 1>();
      range.extend(values);
      const Eigen::Matrix3d turn =
          similarity.topLeftCorner<3, 3>() / scaleOf(similarity);
      EXPECT_LT((turn * turn.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-9);
    }
    return range;
  };
  const auto usual = extremes();
  EXPECT_GE(usual.min()[0], 0.8 - 1e-9);
  EXPECT_LT(usual.min()[0], 0.84);
  EXPECT_LE(usual.max()[0], 1.2 + 1e-9);
  EXPECT_GT(usual.max()[0], 1.16);
  for (int axis = 1; axis < 4; ++axis) {
    EXPECT_LT(usual.min()[axis], -0.3);
    EXPECT_GT(usual.max()[axis], 0.3);
  }
  protocol.smallest_scale = 2.0;
  protocol.largest_scale = 5.0;
  const auto large = extremes();
  EXPECT_GE(large.min()[0], 2.0 - 1e-9);
  EXPECT_LE(large.max()[0], 5.0 + 1e-9);
  EXPECT_GT(large.max()[0], 4.5);
}

TEST_F(EvaluationCases, RotationsFollowTheProtocol)
{
  const auto countSmall = [&] {
    int small = 0;
    for (unsigned int i = 0; i < 60; ++i) {
      const Eigen::Matrix4d similarity = caseOf("similarity", 200, i).truth.inverse();
      small += !turnsAboutEachAxisBy(30.0, similarity.topLeftCorner<3, 3>() /
                                               scaleOf(similarity));
    }
    return small;
  };
  EXPECT_EQ(0, countSmall());
  protocol.rotations = Rotations::SO3;
  EXPECT_GT(countSmall(), 10);
}

TEST_F(EvaluationCases, GaussianNoiseMovesAlongTheNormals)
{
  for (const double range : {0.33, 0.66}) {
    const Case work = caseOf(range == 0.33 ? "gauss-0.33" : "gauss-0.66", 5000);
    const auto moved = displacements(work);
    const double sigma = range * neighbourDistance(work);
    EXPECT_NEAR(0.0, mean(moved, 1), 4.0 * sigma / std::sqrt(5000.0));
    EXPECT_NEAR(sigma, std::sqrt(mean(moved, 2)), 0.05 * sigma);
    EXPECT_NEAR(3.0, mean(moved, 4) / std::pow(mean(moved, 2), 2), 0.4);
  }
}

TEST_F(EvaluationCases, UniformNoiseIsOneSided)
{
  for (const double range : {0.5, 1.0}) {
    const Case work = caseOf(range == 0.5 ? "uniform-0.5" : "uniform-1", 5000);
    const auto moved = displacements(work);
    const double most = range * neighbourDistance(work);
    EXPECT_GT(*std::min_element(moved.begin(), moved.end()), -1e-6);
    EXPECT_NEAR(most, *std::max_element(moved.begin(), moved.end()), 0.03 * most);
    EXPECT_NEAR(most / 2.0, mean(moved, 1), 0.03 * most);
    EXPECT_NEAR(most * most / 3.0, mean(moved, 2), 0.03 * most * most);
  }
}

TEST_F(EvaluationCases, DeletedShareLiesBehindAPlane)
{
  const Surface surface = surfaceOf(folder, lump());
  for (const double share : {0.3, 0.55}) {
    protocol.deleted = share;
    Condition condition = conditionsOf({"deleted"}, protocol).at(0);
    condition.points = 101;
    const Case cut = makeCase(surface, "lump", condition, 0, protocol);
    condition.deleted = 0.0;
    const Case all = makeCase(surface, "lump", condition, 0, protocol);
    EXPECT_EQ(1.0 - share, cut.overlap);
    EXPECT_EQ(std::lround((1.0 - share) * 101.0), std::ptrdiff_t(cut.source->size()));
    EXPECT_EQ(cut.source->size(), cut.source_normals.size());
    EXPECT_EQ(101u, cut.target->size());
    EXPECT_EQ(all.truth, cut.truth);

    const auto kept = positionsOf(*cut.source);
    std::vector<Eigen::Vector3d> removed;
    for (const auto& point : positionsOf(*all.source))
      if (distanceToNearest(point, kept) > 0.0)
        removed.push_back(point);
    ASSERT_EQ(101u, kept.size() + removed.size());
    EXPECT_TRUE(planeSeparates(kept, removed));
  }
}

TEST_F(EvaluationCases, CutsComeFromAllDirections)
{
  Eigen::AlignedBox3d range;
  for (unsigned int i = 0; i < 40; ++i) {
    const Case work = caseOf("deleted-0.3", 300, i);
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const auto& point : placedSource(work))
      middle += point / static_cast<double>(work.source->size());
    range.extend(middle);
  }
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_LT(range.min()[axis], -0.03);
    EXPECT_GT(range.max()[axis], 0.03);
  }
}

TEST_F(EvaluationCases, DensityFallsTwentyfold)
{
  // The points of a ball are spread evenly along each axis.
  const Surface surface =
      surfaceOf(folder, ellipsoid({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}));
  const auto condition = conditionOf("density", 10000, protocol);
  const Case work = makeCase(surface, "ball", condition, 0, protocol);
  EXPECT_EQ(10000u, work.target->size());
  ASSERT_EQ(5000u, work.source->size());
  EXPECT_EQ(5000u, work.source_normals.size());
  EXPECT_EQ(1.0, work.overlap);
  const double radius = 0.5 / std::sqrt(3.0);
  const auto placed = placedSource(work);
  Eigen::Vector3d dense = Eigen::Vector3d::Zero();
  for (const auto& point : placed) {
    EXPECT_NEAR(radius, point.norm(), 0.02 * radius);
    dense += point / 5000.0;
  }
  double mean_place = 0.0, first_tenth = 0.0, last_tenth = 0.0;
  for (const auto& point : placed) {
    const double place = (1.0 - point.dot(dense.normalized()) / radius) / 2.0;
    mean_place += place / 5000.0;
    first_tenth += place < 0.1;
    last_tenth += place > 0.9;
  }
  EXPECT_NEAR(1.0 / std::log(20.0) - 1.0 / 19.0, mean_place, 0.015);
  EXPECT_NEAR(std::pow(20.0, 0.9), first_tenth / last_tenth, 4.0);
}

TEST_F(EvaluationCases, TrueScaleLeavesTheRest)
{
  for (const char* condition : {"similarity", "deleted-0.3"}) {
    const Case original = caseOf(condition, 300), scaled = withTrueScale(original);
    EXPECT_GT(std::abs(scaleOf(original.truth) - 1.0), 1e-3);
    EXPECT_NEAR(1.0, scaleOf(scaled.truth), 1e-12);
    const auto before = placedSource(original), after = placedSource(scaled);
    ASSERT_EQ(before.size(), after.size());
    for (std::size_t i = 0; i < before.size(); ++i)
      ASSERT_LT((before[i] - after[i]).norm(), 1e-6);
    EXPECT_EQ(original.source_normals, scaled.source_normals);
    EXPECT_TRUE(same(*original.target, *scaled.target));
    EXPECT_EQ(original.overlap, scaled.overlap);
    EXPECT_EQ(original.seed, scaled.seed);
    // the original stays
    EXPECT_FALSE(same(*original.source, *scaled.source));
  }
}

TEST_F(EvaluationCases, OfACloudShareNoPoint)
{
  const Surface surface(folder.write("cloud.pcd", pcdOf(scattered(1000, 1))));
  Random random = randomFor("all");
  std::vector<Eigen::Vector3d> all;
  for (const auto& point : surface.draw(1000, random))
    all.push_back(point.position);
  for (const char* name : {"similarity", "density", "deleted-0.3"}) {
    const Case work =
        makeCase(surface, "cloud", conditionOf(name, 400, protocol), 0, protocol);
    const auto target = positionsOf(*work.target);
    for (const auto& point : placedSource(work)) {
      EXPECT_LT(distanceToNearest(point, all), 1e-6) << name;
      EXPECT_GT(distanceToNearest(point, target), 1e-5) << name;
    }
  }
}
