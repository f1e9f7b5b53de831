/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "io/geometry.h"
#include "options.h"
#include "registration.h"

#include <optional>
#include <string>
#include <vector>

namespace tool {

/** \brief What there is to warn of in a file that has been read: what was taken for
 * granted, and numbers that are too coarse for what they say.
 */
std::vector<std::string>
warningsOf(const Geometry& geometry);

/** \brief Register what two files hold, meshes by points spread over them.
 * \param[in] options say how
 * \param[in] with_fitness whether to find the fitness, too
 */
Result
registerGeometries(const Geometry& source,
                   const Geometry& target,
                   const std::optional<Eigen::Matrix4d>& guess,
                   const Options& options,
                   bool with_fitness);

/** \brief Whether it was not the clouds that were to blame: a broken driver is not. */
bool
saysNothingOfClouds(const Result& result);

} // namespace tool
