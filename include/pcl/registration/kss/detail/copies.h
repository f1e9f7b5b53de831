/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/detail/points.h>
#include <pcl/registration/kss/export.h>
#include <pcl/registration/kss/result.h>
#include <pcl/registration/kss/settings.h>

#include <cstddef>
#include <optional>

namespace pcl {
namespace kss {

/** \brief More points have a surface to go by. */
constexpr std::size_t most_points_of_copies = 40;

/** \brief The poses at which a cloud is an exact copy of another one, rounding aside,
 * where it has so few points, four to \ref most_points_of_copies, that there is no
 * surface to go by.
 * \param[in] source
 * \param[in] target
 * \param[in] settings scale and axis of rotation
 * \param[in] guess which the first of the poses is nearest to, and whose scale it has
 * where that is not estimated; none: the identity
 * \return more than one where the points are symmetric; empty where the clouds are no
 * copies, have other numbers of points, or lie on a line
 */
PCL_KSS_ICP_EXPORT Alternatives
copiesOf(const LocalCloud& source,
         const LocalCloud& target,
         const Settings& settings,
         const std::optional<StoredPose>& guess);

} // namespace kss
} // namespace pcl
