/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "picture.h"

#include "canvas.h"
#include "distances.h"
#include "histogram.h"
#include "panel.h"
#include "short_text.h"
#include "view.h"

#include <algorithm>
#include <cmath>

namespace tool {
namespace {

constexpr double WIDTH = 1200.0, MARGIN = 24.0, GAP = 24.0, TITLE = 30.0;
constexpr double HALF = 0.5 * (WIDTH - 2.0 * MARGIN - GAP);
constexpr double QUARTER = (WIDTH - 2.0 * MARGIN - 3.0 * GAP) / 4.0;
constexpr std::size_t MOST_OTHERS = 4;

const Colour pale{0.88, 0.88, 0.88}, grey{0.42, 0.42, 0.42};
const TextStyle panel_title{15.0, true}, small{12.5, false, grey}, caption{12.5};

/** Of SOURCE, dark enough for thin lines. */
const Colour AXES{0.72, 0.34, 0.0};

/** Half of what axes take of a panel's width. */
constexpr double AXES_ROOM = 38.0;

/** From a line of a caption to the next. */
constexpr double CAPTION_LINE = 17.0;

/** Colours of light and shade, and such that have to stay what they stand for. */
constexpr double STRONG_RELIEF = 0.8, WEAK_RELIEF = 0.3;

Colour
colourOf(PictureText::Verdict verdict)
{
  switch (verdict) {
  case PictureText::Verdict::REGISTERED:
    return {0.05, 0.40, 0.22};
  case PictureText::Verdict::AMBIGUOUS:
    return {0.58, 0.36, 0.0};
  default:
    return {0.68, 0.13, 0.13};
  }
}

/** The frame that holds two. */
Frame
unionOf(const Frame& a, const Frame& b)
{
  const Eigen::Vector2d low =
      (a.middle - 0.5 * a.size).cwiseMin(b.middle - 0.5 * b.size);
  const Eigen::Vector2d high =
      (a.middle + 0.5 * a.size).cwiseMax(b.middle + 0.5 * b.size);
  return {0.5 * (low + high), high - low};
}

Eigen::Vector3d
middleOf(const Points& points)
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& point : points)
    sum += point / points.size();
  return sum;
}

/** How high a panel is best, that is so wide. */
double
heightFor(const Frame& frame, double width)
{
  return std::round(std::min(
      std::max(width * frame.size.y() / frame.size.x(), 0.45 * width), 0.95 * width));
}

class Sheet {
public:
  Sheet(const Subject& source,
        const Subject& target,
        const std::vector<PicturePose>& poses,
        const PictureText& text)
  : source_(source)
  , target_(target)
  , poses_(poses)
  , text_(text)
  , drawn_source_(drawnOf(source.points))
  , nearest_(target.points)
  {
    const Points drawn_target = drawnOf(target.points);
    view_ = viewOf(drawn_target);
    const double thinned =
        std::sqrt(double(target.points.size()) / drawn_target.size());
    target_layer_ = {seenFrom(view_, drawn_target),
                     thinned * nearest_.spacing(),
                     {packed(TARGET_COLOUR)}};
    target_frame_ = frameOf(target_layer_.seen);
    source_spacing_ = NearestPoints(drawn_source_).spacing();
    before_ = sourceAt(Eigen::Matrix4d::Identity());
    before_frame_ = frameOf(before_.seen);
    if (!poses_.empty()) {
      after_ = sourceAt(poses_.front().transformation);
      after_frame_ = unionOf(frameOf(after_.seen), target_frame_);
    }
  }

