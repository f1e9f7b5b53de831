/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "geometry/packed_points.h"

#include "geometry/space_filling.h"
#include "support/wide_vectors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace pcl {
namespace kss {
namespace {

using Box = Eigen::AlignedBox3f;

constexpr int wide = PackedPoints::wide, leaf_size = PackedPoints::leaf_size;
constexpr float infinite = std::numeric_limits<float>::infinity();

/** What is to be looked into never has more entries: each level leaves no more than its
 * other children behind. */
constexpr std::size_t deepest = 128;

inline float
larger(float a, float b)
{
  return a > b ? a : b;
}

/** The two nearest of what it is given. */
struct Found : NearestTwo {
  void
  take(std::int32_t index, float at)
  {
    if (at < squared) {
      second_squared = squared;
      second = nearest;
      squared = at;
      nearest = index;
    }
    else if (at < second_squared) {
      second_squared = at;
      second = index;
    }
  }
};

} // namespace

PackedPoints::PackedPoints(const float* first, std::size_t stride, std::size_t size)
{
  const std::vector<std::int32_t> order = alongSpace(first, stride, size);
  leaves_.resize((order.size() + leaf_size - 1) / leaf_size);
  std::vector<Box> boxes(leaves_.size());
  for (std::size_t i = 0; i < leaves_.size() * leaf_size; ++i) {
    constexpr float beyond[] = {infinite, infinite, infinite};
    const bool exists = i < order.size();
    const float* const point = exists ? first + order[i] * stride : beyond;
    Leaf& leaf = leaves_[i / leaf_size];
    leaf.x[i % leaf_size] = point[0];
    leaf.y[i % leaf_size] = point[1];
    leaf.z[i % leaf_size] = point[2];
    leaf.indices[i % leaf_size] = exists ? order[i] : -1;
    if (exists)
      boxes[i / leaf_size].extend(Eigen::Vector3f(point));
  }
  while (boxes.size() > 1 || (levels_.empty() && !boxes.empty())) {
    levels_.push_back(nodesOver(boxes));
    std::vector<Box> over(levels_.back().size());
    for (std::size_t i = 0; i < boxes.size(); ++i)
      over[i / wide].extend(boxes[i]);
    boxes.swap(over);
  }
}

std::vector<PackedPoints::Node>
PackedPoints::nodesOver(const std::vector<Box>& boxes)
{
  std::vector<Node> nodes((boxes.size() + wide - 1) / wide);
  for (std::size_t i = 0; i < nodes.size() * wide; ++i)
    for (int axis = 0; axis < 3; ++axis) {
      Node& node = nodes[i / wide];
      const bool exists = i < boxes.size();
      node.lower[axis][i % wide] = exists ? boxes[i].min()[axis] : infinite;
      node.upper[axis][i % wide] = exists ? boxes[i].max()[axis] : infinite;
    }
  return nodes;
}

Box
PackedPoints::boxOf(std::size_t leaf) const
{
  const Node& node = levels_.front()[leaf / wide];
  Box box;
  for (int axis = 0; axis < 3; ++axis) {
    box.min()[axis] = node.lower[axis][leaf % wide];
    box.max()[axis] = node.upper[axis][leaf % wide];
  }
  return box;
}

PCL_KSS_WIDE NearestTwo
PackedPoints::nearest(const float* position, float squared_limit) const
{
  /** A node, or a leaf, that may hold a nearer point. */
  struct Pending {
    float squared;
    int level; ///< -1: a leaf
    std::size_t number;
  };
  const float px = position[0], py = position[1], pz = position[2];
  Found found;
  // just beyond the limit, so that what lies at it is found
  float bound = std::nextafter(squared_limit, infinite);
  std::array<Pending, deepest> pending;
  std::size_t count = 0;
  if (!levels_.empty())
    pending[count++] = {0.0f, static_cast<int>(levels_.size()) - 1, 0};
  while (count > 0) {
    const Pending next = pending[--count];
    if (!(next.squared < bound))
      continue;
    if (next.level < 0) {
      const Leaf& leaf = leaves_[next.number];
      for (int part = 0; part < leaf_size; part += wide) {
        float squared[wide];
        for (int i = 0; i < wide; ++i) {
          const float x = leaf.x[part + i] - px, y = leaf.y[part + i] - py,
                      z = leaf.z[part + i] - pz;
          squared[i] = x * x + y * y + z * z;
        }
        for (unsigned int left = whichBelow(squared, bound); left != 0;
             left &= left - 1) {
          const int i = __builtin_ctz(left);
          found.take(leaf.indices[part + i], squared[i]);
        }
      }
      bound = std::min(bound, found.second_squared);
      continue;
    }
    const Node& node = levels_[next.level][next.number];
    float squared[wide];
    for (int i = 0; i < wide; ++i) {
      const float x =
          larger(larger(node.lower[0][i] - px, px - node.upper[0][i]), 0.0f);
      const float y =
          larger(larger(node.lower[1][i] - py, py - node.upper[1][i]), 0.0f);
      const float z =
          larger(larger(node.lower[2][i] - pz, pz - node.upper[2][i]), 0.0f);
      squared[i] = x * x + y * y + z * z;
    }
    // the nearest one last, so that it is the next
    const std::size_t begin = count;
    for (unsigned int left = whichBelow(squared, bound); left != 0; left &= left - 1) {
      const int i = __builtin_ctz(left);
      std::size_t at = count++;
      for (; at > begin && pending[at - 1].squared < squared[i]; --at)
        pending[at] = pending[at - 1];
      pending[at] = {squared[i], next.level - 1, next.number * wide + i};
    }
  }
  return found;
}

PCL_KSS_WIDE void
PackedPoints::leavesWithin(const Box& box,
                           float distance,
                           std::vector<std::size_t>& leaves) const
{
  struct Pending {
    int level;
    std::size_t number;
  };
  leaves.clear();
  const float squared_distance = std::nextafter(distance * distance, infinite);
  std::array<Pending, deepest> pending;
  std::size_t count = 0;
  if (!levels_.empty())
    pending[count++] = {static_cast<int>(levels_.size()) - 1, 0};
  while (count > 0) {
    const Pending next = pending[--count];
    const Node& node = levels_[next.level][next.number];
    float squared[wide] = {};
    for (int axis = 0; axis < 3; ++axis)
      for (int i = 0; i < wide; ++i) {
        const float gap = larger(larger(node.lower[axis][i] - box.max()[axis],
                                        box.min()[axis] - node.upper[axis][i]),
                                 0.0f);
        squared[i] += gap * gap;
      }
    for (unsigned int left = whichBelow(squared, squared_distance); left != 0;
         left &= left - 1) {
      const std::size_t child = next.number * wide + __builtin_ctz(left);
      if (next.level == 0)
        leaves.push_back(child);
      else
        pending[count++] = {next.level - 1, child};
    }
  }
}

} // namespace kss
} // namespace pcl
