/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

// An object that a depth camera has seen from all around: each view shows a part, and
// nothing says where the camera was. All of them become one cloud.
//
//   09_turntable [FIRST.pcd SECOND.pcd ... MERGED.pcd]

#include "lump.h"
#include "virtual_scanner.h"

#include <pcl/io/pcd_io.h>
#include <pcl/registration/kss_multiview.h>

#include <iostream>
#include <limits>
#include <vector>

/** How far it is to the lump of lump.h in a direction: step by step, never too far. */
float
distanceToLump(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction)
{
  for (float range = 2.0f; range < 8.0f;) {
    const Eigen::Vector3f point = origin + range * direction;
    const float gap = point.norm() - example::radius(point.normalized());
    if (gap < 0.002f)
      return range;
    range += 0.3f * gap;
  }
  return std::numeric_limits<float>::infinity();
}

/** Eight views, 45 degrees apart, from above and from below by turns. */
std::vector<example::Scan>
makeViews()
{
  example::Scanner camera;
  camera.columns = camera.rows = 150;
  camera.width = 48.0f;
  camera.lowest = -24.0f;
  camera.highest = 24.0f;
  std::vector<example::Scan> views;
  for (int i = 0; i < 8; ++i) {
    const Eigen::Isometry3d place =
        Eigen::AngleAxisd(M_PI / 4.0 * i, Eigen::Vector3d::UnitZ()) *
        Eigen::AngleAxisd(i % 2 == 0 ? 0.4 : -0.2, Eigen::Vector3d::UnitY()) *
        Eigen::Translation3d(-5.0, 0.0, 0.0);
    views.push_back(example::scanFrom(place, camera, distanceToLump, i));
  }
  return views;
}

int
main(int argc, char** argv)
{
  std::vector<example::Scan> views;
  for (int i = 1; i < argc - 1; ++i)
    views.push_back(
        {example::load<pcl::PointXYZ>(argv[i]), Eigen::Isometry3d::Identity()});
  const bool generated = views.empty();
  if (generated)
    views = makeViews();

  pcl::registration::KSSMultiview<pcl::PointXYZ> multiview;
  for (const example::Scan& view : views)
    multiview.addScan(view.cloud);
  if (!multiview.align()) {
    std::cerr << multiview.getFailureReason() << '\n';
    return 1;
  }

  // The largest group comes first; a view that fits nowhere is a group of its own.
  example::Cloud merged;
  multiview.getMergedCloud(0, merged);
  std::cout << multiview.getGroups()[0].size() << " of " << views.size()
            << " views make a cloud of " << merged.size() << " points\n";
  if (!generated)
    return pcl::io::savePCDFileBinary(argv[argc - 1], merged) == 0 ? 0 : 1;

  // the lump's radius is between 1 and 2
  return example::areInPlace(multiview, views, 0.03) ? 0 : 1;
}
