/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <string>

namespace pcl {
namespace kss {

/** \brief A question for the units that two clouds may be in, by how much larger the
 * numbers of one are: "is the source in millimetres and the target in metres".
 * \param[in] large the cloud of the larger numbers
 * \param[in] small the other
 * \param[in] factor between them, above 1
 */
std::string
questionOfUnits(const std::string& large, const std::string& small, double factor);

} // namespace kss
} // namespace pcl
