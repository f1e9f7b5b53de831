/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "splats.h"

#include <Eigen/Core>
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace tool {
namespace {

/** Each pixel is made of so many times so many finer ones, so that rims are smooth. */
constexpr int FINE = 2;

constexpr float NOTHING = -std::numeric_limits<float>::infinity();

/** The nearest splat at each fine pixel. */
struct FineImage {
  FineImage(int width, int height)
  : width(width)
  , height(height)
  , depth(static_cast<std::size_t>(width) * height, NOTHING)
  , colour(depth.size(), 0)
  {
  }

  void
  add(const Splat& splat)
  {
    const float x = FINE * splat.x, y = FINE * splat.y, radius = FINE * splat.radius;
    constexpr float BEYOND = 1e6f; // any image
    if (!(std::abs(x) < BEYOND && std::abs(y) < BEYOND))
      return;
    const int left = std::max(0, static_cast<int>(std::ceil(x - radius)));
    const int right = std::min(width - 1, static_cast<int>(std::floor(x + radius)));
    const int top = std::max(0, static_cast<int>(std::ceil(y - radius)));
    const int bottom = std::min(height - 1, static_cast<int>(std::floor(y + radius)));
    for (int row = top; row <= bottom; ++row)
      for (int column = left; column <= right; ++column) {
        const float squared = (column - x) * (column - x) + (row - y) * (row - y);
        // a little domed: of points at one depth each shows its own part
        const float at = splat.height - 0.3f * squared / (FINE * radius);
        const std::size_t pixel = static_cast<std::size_t>(row) * width + column;
        if (squared <= radius * radius && at > depth[pixel]) {
          depth[pixel] = at;
          colour[pixel] = splat.colour;
        }
      }
  }

  int width, height;
  std::vector<float> depth;
  std::vector<std::uint32_t> colour;
};

/** Depth of the pixels. */
class Depth {
public:
  explicit Depth(const FineImage& fine)
  : width_(fine.width / FINE)
  , height_(fine.height / FINE)
  , depth_(static_cast<std::size_t>(width_) * height_, NOTHING)
  {
    for (int row = 0; row < FINE * height_; ++row)
      for (int column = 0; column < FINE * width_; ++column) {
        float& depth =
            depth_[static_cast<std::size_t>(row / FINE) * width_ + column / FINE];
        depth = std::max(
            depth, fine.depth[static_cast<std::size_t>(row) * fine.width + column]);
      }
  }

  float
  at(int column, int row) const
  {
    return column < 0 || row < 0 || column >= width_ || row >= height_
               ? NOTHING
               : depth_[static_cast<std::size_t>(row) * width_ + column];
  }

private:
  int width_, height_;
  std::vector<float> depth_;
};

/** How bright the surface is at a pixel, in [0, 1].
 * \param[in] step between the pixels that tell its plane */
float
lightAt(const Depth& depth, int column, int row, int step)
{
  constexpr int REACH = 3;
  const float here = depth.at(column, row);
  // the plane through the depths, without what lies in front or behind
  Eigen::Matrix3f equations = Eigen::Matrix3f::Identity() * 1e-3f;
  Eigen::Vector3f right_side = Eigen::Vector3f::Zero();
  for (int i = -REACH; i <= REACH; ++i)
    for (int j = -REACH; j <= REACH; ++j) {
      const float x = static_cast<float>(i * step), y = static_cast<float>(j * step);
      const float rise = depth.at(column + i * step, row + j * step) - here;
      const float distance = std::sqrt(x * x + y * y) + 1.0f;
      if (!(std::abs(rise) < 2.5f * distance))
        continue;
      const Eigen::Vector3f term(x, y, 1.0f);
      const float weight = 1.0f / (1.0f + rise * rise / (distance * distance));
      equations += weight * term * term.transpose();
      right_side += weight * rise * term;
    }
  const Eigen::Vector3f plane = equations.inverse() * right_side;
  const Eigen::Vector3f normal =
      Eigen::Vector3f(-plane[0], -plane[1], 1.0f).normalized();
  static const Eigen::Vector3f light =
      Eigen::Vector3f(-0.45f, -0.55f, 0.70f).normalized();
  // what faces away is in the half shade, not in the dark
  const float lit = std::pow(0.5f + 0.5f * normal.dot(light), 1.3f);
  // what rises above the plane round here takes light away
  float risen = 0.0f;
  constexpr std::array<std::array<int, 2>, 8> around{
      {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};
  for (const auto& [i, j] : around)
    for (const int far : {2, 5}) {
      const int x = i * far * step, y = j * far * step;
      const float rise =
          depth.at(column + x, row + y) - here - plane[0] * x - plane[1] * y;
      risen += std::min(std::max(rise / (far * step), 0.0f), 1.0f) / 16.0f;
    }
  return lit * std::exp(-1.6f * risen);
}

/** The mean of the fine pixels of a pixel, at a brightness. */
std::uint32_t
mixed(const FineImage& fine, int column, int row, float brightness)
{
  float red = 0.0f, green = 0.0f, blue = 0.0f, alpha = 0.0f;
  for (int i = 0; i < FINE * FINE; ++i) {
    const std::uint32_t colour =
        fine.colour[static_cast<std::size_t>(FINE * row + i / FINE) * fine.width +
                    FINE * column + i % FINE];
    alpha += static_cast<float>(colour >> 24);
    red += static_cast<float>(colour >> 16 & 255);
    green += static_cast<float>(colour >> 8 & 255);
    blue += static_cast<float>(colour & 255);
  }
  const float mean = 1.0f / (FINE * FINE);
  const auto byte = [&](float sum, float bright) {
    return static_cast<std::uint32_t>(std::min(mean * alpha, bright * mean * sum) +
                                      0.5f);
  };
  return byte(alpha, 1.0f) << 24 | byte(red, brightness) << 16 |
         byte(green, brightness) << 8 | byte(blue, brightness);
}

} // namespace

Image
drawSplats(const std::vector<Splat>& splats, int width, int height, double relief)
{
  FineImage fine(FINE * width, FINE * height);
  float largest = 0.0f;
  for (const Splat& splat : splats) {
    fine.add(splat);
    largest = std::max(largest, splat.radius);
  }
  const Depth depth(fine);
  const int step = std::max(1, static_cast<int>(std::lround(0.8f * largest)));
  Image image{width, height, std::vector<std::uint32_t>(width * height, 0)};
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column)
      if (depth.at(column, row) > NOTHING) {
        const float bright = lightAt(depth, column, row, step);
        image.pixels[static_cast<std::size_t>(row) * width + column] =
            mixed(fine, column, row,
                  static_cast<float>(1.0 - relief + 1.15 * relief * bright));
      }
  return image;
}

} // namespace tool
