/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/PCLPointCloud2.h>

#include <Eigen/Core>

namespace tool {

/** \brief The origin of a frame amid a cloud, in which floats are as fine as can be:
 * the median, which points far away do not move.
 * \param[in] cloud has x, y and z, and at least one finite point
 * \throws std::invalid_argument where single precision cannot hold the cloud
 */
Eigen::Vector3d
localOrigin(const pcl::PCLPointCloud2& cloud);

/** \brief A transformation between two frames as one between local ones in them.
 * \param[in] transformation of points in the frames
 * \param[in] source_origin of the local frame of what is transformed
 * \param[in] target_origin of the local frame that it is transformed to
 */
Eigen::Matrix4d
toLocalFrames(const Eigen::Matrix4d& transformation,
              const Eigen::Vector3d& source_origin,
              const Eigen::Vector3d& target_origin);

/** \brief A transformation between two local frames as one between the frames that they
 * lie in.
 * \param[in] local maps the source's local frame to the target's
 */
Eigen::Matrix4d
fromLocalFrames(const Eigen::Matrix4d& local,
                const Eigen::Vector3d& source_origin,
                const Eigen::Vector3d& target_origin);

} // namespace tool
