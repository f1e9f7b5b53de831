/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "random.h"

#include "io/mesh_sampling.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

/** What a model's clouds are drawn from. */
namespace evaluation {

using tool::SurfacePoint;
using SurfacePoints = std::vector<SurfacePoint>;

/** \brief The surface of a mesh, or a cloud that stands for one; centred at the origin,
 * its diagonal 1.
 */
class Surface {
public:
  /** \brief Read a model. The normals of a cloud are estimated from 12 neighbours and
   * point away from its middle.
   * \throws std::runtime_error where the file cannot be read, or has neither area nor
   * enough points
   */
  explicit Surface(const std::string& path);

  /** \brief Whether it can be sampled with any number of points. */
  bool
  isMesh() const
  {
    return mesh_.has_value();
  }

  /** \brief Points at random, uniformly by area. Of a cloud at most all its points are
   * drawn, each once.
   */
  SurfacePoints
  draw(std::size_t number, Random& random) const;

  /** \brief Two samplings that have no point in common. Of a cloud the first takes at
   * most half of the points, the second what is left.
   */
  std::pair<SurfacePoints, SurfacePoints>
  drawTwo(std::size_t first, std::size_t second, Random& random) const;

private:
  std::optional<tool::MeshSampler> mesh_;
  SurfacePoints cloud_;
};

} // namespace evaluation
