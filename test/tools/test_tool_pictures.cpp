/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * The pictures that the command line tool draws.
 */

#include "tool_run.h"

#include "picture/canvas.h"
#include "picture/colour_scale.h"
#include "picture/distances.h"
#include "picture/picture.h"
#include "picture/splats.h"
#include "picture/view.h"

#include <cairo.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <set>

namespace {

using namespace kss_test;
using tool::Colour;

/** The pixels of a PNG file, without alpha; none where it is no such file. */
struct Pixels {
  explicit Pixels(const std::filesystem::path& path)
  {
    const std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> surface(
        cairo_image_surface_create_from_png(path.c_str()), cairo_surface_destroy);
    if (cairo_surface_status(surface.get()) != CAIRO_STATUS_SUCCESS)
      return;
    width = cairo_image_surface_get_width(surface.get());
    height = cairo_image_surface_get_height(surface.get());
    const unsigned char* const data = cairo_image_surface_get_data(surface.get());
    const int stride = cairo_image_surface_get_stride(surface.get());
    for (int row = 0; row < height; ++row) {
      const auto* first = reinterpret_cast<const std::uint32_t*>(data + row * stride);
      for (int column = 0; column < width; ++column)
        pixels.push_back(first[column] & 0xffffff);
    }
  }

  /** How many pixels have about the hue of a colour, whatever light falls on it. */
  std::size_t
  like(const Colour& colour) const
  {
    return likeAmong(pixels, colour);
  }

  /** Those of a rectangle. */
  std::vector<std::uint32_t>
  within(int left, int top, int right, int bottom) const
  {
    std::vector<std::uint32_t> some;
    for (int row = top; row < bottom; ++row)
      some.insert(some.end(), pixels.begin() + row * width + left,
                  pixels.begin() + row * width + right);
    return some;
  }

  static std::size_t
  likeAmong(const std::vector<std::uint32_t>& pixels, const Colour& colour)
  {
    const Eigen::Vector3d wanted =
        Eigen::Vector3d(colour.red, colour.green, colour.blue).normalized();
    return std::count_if(pixels.begin(), pixels.end(), [&](std::uint32_t pixel) {
      const Eigen::Vector3d found(pixel >> 16, pixel >> 8 & 255, pixel & 255);
      return found.norm() > 50.0 && found.normalized().dot(wanted) > 0.995;
    });
  }

