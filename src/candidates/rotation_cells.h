/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "geometry/cell_grid.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace pcl {
namespace kss {

/** \brief Rotations sorted into cells, so that those near another one are found without
 * asking all.
 *
 * Cells divide the vector parts of the quaternions whose real part is not negative: q
 * and -q are one rotation.
 */
class RotationCells {
public:
  /** \brief The chord between the quaternions of rotations that differ by an angle. */
  static double
  chord(double angle)
  {
    return 2.0 * std::sin(0.25 * angle);
  }

  /** \param[in] edge of a cell; about as long as the chord that will be asked for
   * \param[in] expected how many rotations; it grows for more
   */
  explicit RotationCells(double edge, std::size_t expected = 0)
  : edge_(std::max(edge, finest))
  , table_(expected)
  {
    before_.reserve(expected);
  }

  /** \brief Add a rotation; the first has the number 0.
   * \param[in] rotation a unit quaternion
   * \param[in] group only rotations of one group are near each other
   */
  void
  add(const Eigen::Quaterniond& rotation, std::uint64_t group = 0)
  {
    const Eigen::Vector3d at = vectorOf(rotation);
    const std::size_t cell =
        table_.add(keyOf({cellOf(at.x()), cellOf(at.y()), cellOf(at.z())}, group));
    if (cell == last_.size())
      last_.push_back(none);
    before_.push_back(last_[cell]);
    last_[cell] = static_cast<std::uint32_t>(before_.size() - 1);
  }

  /** \brief Whether something holds for a rotation that was added.
   * \param[in] rotation a unit quaternion
   * \param[in] chord those that lie within it are asked; farther ones may be, and some
   * twice
   * \param[in] group of those that are asked
   * \param[in] predicate is called with numbers until it holds for one
   */
  template <typename Predicate>
  bool
  anyNear(const Eigen::Quaterniond& rotation,
          double chord,
          std::uint64_t group,
          const Predicate& predicate) const
  {
    // rotations that are the same to the last bits may have vector parts that are not
    constexpr double rounding = 1e-7;
    const double reach = chord + rounding;
    const Eigen::Vector3d at = vectorOf(rotation);
    return anyAround(at, reach, group, predicate) ||
           (std::abs(rotation.w()) <= reach && anyAround(-at, reach, group, predicate));
  }

private:
  using Coordinates = std::array<std::uint64_t, 3>;

  static constexpr std::uint32_t none = -1;
  static constexpr double finest = 1.0 / 127.0; ///< coordinates have eight bits

  static std::uint64_t
  keyOf(const Coordinates& cell, std::uint64_t group)
  {
    return ((group << 8 | cell[0]) << 8 | cell[1]) << 8 | cell[2];
  }

  static Eigen::Vector3d
  vectorOf(const Eigen::Quaterniond& rotation)
  {
    return rotation.w() < 0.0 ? Eigen::Vector3d(-rotation.vec()) : rotation.vec();
  }

  std::uint64_t
  cellOf(double coordinate) const
  {
    return static_cast<std::uint64_t>((std::clamp(coordinate, -1.0, 1.0) + 1.0) /
                                      edge_);
  }

  template <typename Predicate>
  bool
  anyAround(const Eigen::Vector3d& at,
            double reach,
            std::uint64_t group,
            const Predicate& predicate) const
  {
    Coordinates lower, upper;
    for (int axis = 0; axis < 3; ++axis) {
      lower[axis] = cellOf(at[axis] - reach);
      upper[axis] = cellOf(at[axis] + reach);
    }
    for (auto x = lower[0]; x <= upper[0]; ++x)
      for (auto y = lower[1]; y <= upper[1]; ++y)
        for (auto z = lower[2]; z <= upper[2]; ++z) {
          const int cell = table_.find(keyOf({x, y, z}, group));
          if (cell >= 0)
            for (std::uint32_t i = last_[cell]; i != none; i = before_[i])
              if (predicate(static_cast<std::size_t>(i)))
                return true;
        }
    return false;
  }

  double edge_;
  KeyTable table_;
  std::vector<std::uint32_t> last_;   ///< of each cell, the rotation that came last
  std::vector<std::uint32_t> before_; ///< of each rotation, the one before in its cell
};

} // namespace kss
} // namespace pcl
