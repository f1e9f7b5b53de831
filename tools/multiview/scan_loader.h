/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "io/geometry.h"

#include <pcl/registration/kss/cloud_registration.h>

#include <cstddef>
#include <memory>

namespace tool {

/** \brief A scan as registrations take it: the finite points of a cloud with what is
 * known of their normals, or points spread over a mesh.
 * \param[in] samples so many points stand for a mesh
 */
std::shared_ptr<const pcl::kss::Cloud>
cloudOf(const Geometry& scan, std::size_t samples);

} // namespace tool
