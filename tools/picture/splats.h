/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <cstdint>
#include <vector>

namespace tool {

/** \brief A point of a surface as an image shows it: a disk that faces the viewer. */
struct Splat {
  /** \brief Pixels from the left, from the top, and towards the viewer. */
  float x, y, height;
  /** \brief In pixels. */
  float radius;
  /** \brief See packed(). */
  std::uint32_t colour;
};

/** \brief Pixels row by row: alpha, red, green and blue, these times alpha. */
struct Image {
  int width, height;
  std::vector<std::uint32_t> pixels;
};

/** \brief Draw points such that the surface that they lie on can be read: those that
 * are nearer cover others, light falls from the upper left onto the planes that depth
 * has round each pixel, and hollows are dark. Where there is none the image is clear.
 * \param[in] relief how much of the colours light may take, in [0, 1]
 */
Image
drawSplats(const std::vector<Splat>& splats, int width, int height, double relief);

} // namespace tool
