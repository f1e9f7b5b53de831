/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "surface.h"

#include "neighbour_distances.h"

#include "io/read_geometry.h"

#include <algorithm>
#include <stdexcept>

namespace evaluation {
namespace {

constexpr std::size_t least_points = 100;

/** The similarity that brings a box to the origin and its diagonal to 1. */
Eigen::Matrix4d
normalisation(const Eigen::AlignedBox3d& box)
{
  const double diagonal = box.diagonal().norm();
  if (!(diagonal > 0.0))
    throw std::runtime_error("all points are the same");
  Eigen::Matrix4d result = Eigen::Matrix4d::Identity();
  result.topLeftCorner<3, 3>() /= diagonal;
  result.topRightCorner<3, 1>() = -box.center() / diagonal;
  return result;
}

/** \brief The first points of a random order. */
SurfacePoints
shuffled(SurfacePoints points, Random& random)
{
  for (std::size_t i = points.size(); i > 1; --i)
    std::swap(points[i - 1],
              points[static_cast<std::size_t>(uniform(random, 0.0, double(i)))]);
  return points;
}

} // namespace

Surface::Surface(const std::string& path)
{
  tool::Geometry geometry = tool::readGeometry(path);
  geometry = tool::transformed(geometry, normalisation(tool::boundingBox(geometry)));
  if (!geometry.faces.empty()) {
    mesh_.emplace(geometry);
    if (!(mesh_->area() > 0.0))
      throw std::runtime_error("the mesh has no area");
    return;
  }
  for (const auto& point : tool::positionsOf(geometry))
    if (point.allFinite())
      cloud_.push_back({point, Eigen::Vector3d::Zero()});
  if (cloud_.size() < 2 * least_points)
    throw std::runtime_error("has " + std::to_string(cloud_.size()) +
                             " points and no faces; two samplings need " +
                             std::to_string(2 * least_points));
  estimateNormals(cloud_);
}

SurfacePoints
Surface::draw(std::size_t number, Random& random) const
{
  SurfacePoints points;
  if (mesh_) {
    while (points.size() < number)
      points.push_back(mesh_->draw(random));
    return points;
  }
  points = shuffled(cloud_, random);
  points.resize(std::min(number, points.size()));
  return points;
}

std::pair<SurfacePoints, SurfacePoints>
Surface::drawTwo(std::size_t first, std::size_t second, Random& random) const
{
  SurfacePoints points = draw(first + second, random);
  const auto share = mesh_ ? first : std::min(first, cloud_.size() / 2);
  return {SurfacePoints(points.begin(), points.begin() + share),
          SurfacePoints(points.begin() + share, points.end())};
}

} // namespace evaluation
