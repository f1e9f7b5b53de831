/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/multiview.h>
#include <pcl/registration/kss/scan_work.h>
#include <pcl/registration/kss/settings.h>

#include <pcl/memory.h>
#include <pcl/point_cloud.h>

#include <Eigen/Core>

#include <cstddef>
#include <string>
#include <vector>

namespace pcl {
namespace registration {

/** \brief @b KSSMultiview finds the poses of many scans, without any to begin with.
 *
 * Pairs of scans are registered by KSS-ICP; loops of pairs tell right ones from wrong
 * ones; scans that right ones connect form a group, and their poses are refined
 * jointly, by the points of all overlapping pairs at once. Scans that nothing connects
 * are told apart: each group has a frame of its own, that of its first scan.
 * \code
 * pcl::registration::KSSMultiview<pcl::PointXYZ> multiview;
 * for (const auto& scan : scans)
 *   multiview.addScan(scan);
 * if (!multiview.align())
 *   std::cerr << multiview.getFailureReason() << '\n';
 * for (std::size_t group = 0; group < multiview.getGroups().size(); ++group)
 *   multiview.getMergedCloud(group, cloud);
 * \endcode
 * All scans have the same unit: their scale is known to be 1. A program that uses it
 * links pcl_kss_icp::pcl_kss_icp_multiview.
 * \ingroup registration
 */
template <typename PointT>
class KSSMultiview {
public:
  /** \brief As PCL's classes name them; poses are double, whatever the points are. */
  /** \{ */
  using PointCloud = pcl::PointCloud<PointT>;
  using PointCloudConstPtr = typename PointCloud::ConstPtr;
  using Matrix4 = Eigen::Matrix4d;
  /** \} */

  /** \brief Add a scan. Its points that are not finite are left out; its normals are
   * gone by, where it has some.
   * \param[in] cloud kept, and not copied
   * \return its number: they count from 0
   */
  std::size_t
  addScan(const PointCloudConstPtr& cloud);

  /** \brief Forget all scans. */
  void
  clear();

  /** \brief Set how pairs are registered: see kss::Settings. The scale is known, pairs
   * run in one thread each, and Settings::threads is how many run at once. Where a
   * value is out of bounds, the former one stays, which is told as an error.
   */
  void
  setSettings(const kss::Settings& settings);

  /** \brief Get how pairs are registered. */
  const kss::Settings&
  getSettings() const
  {
    return settings_;
  }

  /** \brief Set which pairs are tried, and whether poses are refined jointly. The
   * threads are those of setSettings(). */
  void
  setMultiviewSettings(const kss::MultiviewSettings& settings)
  {
    multiview_settings_ = settings;
  }

  /** \brief Get which pairs are tried, and whether poses are refined jointly. */
  const kss::MultiviewSettings&
  getMultiviewSettings() const
  {
    return multiview_settings_;
  }

  /** \brief Set how many bytes may be taken by what is made of scans and kept for their
   * next pairs; 2 GiB by default. */
  void
  setRoom(std::size_t bytes)
  {
    room_ = bytes;
  }

  /** \brief Set who is told how far the work has come; may be empty. */
  void
  setProgressCallback(const kss::ProgressCallback& progress)
  {
    progress_ = progress;
  }

  /** \brief Find the poses of all scans. Nothing is thrown.
   * \return whether it came to its end; groups and poses say what was found
   */
  bool
  align();

  /** \brief Why the last align() came to no end; empty if it did. */
  const std::string&
  getFailureReason() const
  {
    return result_.failure.reason;
  }

  /** \brief The numbers of the scans of each group, the largest group first. */
  const std::vector<std::vector<std::size_t>>&
  getGroups() const
  {
    return result_.groups;
  }

  /** \brief The pose of a scan: maps it to the frame of its group.
   * \throws std::out_of_range where there is no such scan
   */
  Matrix4
  getPose(std::size_t scan) const
  {
    return result_.scans.at(scan).transformation;
  }

  /** \brief All pairs that were tried, and what they are to the model. */
  const std::vector<kss::GraphPair>&
  getPairs() const
  {
    return result_.pairs;
  }

  /** \brief All that the last align() found. */
  const kss::Multiview&
  getResult() const
  {
    return result_;
  }

  /** \brief Get all points of the scans of a group in its frame.
   * \param[in] group its number
   * \param[out] cloud its points, those of one scan after the other; fields other than
   * position and normal as they are
   * \throws std::out_of_range where there is no such group
   */
  void
  getMergedCloud(std::size_t group, PointCloud& cloud) const;

private:
  std::vector<PointCloudConstPtr> scans_;
  kss::Settings settings_;
  kss::MultiviewSettings multiview_settings_;
  std::size_t room_ = std::size_t(2) << 30;
  kss::ProgressCallback progress_;
  kss::Multiview result_;
};

} // namespace registration
} // namespace pcl

#include <pcl/registration/impl/kss_multiview.hpp>
