/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "group_picture.h"

#include "picture/canvas.h"
#include "picture/colour_scale.h"
#include "picture/distances.h"
#include "picture/panel.h"
#include "picture/view.h"

#include <pcl/registration/kss/detail/bulk.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace tool {
namespace {

/** Three directions at right angles: of the longest, the middle and the least extent.
 *
 * Scans that stand upright on one of the axes are seen upright: what is about an axis
 * is one.
 */
Eigen::Matrix3d
extentsOf(const Points& points)
{
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const auto& point : points)
    mean += (point - points.front()) / static_cast<double>(points.size());
  mean += points.front();
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const auto& point : points)
    scatter += (point - mean) * (point - mean).transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal(scatter);
  Eigen::Vector3d least = principal.eigenvectors().col(0);
  Eigen::Vector3d longest = principal.eigenvectors().col(2);
  constexpr double ABOUT = 0.94; // the cosine of 20 degrees
  Eigen::Index axis = 0;
  if (least.cwiseAbs().maxCoeff(&axis) > ABOUT)
    least = Eigen::Vector3d::Unit(axis);
  longest = (longest - longest.dot(least) * least).normalized();
  if (longest.cwiseAbs().maxCoeff(&axis) > ABOUT &&
      std::abs(least[axis]) < 1e-9) // still at a right angle
    longest = Eigen::Vector3d::Unit(axis);
  // upwards and to the right, as the axes of the file go
  const auto forward = [](const Eigen::Vector3d& direction) -> Eigen::Vector3d {
    Eigen::Index largest = 0;
    direction.cwiseAbs().maxCoeff(&largest);
    return direction[largest] < 0.0 ? Eigen::Vector3d(-direction) : direction;
  };
  Eigen::Matrix3d extents;
  extents.col(2) = forward(least);
  extents.col(0) = forward(longest);
  extents.col(1) = extents.col(2).cross(extents.col(0));
  return extents;
}

/** Those that are not so far out that nothing else could be seen. */
std::vector<std::pair<std::size_t, Points>>
visible(std::vector<std::pair<std::size_t, Points>> scans)
{
  constexpr double FARTHEST = 1e18; // its square is a float
  Points all;
  for (auto& [number, points] : scans) {
    const auto is_far = [](const Eigen::Vector3d& point) {
      return !(point.cwiseAbs().maxCoeff() < FARTHEST);
    };
    points.erase(std::remove_if(points.begin(), points.end(), is_far), points.end());
    all.insert(all.end(), points.begin(), points.end());
  }
  if (all.empty())
    return {};
  Points some;
  const std::size_t step = all.size() / pcl::kss::bulk_points + 1;
  for (std::size_t i = 0; i < all.size(); i += step)
    some.push_back(all[i]);
  const pcl::kss::Bulk bulk = pcl::kss::bulkOf(std::move(some));
  for (auto& [number, points] : scans) {
    const auto is_out = [&](const Eigen::Vector3d& point) {
      return !bulk.holds(point);
    };
    points.erase(std::remove_if(points.begin(), points.end(), is_out), points.end());
  }
  return scans;
}

SidePicture
drawSide(const std::string& side,
         const Eigen::Matrix3d& view,
         const std::vector<std::pair<std::size_t, Points>>& scans,
         const Points& all,
         double spacing,
         int width,
         int height)
{
  const Frame frame = frameOf(seenFrom(view, all));
  std::vector<Layer> layers;
  layers.reserve(scans.size());
  for (const auto& [number, points] : scans)
    if (!points.empty())
      layers.push_back(
          {seenFrom(view, points), spacing, {packed(colourOfNumber(number))}});
  std::vector<const Layer*> shown;
  for (const auto& layer : layers)
    shown.push_back(&layer);

  constexpr double RELIEF = 0.5;
  std::ostringstream png;
  writePNG(imageOf(width, height, frame, shown, RELIEF), png);
  const double scale = frame.pixelsPerUnit(width, height);
  const double ruler = roundLength(0.25 * width / scale);
  return {side, png.str(), ruler, ruler * scale / width};
}

} // namespace

bool
canDrawGroups()
{
  return true;
}

std::vector<SidePicture>
drawGroup(const std::vector<std::pair<std::size_t, Points>>& given,
          int width,
          int height)
{
  const auto scans = visible(given);
  Points all;
  for (const auto& [number, points] : scans)
    all.insert(all.end(), points.begin(), points.end());
  if (all.empty())
    return {};
  const Eigen::Matrix3d extents = extentsOf(all);
  const Eigen::Vector3d longest = extents.col(0), middle = extents.col(1),
                        least = extents.col(2);
  const bool is_level = least.isApprox(Eigen::Vector3d::UnitZ());
  const double spacing = NearestPoints(all).spacing();
  // rows of a view: to the right, up, towards the viewer
  const auto rows = [](const Eigen::Vector3d& right, const Eigen::Vector3d& up) {
    Eigen::Matrix3d view;
    view << right.transpose(), up.transpose(), right.cross(up).transpose();
    return view;
  };
  const auto draw = [&](const char* side, const Eigen::Matrix3d& view) {
    return drawSide(side, view, scans, all, spacing, width, height);
  };
  return {draw(is_level ? "From above" : "The broad side", rows(longest, middle)),
          draw("The long side", rows(longest, least)),
          draw("The end", rows(middle, least))};
}

} // namespace tool
