/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/detail/points.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace kss_test {

using pcl::kss::Points;

struct Triangle {
  Eigen::Vector3d a, b, c;
};

/** \brief Surfaces to sample clouds from. */
using Mesh = std::vector<Triangle>;

/** \brief A parallelogram. */
inline Mesh
panel(const Eigen::Vector3d& corner, const Eigen::Vector3d& u, const Eigen::Vector3d& v)
{
  return {{corner, corner + u, corner + v}, {corner + u + v, corner + u, corner + v}};
}

inline Mesh
box(const Eigen::Vector3d& center, const Eigen::Vector3d& half)
{
  Mesh mesh;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      const int next = (axis + 1) % 3, last = (axis + 2) % 3;
      Eigen::Vector3d corner = center - half;
      corner[axis] = center[axis] + side * half[axis];
      const auto face = panel(corner, 2.0 * half[next] * Eigen::Vector3d::Unit(next),
                              2.0 * half[last] * Eigen::Vector3d::Unit(last));
      mesh.insert(mesh.end(), face.begin(), face.end());
    }
  return mesh;
}

inline Mesh
ellipsoid(const Eigen::Vector3d& center, const Eigen::Vector3d& radii)
{
  constexpr int steps = 24;
  const auto at = [&](int ring, int step) -> Eigen::Vector3d {
    const double polar = M_PI * ring / steps;
    const double around = 2.0 * M_PI * step / steps;
    const Eigen::Vector3d unit(std::sin(polar) * std::cos(around),
                               std::sin(polar) * std::sin(around), std::cos(polar));
    return center + radii.cwiseProduct(unit);
  };
  Mesh mesh;
  for (int ring = 0; ring < steps; ++ring)
    for (int step = 0; step < steps; ++step) {
      mesh.push_back({at(ring, step), at(ring + 1, step), at(ring + 1, step + 1)});
      mesh.push_back({at(ring, step), at(ring, step + 1), at(ring + 1, step + 1)});
    }
  return mesh;
}

inline Mesh
together(const std::vector<Mesh>& parts)
{
  Mesh mesh;
  for (const Mesh& part : parts)
    mesh.insert(mesh.end(), part.begin(), part.end());
  return mesh;
}

/** \brief A body with limbs: no rotation but the identity maps it onto itself. */
inline Mesh
creature()
{
  return together({ellipsoid({0.0, 0.0, 0.0}, {1.0, 0.6, 0.45}),
                   ellipsoid({-1.1, 0.2, 0.5}, {0.35, 0.3, 0.3}),
                   box({1.0, 0.6, 0.2}, {0.5, 0.12, 0.1}),
                   box({0.2, -0.4, -0.7}, {0.1, 0.12, 0.4}),
                   box({-0.5, 0.3, -0.6}, {0.1, 0.3, 0.25})});
}

/** \brief Something else: no pose makes it look like the creature. */
inline Mesh
cross()
{
  return together({box({0.0, 0.0, 0.0}, {2.0, 0.1, 0.1}),
                   box({0.3, 0.0, 0.0}, {0.1, 1.4, 0.1}),
                   box({-0.5, 0.0, 0.5}, {0.1, 0.1, 0.9})});
}

/** \brief A bumpy ball: every part of it is different. */
inline Mesh
lump()
{
  const auto bulged = [](const Eigen::Vector3d& p) -> Eigen::Vector3d {
    const double bumps = 0.25 * std::sin(3.0 * p.x() + 1.0) * std::cos(2.0 * p.y()) +
                         0.2 * std::sin(4.0 * p.y() - 2.0 * p.z()) +
                         0.15 * std::cos(5.0 * p.z() + p.x()) +
                         0.12 * std::sin(6.0 * p.x() - 5.0 * p.y() + 2.0 * p.z());
    return (1.0 + bumps) * p;
  };
  Mesh mesh = ellipsoid({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0});
  for (Triangle& t : mesh)
    t = {bulged(t.a), bulged(t.b), bulged(t.c)};
  return mesh;
}

