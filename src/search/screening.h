/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/settings.h>

#include "candidates/candidates.h"

#include <memory>
#include <vector>

namespace pcl {
namespace kss {

/** \brief Finds those of millions of candidates that deserve a closer look.
 *
 * What is screened is the directed truncated mean from the cloud that is turned to the
 * one whose centre is replaced, from few points: the sums for all centres of a rotation
 * are vector additions, a hundred times as many in a second as distances of pairs.
 */
class Screening {
public:
  /** \param[in] settings device, threads and number of points
   * \throws DeviceError where the device asked for cannot be had
   */
  explicit Screening(const Settings& settings);

  ~Screening();

  /** \brief Set the pre-shapes, in the order of farthest points.
   * \param[in] source any leading part of its points covers the cloud
   * \param[in] target as the source
   * \param[in] limit what a distance counts at most
   */
  void
  setClouds(const Points& source, const Points& target, float limit);

  /** \brief The candidates of the lowest energies, as many at each scale: a directed
   * energy falls when the cloud shrinks.
   * \param[in] candidates of any number of rotations, scales and centres
   * \param[in] many how many are found, about
   * \return their indices, rising
   */
  std::vector<std::size_t>
  lowest(const Candidates& candidates, std::size_t many);

private:
  /** \brief A cloud with the field that its centres have been given. */
  struct ScreenedCloud;

  std::unique_ptr<ScreenedCloud> source_, target_;
  Eigen::Index probes_;
  float limit_ = 0.0f;
};

} // namespace kss
} // namespace pcl
