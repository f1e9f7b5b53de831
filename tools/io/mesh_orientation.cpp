/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "mesh_orientation.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <tuple>

namespace tool {
namespace {

using Faces = std::vector<pcl::Vertices>;

/** For every point the first one of the same coordinates. */
std::vector<std::size_t>
weld(const Points& points)
{
  std::vector<std::size_t> order(points.size()), first(points.size());
  std::iota(order.begin(), order.end(), 0);
  const auto key = [&](std::size_t i) {
    return std::make_tuple(points[i].x(), points[i].y(), points[i].z());
  };
  std::iota(first.begin(), first.end(), 0);
  order.erase(std::remove_if(order.begin(), order.end(),
                             [&](std::size_t i) { return !points[i].allFinite(); }),
              order.end());
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
  for (std::size_t i = 1; i < order.size(); ++i)
    if (points[order[i]] == points[order[i - 1]])
      first[order[i]] = first[order[i - 1]];
  return first;
}

/** An edge of a face, its points in rising order. */
struct Edge {
  std::size_t low, high, face;
  bool rises; ///< as the face is wound

  bool
  operator<(const Edge& other) const
  {
    return std::tie(low, high, face) < std::tie(other.low, other.high, other.face);
  }
};

std::vector<Edge>
sortedEdges(const Faces& faces, const std::vector<std::size_t>& welded)
{
  std::vector<Edge> edges;
  for (std::size_t face = 0; face < faces.size(); ++face) {
    const auto& corners = faces[face].vertices;
    // what has no area has no neighbours
    std::set<std::size_t> distinct;
    for (const auto corner : corners)
      distinct.insert(welded[corner]);
    if (distinct.size() < 3)
      continue;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const std::size_t from = welded[corners[i]];
      const std::size_t to = welded[corners[(i + 1) % corners.size()]];
      if (from != to)
        edges.push_back({std::min(from, to), std::max(from, to), face, from < to});
    }
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

/** Two faces that share an edge. */
struct Link {
  std::size_t face;
  bool opposed; ///< one of them is wound the other way round
};

/** How the faces of a mesh hang together. */
struct Connections {
  std::vector<std::vector<Link>> links; ///< of each face
  std::vector<bool> has_border;         ///< whether a face lacks a neighbour
};

Connections
connectionsOf(const Faces& faces, const std::vector<std::size_t>& welded)
{
  Connections found{std::vector<std::vector<Link>>(faces.size()),
                    std::vector<bool>(faces.size())};
  const std::vector<Edge> edges = sortedEdges(faces, welded);
  for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
    while (end < edges.size() && edges[end].low == edges[begin].low &&
           edges[end].high == edges[begin].high)
      ++end;
    const Edge &one = edges[begin], &other = edges[end - 1];
    if (end - begin == 2 && one.face != other.face) {
      const bool opposed = one.rises == other.rises;
      found.links[one.face].push_back({other.face, opposed});
      found.links[other.face].push_back({one.face, opposed});
    }
    else
      for (std::size_t i = begin; i < end; ++i)
        found.has_border[edges[i].face] = true;
  }
  return found;
}

/** Faces that hang together. */
struct Component {
  std::vector<std::size_t> faces;
  bool is_closed = true;
  bool is_orientable = true;
};

/** Follow the links from a face.
 * \param[in,out] seen which faces belong to a component
 * \param[in,out] turned which faces are to be turned for one winding
 */
Component
componentFrom(std::size_t start,
              const Connections& connections,
              std::vector<bool>& seen,
              std::vector<bool>& turned)
{
  Component component;
  component.faces = {start};
  seen[start] = true;
  for (std::size_t i = 0; i < component.faces.size(); ++i) {
    const std::size_t face = component.faces[i];
    component.is_closed = component.is_closed && !connections.has_border[face];
    for (const Link& link : connections.links[face]) {
      const bool turn = turned[face] != link.opposed;
      if (!seen[link.face]) {
        seen[link.face] = true;
        turned[link.face] = turn;
        component.faces.push_back(link.face);
      }
      else if (turned[link.face] != turn)
        component.is_orientable = false;
    }
  }
  return component;
}

/** Six times what a face and a point enclose. */
double
volumeUnder(const pcl::Vertices& face,
            const Points& points,
            const Eigen::Vector3d& apex)
{
  double volume = 0.0;
  for (std::size_t i = 2; i < face.vertices.size(); ++i)
    volume += (points[face.vertices[0]] - apex)
                  .dot((points[face.vertices[i - 1]] - apex)
                           .cross(points[face.vertices[i]] - apex));
  return volume;
}

} // namespace

void
turnOutwards(Geometry& mesh)
{
  const Points points = positionsOf(mesh);
  const Connections connections = connectionsOf(mesh.faces, weld(points));
  std::vector<bool> seen(mesh.faces.size()), turned(mesh.faces.size());
  std::vector<std::size_t> wound; // by the file, all of its components
  double enclosed = 0.0;
  for (std::size_t start = 0; start < mesh.faces.size(); ++start) {
    if (seen[start] || mesh.faces[start].vertices.empty())
      continue;
    const Component component = componentFrom(start, connections, seen, turned);
    const auto& faces = component.faces;
    const Eigen::Vector3d apex = points[mesh.faces[start].vertices[0]];
    double volume = 0.0;
    bool as_wound = true;
    for (const std::size_t face : faces) {
      volume +=
          (turned[face] ? -1.0 : 1.0) * volumeUnder(mesh.faces[face], points, apex);
      as_wound = as_wound && !turned[face];
    }
    if (!component.is_closed || !component.is_orientable || !std::isfinite(volume)) {
      for (const std::size_t face : faces)
        turned[face] = false;
    }
    else if (as_wound) {
      wound.insert(wound.end(), faces.begin(), faces.end());
      enclosed += volume;
    }
    else if (volume < 0.0)
      for (const std::size_t face : faces)
        turned[face] = !turned[face];
  }
  if (enclosed < 0.0)
    for (const std::size_t face : wound)
      turned[face] = true;
  for (std::size_t face = 0; face < mesh.faces.size(); ++face)
    if (turned[face])
      std::reverse(mesh.faces[face].vertices.begin(), mesh.faces[face].vertices.end());
}

} // namespace tool
