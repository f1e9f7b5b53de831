/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/export.h>
#include <pcl/registration/kss/result.h>
#include <pcl/registration/kss/settings.h>

#include <functional>
#include <optional>
#include <string>

namespace pcl {
namespace kss {

/** \brief The axis along which a cloud is turned into its mirror image: 0 to 2; none:
 * it is not. */
using Mirror = std::optional<int>;

/** \brief Registers the clouds once more, otherwise.
 *
 * Given whether the source is to be replaced by its mirror image, at the scale that was
 * given, and the settings; returns the scale at which the clouds fit, if they do.
 */
using ScaleOfFit =
    std::function<std::optional<double>(Mirror mirror, const Settings& settings)>;

/** \brief One sentence on what would fit where nothing does: the mirror image of the
 * source, or another scale than the one given, or that scale where it has been
 * estimated; empty where none does.
 * \param[in] settings nothing fits with
 * \param[in] overlap at the best pose
 * \param[in] given_scale the scale of all poses where it is not estimated
 * \param[in] size_ratio how large the target is, as a multiple of the source
 * \param[in] scale_of_fit asked three times at most
 */
PCL_KSS_ICP_EXPORT std::string
whatWouldFit(const Settings& settings,
             const Overlap& overlap,
             double given_scale,
             double size_ratio,
             const ScaleOfFit& scale_of_fit);

} // namespace kss
} // namespace pcl
