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

constexpr float height = 2.6f, wall = 0.2f;
// no two rooms are of one size: else their walls would fit on each other
constexpr float lines[2][3] = {{0.0f, 4.4f, 10.0f}, {0.0f, 5.4f, 10.0f}};

/** A wall of a room along x or y (axis 0 or 1), perhaps with a door in its middle. */
void
addWall(example::Boxes& flat,
        const Eigen::Vector2f& begin,
        int axis,
        float length,
        bool has_door)
{
  const auto add = [&](float from, float to, float bottom) {
    Eigen::Vector3f smallest(begin.x(), begin.y(), bottom), largest = smallest;
    smallest[axis] += from;
    largest[axis] += to;
    largest[1 - axis] += wall;
    largest.z() = height;
    flat.add(smallest, largest);
  };
  const float door = (length + wall) / 2.0f - 0.5f;
  add(0.0f, has_door ? door : length, 0.0f);
  if (has_door) {
    add(door, door + 1.0f, 2.0f);
    add(door + 1.0f, length, 0.0f);
  }
}

/** Four rooms around a corner of walls with doors, and things in each. */
example::Boxes
makeFlat()
{
  example::Boxes flat;
  flat.add({0.0f, 0.0f, -0.1f}, {10.2f, 10.2f, 0.0f});
  flat.add({0.0f, 0.0f, height}, {10.2f, 10.2f, height + 0.1f});
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 2; ++j) {
      addWall(flat, {lines[0][i], lines[1][j]}, 1, lines[1][j + 1] - lines[1][j],
              i == 1);
      addWall(flat, {lines[0][j], lines[1][i]}, 0, lines[0][j + 1] - lines[0][j],
              i == 1);
    }
  std::mt19937 random(5);
  std::uniform_real_distribution<float> uniform;
  for (int i = 0; i < 60; ++i) { // along the walls, doors left free
    const float aside = 0.1f + 0.8f * uniform(random), out = 0.4f * uniform(random);
    const bool turned = uniform(random) < 0.5f;
    Eigen::Vector2f spot(turned ? out : aside, turned ? aside : out);
    Eigen::Vector3f size(0.2f + 0.7f * uniform(random), 0.2f + 0.7f * uniform(random),
                         0.2f + 1.6f * uniform(random));
    const int corner = i % 16; // which of a room's corners, and which room
    for (int axis = 0; axis < 2; ++axis) {
      const bool far = (corner >> axis) % 2 == 1,
                 next = (corner >> (axis + 2)) % 2 == 1;
      spot[axis] = far ? lines[axis][next + 1] - spot[axis] - size[axis]
                       : lines[axis][next] + wall + spot[axis];
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
  const Eigen::Vector2d stands[] = {{2.2, 2.9}, {4.5, 2.8}, {7.4, 2.7}, {7.3, 5.5},
                                    {7.2, 7.9}, {4.5, 7.8}, {2.4, 7.7}, {2.3, 5.5}};
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
