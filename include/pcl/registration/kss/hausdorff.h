/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/points.h>
#include <pcl/registration/kss/settings.h>

#include <memory>
#include <string>
#include <vector>

namespace pcl {
namespace kss {

/** \brief Places the source: the upper three rows of a similarity. */
using Placement = Eigen::Matrix<float, 3, 4, Eigen::RowMajor>;

/** \brief How far a placed source and the target lie apart. */
struct HausdorffDistances {
  /** \brief The directed Hausdorff distance from the source: the largest distance of a
   * source point to its nearest target point. */
  float source_to_target;
  /** \brief The mean of those distances. */
  float mean_source_to_target;
  /** \brief The directed Hausdorff distance from the target. */
  float target_to_source;
  /** \brief The mean distance of the target points to their nearest source points. */
  float mean_target_to_source;

  /** \brief The Hausdorff distance H of (e9): the larger of the directed ones. */
  float
  hausdorff() const
  {
    return std::max(source_to_target, target_to_source);
  }

  /** \brief The mean distance, both ways. */
  float
  mean() const
  {
    return 0.5f * (mean_source_to_target + mean_target_to_source);
  }
};

/** \brief Computes the distances of many placements of one source on one target. */
class HausdorffEvaluator {
public:
  virtual ~HausdorffEvaluator() = default;

  /** \brief Set the two clouds; at least one point each. */
  virtual void
  setClouds(const Points& source, const Points& target) = 0;

  /** \brief The distances of all placements, in their order. */
  virtual std::vector<HausdorffDistances>
  evaluate(const std::vector<Placement>& placements) = 0;

  /** \brief The name of the device that does the work. */
  virtual std::string
  deviceName() const = 0;
};

/** \brief An evaluator on the host: the reference, and the way out without OpenCL.
 * \param[in] threads 0: as many as there are cores
 */
std::unique_ptr<HausdorffEvaluator>
makeHostEvaluator(unsigned int threads);

/** \brief An evaluator on an OpenCL device.
 * \param[in] device part of a device's name, or "auto": the first GPU, else the first
 * \param[in] threads compute units to use of a CPU device; 0: all
 * \throws DeviceError where there is no such device or it does not work
 */
std::unique_ptr<HausdorffEvaluator>
makeOpenCLEvaluator(const std::string& device, unsigned int threads);

/** \brief The evaluator that the settings ask for: with the device "auto" the host
 * takes over, with one warning, where no OpenCL device can be had. \throws DeviceError
 * where a device asked for by name cannot be had
 */
std::unique_ptr<HausdorffEvaluator>
makeEvaluator(const Settings& settings);

} // namespace kss
} // namespace pcl
