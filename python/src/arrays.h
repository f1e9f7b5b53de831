/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * Clouds and results as numpy has them.
 */

#pragma once

#include <pcl/registration/kss/cloud_registration.h>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

namespace pcl_kss_icp {

/** \brief A row per point, without gaps. */
template <typename Scalar>
using Rows = pybind11::array_t<Scalar, pybind11::array::c_style>;

/** \brief A cloud of its own from rows.
 * \param[in] points N x 3
 * \param[in] normals N x 3, or 0 x 3
 */
pcl::kss::Cloud
cloudOf(const Rows<double>& points, const Rows<float>& normals);

/** \brief A pose from 4 x 4 numbers. */
pcl::kss::StoredPose
poseOf(const Rows<double>& matrix);

/** \brief A result as a dictionary by the names of the package's Result. */
pybind11::dict
dictOf(const pcl::kss::Registered& result);

} // namespace pcl_kss_icp
