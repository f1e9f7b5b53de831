/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "clouds.h"

#include <Eigen/Geometry>

#include <array>
#include <string>
#include <vector>

namespace benchmarks {

struct TriangleMesh {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<std::size_t, 3>> triangles;
};

/** \brief Read a mesh file, and put it about the origin.
 * \param[in] size what the diagonal of its box becomes
 * \throws std::runtime_error naming the file where it is no mesh
 */
TriangleMesh
readMesh(const std::string& path, double size);

/** \brief A closed surface with bumps, dents and a few horns, and without any symmetry:
 * another one with every seed.
 * \param[in] size the diagonal of its box
 */
TriangleMesh
makeLump(unsigned int seed, double size);

/** \brief One depth image of a mesh, in the frame of the camera: x to the right, y
 * down.
 *
 * Faces that are seen at more than 80 degrees give no depth, as with real cameras.
 * \param[in] focal_length in pixels; the image has 640 x 480
 * \param[in] noise of the depths: the standard deviation
 */
Cloud::Ptr
photograph(const TriangleMesh& mesh,
           const Eigen::Isometry3d& camera,
           double focal_length,
           double noise,
           unsigned int seed);

} // namespace benchmarks
