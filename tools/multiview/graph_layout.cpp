/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "graph_layout.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace tool {
namespace {

using Places = std::vector<Eigen::Vector2d>;

/** The centroids of a group's scans, to the right and down, on their two widest axes.
 */
Places
flattened(const Model& model, const std::vector<std::size_t>& group)
{
  Eigen::Matrix3Xd points(3, group.size());
  for (std::size_t i = 0; i < group.size(); ++i) {
    const Eigen::Matrix4d pose = model.result.scans[group[i]].transformation;
    points.col(i) = Eigen::Affine3d(pose) * model.result.scans[group[i]].centroid;
  }
  points.colwise() -= points.rowwise().mean().eval();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(points *
                                                            points.transpose());
  Places places;
  for (const auto& point : points.colwise()) {
    const Eigen::Vector2d place(axes.eigenvectors().col(2).dot(point),
                                axes.eigenvectors().col(1).dot(point));
    places.push_back(place.allFinite() ? place : Eigen::Vector2d(0.0, 0.0));
  }
  return places;
}

/** Move apart what is too near, and all of it into a rectangle from 0 on. */
Eigen::Vector2d
spread(Places& places, const Eigen::Vector2d& room, double apart)
{
  Eigen::AlignedBox2d box;
  for (const auto& place : places)
    box.extend(place);
  const Eigen::Vector2d size = box.sizes();
  const double scale =
      size.maxCoeff() > 0.0
          ? (room.array() / size.cwiseMax(1e-9 * size.maxCoeff()).array()).minCoeff()
          : 0.0;
  for (auto& place : places)
    place = scale * (place - box.min());
  constexpr int ROUNDS = 60;
  for (int round = 0; round < ROUNDS; ++round)
    for (std::size_t i = 0; i < places.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        Eigen::Vector2d between = places[i] - places[j];
        const double distance = between.norm();
        if (distance >= apart)
          continue;
        // those in one place go different ways
        between = distance > 1e-6 * apart
                      ? Eigen::Vector2d(between / distance)
                      : Eigen::Vector2d(std::cos(2.4 * i), std::sin(2.4 * i));
        places[i] += 0.5 * (apart - distance) * between;
        places[j] -= 0.5 * (apart - distance) * between;
      }
  box.setEmpty();
  for (const auto& place : places)
    box.extend(place);
  for (auto& place : places)
    place -= box.min();
  return box.sizes();
}

} // namespace

GraphLayout
layOut(const Model& model, double width)
{
  GraphLayout layout;
  const std::size_t scans = model.result.scans.size();
  layout.width = width;
  layout.radius = scans <= 80 ? 11.0 : scans <= 200 ? 8.0 : 5.0;
  layout.places.assign(scans, Eigen::Vector2d::Zero());
  const double margin = layout.radius + 16.0, head = 14.0, gap = 14.0;

  double x = 0.0, y = 0.0,
         row = 0.0; // where the next cell goes, and how high its row is
  for (std::size_t g = 0; g < model.result.groups.size(); ++g) {
    const auto& group = model.result.groups[g];
    const double edge =
        group.size() == 1 ? 0.0
                          : 60.0 + 62.0 * std::sqrt(static_cast<double>(group.size()));
    const double most = width - 2.0 * margin;
    Places places = flattened(model, group);
    const Eigen::Vector2d size =
        spread(places, {std::min(1.7 * edge, most), edge}, 3.0 * layout.radius);
    const std::string title = group.size() == 1 ? "" : "Group " + std::to_string(g + 1);
    const double least = title.empty() ? 0.0 : 76.0; // for the title
    GroupCell cell{x, y, std::max(size.x() + 2.0 * margin, least),
                   size.y() + 2.0 * margin + head, title};
    if (x > 0.0 && x + cell.width > width) {
      y += row + gap;
      cell.x = x = row = 0.0;
      cell.y = y;
    }
    for (std::size_t i = 0; i < group.size(); ++i)
      layout.places[group[i]] =
          places[i] + Eigen::Vector2d(cell.x + 0.5 * (cell.width - size.x()),
                                      cell.y + margin + head);
    x += cell.width + gap;
    row = std::max(row, cell.height);
    layout.width = std::max(layout.width, cell.width);
    layout.cells.push_back(std::move(cell));
  }
  layout.height = y + row;
  return layout;
}

} // namespace tool