  void
  draw(std::ostream& stream)
  {
    Canvas ruler(1, 1); // measures text
    const TextStyle details{14.5};
    const auto lines = ruler.wrapped(text_.details, details, WIDTH - 2.0 * MARGIN);
    const double head = MARGIN + 74.0 + 21.0 * lines.size();
    const double row = heightFor(poses_.empty() ? target_frame_ : after_frame_, HALF);
    const std::size_t others = std::min(poses_.size(), MOST_OTHERS + 1);
    const double other = poses_.empty() ? 0.0 : heightFor(after_frame_, QUARTER);
    std::size_t caption_lines = 0;
    for (std::size_t i = 1; i < others; ++i)
      caption_lines = std::max(caption_lines, captionOf(ruler, poses_[i]).size());
    double height = head + TITLE + row + MARGIN;
    if (!poses_.empty())
      height += GAP + TITLE + row;
    if (others > 1)
      height += GAP + TITLE + other + CAPTION_LINE * caption_lines + 7.0;
    Canvas canvas(static_cast<int>(WIDTH), static_cast<int>(height + 16.0));

    canvas.write(MARGIN, MARGIN + 18.0, text_.title,
                 {23.0, true, colourOf(text_.verdict)});
    canvas.write(WIDTH - MARGIN - canvas.widthOf(text_.maker, small), MARGIN + 14.0,
                 text_.maker, small);
    for (std::size_t i = 0; i < lines.size(); ++i)
      canvas.write(MARGIN, MARGIN + 45.0 + 21.0 * i, lines[i], details);
    drawKey(canvas, MARGIN + 50.0 + 21.0 * lines.size());

    double y = head + TITLE;
    const double second = MARGIN + HALF + GAP;
    const Area before{MARGIN, y, HALF, row}, after{second, y, HALF, row};
    drawBefore(canvas, before);
    drawAfter(canvas, after);
    if (poses_.empty())
      return canvas.writePNG(stream);
    y += row + GAP + TITLE;
    drawDistances(canvas, {MARGIN, y, HALF, row}, {second, y, HALF, row});
    y += row + GAP + TITLE;
    if (others > 1)
      canvas.write(MARGIN, y - 10.0, "Others that fit about as well", panel_title);
    for (std::size_t i = 1; i < others; ++i)
      drawOther(canvas, poses_[i],
                {MARGIN + (i - 1) * (QUARTER + GAP), y, QUARTER, other});
    canvas.writePNG(stream);
  }

private:
  Layer
  sourceAt(const Eigen::Matrix4d& transformation) const
  {
    const double scale = std::cbrt(transformation.topLeftCorner<3, 3>().determinant());
    return {seenFrom(view_, moved(drawn_source_, transformation)),
            scale * source_spacing_,
            {packed(SOURCE_COLOUR)}};
  }

  void
  drawKey(Canvas& canvas, double y)
  {
    double x = MARGIN;
    const std::pair<Colour, std::string> entries[] = {
        {SOURCE_COLOUR, "SOURCE: " + source_.title},
        {TARGET_COLOUR, "TARGET: " + target_.title}};
    for (const auto& [colour, words] : entries) {
      const std::string shown = canvas.shortened(words, {14.5}, HALF - 19.0 - 32.0);
      canvas.disk(x + 6.0, y + 7.0, 6.0, colour);
      canvas.write(x + 19.0, y + 12.0, shown, {14.5});
      x += 19.0 + canvas.widthOf(shown, {14.5}) + 32.0;
    }
  }

  void
  title(Canvas& canvas,
        const Area& area,
        const std::string& words,
        const std::string& more = "")
  {
    canvas.write(area.x, area.y - 10.0, words, panel_title);
    canvas.write(area.x + canvas.widthOf(words, panel_title) + 12.0, area.y - 10.0,
                 more, small);
    canvas.outline(area.x, area.y, area.width - 1.0, area.height - 1.0, pale);
  }

  void
  drawBefore(Canvas& canvas, const Area& area)
  {
    const Frame both = unionOf(before_frame_, target_frame_);
    const double source_size = before_frame_.size.norm(),
                 target_size = target_frame_.size.norm();
    const double larger = std::max(source_size, target_size);
    if (both.size.norm() < 2.5 * larger &&
        std::min(source_size, target_size) > 0.1 * larger) {
      title(canvas, area, "Before");
      drawLayers(canvas, area, both, {&before_, &target_layer_}, STRONG_RELIEF);
      drawRuler(canvas, area, both);
      return;
    }
    // each in a half of its own
    const bool is_to_scale = std::min(source_size, target_size) > 0.33 * larger;
    const double apart = (middleOf(drawn_source_) - middleOf(target_.points)).norm();
    title(canvas, area, "Before",
          "side by side: " + shortText(apart) + " apart" +
              (is_to_scale ? ""
                           : ", sizes " + shortText(source_size) + " and " +
                                 shortText(target_size)));
    Frame left = before_frame_, right = target_frame_;
    if (is_to_scale)
      left.size = right.size = left.size.cwiseMax(right.size);
    const double half = 0.5 * area.width;
    drawLayers(canvas, {area.x, area.y, half, area.height}, left, {&before_},
               STRONG_RELIEF);
    drawLayers(canvas, {area.x + half, area.y, half, area.height}, right,
               {&target_layer_}, STRONG_RELIEF);
    canvas.line(area.x + half, area.y, area.x + half, area.y + area.height, pale);
  }

