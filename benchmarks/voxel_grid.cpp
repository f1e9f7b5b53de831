/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

// What hardly any program on point clouds can do without, as a measure for the others:
// both clouds thinned by VoxelGrid, and a search tree of the target.

#include "clouds.h"
#include "diagonal.h"
#include "process.h"
#include "sizes.h"

#include <pcl/filters/voxel_grid.h>
#include <pcl/kdtree/kdtree_flann.h>

namespace benchmarks {
namespace {

void
thin(const Cloud::ConstPtr& cloud, float leaf)
{
  pcl::VoxelGrid<pcl::PointXYZ> grid;
  grid.setInputCloud(cloud);
  grid.setLeafSize(leaf, leaf, leaf);
  Cloud thinned;
  grid.filter(thinned);
}

void
VoxelGridAndKdTree(benchmark::State& state)
{
  const Pair& pair = pairOf(state.range(0));
  const float leaf = static_cast<float>(diagonalOf(*pair.target) / 50.0);
  double grids = 0.0, tree = 0.0;
  for (auto _ : state) {
    const double start = cpuSeconds();
    thin(pair.source, leaf);
    thin(pair.target, leaf);
    const double between = cpuSeconds();
    pcl::KdTreeFLANN<pcl::PointXYZ> kd_tree;
    kd_tree.setInputCloud(pair.target);
    grids = between - start;
    tree = cpuSeconds() - between;
  }
  state.counters["voxel_grid_s"] = grids;
  state.counters["kd_tree_s"] = tree;
}
BENCHMARK(VoxelGridAndKdTree)->Apply(allSizesOften);

} // namespace
} // namespace benchmarks
