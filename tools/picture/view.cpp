/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "view.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <vector>

namespace tool {
namespace {

/** How far the viewer steps aside from the direction of least extent, and up. */
constexpr double ASIDE = 0.4, ABOVE = 0.35;

/** So many times as long as wide is a strip; so much lower than wide lies flat. */
constexpr double STRIP = 2.5, GROUND = 0.3;

/** The cosine of an angle that is about none. */
constexpr double STRAIGHT = 0.9;

/** Right, up and towards the viewer: the last is given, and the second about. */
Eigen::Matrix3d
axesOf(const Eigen::Vector3d& about_up, const Eigen::Vector3d& viewer)
{
  Eigen::Matrix3d axes;
  axes.row(2) = viewer.normalized();
  axes.row(0) = about_up.cross(viewer).normalized();
  axes.row(1) = axes.row(2).cross(axes.row(0));
  return axes;
}

/** The ends between which all but a few in a thousand lie, with a tenth more room as
 * far as there is something. */
std::pair<double, double>
bulkOf(std::vector<double> values)
{
  const auto at = [&](double share) {
    const auto nth = values.begin() + std::lround(share * (values.size() - 1.0));
    std::nth_element(values.begin(), nth, values.end());
    return *nth;
  };
  const double low = at(0.003), high = at(0.997), room = 0.1 * (high - low);
  return {std::max(low - room, at(0.0)), std::min(high + room, at(1.0))};
}

} // namespace

Eigen::Matrix3d
viewOf(const Points& points)
{
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const auto& point : points)
    mean += (point - points.front()) / points.size();
  mean += points.front();
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const auto& point : points)
    scatter += (point - mean) * (point - mean).transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal(scatter);
  const Eigen::Vector3d lengths = principal.eigenvalues().cwiseMax(0.0).cwiseSqrt();

  // from the front, the right or above; straight where that is about right
  const Eigen::Vector3d usual(0.5, -0.6, 0.62);
  Eigen::Vector3d thin = principal.eigenvectors().col(0);
  thin *= thin.dot(usual) < 0.0 ? -1.0 : 1.0;
  Eigen::Index nearest = 0;
  if (thin.cwiseAbs().maxCoeff(&nearest) > STRAIGHT)
    thin = Eigen::Vector3d::Unit(nearest) * (thin[nearest] < 0.0 ? -1.0 : 1.0);
  const Eigen::Vector3d z = Eigen::Vector3d::UnitZ(), y = Eigen::Vector3d::UnitY();
  Eigen::Vector3d up = std::abs(thin.dot(z)) > std::abs(thin.dot(y)) + 0.2 ? y : z;
  const Eigen::Vector3d length = principal.eigenvectors().col(2);
  const bool is_strip = lengths[2] > STRIP * lengths[1];
  if (is_strip && std::abs(length.dot(up)) < STRAIGHT) {
    const Eigen::Vector3d across = thin.cross(length);
    up = across.dot(up) < 0.0 ? Eigen::Vector3d(-across) : across;
  }
  const Eigen::Matrix3d straight = axesOf(up, thin);
  // what lies on the ground is seen from the front of it
  const bool is_ground = thin.dot(z) > STRAIGHT && lengths[0] < GROUND * lengths[1];
  const double above = is_ground ? -2.0 * ABOVE : ABOVE;
  return axesOf(up, thin + ASIDE * straight.row(0).transpose() +
                        above * straight.row(1).transpose());
}

Points
seenFrom(const Eigen::Matrix3d& view, const Points& points)
{
  Points seen;
  seen.reserve(points.size());
  for (const auto& point : points)
    seen.emplace_back(view * point);
  return seen;
}

double
Frame::pixelsPerUnit(double width, double height) const
{
  constexpr double ROOM = 0.94;
  return ROOM * std::min(width / size.x(), height / size.y());
}

Frame
frameOf(const Points& seen)
{
  Frame frame;
  for (int axis = 0; axis < 2; ++axis) {
    std::vector<double> values;
    values.reserve(seen.size());
    for (const auto& point : seen)
      values.push_back(point[axis]);
    const auto [low, high] = bulkOf(std::move(values));
    frame.middle[axis] = 0.5 * (low + high);
    frame.size[axis] = high - low;
  }
  // points on a line, or all in one place
  const double largest = frame.size.maxCoeff();
  frame.size = frame.size.cwiseMax(largest > 0.0 ? 1e-3 * largest : 1.0);
  return frame;
}

} // namespace tool