  int width = 0, height = 0;
  std::vector<std::uint32_t> pixels;
};

const Colour green{0.05, 0.40, 0.22}, red{0.68, 0.13, 0.13};

TEST_F(ToolRun, DrawsWhatFitsAndWhatIsRefused)
{
  ASSERT_EQ(0, search("source.xyz target.xyz --quiet --picture right.png").status);
  const Pixels right(path("right.png"));
  EXPECT_EQ(1200, right.width);
  EXPECT_GT(right.height, 600);
  EXPECT_GT(right.like(tool::SOURCE_COLOUR), 5000u);
  EXPECT_GT(right.like(tool::TARGET_COLOUR), 5000u);
  // the verdict
  EXPECT_GT(right.like(green), 300u);
  EXPECT_LT(right.like(red), 30u);

  Points half = blob();
  for (auto& point : half)
    point.z() = std::abs(point.z()) * std::abs(point.x());
  write("half.xyz", half);
  ASSERT_EQ(1, search("half.xyz target.xyz --rigid --quiet --picture no.png").status);
  const Pixels refused(path("no.png"));
  EXPECT_EQ(1200, refused.width);
  EXPECT_GT(refused.like(red), 300u);
  EXPECT_LT(refused.like(green), 30u);
  EXPECT_NE(right.pixels, refused.pixels);
}

TEST_F(ToolRun, DrawsWhereThereIsNoPose)
{
  ASSERT_EQ(1, search("line.xyz target.xyz --quiet --picture no.png").status);
  const Pixels picture(path("no.png"));
  EXPECT_EQ(1200, picture.width);
  EXPECT_GT(picture.like(tool::TARGET_COLOUR), 2000u);
  EXPECT_GT(picture.like(red), 300u);
}

TEST_F(ToolRun, DrawsThePosesThatFitAsWell)
{
  const auto box = [](std::size_t seed, const Eigen::Affine3d& turn) {
    std::mt19937 random(static_cast<std::mt19937::result_type>(seed));
    const auto uniform = [&] { return random() / 4294967296.0 - 0.5; };
    Points points;
    for (int i = 0; i < 4000; ++i) {
      Eigen::Vector3d point(uniform(), uniform(), uniform());
      const int axis = i % 3;
      point[axis] = point[axis] < 0.0 ? -0.5 : 0.5;
      points.push_back(turn * point.cwiseProduct(Eigen::Vector3d(3, 2, 1)));
    }
    return points;
  };
  write("box.xyz", box(1, Eigen::Affine3d::Identity()));
  write("turned.xyz", box(2, similarity(1.0)));
  const Outcome result =
      run("--device host box.xyz turned.xyz --rigid --picture b.png --report r.json");
  ASSERT_EQ(0, result.status) << result.errors;
  EXPECT_NE(std::string::npos, result.output.find("Ambiguous:")) << result.output;
  ASSERT_EQ(0, search("source.xyz target.xyz --quiet --picture right.png").status);
  // with a row more
  EXPECT_GT(Pixels(path("b.png")).height, 900);
}

TEST_F(ToolRun, DrawsWhateverFilesAreCalled)
{
  // no UTF-8, and a letter of two bytes
  const std::string name = "so\xff\xc3\xb6ur\x01"
                           "ce.xyz";
  std::filesystem::copy(path("source.xyz"), directory_ / name);
  ASSERT_EQ(0, search("'" + name + "' target.xyz --quiet --picture named.png").status);
  EXPECT_GT(Pixels(path("named.png")).like(tool::SOURCE_COLOUR), 5000u);
}

/** A picture of points with names and captions. */
Pixels
drawn(const std::filesystem::path& path,
      const Points& points,
      const std::string& name,
      const std::string& caption,
      std::size_t others)
{
  const tool::Subject subject{name, points};
  const std::vector<tool::PicturePose> poses(others + 1,
                                             {Eigen::Matrix4d::Identity(), caption});
  std::ofstream stream(path, std::ios::binary);
  tool::drawPicture(
      subject, subject, poses,
      {tool::PictureText::Verdict::AMBIGUOUS, "Title", "Details", "maker"}, stream);
  stream.close();
  return Pixels(path);
}

/** How many pixels there are that are not white. */
std::size_t
inked(const std::vector<std::uint32_t>& pixels)
{
  return pixels.size() - std::count(pixels.begin(), pixels.end(), 0xffffffu);
}

TEST_F(ToolRun, DrawsLongNamesAndCaptionsWhereTheyBelong)
{
  constexpr int MARGIN = 24, QUARTER = 270, GAP = 24, KEY = 120;
  const Pixels picture =
      drawn(path("long.png"), blob(), std::string(200, 'W') + ".xyz, 1,500 points",
            "turned by 180°, scaled by 0.963 (score 1.49)", 4);
  ASSERT_EQ(1200, picture.width);
  const int right = picture.width - MARGIN;
  EXPECT_EQ(0u, inked(picture.within(right, 80, picture.width, picture.height)));
  // the disk beside each name
  EXPECT_GT(picture.likeAmong(picture.within(0, 80, 60, KEY), tool::SOURCE_COLOUR),
            60u);
  EXPECT_GT(picture.likeAmong(picture.within(560, 80, 620, KEY), tool::TARGET_COLOUR),
            60u);
  // between the panels there is nothing, beneath them something
  const int low = picture.height - 60;
  for (int i = 0; i < 3; ++i) {
    const int end = MARGIN + (i + 1) * QUARTER + i * GAP;
    EXPECT_EQ(0u, inked(picture.within(end + 1, low, end + GAP - 1, picture.height)));
    EXPECT_GT(inked(picture.within(end - QUARTER, low, end, picture.height)), 100u);
  }
  // a line more than that of a short one
  EXPECT_GT(picture.height,
            drawn(path("short.png"), blob(), "blob", "turned", 4).height);
}

TEST_F(ToolRun, DrawsCopiesOfAPointAsOneThatIsSeen)
{
  const Pixels picture =
      drawn(path("copies.png"), Points(50, {1.0, 2.0, 3.0}), "copies.xyz", "", 0);
  // in the panel of both before; they hide each other
  const auto panel = picture.within(25, 160, 587, picture.height / 2 - 40);
  EXPECT_GT(picture.likeAmong(panel, tool::SOURCE_COLOUR) +
                picture.likeAmong(panel, tool::TARGET_COLOUR),
            50u);
}

TEST(Canvas, ShortensTheMiddle)
{
  tool::Canvas canvas(1, 1);
  const tool::TextStyle style;
  const std::string fits = "scan.ply, 10 points";
  EXPECT_EQ(fits, canvas.shortened(fits, style, canvas.widthOf(fits, style)));
  std::string name;
  for (int i = 0; i < 60; ++i)
    name += i % 2 ? "ö" : "m"; // of two bytes and of one
  for (const double width : {20.0, 100.0, 101.0, 300.0}) {
    const std::string shown = canvas.shortened(name + ".ply", style, width);
    EXPECT_LE(canvas.widthOf(shown, style), width);
    EXPECT_GT(canvas.widthOf(shown, style), width - 20.0);
    EXPECT_EQ(std::string::npos, shown.find('?')) << shown; // no half of a letter
    EXPECT_NE(std::string::npos, shown.find("…")) << shown;
  }
  const std::string shown = canvas.shortened(name + ".ply", style, 100.0);
  EXPECT_EQ(0u, shown.find('m'));
  EXPECT_EQ(shown.size() - 4, shown.rfind(".ply"));
}

TEST_F(ToolRun, SaysWhereNoPictureCanBeWritten)
{
  std::filesystem::create_directory(path("a_directory.png"));
  std::vector<std::string> places{"no_directory/p.png", "a_directory.png"};
  if (std::filesystem::exists("/dev/full"))
    places.emplace_back("/dev/full");
  const auto before = files();
  for (const std::string& place : places) {
    const Outcome result = search("source.xyz target.xyz --picture " + place);
    EXPECT_EQ(2, result.status) << place;
    EXPECT_NE(std::string::npos, result.errors.find(place)) << result.errors;
    EXPECT_EQ("", result.output);
  }
  EXPECT_EQ(before, files());
}

TEST(ColourScale, ReadsTheSameToEverybody)
{
  // lightness alone tells the order, in steps of one size
  const auto lightness = [](const Colour& colour) {
    const auto linear = [](double x) {
      return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
    };
    const double luminance = 0.2126 * linear(colour.red) +
                             0.7152 * linear(colour.green) +
                             0.0722 * linear(colour.blue);
    return 116.0 * std::cbrt(luminance) - 16.0; // CIE L*
  };
  constexpr int STEPS = 10;
  const double all = lightness(tool::colourOf(1.0)) - lightness(tool::colourOf(0.0));
  EXPECT_GT(all, 60.0);
  for (int i = 0; i < STEPS; ++i) {
    const double step = lightness(tool::colourOf((i + 1.0) / STEPS)) -
                        lightness(tool::colourOf(double(i) / STEPS));
    EXPECT_NEAR(all / STEPS, step, 0.4 * all / STEPS) << i;
  }
  EXPECT_EQ(tool::packed(tool::colourOf(0.0)), tool::packed(tool::colourOf(-1.0)));
  EXPECT_EQ(tool::packed(tool::colourOf(1.0)), tool::packed(tool::colourOf(2.0)));
  EXPECT_EQ(0xff00ff80u, tool::packed({0.0, 1.0, 128.0 / 255.0}));
}

TEST(Splats, TheNearerOneCovers)
{
  const std::uint32_t far = 0xff0000ffu, near = 0xffff0000u;
  const std::vector<tool::Splat> splats{
      {20, 20, 5, 6, near}, {20, 20, 0, 6, far}, {32, 20, 0, 4, far}};
  const tool::Image image = tool::drawSplats(splats, 40, 40, 0.0);
  ASSERT_EQ(1600u, image.pixels.size());
  const auto at = [&](int column, int row) { return image.pixels[40 * row + column]; };
  EXPECT_EQ(near, at(20, 20));
  EXPECT_EQ(far, at(32, 20));
  EXPECT_EQ(0u, at(5, 5));
}

TEST(Splats, LightShowsWhichWayASurfaceFaces)
{
  // planes that rise to the right and to the left
  const auto brightness = [](float slope) {
    std::vector<tool::Splat> splats;
    for (int x = 0; x < 60; ++x)
      for (int y = 0; y < 60; ++y)
        splats.push_back({x + 0.5f, y + 0.5f, slope * x, 1.0f, 0xff808080u});
    return tool::drawSplats(splats, 60, 60, 1.0).pixels[60 * 30 + 30] & 255;
  };
  EXPECT_GT(brightness(0.8f), brightness(0.0f) / 2);
  EXPECT_GT(brightness(0.8f), brightness(-0.8f) + 30);
}

TEST(View, KeepsUpUpAndLaysStripsAlong)
{
  const auto box = [](const Eigen::Vector3d& size) {
    Points points;
    for (double x : {-0.5, 0.0, 0.5})
      for (double y : {-0.5, 0.0, 0.5})
        for (double z : {-0.5, 0.0, 0.5})
          points.emplace_back(Eigen::Vector3d(x, y, z).cwiseProduct(size));
    return points;
  };
  // thin along y: z is up
  Eigen::Matrix3d view = tool::viewOf(box({3, 1, 2}));
  EXPECT_NEAR(1.0, view.determinant(), 1e-9);
  EXPECT_GT(view(1, 2), 0.8);
  EXPECT_LT(view(2, 1), -0.8);
  // thin along z: y is
  view = tool::viewOf(box({3, 2, 1}));
  EXPECT_GT(view(1, 1), 0.8);
  EXPECT_GT(view(2, 2), 0.8);
  // a long one goes from left to right, whichever way it lies
  Points strip = box({20, 2, 1});
  const Eigen::Matrix3d turn(
      Eigen::AngleAxisd(1.0, Eigen::Vector3d(1, 2, 3).normalized()));
  for (auto& point : strip)
    point = turn * point;
  view = tool::viewOf(strip);
  EXPECT_GT(std::abs(view.row(0).dot(turn.col(0))), 0.8);
}

TEST(View, FramesWhatMostPointsShow)
{
  Points seen;
  for (int i = 0; i <= 1000; ++i)
    seen.emplace_back(i / 1000.0, 2.0 + i / 500.0, i);
  seen.emplace_back(1e6, -1e6, 0.0);
  const tool::Frame frame = tool::frameOf(seen);
  EXPECT_NEAR(0.5, frame.middle.x(), 0.06);
  EXPECT_NEAR(3.0, frame.middle.y(), 0.12);
  EXPECT_NEAR(1.0, frame.size.x(), 0.12);
  EXPECT_NEAR(2.0, frame.size.y(), 0.24);
  EXPECT_GT(tool::frameOf({Eigen::Vector3d::Zero()}).size.minCoeff(), 0.0);
}

TEST(Distances, AreThoseOfNearestPointsFarFromTheOrigin)
{
  const Eigen::Vector3d origin(4512345.0, 512345.0, 1234.0);
  Points lattice, points;
  for (int i = 0; i < 50; ++i)
    for (int j = 0; j < 50; ++j) {
      lattice.push_back(origin + Eigen::Vector3d(0.1 * i, 0.1 * j, 0.0));
      points.push_back(lattice.back() + Eigen::Vector3d(0.0, 0.0, 0.02));
    }
  points[7].z() += 3.0;
  Points doubled = lattice; // as some scanners write them
  doubled.insert(doubled.end(), lattice.begin(), lattice.begin() + 2000);
  const tool::NearestPoints nearest(doubled);
  EXPECT_NEAR(0.1, nearest.spacing(), 1e-4);
  const tool::Distances distances = tool::distancesOf(points, nearest);
  ASSERT_EQ(points.size(), distances.all.size());
  EXPECT_NEAR(0.02, distances.all[0], 1e-4);
  EXPECT_NEAR(3.02, distances.all[7], 1e-4);
  EXPECT_NEAR(0.02, distances.median, 1e-4);
  EXPECT_NEAR(0.3, distances.top, 1e-9); // three spacings
}

} // namespace
