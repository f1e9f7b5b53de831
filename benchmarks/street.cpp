/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

// A street: houses with window recesses and balconies, kerbs, parked cars, lamp posts
// and trees. And four of them around a block.

#include "place_builder.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace benchmarks {
namespace {

/** \brief What is along one side of a street: from where to where. */
struct Side {
  double sign; ///< 1: on the left
  double houses_begin, houses_end;
  double houses_limit; ///< no house reaches farther
  double pavement_begin, pavement_end;
  double things_begin, things_end; ///< cars, lamp posts and trees
};

class Builder : public PlaceBuilder {
public:
  explicit Builder(unsigned int seed)
  : PlaceBuilder(seed)
  {
    slope_ = {uniform(-0.02, 0.02), uniform(-0.01, 0.01)};
    place_.addGround(slope_);
  }

  /** \brief Go on building where the street is that x runs along. */
  void
  goTo(const Eigen::Isometry2d& street)
  {
    street_ = street;
  }

  void
  addSide(const Side& side)
  {
    addHouses(side);
    addPavement(side);
  }

  void
  addCar(double x, double y, double yaw)
  {
    const double length = uniform(3.8, 4.8), height = uniform(0.65, 0.85);
    const double z = groundAt(x, y) + 0.25;
    const Eigen::Vector2d back =
        -uniform(0.1, 0.5) * Eigen::Vector2d(std::cos(yaw), std::sin(yaw));
    addBox({x, y, z + height / 2.0}, {length, 1.8, height}, yaw);
    addBox({x + back.x(), y + back.y(), z + height + 0.3}, {0.5 * length, 1.55, 0.6},
           yaw);
  }

private:
  Eigen::Vector3d
  inPlace(const Eigen::Vector3d& point) const
  {
    Eigen::Vector3d placed = point;
    placed.head<2>() = street_ * point.head<2>();
    return placed;
  }

  void
  addBox(const Eigen::Vector3d& middle, const Eigen::Vector3d& size, double yaw = 0.0)
  {
    place_.addBox(inPlace(middle), size,
                  yaw + Eigen::Rotation2Dd(street_.linear()).angle());
  }

  double
  groundAt(double x, double y) const
  {
    return slope_.dot(street_ * Eigen::Vector2d(x, y));
  }

  /** \brief One house after the other, with a gap now and then. */
  void
  addHouses(const Side& side)
  {
    for (double x = side.houses_begin; x < side.houses_end;) {
      const double width = std::min(uniform(8.0, 16.0), side.houses_limit - x);
      if (width < 6.0)
        return;
      addHouse(x, width, side.sign);
      x += width + (uniform(0.0, 1.0) < 0.3 ? uniform(2.0, 6.0) : 0.0);
    }
  }

  /** \brief Piers and bands in front of a core leave its windows open. */
  void
  addHouse(double begin, double width, double side)
  {
    const double front = side * (9.0 + uniform(0.0, 1.5)), depth = uniform(8.0, 12.0);
    const double recess = uniform(0.15, 0.3), storey = uniform(2.9, 3.6);
    const int storeys = static_cast<int>(uniform(3.0, 6.0));
    const double height = storeys * storey + 0.6, foot = groundAt(begin, front) - 0.5;
    const double middle = begin + width / 2.0;
    addBox({middle, front + side * (recess + depth / 2.0), foot + height / 2.0},
           {width, depth, height});

    const double y = front + side * recess / 2.0;
    const int piers = static_cast<int>(width / uniform(2.2, 3.2)) + 1;
    const double pier = uniform(0.8, 1.3);
    for (int i = 0; i < piers; ++i)
      addBox({begin + pier / 2.0 + i * (width - pier) / (piers - 1), y,
              foot + height / 2.0},
             {pier, recess, height});
    for (int i = 0; i <= storeys; ++i)
      addBox({middle, y, foot + 0.6 + i * storey}, {width, recess, 1.2});
    for (int i = 1; i < storeys; ++i)
      if (uniform(0.0, 1.0) < 0.4)
        addBox({begin + uniform(1.5, width - 1.5), front - side * 0.5,
                foot + 0.8 + i * storey},
               {uniform(1.5, 2.8), 1.0, 1.0});
  }