  void
  drawAfter(Canvas& canvas, const Area& area)
  {
    const bool is_refused = text_.verdict == PictureText::Verdict::NOT_REGISTERED;
    title(canvas, area,
          poses_.empty() ? "No pose was found"
          : is_refused   ? "The best pose found, which is refused"
                         : "After",
          isAmbiguous() ? "with the directions of SOURCE's x, y and z" : "");
    if (poses_.empty())
      return;
    const Area room = besideAxes(area);
    drawLayers(canvas, room, after_frame_, {&after_, &target_layer_}, STRONG_RELIEF);
    drawRuler(canvas, room, after_frame_);
    drawAxes(canvas, area, poses_.front());
  }

  void
  drawDistances(Canvas& canvas, const Area& panel, const Area& diagram)
  {
    const Points placed = moved(drawn_source_, poses_.front().transformation);
    const Distances distances = distancesOf(placed, nearest_);
    Layer coloured = after_;
    coloured.colours.clear();
    for (const double distance : distances.all)
      coloured.colours.push_back(packed(tool::colourOf(distance / distances.top)));
    title(canvas, panel, "SOURCE by its distance from TARGET");
    const Frame frame = frameOf(coloured.seen);
    drawLayers(canvas, panel, frame, {&coloured}, WEAK_RELIEF);
    drawRuler(canvas, panel, frame);
    canvas.write(diagram.x, diagram.y - 10.0, "Points of SOURCE at each distance",
                 panel_title);
    drawHistogram(canvas, diagram, distances);
  }

  bool
  isAmbiguous() const
  {
    return text_.verdict == PictureText::Verdict::AMBIGUOUS;
  }

  /** What axes leave of a panel. */
  Area
  besideAxes(const Area& area) const
  {
    return {area.x, area.y, area.width - (isAmbiguous() ? 2.0 * AXES_ROOM : 0.0),
            area.height};
  }

  /** The directions of SOURCE's axes in the lower right corner: where things are
   * symmetric, they alone tell poses apart. */
  void
  drawAxes(Canvas& canvas, const Area& area, const PicturePose& pose)
  {
    if (!isAmbiguous())
      return;
    constexpr double LENGTH = 24.0;
    const double x = area.x + area.width - AXES_ROOM,
                 y = area.y + area.height - AXES_ROOM;
    Eigen::Matrix3d axes = view_ * pose.transformation.topLeftCorner<3, 3>();
    axes /= std::cbrt(axes.determinant());
    for (int axis = 0; axis < 3; ++axis) {
      const double right = axes(0, axis), down = -axes(1, axis);
      canvas.line(x, y, x + LENGTH * right, y + LENGTH * down, AXES);
      canvas.write(x + (LENGTH + 8.0) * right - 4.0, y + (LENGTH + 8.0) * down + 4.0,
                   std::string(1, "xyz"[axis]), {12.5, true, AXES});
    }
  }

  void
  drawOther(Canvas& canvas, const PicturePose& pose, const Area& area)
  {
    canvas.outline(area.x, area.y, area.width - 1.0, area.height - 1.0, pale);
    const Layer layer = sourceAt(pose.transformation);
    drawLayers(canvas, besideAxes(area), unionOf(frameOf(layer.seen), target_frame_),
               {&layer, &target_layer_}, STRONG_RELIEF);
    drawAxes(canvas, area, pose);
    double y = area.y + area.height + 1.0;
    for (const std::string& line : captionOf(canvas, pose))
      canvas.write(area.x, y += CAPTION_LINE, line, caption);
  }

  static std::vector<std::string>
  captionOf(Canvas& canvas, const PicturePose& pose)
  {
    return canvas.wrapped(pose.caption, caption, QUARTER);
  }

  const Subject &source_, &target_;
  const std::vector<PicturePose>& poses_;
  const PictureText& text_;
  Points drawn_source_;
  NearestPoints nearest_;
  double source_spacing_;
  Eigen::Matrix3d view_;
  Layer target_layer_, before_, after_;
  Frame target_frame_, before_frame_, after_frame_;
};

} // namespace

void
drawPicture(const Subject& source,
            const Subject& target,
            const std::vector<PicturePose>& poses,
            const PictureText& text,
            std::ostream& stream)
{
  Sheet(source, target, poses, text).draw(stream);
}

} // namespace tool
