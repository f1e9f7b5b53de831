/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "geometry.h"

#include <array>
#include <random>
#include <vector>

namespace tool {

/** \brief A point of a surface, and the normal of the face that it lies on. */
struct SurfacePoint {
  Eigen::Vector3d position, normal;
};

/** \brief Draws points of a mesh, uniformly by area. */
class MeshSampler {
public:
  /** \brief Faces that have a point that is not finite are left out. */
  explicit MeshSampler(const Geometry& mesh);

  /** \brief The same of a mesh some of whose faces are wound the wrong way round.
   * \param[in] points the positions of the mesh
   * \param[in] turned which ones; one for each face
   */
  MeshSampler(const Geometry& mesh, Points points, const std::vector<bool>& turned);

  /** \brief The area of all faces; without any, nothing can be drawn. */
  double
  area() const
  {
    return area_up_to_.empty() ? 0.0 : area_up_to_.back();
  }

  /** \brief A point that follows from the generator's state alone, with every standard
   * library.
   */
  SurfacePoint
  draw(std::mt19937_64& generator) const;

private:
  using Triangle = std::array<pcl::index_t, 3>;

  std::array<Eigen::Vector3d, 3>
  cornersOf(const Triangle& triangle) const
  {
    return {points_[triangle[0]], points_[triangle[1]], points_[triangle[2]]};
  }

  Points points_;
  std::vector<Triangle> triangles_;
  std::vector<double> area_up_to_;
};

/** \brief Points of surfaces, and their normals. */
struct SurfacePoints {
  Points positions;
  /** \brief As many; none where they are not known. */
  Points normals;
};

/** \brief Spread points over the faces of a mesh, uniformly by area and the same ones
 * at every call.
 * \param[in] mesh any; one without faces has no area
 * \param[in] number of points
 * \return the points, with the normals of their faces, outwards where the mesh is
 * closed (turnOutwards()); those of the mesh itself where its faces have no area
 */
SurfacePoints
sampleMesh(const Geometry& mesh, std::size_t number);

/** \brief Points of surfaces as a cloud, which keeps all their digits. */
pcl::PCLPointCloud2
cloudOf(const SurfacePoints& points);

} // namespace tool
