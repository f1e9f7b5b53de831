/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

// A street: houses with window recesses and balconies, kerbs, parked cars, lamp posts
// and trees.

#include "place_builder.h"

#include <cmath>
#include <random>

namespace benchmarks {
namespace {

class Builder : public PlaceBuilder {
public:
  explicit Builder(unsigned int seed)
  : PlaceBuilder(seed)
  {
    slope_ = {uniform(-0.02, 0.02), uniform(-0.01, 0.01)};
    place_.addGround(slope_);
    for (const double side : {-1.0, 1.0}) {
      addHouses(side);
      addPavement(side);
    }
  }

  void
  addCar(double x, double y, double yaw)
  {
    const double length = uniform(3.8, 4.8), height = uniform(0.65, 0.85);
    const double z = groundAt(x, y) + 0.25;
    const Eigen::Vector2d back =
        -uniform(0.1, 0.5) * Eigen::Vector2d(std::cos(yaw), std::sin(yaw));
    place_.addBox({x, y, z + height / 2.0}, {length, 1.8, height}, yaw);
    place_.addBox({x + back.x(), y + back.y(), z + height + 0.3},
                  {0.5 * length, 1.55, 0.6}, yaw);
  }

private:
  double
  groundAt(double x, double y) const
  {
    return slope_.dot(Eigen::Vector2d(x, y));
  }

  /** \brief One house after the other, with a gap now and then. */
  void
  addHouses(double side)
  {
    for (double x = -60.0; x < 60.0;) {
      const double width = uniform(8.0, 16.0);
      addHouse(x, width, side);
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
    place_.addBox({middle, front + side * (recess + depth / 2.0), foot + height / 2.0},
                  {width, depth, height});

    const double y = front + side * recess / 2.0;
    const int piers = static_cast<int>(width / uniform(2.2, 3.2)) + 1;
    const double pier = uniform(0.8, 1.3);
    for (int i = 0; i < piers; ++i)
      place_.addBox({begin + pier / 2.0 + i * (width - pier) / (piers - 1), y,
                     foot + height / 2.0},
                    {pier, recess, height});
    for (int i = 0; i <= storeys; ++i)
      place_.addBox({middle, y, foot + 0.6 + i * storey}, {width, recess, 1.2});
    for (int i = 1; i < storeys; ++i)
      if (uniform(0.0, 1.0) < 0.4)
        place_.addBox({begin + uniform(1.5, width - 1.5), front - side * 0.5,
                       foot + 0.8 + i * storey},
                      {uniform(1.5, 2.8), 1.0, 1.0});
  }

  /** \brief A kerb, and what stands along it. */
  void
  addPavement(double side)
  {
    const int pieces = 24; // the kerb follows the slope
    for (int i = 0; i < pieces; ++i) {
      const double x = -57.5 + 5.0 * i, y = side * 8.0;
      place_.addBox({x, y, groundAt(x, y)}, {5.0, 5.0, 0.26});
    }
    for (double x = -55.0 + uniform(0.0, 6.0); x < 55.0; x += uniform(5.5, 11.0))
      if (uniform(0.0, 1.0) < 0.7)
        addCar(x, side * uniform(4.2, 4.5), uniform(-0.05, 0.05));
    for (double x = -55.0 + uniform(0.0, 15.0); x < 55.0; x += uniform(18.0, 26.0)) {
      const double y = side * 6.1;
      place_.addCylinder({x, y, groundAt(x, y)}, 0.09, uniform(6.0, 8.0));
    }
    for (double x = -55.0 + uniform(0.0, 15.0); x < 55.0; x += uniform(9.0, 20.0))
      addTree(x, side * uniform(6.4, 7.0));
  }

  /** \brief A crown is a crowd of small balls that lets some rays through. */
  void
  addTree(double x, double y)
  {
    const double crown = uniform(1.2, 2.0), height = uniform(3.2, 4.5) + crown;
    const double z = groundAt(x, y);
    place_.addCylinder({x, y, z}, uniform(0.1, 0.22), height);
    std::normal_distribution<double> normal(0.0, 0.45 * crown);
    for (int i = 0; i < 60; ++i) {
      const double dx = normal(random_), dy = normal(random_), dz = normal(random_);
      place_.addBall({x + dx, y + dy, z + height + dz}, uniform(0.1, 0.35));
    }
  }

  Eigen::Vector2d slope_;
};

} // namespace

Place
street(unsigned int seed, double car)
{
  Builder builder(seed);
  builder.addCar(car, 1.8, M_PI);
  return builder.place();
}

} // namespace benchmarks
