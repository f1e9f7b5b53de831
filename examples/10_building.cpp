/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

// A flat, scanned from a tripod in each room and in each door: scans of two rooms have
// little in common but what is seen through the door between them.

#include "virtual_scanner.h"

#include <pcl/registration/kss_multiview.h>

#include <iostream>
#include <vector>

namespace {

constexpr float room = 5.0f, height = 2.6f, wall = 0.2f;

/** A wall of a room along x or y (axis 0 or 1), perhaps with a door in its middle. */
void
addWall(example::Boxes& flat, Eigen::Vector2f begin, int axis, bool has_door)
{
  const auto add = [&](float from, float to, float bottom) {
    Eigen::Vector3f smallest(begin.x(), begin.y(), bottom), largest = smallest;
    smallest[axis] += from;
    largest[axis] += to;
    largest[1 - axis] += wall;
    largest.z() = height;
    flat.add(smallest, largest);
  };
  add(0.0f, has_door ? 2.1f : room, 0.0f);
  if (has_door) {
    add(2.1f, 3.1f, 2.0f);
    add(3.1f, room, 0.0f);
  }
}

/** Four rooms around a corner of walls with doors, and things in each. */
example::Boxes
makeFlat()
{
  example::Boxes flat;
  flat.add({0.0f, 0.0f, -0.1f}, {2.0f * room, 2.0f * room + wall, 0.0f});
  flat.add({0.0f, 0.0f, height}, {2.0f * room, 2.0f * room + wall, height + 0.1f});
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 2; ++j) {
      addWall(flat, {i * room, j * room}, 1, i == 1);
      addWall(flat, {j * room, i * room}, 0, i == 1);
    }
  std::mt19937 random(5);
  std::uniform_real_distribution<float> uniform;
  for (int i = 0; i < 60; ++i) { // along the walls, doors left free
    const float aside = 0.4f + 1.3f * uniform(random), out = 0.4f * uniform(random);
    const bool turned = uniform(random) < 0.5f;
    Eigen::Vector2f spot(turned ? out : aside, turned ? aside : out);
    Eigen::Vector3f size(0.2f + 0.7f * uniform(random), 0.2f + 0.7f * uniform(random),
                         0.2f + 1.6f * uniform(random));
    const int corner = i % 16; // which room, and which of its corners
    for (int axis = 0; axis < 2; ++axis) {
      const bool far = (corner >> axis) % 2 == 1,
                 next = (corner >> (axis + 2)) % 2 == 1;
      spot[axis] = far ? room - spot[axis] - size[axis] : wall + spot[axis];
      spot[axis] += next ? room : 0.0f;
    }
    const Eigen::Vector3f smallest(spot.x(), spot.y(), 0.0f);
    flat.add(smallest, smallest + size);
  }
  return flat;
}

} // namespace

int
main()
{
  const example::Boxes flat = makeFlat();
  const auto distance = [&](const Eigen::Vector3f& origin,
                            const Eigen::Vector3f& direction) {
    return flat.distance(origin, direction);
  };
  const Eigen::Vector2d stands[] = {{2.4, 2.7}, {5.1, 2.6}, {7.5, 2.4}, {7.6, 5.1},
                                    {7.4, 7.7}, {5.1, 7.6}, {2.7, 7.4}, {2.6, 5.1}};
  std::vector<example::Scan> scans;
  for (const Eigen::Vector2d& stand : stands) {
    const Eigen::Isometry3d place(Eigen::Translation3d(stand.x(), stand.y(), 1.5));
    scans.push_back(example::scanFrom(place, {}, distance,
                                      static_cast<unsigned int>(scans.size())));
  }

  pcl::registration::KSSMultiview<pcl::PointXYZ> multiview;
  for (const example::Scan& scan : scans)
    multiview.addScan(scan.cloud);
  if (!multiview.align()) {
    std::cerr << multiview.getFailureReason() << '\n';
    return 1;
  }

  // Which scans are neighbours nobody has said: it is in the pairs.
  for (const pcl::kss::GraphPair& pair : multiview.getPairs())
    if (pair.verdict == pcl::kss::PairVerdict::KEPT)
      std::cout << "scan " << pair.result.source << " on scan " << pair.result.target
                << ", with confidence " << pair.result.confidence << '\n';
  return example::areInPlace(multiview, scans, 0.05) ? 0 : 1;
}
