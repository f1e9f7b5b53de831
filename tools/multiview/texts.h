/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "model.h"

#include <string>
#include <vector>

/** \file
 * What is known of many scans, for other programs. docs/multiview.md lists what is in
 * each.
 */

namespace tool {

/** \brief Where each scan is, as JSON.
 * \param[in] names of the scans, see scanNames()
 */
std::string
posesText(const Model& model, const std::vector<std::string>& names);

/** \brief All pairs that were tried, as JSON. */
std::string
graphText(const Model& model);

/** \brief All pairs that were tried, a line each with commas between. */
std::string
pairsText(const Model& model);

/** \brief How long the stages took, as JSON: apart from the others, which are the
 * same whenever they are made. */
std::string
timesText(const Model& model);

/** \brief The scans of a group and its kept pairs, as g2o reads them. */
std::string
g2oText(const Model& model, const std::vector<std::size_t>& group);

/** \brief The information of a pair, as g2o counts it.
 * \param[in] pose of the pair
 * \param[in] centroid of the source, in its own coordinates
 */
Eigen::Matrix<double, 6, 6>
g2oInformation(const pcl::kss::PairPose& pose, const Eigen::Vector3d& centroid);

} // namespace tool
