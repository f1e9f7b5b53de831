/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/detail/packed_tree.h>
#include <pcl/search/kdtree.h>

#include <cstddef>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace pcl {
namespace kss {

/** \brief PCL's search for one nearest point, or two, by a \ref PackedTree, and for
 * everything else by PCL's k-d tree.
 *
 * Each is built when it is asked for the first time: a cloud that nobody searches costs
 * nothing. Searches may run at the same time.
 */
template <typename PointT>
class PackedSearch : public search::KdTree<PointT> {
  using Base = search::KdTree<PointT>;

public:
  using Ptr = shared_ptr<PackedSearch<PointT>>;
  using Base::nearestKSearch;
  using Base::radiusSearch;
  using typename Base::PointCloudConstPtr;

  PackedSearch()
  : representation_(this->tree_->getPointRepresentation())
  {
  }

  /** \brief What PCL's search returns here: nothing, or, after 1.13, whether it can
   * take the cloud, which is told by searches here. */
  using Accepted =
      decltype(std::declval<search::KdTree<PointT>&>().setInputCloud(nullptr));

  Accepted
  setInputCloud(const PointCloudConstPtr& cloud,
                const IndicesConstPtr& indices = {}) override
  {
    this->input_ = cloud;
    this->indices_ = indices;
    const std::lock_guard<std::mutex> lock(mutex_);
    packed_.reset();
    has_tree_ = false;
    return Accepted(true);
  }

  int
  nearestKSearch(const PointT& point,
                 int k,
                 Indices& indices,
                 std::vector<float>& squared_distances) const override
  {
    if (k > 2 || !isOfSpace()) {
      makeTree();
      return Base::nearestKSearch(point, k, indices, squared_distances);
    }
    const NearestTwo found = packedTree().nearest(point.getVector3fMap().data());
    const std::int32_t found_indices[] = {found.nearest, found.second};
    const float found_squared[] = {found.squared, found.second_squared};
    int number = 0;
    while (number < k && found_indices[number] >= 0)
      ++number;
    indices.assign(found_indices, found_indices + number);
    squared_distances.assign(found_squared, found_squared + number);
    return number;
  }

  int
  radiusSearch(const PointT& point,
               double radius,
               Indices& indices,
               std::vector<float>& squared_distances,
               unsigned int most = 0) const override
  {
    makeTree();
    return Base::radiusSearch(point, radius, indices, squared_distances, most);
  }

  /** \brief Whether distances are those of space, and to all points of a cloud: a
   * \ref PackedTree knows no others. */
  bool
  isOfSpace() const
  {
    return !this->indices_ && this->input_ && !this->input_->empty() &&
           this->tree_->getPointRepresentation() == representation_;
  }

  /** \brief The tree of the cloud, where isOfSpace(). */
  const PackedTree&
  packedTree() const
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!packed_)
      packed_ = std::make_unique<PackedTree>(
          this->input_->front().getVector3fMap().data(), sizeof(PointT) / sizeof(float),
          this->input_->size());
    return *packed_;
  }

private:
  void
  makeTree() const
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!has_tree_)
      this->tree_->setInputCloud(this->input_, this->indices_);
    has_tree_ = true;
  }

  typename Base::PointRepresentationConstPtr representation_;
  mutable std::mutex mutex_;
  mutable std::unique_ptr<const PackedTree> packed_;
  mutable bool has_tree_ = false;
};

} // namespace kss
} // namespace pcl
