/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "tool_files.h"

#include "io/mesh_sampling.h"

using namespace kss_test;

/** The mean number of samples in each of n parts of equal probability. */
void
expectEven(const std::vector<int>& counts)
{
  double total = 0.0, chi_squared = 0.0;
  for (const int count : counts)
    total += count;
  const double mean = total / counts.size();
  for (const int count : counts)
    chi_squared += (count - mean) * (count - mean) / mean;
  // far beyond any quantile, but near what an uneven distribution would give
  EXPECT_LT(chi_squared, 2.0 * counts.size()) << "of " << counts.size();
}

TEST_F(ToolFiles, SampleMeshesEvenlyByArea)
{
  // A square of one face and a rectangle of nine times its area, all of triangles and
  // quadrangles, with a face that has no place.
  Geometry mesh;
  mesh.cloud = cloudOfDoubles({0, 0, 5, 1, 0,  5, 1, 1,  5, 0, 1,
                               5, 1, 0, 5, 10, 0, 5, 10, 1, 5, NOT_A_NUMBER,
                               0, 0},
                              {"x", "y", "z"});
  for (const auto& corners :
       {pcl::Indices{0, 1, 2, 3}, {4, 5, 6}, {4, 6, 2}, {0, 1, 7}}) {
    mesh.faces.emplace_back();
    mesh.faces.back().vertices = corners;
  }
  const Points samples = sampleMesh(mesh, 20000).positions;
  ASSERT_EQ(20000u, samples.size());
  std::vector<int> counts(10 * 4 * 4);
  for (const auto& sample : samples) {
    ASSERT_NEAR(5.0, sample.z(), 1e-14);
    ASSERT_TRUE(sample.x() >= 0 && sample.x() <= 10 && sample.y() >= 0 &&
                sample.y() <= 1);
    ++counts[std::min(39, static_cast<int>(sample.x() * 4)) * 4 +
             std::min(3, static_cast<int>(sample.y() * 4))];
  }
  expectEven(counts);
  EXPECT_EQ(samples, sampleMesh(mesh, 20000).positions);
}

TEST_F(ToolFiles, SampleMeshesWithoutArea)
{
  Geometry mesh;
  mesh.cloud = cloudOfDoubles({0, 0, 0, 1, 1, 1, 2, 2, 2}, {"x", "y", "z"});
  mesh.faces.emplace_back();
  mesh.faces.back().vertices = {0, 1, 2};
  expectEqual(positionsOf(mesh), sampleMesh(mesh, 100).positions, 0.0);
  EXPECT_TRUE(sampleMesh(mesh, 100).normals.empty());
}
