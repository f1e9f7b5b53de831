/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

// Rooms side by side, with doors between them, windows, and furniture that differs from
// room to room.

#include "place_builder.h"

#include <Eigen/Geometry>

#include <cmath>
#include <random>
#include <vector>

namespace benchmarks {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double height = 2.6, wall = 0.2, door_width = 0.95, door_height = 2.05;

class Builder : public PlaceBuilder {
public:
  Builder(unsigned int seed, Rooms rooms)
  : PlaceBuilder(seed)
  {
    const std::vector<double> x = buildingWalls(rooms, 0), y = buildingWalls(rooms, 1);
    addBlock({-wall, -wall, -wall}, {x.back(), y.back(), 0.0});
    addBlock({-wall, -wall, height}, {x.back(), y.back(), height + wall});
    for (std::size_t i = 0; i < x.size(); ++i)
      for (std::size_t j = 0; j + 1 < y.size(); ++j)
        addWall({x[i], y[j]}, 1, y[j + 1] - y[j], i > 0 && i + 1 < x.size());
    for (std::size_t i = 0; i + 1 < x.size(); ++i)
      for (std::size_t j = 0; j < y.size(); ++j)
        addWall({x[i], y[j]}, 0, x[i + 1] - x[i], j > 0 && j + 1 < y.size());
    for (std::size_t i = 0; i + 1 < x.size(); ++i)
      for (std::size_t j = 0; j + 1 < y.size(); ++j)
        furnish({x[i], y[j]}, {x[i + 1] - wall, y[j + 1] - wall});
  }

private:
  /** \brief A box by two corners. */
  void
  addBlock(const Vector3d& smallest, const Vector3d& largest)
  {
    place_.addBox((smallest + largest) / 2.0, largest - smallest);
  }

  /** \brief A wall along an axis, on the near side of where it begins: with a door in
   * its middle, or with a window.
   */
  void
  addWall(const Vector2d& begin, int axis, double length, bool has_door)
  {
    const double width = has_door ? door_width : uniform(0.9, 1.8);
    const double open = has_door ? (length - wall - door_width) / 2.0
                                 : uniform(0.5, length - 1.0 - width);
    const auto add = [&](double from, double to, double bottom, double top,
                         double thickness) {
      Vector3d smallest(begin.x(), begin.y(), bottom), largest = smallest;
      smallest[axis] += from;
      largest[axis] += to;
      smallest[1 - axis] -= wall;
      largest[1 - axis] += thickness - wall;
      largest.z() = top;
      addBlock(smallest, largest);
    };
    add(-wall, open, 0.0, height, wall);
    add(open + width, length - wall, 0.0, height, wall);
    add(open, open + width, has_door ? door_height : uniform(2.0, 2.3), height, wall);
    if (!has_door) {
      add(open, open + width, 0.0, uniform(0.7, 1.0), wall);
      add(open, open + width, 0.0, height, 0.05); // the pane
    }
  }

  /** \brief Pieces in the four quarters, where no door is. */
  void
  furnish(const Vector2d& smallest, const Vector2d& largest)
  {
    const int first = static_cast<int>(uniform(0.0, 4.0));
    for (int quarter = 0; quarter < 4; ++quarter) {
      const bool right = quarter % 2 == 1, back = quarter > 1;
      // from the corner of the room inwards
      const Vector2d at(right ? largest.x() : smallest.x(),
                        back ? largest.y() : smallest.y());
      const Vector2d inwards(right ? -1.0 : 1.0, back ? -1.0 : 1.0);
      switch ((quarter + first) % 4) {
      case 0:
        addShelf(at, inwards);
        break;
      case 1:
        addTable(at + inwards.cwiseProduct(Vector2d(1.1, 0.8)));
        break;
      case 2:
        addSofa(at, inwards);
        break;
      default:
        addPlant(at + inwards * 0.5);
        addClutter(at, inwards);
      }
    }
  }

  /** \brief A block in a corner of a room. */
  void
  addInCorner(const Vector2d& at,
              const Vector2d& inwards,
              const Vector3d& from,
              const Vector3d& to)
  {
    Vector3d a = from, b = to;
    a.head<2>() = at + inwards.cwiseProduct(from.head<2>());
    b.head<2>() = at + inwards.cwiseProduct(to.head<2>());
    addBlock(a.cwiseMin(b), a.cwiseMax(b));
  }

