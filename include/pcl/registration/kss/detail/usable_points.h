/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/detail/bulk.h>
#include <pcl/registration/kss/detail/grid_index.h>
#include <pcl/registration/kss/detail/points.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

// Of a cloud, whatever holds it, these ask for places only: what place (i) returns is
// the position of point i, as three floats or doubles of Eigen's.

namespace pcl {
namespace kss {

/** \brief Those of the indices whose points have finite coordinates. */
template <typename Places, typename Index>
std::vector<Index>
finiteIndices(const Places& place, const std::vector<Index>& indices)
{
  std::vector<Index> finite;
  finite.reserve(indices.size());
  for (const Index i : indices)
    if (place(i).allFinite())
      finite.push_back(i);
  return finite;
}

/** \brief So many of the indices, spread over all of them; a step that wanders keeps
 * clear of the rows of an organized cloud.
 * \param[in] indices any number
 * \param[in] most 0: all
 */
template <typename Index>
std::vector<Index>
spread(const std::vector<Index>& indices, std::size_t most)
{
  if (most == 0 || indices.size() <= most)
    return indices;
  constexpr double golden = 0.6180339887498949;
  const double step = static_cast<double>(indices.size()) / static_cast<double>(most);
  std::vector<Index> some;
  some.reserve(most);
  for (std::size_t i = 0; i < most; ++i) {
    const double at = static_cast<double>(i);
    const double found = at * step + std::fmod(golden * at, 1.0) * (step - 1.0);
    some.push_back(indices[static_cast<std::size_t>(found)]);
  }
  return some;
}

/** \brief Order indices such that points that follow each other lie close together, as
 * it suits a processor's cache.
 * \param[in] place finite at the indices
 * \param[in,out] indices at least one
 */
template <typename Places, typename Index>
void
sortInSpace(const Places& place, std::vector<Index>& indices)
{
  const auto at = [&place](Index i) -> Eigen::Vector3f {
    return place(i).template cast<float>();
  };
  Eigen::AlignedBox3f box;
  for (const Index i : indices)
    box.extend(at(i));
  const Eigen::Array3f size = box.sizes().array().max(1e-30f);
  // the interleaved bits of the coordinates, in 64ths of the box
  std::vector<std::pair<unsigned int, Index>> keys;
  for (const Index i : indices) {
    const Eigen::Array3i cell =
        toIndices(Eigen::Array3f(63.0f * (at(i) - box.min()).array() / size),
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

/** \brief The bulk of some points of a cloud.
 * \param[in] place finite at the indices
 * \param[in] indices at least one
 */
template <typename Places, typename Index>
Bulk
bulkOf(const Places& place, const std::vector<Index>& indices)
{
  std::vector<Eigen::Vector3d> some;
  for (const Index i : spread(indices, bulk_points))
    some.emplace_back(place(i).template cast<double>());
  return bulkOf(std::move(some));
}

/** \brief The mean of some points of a cloud.
 * \param[in] place finite at the indices
 * \param[in] indices at least one
 */
template <typename Places, typename Index>
Eigen::Vector3d
centroidOf(const Places& place, const std::vector<Index>& indices)
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Index i : indices)
    sum += place(i).template cast<double>();
  return sum / static_cast<double>(indices.size());
}

/** \brief What of a cloud a registration goes by. */
template <typename Index>
struct UsablePoints {
  /** \brief The indices of the finite points that its bulk holds. */
  std::vector<Index> indices;
  /** \brief Where they lie. */
  Bulk bulk;
  /** \brief How many finite points lie too far away. */
  std::size_t far = 0;
};

/** \brief Leave out points that are not finite, or far away from all others.
 * \param[in] place of any points
 * \param[in] indices of some
 * \throws std::invalid_argument where nothing is left, or where throwIfTooWide() does
 */
template <typename Places, typename Index>
UsablePoints<Index>
usablePoints(const Places& place, const std::vector<Index>& indices)
{
  UsablePoints<Index> usable;
  usable.indices = finiteIndices(place, indices);
  if (usable.indices.empty())
    throw std::invalid_argument("it has no finite points");
  usable.bulk = bulkOf(place, usable.indices);
  throwIfTooWide(usable.bulk);
  const auto is_far = [&](Index i) {
    return !usable.bulk.holds(place(i).template cast<double>());
  };
  const auto end = std::remove_if(usable.indices.begin(), usable.indices.end(), is_far);
  usable.far = static_cast<std::size_t>(usable.indices.end() - end);
  usable.indices.erase(end, usable.indices.end());
  return usable;
}

/** \brief The normals of some points, of unit length; zero where they have none.
 * \param[in] normal what normal (i) returns is the normal of point i, of any length
 * \return no columns where most of the points have none
 */
template <typename Normals, typename Index>
Points
unitNormals(const Normals& normal, const std::vector<Index>& indices)
{
  const auto unit = [&normal](Index i) -> Eigen::Vector3f {
    const Eigen::Vector3d given = normal(i).template cast<double>();
    const double length = given.norm();
    if (!std::isfinite(length) || length == 0.0)
      return Eigen::Vector3f::Zero();
    return (given / length).template cast<float>();
  };
  const auto known = static_cast<std::size_t>(std::count_if(
      indices.begin(), indices.end(), [&unit](Index i) { return !unit(i).isZero(); }));
  Points normals;
  if (2 * known > indices.size()) {
    normals.resize(3, indices.size());
    for (std::size_t i = 0; i < indices.size(); ++i)
      normals.col(i) = unit(indices[i]);
  }
  return normals;
}

/** \brief Usable points, in a frame in their middle, without normals. */
template <typename Places, typename Index>
LocalCloud
localCloud(const Places& place, const UsablePoints<Index>& usable)
{
  LocalCloud local;
  local.origin = usable.bulk.middle;
  local.points.resize(3, usable.indices.size());
  for (std::size_t i = 0; i < usable.indices.size(); ++i)
    local.points.col(i) =
        (place(usable.indices[i]).template cast<double>() - local.origin)
            .template cast<float>();
  return local;
}

/** \brief What rounding to floats alone contributes to the squared distance of two
 * points: a few dozen roundings of the largest coordinate, as many steps of ICP make.
 * \param[in] place finite at the indices
 * \param[in] indices any number
 */
template <typename Places, typename Index>
double
roundingError(const Places& place, const std::vector<Index>& indices)
{
  double largest = 0.0;
  for (const Index i : indices)
    largest = std::max(largest, place(i).template cast<double>().squaredNorm());
  return largest * std::pow(10.0 * std::numeric_limits<float>::epsilon(), 2);
}

} // namespace kss
} // namespace pcl
