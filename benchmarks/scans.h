/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "clouds.h"

/** Pairs of scans as scanners make them: each from one side, with shadows, dense near
 * the scanner and sparse far from it. They are made once for every seed and stay.
 */
namespace benchmarks {

/** \brief A street by a lidar of 32 rings that spins, some 25,000 points, and again
 * from 6 m farther on; another car drives there meanwhile. Ranges up to 70 m are off by
 * 2 cm.
 */
const Pair&
streetPair(unsigned int seed);

/** \brief A room by a depth camera of 640 x 480 pixels, some 300,000 points, and again
 * from 1.2 m aside. Depths are off by 1.5 mm at a metre, and by the square of it.
 */
const Pair&
roomPair(unsigned int seed);

} // namespace benchmarks
