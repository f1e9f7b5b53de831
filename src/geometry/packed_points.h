/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/detail/packed_tree.h>

#include "support/wide_vectors.h"

#include <Eigen/Geometry>

#include <cstddef>
#include <vector>

namespace pcl {
namespace kss {

/** \brief The points of a cloud in leaves, the boxes around these in nodes, and so on
 * up to one node: see PackedTree.
 */
class PackedPoints {
public:
  /** \brief What a vector holds: as many boxes make a node, twice as many points a
   * leaf. */
  static constexpr int wide = lanes, leaf_size = 2 * wide;

  /** \brief Some points that lie close together; where there are fewer, copies at
   * infinity follow, whose index is -1. */
  struct Leaf {
    float x[leaf_size], y[leaf_size], z[leaf_size];
    std::int32_t indices[leaf_size];
  };

  /** \brief See PackedTree. */
  PackedPoints(const float* first, std::size_t stride, std::size_t size);

  const std::vector<Leaf>&
  leaves() const
  {
    return leaves_;
  }

  /** \brief The box around a leaf's points. */
  Eigen::AlignedBox3f
  boxOf(std::size_t leaf) const;

  /** \brief The two points nearest to a position; see PackedTree. */
  NearestTwo
  nearest(const float* position, float squared_limit) const;

  /** \brief All leaves that may hold points within a distance of a box.
   * \param[in] box where to look
   * \param[in] distance
   * \param[out] leaves their numbers
   */
  void
  leavesWithin(const Eigen::AlignedBox3f& box,
               float distance,
               std::vector<std::size_t>& leaves) const;

private:
  /** The boxes around the children of a node; empty ones around infinity. */
  struct Node {
    float lower[3][wide], upper[3][wide];
  };

  static std::vector<Node>
  nodesOver(const std::vector<Eigen::AlignedBox3f>& boxes);

  std::vector<Leaf> leaves_;
  /** From the nodes over leaves to the root. */
  std::vector<std::vector<Node>> levels_;
};

} // namespace kss
} // namespace pcl
