/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "canvas.h"

#include "legible.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <new>
#include <sstream>
#include <stdexcept>

namespace tool {
namespace {

/** Write a surface as PNG, unless something has failed before. */
void
writeSurface(cairo_surface_t* surface, cairo_status_t status, std::ostream& stream)
{
  const auto write = [](void* to, const unsigned char* data, unsigned int size) {
    auto& stream = *static_cast<std::ostream*>(to);
    stream.write(reinterpret_cast<const char*>(data), size);
    return stream ? CAIRO_STATUS_SUCCESS : CAIRO_STATUS_WRITE_ERROR;
  };
  if (status == CAIRO_STATUS_SUCCESS)
    status = cairo_surface_write_to_png_stream(surface, write, &stream);
  if (status != CAIRO_STATUS_SUCCESS && status != CAIRO_STATUS_WRITE_ERROR)
    throw std::runtime_error(std::string("the picture cannot be drawn: ") +
                             cairo_status_to_string(status));
}

/** An image as cairo has it. */
SurfacePointer
surfaceOf(const Image& image)
{
  SurfacePointer surface(
      cairo_image_surface_create(CAIRO_FORMAT_ARGB32, image.width, image.height));
  unsigned char* const data = cairo_image_surface_get_data(surface.get());
  if (!data)
    throw std::bad_alloc();
  const int stride = cairo_image_surface_get_stride(surface.get());
  for (int row = 0; row < image.height; ++row)
    std::memcpy(data + static_cast<std::ptrdiff_t>(row) * stride,
                &image.pixels[static_cast<std::size_t>(row) * image.width],
                sizeof(std::uint32_t) * image.width);
  cairo_surface_mark_dirty(surface.get());
  return surface;
}

} // namespace

void
writePNG(const Image& image, std::ostream& stream)
{
  writeSurface(surfaceOf(image).get(), CAIRO_STATUS_SUCCESS, stream);
}

Canvas::Canvas(int width, int height)
: surface_(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height))
, context_(cairo_create(surface_.get()))
{
  if (cairo_status(context_.get()) != CAIRO_STATUS_SUCCESS)
    throw std::bad_alloc();
  cairo_font_options_t* const options = cairo_font_options_create();
  cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
  cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_SLIGHT);
  cairo_set_font_options(context_.get(), options);
  cairo_font_options_destroy(options);
  box(0, 0, width, height, {1.0, 1.0, 1.0});
}

double
Canvas::widthOf(const std::string& text, const TextStyle& style)
{
  setStyle(style);
  cairo_text_extents_t extents;
  cairo_text_extents(context_.get(), legible(text).c_str(), &extents);
  return extents.x_advance;
}

std::vector<std::string>
Canvas::wrapped(const std::string& text, const TextStyle& style, double width)
{
  std::istringstream words(text);
  std::vector<std::string> lines;
  for (std::string word; words >> word;)
    if (!lines.empty() && widthOf(lines.back() + ' ' + word, style) <= width)
      lines.back() += ' ' + word;
    else
      lines.push_back(word);
  return lines;
}

std::string
Canvas::shortened(const std::string& text, const TextStyle& style, double width)
{
  std::string head = legible(text), tail;
  if (widthOf(head, style) <= width)
    return head;
  // half of the characters each, and from the longer end one after the other away
  const auto begins = [](char byte) { return (byte & 0xc0) != 0x80; };
  const auto from = std::find_if(head.begin() + head.size() / 2, head.end(), begins);
  tail.assign(from, head.end());
  head.erase(from, head.end());
  const std::string gap = "…";
  while (!(head + tail).empty() && widthOf(head + gap + tail, style) > width)
    if (head.size() > tail.size())
      head.erase(std::find_if(head.rbegin(), head.rend(), begins).base() - 1,
                 head.end());
    else
      tail.erase(tail.begin(), std::find_if(tail.begin() + 1, tail.end(), begins));
  return head + gap + tail;
}

void
Canvas::write(double x, double y, const std::string& text, const TextStyle& style)
{
  setStyle(style);
  setColour(style.colour);
  cairo_move_to(context_.get(), std::round(x), std::round(y));
  cairo_show_text(context_.get(), legible(text).c_str());
}

void
Canvas::writeCentred(double x,
                     double y,
                     const std::string& text,
                     const TextStyle& style)
{
  write(x - 0.5 * widthOf(text, style), y, text, style);
}

void
Canvas::line(
    double x0, double y0, double x1, double y1, const Colour& colour, double width)
{
  setColour(colour);
  cairo_set_line_width(context_.get(), width);
  // a line of one pixel fills it where it runs in its middle
  const auto crisp = [](double at) { return std::floor(at) + 0.5; };
  cairo_move_to(context_.get(), crisp(x0), crisp(y0));
  cairo_line_to(context_.get(), crisp(x1), crisp(y1));
  cairo_stroke(context_.get());
}

void
Canvas::box(double x, double y, double width, double height, const Colour& colour)
{
  setColour(colour);
  cairo_rectangle(context_.get(), x, y, width, height);
  cairo_fill(context_.get());
}

void
Canvas::outline(double x, double y, double width, double height, const Colour& colour)
{
  line(x, y, x + width, y, colour);
  line(x, y + height, x + width, y + height, colour);
  line(x, y, x, y + height, colour);
  line(x + width, y, x + width, y + height, colour);
}

void
Canvas::disk(double x, double y, double radius, const Colour& colour)
{
  setColour(colour);
  cairo_arc(context_.get(), x, y, radius, 0.0, 2.0 * M_PI);
  cairo_fill(context_.get());
}

void
Canvas::image(double x, double y, const Image& image)
{
  const SurfacePointer surface = surfaceOf(image);
  cairo_set_source_surface(context_.get(), surface.get(), std::round(x), std::round(y));
  cairo_paint(context_.get());
}

void
Canvas::writePNG(std::ostream& stream)
{
  writeSurface(surface_.get(), cairo_status(context_.get()), stream);
}

void
Canvas::setStyle(const TextStyle& style)
{
  cairo_select_font_face(context_.get(), "sans", CAIRO_FONT_SLANT_NORMAL,
                         style.is_bold ? CAIRO_FONT_WEIGHT_BOLD
                                       : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(context_.get(), style.size);
}

void
Canvas::setColour(const Colour& colour)
{
  cairo_set_source_rgb(context_.get(), colour.red, colour.green, colour.blue);
}

} // namespace tool
