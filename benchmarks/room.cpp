/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

// A room: walls with a window and a door, a table with chairs, a sofa, a bookcase, a
// cupboard, a lamp and things that lie about; a chimney breast where the plan has one.

#include "place_builder.h"

#include <cmath>
#include <random>

namespace benchmarks {
namespace {

using Eigen::Vector3d;

class Builder : public PlaceBuilder {
public:
  Builder(unsigned int seed, const RoomPlan& plan)
  : PlaceBuilder(seed)
  , size_(plan.size)
  , beyond_(plan.size - RoomPlan().size)
  {
    addWalls();
    if (plan.has_chimney)
      addBlock({0.0, 3.1, 0.0}, {0.55, 4.3, size_.z()});
    addBookcase();
    addSofa();
    addTable();
    addCupboard();
    addPlant({size_.x() - 0.4, size_.y() - 0.45, 0.0});
    addLamp({0.35, size_.y() - 0.4, 0.0});
    for (int i = 0; i < 4; ++i) // on the floor
      place_.addBox({uniform(1.0, 4.4), uniform(0.8, 3.3), 0.12},
                    {uniform(0.2, 0.45), uniform(0.15, 0.4), 0.24}, uniform(0.0, M_PI));
  }

private:
  /** \brief A box by two corners. */
  void
  addBlock(const Vector3d& smallest, const Vector3d& largest)
  {
    place_.addBox((smallest + largest) / 2.0, largest - smallest);
  }

  /** \brief Behind the wall y = size a window lies deeper; a door stands out. */
  void
  addWalls()
  {
    const Vector3d& size = size_;
    addBlock({-1.0, -1.0, -1.0}, {size.x() + 1.0, size.y() + 1.0, 0.0});
    addBlock({-1.0, -1.0, size.z()}, {size.x() + 1.0, size.y() + 1.0, size.z() + 1.0});
    addBlock({-1.0, -1.0, 0.0}, {0.0, size.y() + 1.0, size.z()});
    addBlock({size.x(), -1.0, 0.0}, {size.x() + 1.0, size.y() + 1.0, size.z()});
    addBlock({0.0, -1.0, 0.0}, {size.x(), 0.0, size.z()});

    const double left = beyond_.x() + uniform(1.2, 1.8),
                 right = left + uniform(1.3, 1.9);
    const double sill = 0.95, top = 2.2, y = size.y(), back = y + 1.0;
    addBlock({0.0, y, 0.0}, {left, back, size.z()});
    addBlock({right, y, 0.0}, {size.x(), back, size.z()});
    addBlock({left, y, 0.0}, {right, back, sill});
    addBlock({left, y, top}, {right, back, size.z()});
    addBlock({left, y + 0.3, sill}, {right, back, top});
    addBlock({left - 0.1, y - 0.12, 0.15}, {right + 0.1, y, 0.75}); // radiator
    const double door = beyond_.y() + uniform(2.2, 3.0);
    addBlock({size.x() - 0.05, door, 0.0}, {size.x(), door + 0.9, 2.05});
  }

  /** \brief Boards along the wall x = 0, with books. */
  void
  addBookcase()
  {
    const double begin = uniform(1.0, 1.4), end = begin + 1.4, depth = 0.32, top = 1.95;
    addBlock({0.0, begin, 0.0}, {depth, begin + 0.03, top});
    addBlock({0.0, end - 0.03, 0.0}, {depth, end, top});
    for (int board = 0; board <= 5; ++board) {
      const double z = 0.05 + board * (top - 0.08) / 5.0;
      addBlock({0.0, begin, z}, {depth, end, z + 0.03});
      if (board == 5)
        continue;
      for (double y = begin + 0.04; y < end - 0.35;) {
        const double width = uniform(0.06, 0.3);
        if (uniform(0.0, 1.0) < 0.75)
          addBlock({0.0, y, z},
                   {uniform(0.14, 0.29), y + width, z + uniform(0.18, 0.3)});
        y += width;
      }
    }
  }