  void
  addShelf(const Vector2d& at, const Vector2d& inwards)
  {
    const double length = uniform(1.1, 1.6), depth = uniform(0.28, 0.4);
    const int boards = static_cast<int>(uniform(3.0, 6.0));
    const double top = uniform(1.6, 2.1);
    for (const double side : {0.0, length})
      addInCorner(at, inwards, {side, 0.0, 0.0}, {side + 0.03, depth, top});
    for (int board = 0; board <= boards; ++board) {
      const double z = top * board / boards;
      addInCorner(at, inwards, {0.0, 0.0, z}, {length, depth, z + 0.03});
      for (double x = 0.05; board < boards && x < length - 0.35;) {
        const double width = uniform(0.06, 0.3);
        if (uniform(0.0, 1.0) < 0.7)
          addInCorner(at, inwards, {x, 0.0, z},
                      {x + width, depth * uniform(0.4, 0.9), z + uniform(0.15, 0.3)});
        x += width;
      }
    }
  }

  void
  addTable(const Vector2d& middle)
  {
    const double yaw = uniform(-0.4, 0.4);
    const Vector3d size(uniform(0.9, 1.4), uniform(0.6, 0.9), uniform(0.68, 0.78));
    addFurniture(middle, yaw, size, 0.05);
    for (int i = 0; i < 3; ++i) {
      const Vector2d way(uniform(-0.3, 0.3), uniform(-0.2, 0.2));
      place_.addBox({middle.x() + way.x(), middle.y() + way.y(), size.z() + 0.1},
                    {uniform(0.1, 0.4), uniform(0.1, 0.3), uniform(0.06, 0.3)},
                    uniform(0.0, M_PI));
    }
    const Vector2d seat =
        middle + Eigen::Rotation2Dd(yaw) * Vector2d(uniform(-0.3, 0.3), 0.65);
    const double turn = yaw + uniform(-0.6, 0.6);
    addFurniture(seat, turn, {0.42, 0.42, 0.46}, 0.04);
    const Vector2d back = seat + Eigen::Rotation2Dd(turn) * Vector2d(0.0, 0.2);
    place_.addBox({back.x(), back.y(), 0.7}, {0.42, 0.04, 0.5}, turn);
  }

  /** \brief A board on four legs. */
  void
  addFurniture(const Vector2d& foot, double yaw, const Vector3d& size, double leg)
  {
    place_.addBox({foot.x(), foot.y(), size.z() - 0.02}, {size.x(), size.y(), 0.04},
                  yaw);
    for (const double x : {-0.5, 0.5})
      for (const double y : {-0.5, 0.5}) {
        const Vector2d at =
            foot + Eigen::Rotation2Dd(yaw) *
                       Vector2d(x * (size.x() - leg), y * (size.y() - leg));
        place_.addBox({at.x(), at.y(), size.z() / 2.0}, {leg, leg, size.z()}, yaw);
      }
  }

  void
  addSofa(const Vector2d& at, const Vector2d& inwards)
  {
    const double length = uniform(1.2, 1.6), depth = uniform(0.75, 0.9);
    addInCorner(at, inwards, {0.05, 0.05, 0.08}, {length, depth, 0.42});
    addInCorner(at, inwards, {0.05, 0.05, 0.42}, {length, 0.28, uniform(0.75, 0.95)});
    addInCorner(at, inwards, {length, 0.05, 0.0}, {length + 0.16, depth, 0.6});
    const Vector2d pillow = at + inwards.cwiseProduct(Vector2d(uniform(0.4, 1.0), 0.4));
    place_.addBox({pillow.x(), pillow.y(), 0.55}, {0.42, 0.16, 0.38},
                  uniform(-0.5, 0.5));
  }

  void
  addPlant(const Vector2d& foot)
  {
    place_.addCylinder({foot.x(), foot.y(), 0.0}, uniform(0.12, 0.2),
                       uniform(0.25, 0.4));
    std::normal_distribution<double> normal(0.0, 0.16);
    for (int i = 0; i < 25; ++i) {
      const double x = normal(random_), y = normal(random_), z = normal(random_);
      place_.addBall({foot.x() + x, foot.y() + y, 0.75 + z}, uniform(0.04, 0.1));
    }
  }

  void
  addClutter(const Vector2d& at, const Vector2d& inwards)
  {
    for (int i = 0; i < 4; ++i) {
      const Vector2d spot =
          at + inwards.cwiseProduct(Vector2d(uniform(0.3, 1.7), uniform(0.3, 1.3)));
      const double top = uniform(0.15, 0.6);
      place_.addBox({spot.x(), spot.y(), top / 2.0},
                    {uniform(0.2, 0.5), uniform(0.2, 0.5), top}, uniform(0.0, M_PI));
    }
  }
};

} // namespace

Place
building(unsigned int seed, Rooms rooms)
{
  return Builder(seed, rooms).place();
}

} // namespace benchmarks