/** \brief A flat isosceles triangle: half a turn about its axis, x, maps it onto
 * itself. */
inline Mesh
pennant()
{
  return {{{0.0, -0.5, 0.0}, {0.0, 0.5, 0.0}, {2.0, 0.0, 0.0}}};
}

/** \brief Points spread evenly by area, independent of those of another seed. */
inline Points
sampled(const Mesh& mesh, Eigen::Index number, unsigned int seed)
{
  std::vector<double> areas;
  for (const Triangle& t : mesh)
    areas.push_back((t.b - t.a).cross(t.c - t.a).norm());
  std::mt19937 random(seed);
  std::discrete_distribution<std::size_t> pick(areas.begin(), areas.end());
  std::uniform_real_distribution<double> share(0.0, 1.0);
  Points points(3, number);
  for (Eigen::Index i = 0; i < number; ++i) {
    const Triangle& t = mesh[pick(random)];
    double u = share(random), v = share(random);
    if (u + v > 1.0) {
      u = 1.0 - u;
      v = 1.0 - v;
    }
    points.col(i) = (t.a + u * (t.b - t.a) + v * (t.c - t.a)).cast<float>();
  }
  return points;
}

/** \brief Points with independent Gaussian errors. */
inline Points
noisy(const Points& points, double sigma, unsigned int seed)
{
  std::mt19937 random(seed);
  std::normal_distribution<double> error(0.0, sigma);
  Points moved = points;
  for (Eigen::Index i = 0; i < moved.size(); ++i)
    moved.data()[i] += static_cast<float>(error(random));
  return moved;
}

/** \brief Independent points in a unit cube. */
inline Points
scattered(Eigen::Index number, unsigned int seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> coordinate(0.0f, 1.0f);
  Points points(3, number);
  for (Eigen::Index i = 0; i < points.size(); ++i)
    points.data()[i] = coordinate(random);
  return points;
}

/** \brief The share of the points that lies farthest in a direction. */
inline Points
part(const Points& points, const Eigen::Vector3f& direction, double share)
{
  std::vector<float> along;
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    along.push_back(direction.dot(points.col(i)));
  std::vector<float> sorted = along;
  std::sort(sorted.begin(), sorted.end());
  const auto size = static_cast<Eigen::Index>(share * points.cols());
  const float border = sorted[sorted.size() - size];
  Points rest(3, 0);
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    if (along[i] >= border) {
      rest.conservativeResize(3, rest.cols() + 1);
      rest.rightCols<1>() = points.col(i);
    }
  return rest;
}

/** \brief The points, then as many outliers that they make up a share of all: evenly
 * scattered over a box half as large again. */
inline Points
withOutliers(const Points& points, double share, unsigned int seed)
{
  const auto outliers =
      static_cast<Eigen::Index>(points.cols() * share / (1.0 - share));
  const Eigen::Vector3f lower = points.rowwise().minCoeff();
  const Eigen::Vector3f extent = points.rowwise().maxCoeff() - lower;
  Points all(3, points.cols() + outliers);
  all.leftCols(points.cols()) = points;
  all.rightCols(outliers) =
      ((1.5f * extent).asDiagonal() * scattered(outliers, seed)).colwise() +
      (lower - 0.25f * extent);
  return all;
}

inline double
diagonalOf(const Points& points)
{
  return (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).norm();
}

/** \brief Even points of a square, a unit apart. */
inline Points
square(int edge)
{
  Points points(3, edge * edge);
  for (int i = 0; i < edge * edge; ++i)
    points.col(i) = Eigen::Vector3f(i % edge, i / edge, 0.0f);
  return points;
}

/** \brief How far a position is from the nearest of some points. */
inline float
distanceTo(const Points& points, const Eigen::Vector3f& position)
{
  return std::sqrt((points.colwise() - position).colwise().squaredNorm().minCoeff());
}

} // namespace kss_test
