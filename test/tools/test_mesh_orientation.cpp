/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * Which way the faces of meshes are wound, and the normals of points on them.
 */

#include "tool_files.h"

#include "io/mesh_orientation.h"
#include "io/mesh_sampling.h"

using namespace kss_test;

namespace {

/** A cube, its faces wound outwards. */
void
addCube(std::vector<double>& coordinates,
        std::vector<pcl::Vertices>& faces,
        const Eigen::Vector3d& center,
        double half)
{
  const auto first = static_cast<pcl::index_t>(coordinates.size() / 3);
  for (int corner = 0; corner < 8; ++corner)
    for (int axis = 0; axis < 3; ++axis)
      coordinates.push_back(center[axis] + (corner >> axis & 1 ? half : -half));
  for (const auto& corners : {pcl::Indices{0, 2, 3, 1},
                              {4, 5, 7, 6},
                              {0, 1, 5, 4},
                              {2, 6, 7, 3},
                              {0, 4, 6, 2},
                              {1, 3, 7, 5}}) {
    faces.emplace_back();
    for (const pcl::index_t corner : corners)
      faces.back().vertices.push_back(first + corner);
  }
}

struct Cube {
  Eigen::Vector3d center;
  double half;
};

Geometry
cubes(const std::vector<Cube>& cubes)
{
  std::vector<double> coordinates;
  Geometry mesh;
  for (const Cube& cube : cubes)
    addCube(coordinates, mesh.faces, cube.center, cube.half);
  mesh.cloud = cloudOfDoubles(coordinates, {"x", "y", "z"});
  return mesh;
}

void
reverse(Geometry& mesh, std::size_t face)
{
  std::reverse(mesh.faces[face].vertices.begin(), mesh.faces[face].vertices.end());
}

/** Each face with points of its own. */
Geometry
unwelded(const Geometry& mesh)
{
  const Points points = positionsOf(mesh);
  std::vector<double> coordinates;
  Geometry apart;
  for (const auto& face : mesh.faces) {
    apart.faces.emplace_back();
    for (const auto corner : face.vertices) {
      apart.faces.back().vertices.push_back(coordinates.size() / 3);
      coordinates.insert(coordinates.end(), points[corner].data(),
                         points[corner].data() + 3);
    }
  }
  apart.cloud = cloudOfDoubles(coordinates, {"x", "y", "z"});
  return apart;
}

/** Of each face: whether its normal points away from a centre. */
std::vector<bool>
pointAway(const Geometry& mesh, const Eigen::Vector3d& center)
{
  const Points points = positionsOf(mesh);
  std::vector<bool> away;
  for (const auto& face : mesh.faces) {
    const auto& [a, b, c] = std::tie(points[face.vertices[0]], points[face.vertices[1]],
                                     points[face.vertices[2]]);
    away.push_back((b - a).cross(c - a).dot(a - center) > 0.0);
  }
  return away;
}

const std::vector<bool> all_six(6, true);

TEST(MeshOrientation, TurnsWhatIsClosedOutwards)
{
  const Eigen::Vector3d center(10.0, -20.0, 5.0);
  // as it is, inside out, one face wrong, most faces wrong
  for (const std::vector<std::size_t>& wrong :
       {std::vector<std::size_t>{}, {0, 1, 2, 3, 4, 5}, {3}, {0, 2, 3, 4, 5}}) {
    Geometry mesh = cubes({{center, 1.0}});
    for (const std::size_t face : wrong)
      reverse(mesh, face);
    for (Geometry cube : {mesh, unwelded(mesh)}) {
      turnOutwards(cube);
      EXPECT_EQ(all_six, pointAway(cube, center)) << wrong.size();
    }
  }
}

TEST(MeshOrientation, LeavesWhatIsOpen)
{
  Geometry mesh = cubes({{{0.0, 0.0, 0.0}, 1.0}});
  for (std::size_t face = 0; face < 6; ++face)
    reverse(mesh, face);
  reverse(mesh, 2);
  mesh.faces.pop_back();
  const auto before = pointAway(mesh, {0.0, 0.0, 0.0});
  turnOutwards(mesh);
  EXPECT_EQ(before, pointAway(mesh, {0.0, 0.0, 0.0}));
  // an edge of three faces, and a point that is nowhere
  mesh = cubes({{{0.0, 0.0, 0.0}, 1.0}});
  reverse(mesh, 4);
  mesh.faces.push_back(mesh.faces[1]);
  turnOutwards(mesh);
  EXPECT_EQ(std::vector<bool>({true, true, true, true, false, true, true}),
            pointAway(mesh, {0.0, 0.0, 0.0}));
  Geometry nowhere;
  nowhere.cloud =
      cloudOfDoubles({0, 0, 0, 1, 0, 0, 0, 1, 0, NOT_A_NUMBER, 0, 1}, {"x", "y", "z"});
  nowhere.faces = nearTetrahedron().faces;
  const auto faces = nowhere.faces;
  turnOutwards(nowhere);
  for (std::size_t i = 0; i < faces.size(); ++i)
    EXPECT_EQ(faces[i].vertices, nowhere.faces[i].vertices);
}

TEST(MeshOrientation, KnowsPartsAndCavities)
{
  const auto ofPart = [](const Geometry& mesh, std::size_t part,
                         const Eigen::Vector3d& center) {
    auto away = pointAway(mesh, center);
    return std::vector<bool>(away.begin() + 6 * part, away.begin() + 6 * part + 6);
  };
  const Eigen::Vector3d there(5.0, 0.0, 0.0), here(0.0, 0.0, 0.0);
  // two parts, of which one has a face that is wrong
  Geometry parts = cubes({{here, 1.0}, {there, 0.5}});
  for (const std::size_t face : {7, 8, 9, 10, 11})
    reverse(parts, face);
  turnOutwards(parts);
  EXPECT_EQ(all_six, ofPart(parts, 0, here));
  EXPECT_EQ(all_six, ofPart(parts, 1, there));
  // a cavity's normals point into it, also where the file has all inside out
  for (const bool inside_out : {false, true}) {
    Geometry hollow = cubes({{here, 1.0}, {here, 0.5}});
    for (std::size_t face = inside_out ? 0 : 6; face < (inside_out ? 6 : 12); ++face)
      reverse(hollow, face);
    turnOutwards(hollow);
    EXPECT_EQ(all_six, ofPart(hollow, 0, here));
    EXPECT_EQ(std::vector<bool>(6, false), ofPart(hollow, 1, here));
  }
}

TEST(MeshOrientation, TellsTheNormalsOfSamples)
{
  Geometry mesh = cubes({{{1.0, 2.0, 3.0}, 0.5}});
  reverse(mesh, 3);
  const SurfacePoints samples = sampleMesh(mesh, 500);
  ASSERT_EQ(500u, samples.normals.size());
  for (std::size_t i = 0; i < samples.normals.size(); ++i) {
    const Eigen::Vector3d from_center =
        samples.positions[i] - Eigen::Vector3d(1.0, 2.0, 3.0);
    EXPECT_NEAR(1.0, samples.normals[i].norm(), 1e-12);
    EXPECT_NEAR(0.5, samples.normals[i].dot(from_center), 1e-12);
  }
}

TEST(MeshOrientation, LeavesNormalsOfPointsAsTheFileHasThem)
{
  const Points normals = normalsOf(fieldsOfAllKinds());
  ASSERT_EQ(6u, normals.size());
  EXPECT_EQ(Eigen::Vector3d(1.0, 0.0, 0.0), normals[2]);
  EXPECT_TRUE(normalsOf(nearTetrahedron()).empty());
}

} // namespace
