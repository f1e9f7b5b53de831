/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/detail/points.h>

#include <optional>
#include <vector>

namespace pcl {
namespace kss {

/** \brief The nearest neighbours of every point of a cloud, the point itself left out.
 */
struct Neighbourhoods {
  /** \brief Neighbours x points: indices of points, nearest first. */
  Eigen::MatrixXi indices;
  /** \brief Neighbours x points: their distances. */
  Eigen::MatrixXf distances;
};

/** \brief Points that know their neighbours. */
struct Surface {
  Points points;
  Neighbourhoods neighbourhoods;
};

/** \brief Find the neighbourhoods of a cloud.
 * \param[in] points the cloud
 * \param[in] neighbours how many of each point; fewer where the cloud has no more
 * \param[in] threads 0: as many as there are cores
 */
Neighbourhoods
neighbourhoodsOf(const Points& points, int neighbours, unsigned int threads);

/** \brief The neighbourhoods of those points of a cloud that are kept: of those whose
 * neighbours all are, they are the same.
 * \param[in] before neighbourhoods of the cloud
 * \param[in] kept indices of points, rising
 * \param[in] points those that are kept
 * \param[in] threads 0: as many as there are cores
 */
Neighbourhoods
withoutOthers(const Neighbourhoods& before,
              const std::vector<int>& kept,
              const Points& points,
              unsigned int threads);

/** \brief Sum up the ways from a point to its neighbours, and their products.
 * \param[in] points a cloud
 * \param[in] point one of them
 * \param[in] neighbours of that, indices
 * \param[in] k how many
 * \param[out] sum
 * \param[out] products a symmetric matrix
 */
void
sumUp(const Points& points,
      Eigen::Index point,
      const int* neighbours,
      Eigen::Index k,
      Eigen::Vector3f& sum,
      Eigen::Matrix3f& products);

/** \brief The surface variation of every neighbourhood (M. Pauly, M. Gross, L. P.
 * Kobbelt, "Efficient Simplification of Point-Sampled Surfaces", 2002): the smallest
 * eigenvalue of its covariance as a fraction of their sum.
 *
 * It is 0 in a plane and 1/3 where points fill space evenly; of a dozen random points
 * in space half the latter. PCL calls it curvature.
 */
Eigen::VectorXf
surfaceVariation(const Points& points,
                 const Neighbourhoods& neighbourhoods,
                 unsigned int threads);

/** \brief The spacing of the points around each point: the edge of the square that
 * a point has for itself if they lie on a surface.
 */
Eigen::VectorXf
spacingOf(const Neighbourhoods& neighbourhoods);

/** \brief How near a surface a point counts as covered by it, in spacings: of random
 * points on a surface, one in a thousand has no point of another such sampling within
 * this distance. */
constexpr float covered = 1.5f;

} // namespace kss
} // namespace pcl
