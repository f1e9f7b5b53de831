/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/registration/kss/detail/bulk.h>
#include <pcl/registration/kss/detail/grid_index.h>
#include <pcl/registration/kss/detail/points.h>
#include <pcl/types.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
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

/** \brief The indices of all points. */
template <typename PointT>
Indices
allIndices(const PointCloud<PointT>& cloud)
{
  Indices all(cloud.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

/** \brief Whether all differences and sums of finite coordinates are floats. PCL's tree
 * ends the process where they are not.
 */
template <typename PointT>
bool
canBeSearched(const PointCloud<PointT>& cloud)
{
  constexpr float farthest = 1e38f;
  return std::none_of(cloud.begin(), cloud.end(), [](const PointT& point) {
    const Eigen::Vector3f place = point.getVector3fMap();
    return place.allFinite() && place.cwiseAbs().maxCoeff() > farthest;
  });
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
    const Eigen::Array3i cell = toIndices(
        Eigen::Array3f(63.0f * (cloud[i].getVector3fMap() - box.min()).array() / size),
        Eigen::Array3i::Constant(63));
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

/** \brief Some points of a cloud, as a cloud.
 * \param[in] indices may name points more than once
 */
template <typename PointT>
typename PointCloud<PointT>::ConstPtr
pointsAt(const PointCloud<PointT>& cloud, const Indices& indices)
{
  const auto points = pcl::make_shared<PointCloud<PointT>>();
  points->header = cloud.header;
  points->reserve(indices.size());
  for (const index_t i : indices)
    points->push_back(cloud[i]);
  return points;
}

/** \brief The bulk of some points of a cloud.
 * \param[in] cloud has finite points at the indices
 * \param[in] indices at least one
 */
template <typename PointT>
Bulk
bulkOf(const PointCloud<PointT>& cloud, const Indices& indices)
{
  std::vector<Eigen::Vector3d> some;
  for (const index_t i : spread(indices, bulk_points))
    some.emplace_back(cloud[i].getVector3fMap().template cast<double>());
  return bulkOf(std::move(some));
}

/** \brief The mean of some points of a cloud.
 * \param[in] cloud has finite points at the indices
 * \param[in] indices at least one
 */
template <typename PointT>
Eigen::Vector3d
centroidOf(const PointCloud<PointT>& cloud, const Indices& indices)
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const index_t i : indices)
    sum += cloud[i].getVector3fMap().template cast<double>();
  return sum / static_cast<double>(indices.size());
}

/** \brief What of a cloud a registration goes by. */
struct UsablePoints {
  /** \brief The indices of the finite points that its bulk holds. */
  Indices indices;
  /** \brief Where they lie. */
  Bulk bulk;
  /** \brief How many finite points lie too far away. */
  std::size_t far = 0;
};

/** \brief Leave out points that are not finite, or far away from all others.
 * \param[in] cloud any cloud
 * \param[in] indices of its points
 * \throws std::invalid_argument where nothing is left, or where throwIfTooWide() or
 * throwIfTooFar() does
 */
template <typename PointT>
UsablePoints
usablePoints(const PointCloud<PointT>& cloud, const Indices& indices)
{
  UsablePoints usable;
  usable.indices = finiteIndices(cloud, indices);
  if (usable.indices.empty())
    throw std::invalid_argument("it has no finite points");
  usable.bulk = bulkOf(cloud, usable.indices);
  throwIfTooWide(usable.bulk);
  throwIfTooFar(usable.bulk);
  const auto is_far = [&](index_t i) {
    return !usable.bulk.holds(cloud[i].getVector3fMap().template cast<double>());
  };
  const auto end = std::remove_if(usable.indices.begin(), usable.indices.end(), is_far);
  usable.far = static_cast<std::size_t>(usable.indices.end() - end);
  usable.indices.erase(end, usable.indices.end());
  return usable;
}

/** \brief The normals of some points, of unit length; zero where they have none.
 * \return no columns where the points are of a type without, or most of them have none
 */
template <typename PointT>
Points
normalsOf(const PointCloud<PointT>& cloud, const Indices& indices)
{
  Points normals;
  if constexpr (traits::has_normal<PointT>::value) {
    const auto unit = [&cloud](index_t i) -> Eigen::Vector3f {
      const Eigen::Vector3d normal =
          cloud[i].getNormalVector3fMap().template cast<double>();
      const double length = normal.norm();
      if (!std::isfinite(length) || length == 0.0)
        return Eigen::Vector3f::Zero();
      return (normal / length).template cast<float>();
    };
    const auto known = static_cast<std::size_t>(
        std::count_if(indices.begin(), indices.end(),
                      [&unit](index_t i) { return !unit(i).isZero(); }));
    if (2 * known > indices.size()) {
      normals.resize(3, indices.size());
      for (std::size_t i = 0; i < indices.size(); ++i)
        normals.col(i) = unit(indices[i]);
    }
  }
  return normals;
}

/** \brief The usable points of a cloud, in a frame in their middle. */
template <typename PointT>
LocalCloud
toLocalCloud(const PointCloud<PointT>& cloud, const UsablePoints& usable)
{
  LocalCloud local;
  local.origin = usable.bulk.middle;
  local.points.resize(3, usable.indices.size());
  for (std::size_t i = 0; i < usable.indices.size(); ++i)
    local.points.col(i) =
        (cloud[usable.indices[i]].getVector3fMap().template cast<double>() -
         local.origin)
            .template cast<float>();
  local.normals = normalsOf(cloud, usable.indices);
  return local;
}

/** \brief What rounding alone contributes to the squared distance of two points: a few
 * dozen roundings of the largest coordinate, as many steps of ICP make.
 * \param[in] cloud has finite points at the indices
 * \param[in] indices any number
 */
template <typename PointT>
double
roundingError(const PointCloud<PointT>& cloud, const Indices& indices)
{
  double largest = 0.0;
  for (const index_t i : indices)
    largest = std::max(largest,
                       cloud[i].getVector3fMap().template cast<double>().squaredNorm());
  return largest * std::pow(10.0 * std::numeric_limits<float>::epsilon(), 2);
}

} // namespace kss
} // namespace pcl
