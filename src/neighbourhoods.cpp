/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include <pcl/point_types.h>
#include <pcl/registration/kss/neighbourhoods.h>
#include <pcl/search/kdtree.h>

#include "parallel.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace pcl {
namespace kss {

Neighbourhoods
neighbourhoodsOf(const Points& points, int neighbours, unsigned int threads)
{
  const Eigen::Index size = points.cols();
  const int k = static_cast<int>(std::min<Eigen::Index>(neighbours, size - 1));
  Neighbourhoods found{Eigen::MatrixXi(k, size), Eigen::MatrixXf(k, size)};
  const auto cloud = pcl::make_shared<PointCloud<PointXYZ>>();
  for (Eigen::Index i = 0; i < size; ++i)
    cloud->push_back({points(0, i), points(1, i), points(2, i)});
  search::KdTree<PointXYZ> tree;
  tree.setInputCloud(cloud);
#pragma omp parallel for num_threads(threadCount(threads)) if (size > 1000)
  for (Eigen::Index i = 0; i < size; ++i) {
    Indices indices(k + 1);
    std::vector<float> squared(k + 1);
    tree.nearestKSearch((*cloud)[i], k + 1, indices, squared);
    int taken = 0;
    for (int n = 0; n <= k && taken < k; ++n)
      if (indices[n] != i) {
        found.indices(taken, i) = indices[n];
        found.distances(taken, i) = std::sqrt(squared[n]);
        ++taken;
      }
  }
  return found;
}

Eigen::VectorXf
surfaceVariation(const Points& points,
                 const Neighbourhoods& neighbourhoods,
                 unsigned int threads)
{
  const Eigen::Index size = points.cols(), k = neighbourhoods.indices.rows();
  Eigen::VectorXf variation(size);
#pragma omp parallel for num_threads(threadCount(threads)) if (size > 1000)
  for (Eigen::Index i = 0; i < size; ++i) {
    Points around(3, k);
    for (Eigen::Index n = 0; n < k; ++n)
      around.col(n) = points.col(neighbourhoods.indices(n, i));
    around.colwise() -= around.rowwise().mean().eval();
    const Eigen::Matrix3f scatter = around * around.transpose();
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> solver;
    solver.computeDirect(scatter, Eigen::EigenvaluesOnly);
    const float total = scatter.trace();
    variation[i] =
        total > 0.0f ? std::max(0.0f, solver.eigenvalues()[0]) / total : 0.0f;
  }
  return variation;
}

Eigen::VectorXf
spacingOf(const Neighbourhoods& neighbourhoods)
{
  // the k-th neighbour's circle holds k points
  const Eigen::Index k = std::min<Eigen::Index>(6, neighbourhoods.distances.rows());
  if (k == 0)
    return Eigen::VectorXf::Zero(neighbourhoods.distances.cols());
  return neighbourhoods.distances.row(k - 1).transpose() *
         std::sqrt(static_cast<float>(M_PI) / k);
}

} // namespace kss
} // namespace pcl
