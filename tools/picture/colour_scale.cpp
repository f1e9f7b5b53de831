/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "colour_scale.h"

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>

namespace tool {
namespace {

/** What screens show of a colour in OKLab. */
Colour
ofOKLab(const Eigen::Vector3d& lab)
{
  const Eigen::Matrix3d to_cones =
      (Eigen::Matrix3d() << 1.0, 0.3963377774, 0.2158037573, // l
       1.0, -0.1055613458, -0.0638541728,                    // m
       1.0, -0.0894841775, -1.2914855480)                    // s
          .finished();
  const Eigen::Matrix3d to_linear =
      (Eigen::Matrix3d() << 4.0767416621, -3.3077115913, 0.2309699292, // red
       -1.2684380046, 2.6097574011, -0.3413193965,                     // green
       -0.0041960863, -0.7034186147, 1.7076147010)                     // blue
          .finished();
  const Eigen::Vector3d linear = to_linear * (to_cones * lab).array().cube().matrix();
  const auto encoded = [](double x) {
    x = std::min(std::max(x, 0.0), 1.0);
    return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055;
  };
  return {encoded(linear[0]), encoded(linear[1]), encoded(linear[2])};
}

/** The curve, of which the parameter is not the length. */
Eigen::Vector3d
curveAt(double t)
{
  // lightness, green to red, blue to yellow
  const Eigen::Vector3d blue(0.30, 0.02, -0.13), green(0.60, -0.17, 0.00),
      yellow(0.92, -0.03, 0.17);
  const double u = 1.0 - t;
  return u * u * blue + 2.0 * u * t * green + t * t * yellow;
}

constexpr int STEPS = 255;

/** Colours at equal steps of the arc. */
std::array<Colour, STEPS + 1>
makeScale()
{
  constexpr int FINE = 20 * STEPS;
  std::array<double, FINE + 1> length{};
  for (int i = 1; i <= FINE; ++i)
    length[i] =
        length[i - 1] + (curveAt(double(i) / FINE) - curveAt((i - 1.0) / FINE)).norm();
  std::array<Colour, STEPS + 1> scale;
  for (int i = 0; i <= STEPS; ++i) {
    const auto at =
        std::lower_bound(length.begin(), length.end(), length[FINE] * i / STEPS);
    scale[i] = ofOKLab(curveAt(static_cast<double>(at - length.begin()) / FINE));
  }
  return scale;
}

} // namespace

Colour
colourOf(double share)
{
  static const std::array<Colour, STEPS + 1> scale = makeScale();
  return scale[std::lround(STEPS * std::min(std::max(share, 0.0), 1.0))];
}

Colour
colourOfNumber(std::size_t number)
{
  // the golden angle: hues that come later fall into the widest gap
  const double hue = 0.8 + 2.399963229728653 * static_cast<double>(number);
  const double lightness = number % 3 == 1 ? 0.80 : 0.70, colourfulness = 0.13;
  return ofOKLab(
      {lightness, colourfulness * std::cos(hue), colourfulness * std::sin(hue)});
}

std::uint32_t
packed(const Colour& colour)
{
  const auto byte = [](double part) {
    return static_cast<std::uint32_t>(std::lround(255.0 * part));
  };
  return 0xff000000u | byte(colour.red) << 16 | byte(colour.green) << 8 |
         byte(colour.blue);
}

} // namespace tool
