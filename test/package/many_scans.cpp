/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include <pcl/registration/kss_multiview.h>

#include <pcl/point_types.h>

#include <cmath>
#include <iostream>

/** Three scans of a helix that widens, the second one turned, the third one moved. */
int
main()
{
  using Cloud = pcl::PointCloud<pcl::PointXYZ>;
  Cloud::Ptr first(new Cloud), second(new Cloud), third(new Cloud);
  for (int i = 0; i < 600; ++i) {
    const float t = 0.02f * i;
    const pcl::PointXYZ point(t * std::cos(t), t * std::sin(t), 0.5f * t * t);
    first->push_back(point);
    second->push_back({-point.y, point.x, point.z});
    third->push_back({point.x, point.y, point.z + 3.0f});
  }
  pcl::registration::KSSMultiview<pcl::PointXYZ> multiview;
  pcl::kss::Settings settings;
  settings.sample_points = 150;
  multiview.setSettings(settings);
  multiview.addScan(first);
  multiview.addScan(second);
  multiview.addScan(third);
  if (!multiview.align() || multiview.getGroups().size() != 1) {
    std::cerr << multiview.getFailureReason() << '\n';
    return 1;
  }
  std::cout << multiview.getPose(1) << "\n\n" << multiview.getPose(2) << '\n';
  Cloud merged;
  multiview.getMergedCloud(0, merged);
  return merged.size() == 1800 && std::abs(multiview.getPose(1)(0, 1) - 1.0) < 0.01 &&
                 std::abs(multiview.getPose(2)(2, 3) + 3.0) < 0.05
             ? 0
             : 1;
}
