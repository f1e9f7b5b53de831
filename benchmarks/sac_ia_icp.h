/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "clouds.h"

/** PCL's own way from two clouds in any poses to a registration. */
namespace benchmarks {

/** \brief How hard it tries. */
struct Effort {
  int samplings;         ///< iterations of SAC-IA
  int randomness;        ///< similar features among which it picks a correspondence
  int icp_iterations;    ///< at most
  double icp_mse_change; ///< relative change of the mean squared error that ends ICP;
                         ///< 0: as PCL sets it, only the iterations do
};

/** \brief The result, and the CPU seconds of each step. */
struct SacIaResult {
  Eigen::Matrix4f pose;
  double voxel_grid, normals, features, sac_ia, icp;
  int icp_iterations;
};

/** \brief VoxelGrid (both clouds; leaf: a fiftieth of the target's diagonal), normals
 * (radius: 2 leaves), FPFH (5 leaves), SampleConsensusInitialAlignment on the thinned
 * clouds, then IterativeClosestPoint on the full ones.
 * \param[in] seed for rand(), by which SAC-IA draws
 */
SacIaResult
registerBySacIa(const Pair& pair, const Effort& effort, unsigned int seed);

} // namespace benchmarks
