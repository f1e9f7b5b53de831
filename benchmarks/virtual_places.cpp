/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "places.h"
#include "scanners.h"
#include "virtual_sets.h"

#include <cmath>
#include <random>
#include <vector>

namespace benchmarks {
namespace {

constexpr double degree = M_PI / 180.0;

/** \brief Where something is on the ground, and where it heads. */
struct Stand {
  Eigen::Vector2d position;
  double yaw;
};

/** \brief Around the block, counter-clockwise on the right lane, with round corners.
 * \param[in] share of the way, from a corner's end on; any
 */
Stand
aroundBlock(double share)
{
  const double lane = blockRadius() + 1.6, corner = 8.0;
  const double straight = 2.0 * (lane - corner), bend = M_PI / 2.0 * corner;
  const double quarters = 4.0 * (share - std::floor(share));
  const double way = (quarters - std::floor(quarters)) * (straight + bend);
  const Eigen::Rotation2Dd turn(M_PI / 2.0 * std::floor(quarters));
  Stand stand{{-straight / 2.0 + way, -lane}, 0.0};
  if (way > straight) {
    stand.yaw = (way - straight) / corner;
    stand.position =
        Eigen::Vector2d(straight / 2.0, -lane + corner) +
        corner * Eigen::Vector2d(std::sin(stand.yaw), -std::cos(stand.yaw));
  }
  return {turn * stand.position, stand.yaw + turn.angle()};
}

/** \brief Along the street and back on the other lane. */
Stand
alongStreet(double share)
{
  if (share < 0.5)
    return {{-55.0 + 220.0 * share, -1.6}, 0.0};
  return {{55.0 - 220.0 * (share - 0.5), 1.6}, M_PI};
}

/** \brief A lidar on a car, which does not drive perfectly. */
Eigen::Isometry3d
lidarAt(const Stand& stand, std::mt19937& random)
{
  std::normal_distribution<double> normal;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  const double x = normal(random), y = normal(random), z = normal(random);
  pose.translation() << stand.position.x() + 0.15 * x, stand.position.y() + 0.15 * y,
      1.9 + 0.03 * z;
  const double yaw = normal(random), pitch = normal(random), roll = normal(random);
  pose.rotate(
      Eigen::AngleAxisd(stand.yaw + 1.5 * degree * yaw, Eigen::Vector3d::UnitZ()));
  pose.rotate(Eigen::AngleAxisd(0.4 * degree * pitch, Eigen::Vector3d::UnitY()));
  pose.rotate(Eigen::AngleAxisd(0.4 * degree * roll, Eigen::Vector3d::UnitX()));
  return pose;
}

/** \brief To and fro through a building: the middle of each room, and the door from
 * there to the next.
 */
std::vector<Eigen::Vector2d>
standsIn(Rooms rooms)
{
  const std::vector<double> x = buildingWalls(rooms, 0), y = buildingWalls(rooms, 1);
  const double wall = 0.1; // half of it: it is on the near side of its line
  std::vector<Eigen::Vector2d> stands;
  std::size_t i = 0;
  for (std::size_t j = 0; j + 1 < y.size(); ++j) {
    const double middle = (y[j] + y[j + 1]) / 2.0 - wall;
    for (std::size_t step = 0; step + 1 < x.size(); ++step) {
      if (step > 0) {
        i = j % 2 == 0 ? i + 1 : i - 1;
        stands.emplace_back(x[j % 2 == 0 ? i : i + 1] - wall, middle);
      }
      else if (j > 0)
        stands.emplace_back((x[i] + x[i + 1]) / 2.0 - wall, y[j] - wall);
      stands.emplace_back((x[i] + x[i + 1]) / 2.0 - wall, middle);
    }
  }
  return stands;
}

} // namespace

VirtualScans
loopScans(std::size_t scans, unsigned int seed)
{
  const std::size_t number = scans == 0 ? 40 : scans;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> gap(0.03, 0.12);
  VirtualScans all;
  for (std::size_t i = 0; i < number; ++i) {
    const double share = static_cast<double>(i) / number;
    const Stand car = aroundBlock(share + gap(random)); // it drives ahead
    const Eigen::Isometry3d lidar = lidarAt(aroundBlock(share), random);
    const Place place = block(seed, car.position, car.yaw);
    all.push_back(
        virtualScan(*sweep(place, lidar, 1000 * seed + static_cast<unsigned int>(i)),
                    "block", i, lidar));
  }
  return all;
}

VirtualScans
streetScans(std::size_t scans, unsigned int seed)
{
  const std::size_t number = scans == 0 ? 40 : scans;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> along(-50.0, 50.0);
  VirtualScans all;
  for (std::size_t i = 0; i < number; ++i) {
    const Stand stand = alongStreet(static_cast<double>(i) / number);
    double car = along(random); // it comes along the other lane
    if (std::abs(car - stand.position.x()) < 8.0)
      car += 16.0;
    const Eigen::Isometry3d lidar = lidarAt(stand, random);
    all.push_back(virtualScan(
        *sweep(street(seed, car), lidar, 1000 * seed + static_cast<unsigned int>(i)),
        "street", i, lidar));
  }
  return all;
}

VirtualScans
buildingScans(Rooms rooms, std::size_t scans, unsigned int seed)
{
  const std::vector<Eigen::Vector2d> stands = standsIn(rooms);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> aside(-0.35, 0.35), yaw(-M_PI, M_PI);
  const Place place = building(seed, rooms);
  VirtualScans all;
  for (std::size_t i = 0; i < (scans == 0 ? stands.size() : scans); ++i) {
    const std::size_t stand = i % stands.size();
    const double dx = aside(random), dy = aside(random);
    const double share = stand % 2 == 1 ? 0.3 : 1.0; // a door is narrow
    Eigen::Isometry3d tripod = Eigen::Isometry3d::Identity();
    tripod.translation() << stands[stand].x() + share * dx,
        stands[stand].y() + share * dy, 1.5 + 0.2 * aside(random);
    tripod.rotate(Eigen::AngleAxisd(yaw(random), Eigen::Vector3d::UnitZ()));
    all.push_back(virtualScan(
        *panorama(place, tripod, 1000 * seed + static_cast<unsigned int>(i)),
        "building", i, tripod));
  }
  return all;
}

VirtualScans
roomScans(std::size_t scans, unsigned int seed, const RoomPlan& plan)
{
  const Place place = room(seed, plan);
  // farther from the walls of a larger room
  const Eigen::Vector3d inwards = (plan.size - RoomPlan().size) / 2.0;
  VirtualScans all;
  for (std::size_t i = 0; i < scans; ++i) {
    // from the right wall on, turning to the back
    const double step = 0.5 * i;
    const Eigen::Isometry3d camera =
        lookAt(inwards + Eigen::Vector3d(4.6 + 0.1 * step, 0.5 + 0.8 * step,
                                         1.5 - 0.05 * step),
               inwards + Eigen::Vector3d(1.6 + 0.4 * step, 2.4 + 0.6 * step, 0.8));
    all.push_back(virtualScan(
        *photograph(place, camera, 1000 * seed + static_cast<unsigned int>(i), 2),
        "room " + std::to_string(seed), i, camera));
  }
  return all;
}

} // namespace benchmarks
