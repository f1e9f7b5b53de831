/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include <pcl/registration/kss/detail/packed_tree.h>

#include "geometry/packed_points.h"

namespace pcl {
namespace kss {

struct PackedTree::Implementation {
  PackedPoints points;
};

PackedTree::PackedTree(const float* first, std::size_t stride, std::size_t size)
: implementation_(new Implementation{PackedPoints(first, stride, size)})
{
}

PackedTree::~PackedTree() = default;

NearestTwo
PackedTree::nearest(const float* position, float squared_limit) const
{
  return implementation_->points.nearest(position, squared_limit);
}

} // namespace kss
} // namespace pcl