  /** \brief Below the window. */
  void
  addSofa()
  {
    const double begin = beyond_.x() + uniform(1.0, 1.4), end = begin + 2.0;
    const double back = size_.y() - 0.25, front = back - 0.85;
    addBlock({begin, front, 0.08}, {end, back, 0.42});
    addBlock({begin, back - 0.22, 0.08}, {end, back, 0.85});
    addBlock({begin - 0.16, front, 0.0}, {begin, back, 0.62});
    addBlock({end, front, 0.0}, {end + 0.16, back, 0.62});
    for (int i = 0; i < 3; ++i)
      place_.addBox({uniform(begin + 0.3, end - 0.3), back - 0.35, 0.6},
                    {0.42, 0.16, 0.4}, uniform(-0.4, 0.4));
  }

  void
  addTable()
  {
    Vector3d middle(uniform(2.2, 2.7), uniform(1.5, 1.9), 0.0);
    middle.head<2>() += beyond_.head<2>() / 2.0;
    const double yaw = uniform(-0.3, 0.3);
    addFurniture(middle, yaw, {1.4, 0.8, 0.74}, 0.05);
    for (const double side : {-1.0, 1.0}) {
      const Vector3d aside(uniform(-0.3, 0.3), side * uniform(0.6, 0.8), 0.0);
      const Vector3d seat = middle + turned(aside, yaw);
      const double turn = yaw + uniform(-0.4, 0.4);
      addFurniture(seat, turn, {0.42, 0.42, 0.46}, 0.04);
      place_.addBox(seat + turned({0.0, side * 0.2, 0.7}, turn), {0.42, 0.04, 0.5},
                    turn);
    }
    for (int i = 0; i < 4; ++i) { // cups, a bowl, books
      const Vector3d spot =
          middle + turned({uniform(-0.6, 0.6), uniform(-0.3, 0.3), 0.74}, yaw);
      if (i < 2)
        place_.addCylinder(spot, uniform(0.04, 0.1), uniform(0.1, 0.3));
      else if (i == 2)
        place_.addBall(spot + Vector3d(0.0, 0.0, 0.1), 0.12);
      else
        place_.addBox(spot + Vector3d(0.0, 0.0, 0.04), {0.22, 0.3, 0.08}, yaw + 0.5);
    }
  }

  static Vector3d
  turned(const Vector3d& way, double yaw)
  {
    return {std::cos(yaw) * way.x() - std::sin(yaw) * way.y(),
            std::sin(yaw) * way.x() + std::cos(yaw) * way.y(), way.z()};
  }

  /** \brief A board on four legs. */
  void
  addFurniture(const Vector3d& foot, double yaw, const Vector3d& size, double leg)
  {
    place_.addBox(foot + Vector3d(0.0, 0.0, size.z() - 0.02),
                  {size.x(), size.y(), 0.04}, yaw);
    for (const double x : {-0.5, 0.5})
      for (const double y : {-0.5, 0.5}) {
        const Vector3d way(x * (size.x() - 2.0 * leg), y * (size.y() - 2.0 * leg),
                           size.z() / 2.0);
        place_.addBox(foot + turned(way, yaw), {leg, leg, size.z()}, yaw);
      }
  }

  /** \brief Low, along the wall x = size, with a screen on it. */
  void
  addCupboard()
  {
    const double begin = uniform(0.5, 0.8), end = begin + 1.3, x = size_.x();
    addBlock({x - 0.45, begin, 0.0}, {x, end, 0.55});
    addBlock({x - 0.27, begin + 0.2, 0.62}, {x - 0.22, end - 0.2, 1.12});
    addBlock({x - 0.35, begin + 0.5, 0.55}, {x - 0.15, end - 0.5, 0.62});
  }

  void
  addPlant(const Vector3d& foot)
  {
    place_.addCylinder(foot, 0.16, 0.3);
    std::normal_distribution<double> normal(0.0, 0.16);
    for (int i = 0; i < 30; ++i) {
      const double x = normal(random_), y = normal(random_), z = normal(random_);
      place_.addBall(foot + Vector3d(x, y, 0.75 + z), uniform(0.04, 0.1));
    }
  }

  void
  addLamp(const Vector3d& foot)
  {
    place_.addCylinder(foot, 0.15, 0.03);
    place_.addCylinder(foot, 0.015, 1.5);
    place_.addCylinder(foot + Vector3d(0.0, 0.0, 1.45), 0.2, 0.28);
  }

  Vector3d size_;
  Vector3d beyond_; ///< how much larger than the usual one
};

} // namespace

Place
room(unsigned int seed, const RoomPlan& plan)
{
  return Builder(seed, plan).place();
}

} // namespace benchmarks