  /** \brief A kerb, and what stands along it. */
  void
  addPavement(const Side& side)
  {
    // the kerb follows the slope
    const int pieces = std::lround((side.pavement_end - side.pavement_begin) / 5.0);
    for (int i = 0; i < pieces; ++i) {
      const double x = side.pavement_begin + 2.5 + 5.0 * i, y = side.sign * 8.0;
      addBox({x, y, groundAt(x, y)}, {5.0, 5.0, 0.26});
    }
    for (double x = side.things_begin + uniform(0.0, 6.0); x < side.things_end;
         x += uniform(5.5, 11.0))
      if (uniform(0.0, 1.0) < 0.7)
        addCar(x, side.sign * uniform(4.2, 4.5), uniform(-0.05, 0.05));
    for (double x = side.things_begin + uniform(0.0, 15.0); x < side.things_end;
         x += uniform(18.0, 26.0)) {
      const double y = side.sign * 6.1;
      place_.addCylinder(inPlace({x, y, groundAt(x, y)}), 0.09, uniform(6.0, 8.0));
    }
    for (double x = side.things_begin + uniform(0.0, 15.0); x < side.things_end;
         x += uniform(9.0, 20.0))
      addTree(x, side.sign * uniform(6.4, 7.0));
  }

  /** \brief A crown is a crowd of small balls that lets some rays through. */
  void
  addTree(double x, double y)
  {
    const double crown = uniform(1.2, 2.0), height = uniform(3.2, 4.5) + crown;
    const double z = groundAt(x, y);
    place_.addCylinder(inPlace({x, y, z}), uniform(0.1, 0.22), height);
    std::normal_distribution<double> normal(0.0, 0.45 * crown);
    for (int i = 0; i < 60; ++i) {
      const double dx = normal(random_), dy = normal(random_), dz = normal(random_);
      place_.addBall(inPlace({x + dx, y + dy, z + height + dz}), uniform(0.1, 0.35));
    }
  }

  Eigen::Vector2d slope_;
  Eigen::Isometry2d street_ = Eigen::Isometry2d::Identity();
};

Eigen::Isometry2d
frameAt(const Eigen::Vector2d& middle, double yaw)
{
  Eigen::Isometry2d frame = Eigen::Isometry2d::Identity();
  frame.translation() = middle;
  frame.rotate(yaw);
  return frame;
}

} // namespace

Place
street(unsigned int seed, double car)
{
  Builder builder(seed);
  for (const double sign : {-1.0, 1.0})
    builder.addSide({sign, -60.0, 60.0, std::numeric_limits<double>::infinity(), -60.0,
                     60.0, -55.0, 55.0});
  builder.addCar(car, 1.8, M_PI);
  return builder.place();
}

Place
block(unsigned int seed, const Eigen::Vector2d& car, double yaw)
{
  Builder builder(seed);
  for (int side = 0; side < 4; ++side) {
    const double heading = M_PI / 2.0 * side;
    builder.goTo(frameAt(
        Eigen::Rotation2Dd(heading) * Eigen::Vector2d(0.0, -blockRadius()), heading));
    // houses close the view at the corners
    builder.addSide({-1.0, -40.0, 40.0, 45.0, -40.0, 40.0, -35.0, 35.0});
    builder.addSide({1.0, -21.0, 21.0, 21.0, -25.0, 25.0, -22.0, 22.0});
  }
  builder.goTo(Eigen::Isometry2d::Identity());
  builder.addCar(car.x(), car.y(), yaw);
  return builder.place();
}

} // namespace benchmarks
