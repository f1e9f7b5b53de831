/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/point_cloud.h>
#include <pcl/registration/kss/points.h>
#include <pcl/types.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace pcl {
namespace kss {

/** \brief Those of the indices whose points have finite coordinates. */
template <typename PointT>
Indices
finiteIndices(const PointCloud<PointT>& cloud, const Indices& indices)
{
  Indices finite;
  finite.reserve(indices.size());
  for (const index_t i : indices)
    if (cloud[i].getVector3fMap().allFinite())
      finite.push_back(i);
  return finite;
}

/** \brief The indices of all points whose coordinates are finite. */
template <typename PointT>
Indices
finiteIndices(const PointCloud<PointT>& cloud)
{
  Indices all(cloud.size());
  std::iota(all.begin(), all.end(), 0);
  return finiteIndices(cloud, all);
}

/** \brief So many of the indices, spread over all of them; a step that wanders keeps
 * clear of the rows of an organized cloud.
 * \param[in] indices any number
 * \param[in] most 0: all
 */
inline Indices
spread(const Indices& indices, std::size_t most)
{
  if (most == 0 || indices.size() <= most)
    return indices;
  constexpr double golden = 0.6180339887498949;
  const double step = static_cast<double>(indices.size()) / static_cast<double>(most);
  Indices some;
  some.reserve(most);
  for (std::size_t i = 0; i < most; ++i) {
    const double at = static_cast<double>(i);
    const double place = at * step + std::fmod(golden * at, 1.0) * (step - 1.0);
    some.push_back(indices[static_cast<std::size_t>(place)]);
  }
  return some;
}

/** \brief Order indices such that points that follow each other lie close together, as
 * it suits a processor's cache.
 * \param[in] cloud has finite points at the indices
 * \param[in,out] indices at least one
 */
template <typename PointT>
void
sortInSpace(const PointCloud<PointT>& cloud, Indices& indices)
{
  Eigen::AlignedBox3f box;
  for (const index_t i : indices)
    box.extend(Eigen::Vector3f(cloud[i].getVector3fMap()));
  const Eigen::Array3f size = box.sizes().array().max(1e-30f);
  // the interleaved bits of the coordinates, in 64ths of the box
  std::vector<std::pair<unsigned int, index_t>> keys;
  for (const index_t i : indices) {
    const Eigen::Array3i cell =
        (63.0f * (cloud[i].getVector3fMap() - box.min()).array() / size)
            .template cast<int>();
    unsigned int key = 0;
    for (int bit = 5; bit >= 0; --bit)
      for (int axis = 0; axis < 3; ++axis)
        key = key << 1 | (cell[axis] >> bit & 1);
    keys.emplace_back(key, i);
  }
  std::sort(keys.begin(), keys.end());
  std::transform(keys.begin(), keys.end(), indices.begin(),
                 [](const auto& key) { return key.second; });
}

/** \brief The coordinates of some points of a cloud, in a frame near their middle. */
template <typename PointT>
LocalCloud
toLocalCloud(const PointCloud<PointT>& cloud, const Indices& indices)
{
  LocalCloud local;
  for (const index_t i : indices)
    local.origin += cloud[i].getVector3fMap().template cast<double>();
  local.origin /= static_cast<double>(std::max<std::size_t>(1, indices.size()));
  local.points.resize(3, indices.size());
  for (std::size_t i = 0; i < indices.size(); ++i)
    local.points.col(i) =
        (cloud[indices[i]].getVector3fMap().template cast<double>() - local.origin)
            .template cast<float>();
  return local;
}

/** \brief What rounding alone contributes to the squared distance of two points: a few
 * dozen roundings of the largest coordinate, as many steps of ICP make.
 */
template <typename PointT>
double
roundingError(const PointCloud<PointT>& cloud)
{
  double largest = 0.0;
  for (const PointT& point : cloud)
    if (point.getVector3fMap().allFinite())
      largest = std::max<double>(largest, point.getVector3fMap().squaredNorm());
  return largest * std::pow(10.0 * std::numeric_limits<float>::epsilon(), 2);
}

} // namespace kss
} // namespace pcl
