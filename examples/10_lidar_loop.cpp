/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

// A car with a lidar around a block of houses. From scan to scan small errors add up;
// where the way comes back to its beginning, the last scans fit the first ones again,
// and that holds all of them in place.

#include "virtual_scanner.h"

#include <pcl/registration/kss_multiview.h>

#include <iostream>
#include <vector>

namespace {

/** Houses of a row, each somewhat farther back than the other, along x or y. */
void
addHouses(example::Boxes& place,
          int axis,
          float begin,
          float end,
          float front,
          float side,
          std::mt19937& random)
{
  std::uniform_real_distribution<float> uniform;
  for (float along = begin; along < end - 1.0f;) {
    const float width = std::min(3.0f + 4.0f * uniform(random), end - along);
    const float back = front + side * 1.5f * uniform(random);
    Eigen::Vector3f smallest(along, along, -1.0f), largest = smallest;
    largest[axis] += width;
    smallest[1 - axis] = std::min(back, back + side * 4.0f);
    largest[1 - axis] = std::max(back, back + side * 4.0f);
    largest.z() = 5.0f + 5.0f * uniform(random);
    place.add(smallest, largest);
    along += width;
  }
}

/** A block of 24 m, streets of 12 m around it, houses beyond them, and parked cars. */
example::Boxes
makeBlock()
{
  example::Boxes place;
  place.add({-60.0f, -60.0f, -1.0f}, {60.0f, 60.0f, 0.0f}); // the ground
  std::mt19937 random(3);
  std::uniform_real_distribution<float> uniform;
  for (int axis = 0; axis < 2; ++axis)
    for (const float side : {-1.0f, 1.0f}) {
      addHouses(place, axis, -12.0f, 12.0f, side * 12.0f, -side, random);
      addHouses(place, axis, -28.0f, 28.0f, side * 24.0f, side, random);
      for (int car = 0; car < 3; ++car) {
        Eigen::Vector3f smallest, size(4.2f, 4.2f, 1.2f + 0.5f * uniform(random));
        smallest[axis] = -12.0f + 8.0f * car + 3.0f * uniform(random);
        smallest[1 - axis] = side * (car == 1 ? 22.0f : 14.0f) - 0.9f;
        smallest.z() = 0.2f;
        size[1 - axis] = 1.8f;
        place.add(smallest, smallest + size);
      }
    }
  return place;
}

/** Somewhere on the square way around the block, and the way that the car looks. */
Eigen::Isometry3d
onTheWay(double share)
{
  const double side = 4.0 * share, along = side - std::floor(side);
  const Eigen::AngleAxisd turn(M_PI / 2.0 * std::floor(side), Eigen::Vector3d::UnitZ());
  return turn * Eigen::Translation3d(-18.0 + 36.0 * along, -18.0, 1.8);
}

} // namespace

int
main()
{
  const example::Boxes block = makeBlock();
  const auto distance = [&](const Eigen::Vector3f& origin,
                            const Eigen::Vector3f& direction) {
    return block.distance(origin, direction);
  };
  example::Scanner lidar;
  lidar.columns = 600;
  lidar.rows = 32;
  lidar.lowest = -25.0f;
  lidar.highest = 15.0f;
  lidar.range = 60.0f;
  lidar.noise = 0.02f;
  std::vector<example::Scan> scans;
  for (unsigned int i = 0; i < 12; ++i)
    scans.push_back(example::scanFrom(onTheWay(i / 12.0), lidar, distance, i));

  pcl::registration::KSSMultiview<pcl::PointXYZ> multiview;
  for (const example::Scan& scan : scans)
    multiview.addScan(scan.cloud);
  if (!multiview.align()) {
    std::cerr << multiview.getFailureReason() << '\n';
    return 1;
  }
  return example::areInPlace(multiview, scans, 0.2) ? 0 : 1;
}
