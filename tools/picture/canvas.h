/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "colour_scale.h"
#include "splats.h"

#include <cairo.h>

#include <memory>
#include <ostream>
#include <string>
#include <vector>

namespace tool {

/** \brief What a text looks like. */
struct TextStyle {
  double size = 14.0;
  bool is_bold = false;
  Colour colour{0.13, 0.13, 0.13};
};

/** \brief Gives back what cairo has made. */
struct DestroyCairo {
  void
  operator()(cairo_surface_t* surface) const
  {
    cairo_surface_destroy(surface);
  }

  void
  operator()(cairo_t* context) const
  {
    cairo_destroy(context);
  }
};

using SurfacePointer = std::unique_ptr<cairo_surface_t, DestroyCairo>;

/** \brief Write an image as PNG, clear where it is clear; the stream tells whether it
 * could be written. */
void
writePNG(const Image& image, std::ostream& stream);

/** \brief A white sheet, in pixels from its upper left corner. */
class Canvas {
public:
  Canvas(int width, int height);

  /** \brief How wide a line of text is. */
  double
  widthOf(const std::string& text, const TextStyle& style);

  /** \brief Words in lines that are not wider than that. */
  std::vector<std::string>
  wrapped(const std::string& text, const TextStyle& style, double width);

  /** \brief The text, without what of its middle is too much for that width. */
  std::string
  shortened(const std::string& text, const TextStyle& style, double width);

  /** \brief Write a line.
   * \param[in] x, y the left end of its base
   */
  void
  write(double x, double y, const std::string& text, const TextStyle& style = {});

  /** \brief Write a line about a middle. */
  void
  writeCentred(double x,
               double y,
               const std::string& text,
               const TextStyle& style = {});

  void
  line(double x0,
       double y0,
       double x1,
       double y1,
       const Colour& colour,
       double width = 1.0);

  void
  box(double x, double y, double width, double height, const Colour& colour);

  void
  outline(double x, double y, double width, double height, const Colour& colour);

  void
  disk(double x, double y, double radius, const Colour& colour);

  void
  image(double x, double y, const Image& image);

  /** \brief Write all of it as PNG; the stream tells whether it could be written. */
  void
  writePNG(std::ostream& stream);

private:
  void
  setStyle(const TextStyle& style);

  void
  setColour(const Colour& colour);

  SurfacePointer surface_;
  std::unique_ptr<cairo_t, DestroyCairo> context_;
};

} // namespace tool
