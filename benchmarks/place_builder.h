/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "places.h"

#include <random>

namespace benchmarks {

/** \brief What builds a place by draws of its own. */
class PlaceBuilder {
public:
  const Place&
  place() const
  {
    return place_;
  }

protected:
  explicit PlaceBuilder(unsigned int seed)
  : random_(seed)
  {
  }

  double
  uniform(double smallest, double largest)
  {
    return std::uniform_real_distribution<double>(smallest, largest)(random_);
  }

  std::mt19937 random_;
  Place place_;
};

} // namespace benchmarks
