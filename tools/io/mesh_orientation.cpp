/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "mesh_orientation.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <tuple>

namespace tool {
namespace {

using Faces = std::vector<pcl::Vertices>;

/** The number of a point or a face: files with more than these hold are refused. */
using Number = std::uint32_t;

/** For every point the first one of the same coordinates. */
std::vector<Number>
weld(const Points& points)
{
  struct Place {
    double x, y, z;
    Number point;

    bool
    operator<(const Place& other) const
    {
      return std::tie(x, y, z, point) <
             std::tie(other.x, other.y, other.z, other.point);
    }
  };
  std::vector<Place> places;
  places.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points[i].allFinite())
      places.push_back(
          {points[i].x(), points[i].y(), points[i].z(), static_cast<Number>(i)});
  std::sort(places.begin(), places.end());

  std::vector<Number> first(points.size());
  std::iota(first.begin(), first.end(), 0);
  for (std::size_t i = 1; i < places.size(); ++i)
    if (points[places[i].point] == points[places[i - 1].point])
      first[places[i].point] = first[places[i - 1].point];
  return first;
}

/** An edge of a face, its points in rising order. */
struct Edge {
  Number low, high, face;
  bool rises; ///< as the face is wound
};

/** Whether a face has three corners that differ: what has no area has no neighbours. */
bool
hasThreeCorners(const pcl::Vertices& face, const std::vector<Number>& welded)
{
  const auto& corners = face.vertices;
  const auto differs_from = [&](Number one) {
    return [&welded, one](pcl::index_t corner) { return welded[corner] != one; };
  };
  if (corners.empty())
    return false;
  const Number first = welded[corners[0]];
  const auto second = std::find_if(corners.begin(), corners.end(), differs_from(first));
  return second != corners.end() &&
         std::any_of(second, corners.end(), [&](pcl::index_t corner) {
           return welded[corner] != first && welded[corner] != welded[*second];
         });
}

template <typename Function>
void
forEachEdge(const Faces& faces, const std::vector<Number>& welded, Function&& function)
{
  for (std::size_t face = 0; face < faces.size(); ++face) {
    if (!hasThreeCorners(faces[face], welded))
      continue;
    const auto& corners = faces[face].vertices;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Number from = welded[corners[i]];
      const Number to = welded[corners[i + 1 < corners.size() ? i + 1 : 0]];
      if (from != to)
        function(Edge{std::min(from, to), std::max(from, to), static_cast<Number>(face),
                      from < to});
    }
  }
}

/** Places of things that belong to others, of which each has so many: those of the i-th
 * lie from the i-th place up to the next one. */
std::vector<std::size_t>
placesOf(const std::vector<Number>& counts)
{
  std::vector<std::size_t> places(counts.size() + 1);
  std::partial_sum(counts.begin(), counts.end(), places.begin() + 1,
                   [](std::size_t sum, std::size_t count) { return sum + count; });
  return places;
}

/** The edges, by their lower point, then their higher one. */
std::vector<Edge>
sortedEdges(const Faces& faces, const std::vector<Number>& welded)
{
  std::vector<Number> counts(welded.size());
  forEachEdge(faces, welded, [&](const Edge& edge) { ++counts[edge.low]; });
  const std::vector<std::size_t> places = placesOf(counts);
  std::vector<Edge> edges(places.back());
  std::vector<std::size_t> next = places;
  forEachEdge(faces, welded, [&](const Edge& edge) { edges[next[edge.low]++] = edge; });
  for (std::size_t low = 0; low < welded.size(); ++low)
    std::sort(edges.begin() + places[low], edges.begin() + places[low + 1],
              [](const Edge& a, const Edge& b) {
                return std::tie(a.high, a.face) < std::tie(b.high, b.face);
              });
  return edges;
}

/** Two faces that share an edge. */
struct Link {
  Number face;
  bool opposed; ///< one of them is wound the other way round
};

/** How the faces of a mesh hang together. */
struct Connections {
  std::vector<Link> links;         ///< of all faces
  std::vector<std::size_t> places; ///< of each face's links
  std::vector<bool> has_border;    ///< whether a face lacks a neighbour
};

Connections
connectionsOf(const Faces& faces, const std::vector<Number>& welded)
{
  Connections found;
  found.has_border.resize(faces.size());
  const std::vector<Edge> edges = sortedEdges(faces, welded);
  const auto for_each_shared = [&](auto&& shared, auto&& border) {
    for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
      while (end < edges.size() && edges[end].low == edges[begin].low &&
             edges[end].high == edges[begin].high)
        ++end;
      if (end - begin == 2 && edges[begin].face != edges[begin + 1].face)
        shared(edges[begin], edges[begin + 1]);
      else
        for (std::size_t i = begin; i < end; ++i)
          border(edges[i].face);
    }
  };
  std::vector<Number> counts(faces.size());
  for_each_shared(
      [&](const Edge& one, const Edge& other) {
        ++counts[one.face];
        ++counts[other.face];
      },
      [&](Number face) { found.has_border[face] = true; });
  found.places = placesOf(counts);
  found.links.resize(found.places.back());
  std::vector<std::size_t> next = found.places;
  for_each_shared(
      [&](const Edge& one, const Edge& other) {
        const bool opposed = one.rises == other.rises;
        found.links[next[one.face]++] = {other.face, opposed};
        found.links[next[other.face]++] = {one.face, opposed};
      },
      [](Number) {});
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
    for (std::size_t at = connections.places[face]; at < connections.places[face + 1];
         ++at) {
      const Link& link = connections.links[at];
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

std::vector<bool>
facesTurnedInwards(const Geometry& mesh, const Points& points)
{
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
  return turned;
}

void
turnOutwards(Geometry& mesh)
{
  const std::vector<bool> turned = facesTurnedInwards(mesh, positionsOf(mesh));
  for (std::size_t face = 0; face < mesh.faces.size(); ++face)
    if (turned[face])
      std::reverse(mesh.faces[face].vertices.begin(), mesh.faces[face].vertices.end());
}

} // namespace tool
