/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "panel.h"

#include "short_text.h"

#include <algorithm>
#include <cmath>

namespace tool {
namespace {

/** In pixels: the finest that can be seen, and the largest that still is a point. */
constexpr double SMALLEST_RADIUS = 0.9, LARGEST_RADIUS = 5.5;

/** Disks as large, in spacings, leave no holes in a surface of points at random. */
constexpr double COVERING = 2.2;

const Colour grey{0.35, 0.35, 0.35};

/** How large the points of a layer are drawn; large where they lie in one place, so
 * that they are seen at all.
 * \param[in] scale pixels per unit
 */
double
radiusOf(const Layer& layer, double scale)
{
  Eigen::AlignedBox2d box;
  for (const auto& point : layer.seen)
    box.extend(point.head<2>());
  if (scale * box.diagonal().norm() < LARGEST_RADIUS)
    return LARGEST_RADIUS;
  return std::min(std::max(COVERING * scale * layer.spacing, SMALLEST_RADIUS),
                  LARGEST_RADIUS);
}

} // namespace

Image
imageOf(int width,
        int height,
        const Frame& frame,
        const std::vector<const Layer*>& layers,
        double relief)
{
  const double scale = frame.pixelsPerUnit(width, height);
  std::size_t number = 0;
  for (const Layer* layer : layers)
    number += layer->seen.size();
  std::vector<Splat> splats;
  splats.reserve(number);
  const double nearest = layers.front()->seen.front().z(); // any will do
  for (const Layer* layer : layers) {
    const double radius = radiusOf(*layer, scale);
    for (std::size_t i = 0; i < layer->seen.size(); ++i) {
      const auto& seen = layer->seen[i];
      splats.push_back(
          {static_cast<float>(0.5 * width + scale * (seen.x() - frame.middle.x())),
           static_cast<float>(0.5 * height - scale * (seen.y() - frame.middle.y())),
           static_cast<float>(scale * (seen.z() - nearest)), static_cast<float>(radius),
           layer->colours[layer->colours.size() > 1 ? i : 0]});
    }
  }
  return drawSplats(splats, width, height, relief);
}

void
drawLayers(Canvas& canvas,
           const Area& area,
           const Frame& frame,
           const std::vector<const Layer*>& layers,
           double relief)
{
  canvas.image(area.x, area.y,
               imageOf(static_cast<int>(area.width), static_cast<int>(area.height),
                       frame, layers, relief));
}

double
roundLength(double most)
{
  const double power = std::pow(10.0, std::floor(std::log10(most)));
  return power * (most >= 5.0 * power ? 5.0 : most >= 2.0 * power ? 2.0 : 1.0);
}

void
drawRuler(Canvas& canvas, const Area& area, const Frame& frame)
{
  const double scale = frame.pixelsPerUnit(area.width, area.height);
  const double length = roundLength(0.25 * area.width / scale);
  const double x = area.x + 12.0, y = area.y + area.height - 12.0;
  canvas.line(x, y, x + scale * length, y, grey);
  for (const double end : {x, x + scale * length})
    canvas.line(end, y - 4.0, end, y + 4.0, grey);
  canvas.write(x + scale * length + 8.0, y + 4.0, shortText(length),
               {12.0, false, grey});
}

} // namespace tool
