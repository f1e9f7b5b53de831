/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "histogram.h"

#include "short_text.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace tool {
namespace {

const Colour ink{0.13, 0.13, 0.13}, grey{0.45, 0.45, 0.45}, pale{0.86, 0.86, 0.86};

constexpr int BARS = 60;

/** The share of the points in each bar; in the last one those beyond the scale. */
std::vector<double>
sharesOf(const Distances& distances)
{
  std::vector<double> shares(BARS + 1, 0.0);
  for (const double distance : distances.all)
    shares[static_cast<std::size_t>(std::min<double>(
        BARS, BARS * distance / distances.top))] += 1.0 / distances.all.size();
  return shares;
}

/** A mark from the top of a diagram down to its scale.
 * \param[in] is_right whether the words are to the right of it, where they have room
 */
void
mark(Canvas& canvas,
     double x,
     const Area& diagram,
     bool is_right,
     const std::string& text)
{
  constexpr double GAP = 5.0;
  const TextStyle style{12.0, false, ink};
  const double width = canvas.widthOf(text, style) + GAP;
  const bool has_room_left = x - width >= diagram.x;
  const bool has_room_right = x + width < diagram.x + diagram.width;
  canvas.line(x, diagram.y, x, diagram.y + diagram.height, grey);
  const bool goes_right = (is_right && has_room_right) || !has_room_left;
  canvas.write(goes_right ? x + GAP : x - width, diagram.y + 10.0, text, style);
}

} // namespace

void
drawHistogram(Canvas& canvas, const Area& area, const Distances& distances)
{
  constexpr double BELOW = 64.0, SCALE = 12.0, GAP = 6.0, BEYOND = 88.0;
  const double left = area.x, right = area.x + area.width - BEYOND;
  const double bottom = area.y + area.height - BELOW, bar = (right - left) / BARS;
  const std::vector<double> shares = sharesOf(distances);
  const double largest =
      std::max(*std::max_element(shares.begin(), shares.end()), 1e-9);
  const double full = bottom - area.y - 34.0; // room for the marks' words
  for (int i = 0; i <= BARS; ++i) {
    const bool is_beyond = i == BARS;
    const double height = full * shares[i] / largest;
    const double x = is_beyond ? right + 34.0 : left + i * bar;
    const double width = is_beyond ? 26.0 : bar;
    const Colour colour = colourOf((i + 0.5) / BARS);
    canvas.box(x, bottom - height, width - (is_beyond ? 0.0 : 1.0), height, colour);
    canvas.box(x, bottom + GAP, is_beyond ? width : bar + 0.5, SCALE, colour);
  }
  canvas.line(left, bottom, right, bottom, pale);

  const double pixels = (right - left) / distances.top;
  const double y = bottom + GAP + SCALE;
  // the top is 1, 1.5, 2, 3 or 5 times a power of ten
  const double power = std::pow(10.0, std::floor(std::log10(distances.top) + 1e-9));
  const double first = distances.top / power;
  const int ticks = first < 1.2 || first > 4.0 ? 5 : first > 1.8 && first < 2.2 ? 4 : 3;
  for (int i = 0; i <= ticks; ++i) {
    const double value = distances.top * i / ticks;
    const double x = std::min(left + pixels * value, right - 1.0);
    canvas.line(x, y, x, y + 5.0, ink);
    canvas.writeCentred(i == 0 ? x + 4.0 : x, y + 19.0, shortText(value), {12.5});
  }
  canvas.writeCentred(right + 47.0, y + 19.0, "farther", {12.5});
  canvas.writeCentred(right + 47.0, bottom - full * shares[BARS] / largest - 6.0,
                      percent(shares[BARS]), {12.5});
  canvas.writeCentred(
      0.5 * (left + right), y + 40.0,
      "distance from the nearest point of TARGET, in the unit of TARGET", {12.5});
  const bool median_is_right = distances.median >= distances.spacing;
  if (distances.spacing < distances.top)
    mark(canvas, left + pixels * distances.spacing,
         {left, area.y + 2.0, right - left, bottom - area.y - 2.0}, !median_is_right,
         "spacing of TARGET's points " + shortText(distances.spacing));
  if (distances.median < distances.top)
    mark(canvas, left + pixels * distances.median,
         {left, area.y + 18.0, right - left, bottom - area.y - 18.0}, median_is_right,
         "median " + shortText(distances.median));
}

} // namespace tool
