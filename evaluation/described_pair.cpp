/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "described_pair.h"

#include "../benchmarks/diagonal.h"

#include <algorithm>

namespace evaluation {
namespace {

benchmarks::Described
described(const Cloud::ConstPtr& cloud, float leaf)
{
  benchmarks::Described result;
  benchmarks::thin(cloud, leaf, result);
  benchmarks::estimateNormals(2.0f * leaf, result);
  benchmarks::describe(5.0f * leaf, result);
  return result;
}

} // namespace

DescribedPair::DescribedPair(const CentredPair& pair)
: leaf(leafFor(pair))
, source(described(pair.source, leaf))
, target(described(pair.target, leaf))
{
}

float
leafFor(const CentredPair& pair, float source_scale)
{
  return std::max({static_cast<float>(benchmarks::diagonalOf(*pair.target)) / 30.0f,
                   2.0f * source_scale * spacingOf(pair.source),
                   2.0f * spacingOf(pair.target)});
}

} // namespace evaluation
