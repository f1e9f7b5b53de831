/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "evaluators/coordinate_columns.h"
#include "opencl/program.h"

namespace pcl {
namespace kss {

/** \brief Points that a kernel looks at together: its float8. */
constexpr Eigen::Index tile = 8;

/** \brief A cloud on a device, as kernels read it tile by tile. */
struct TiledCloud {
  cl::Buffer x, y, z;
  cl_uint points = 0; ///< without those that fill up the last tile
};

/** \brief Upload a cloud for kernels that read it tile by tile.
 * \param[in] program of the device
 * \param[in] cloud at least one point
 */
inline TiledCloud
tiledCloud(OpenCLProgram& program, const Points& cloud)
{
  const Eigen::MatrixX3f columns = coordinateColumns(cloud, tile);
  const auto upload = [&](int axis) {
    return program.upload(columns.col(axis).data(), columns.rows());
  };
  return {upload(0), upload(1), upload(2), static_cast<cl_uint>(cloud.cols())};
}

/** \brief Upload a cloud for kernels that read it point by point: x, y, z, 1. */
inline cl::Buffer
homogeneousCloud(OpenCLProgram& program, const Points& cloud)
{
  const Eigen::Matrix4Xf homogeneous = cloud.colwise().homogeneous();
  return program.upload(homogeneous.data(), homogeneous.size());
}

template <typename Vector>
cl_int4
toInt4(const Vector& v)
{
  return {{v[0], v[1], v[2], 0}};
}

template <typename Vector>
cl_float4
toFloat4(const Vector& v, float w = 0.0f)
{
  return {{v[0], v[1], v[2], w}};
}

} // namespace kss
} // namespace pcl
