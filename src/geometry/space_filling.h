/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl {
namespace kss {

/** \brief The finite points of a cloud along a space-filling curve (G. M. Morton, "A
 * computer oriented geodetic data base", 1966): those that follow each other lie close
 * together.
 * \param[in] first the coordinates of the first point
 * \param[in] stride from one point to the next, in floats
 * \param[in] size number of points
 * \return their indices; those of points in one cell, a thousandth of the cloud wide,
 * rise
 */
std::vector<std::int32_t>
alongSpace(const float* first, std::size_t stride, std::size_t size);

} // namespace kss
} // namespace pcl
