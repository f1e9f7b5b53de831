/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/detail/points.h>

#include <array>
#include <cstddef>
#include <functional>
#include <string_view>

namespace pcl {
namespace kss {

/** \brief What tells a cloud from others without a copy of it: hashes of its points,
 * normals and origin. */
using Fingerprint = std::array<std::size_t, 3>;

/** \brief The fingerprint of a cloud. */
inline Fingerprint
fingerprintOf(const LocalCloud& cloud)
{
  const auto hashOf = [](const auto& numbers) {
    const std::string_view bytes(reinterpret_cast<const char*>(numbers.data()),
                                 sizeof(numbers.data()[0]) * numbers.size());
    return std::hash<std::string_view>()(bytes);
  };
  return {hashOf(cloud.points), hashOf(cloud.normals), hashOf(cloud.origin)};
}

} // namespace kss
} // namespace pcl
