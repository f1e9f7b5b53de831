/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "triangle_mesh.h"

#include <io/read_geometry.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

namespace benchmarks {
namespace {

constexpr int width = 640, height = 480;

void
fitToSize(TriangleMesh& mesh, double size)
{
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& point : mesh.points)
    box.extend(point);
  const double scale = size / box.diagonal().norm();
  const Eigen::Vector3d middle = box.center();
  for (Eigen::Vector3d& point : mesh.points)
    point = scale * (point - middle);
}

/** \brief A ball of rings of points, from pole to pole. */
TriangleMesh
makeBall(std::size_t rings, std::size_t columns)
{
  TriangleMesh ball;
  for (std::size_t i = 0; i <= rings; ++i)
    for (std::size_t j = 0; j < columns; ++j) {
      const double down = M_PI * i / rings, around = 2.0 * M_PI * j / columns;
      ball.points.emplace_back(std::sin(down) * std::cos(around),
                               std::sin(down) * std::sin(around), std::cos(down));
      if (i == rings)
        continue;
      const std::size_t here = i * columns + j, aside = i * columns + (j + 1) % columns;
      ball.triangles.push_back({here, here + columns, aside});
      ball.triangles.push_back({aside, here + columns, aside + columns});
    }
  return ball;
}

struct Bump {
  Eigen::Vector3d direction;
  double rise, narrowness;
};

std::vector<Bump>
makeBumps(std::mt19937& random)
{
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  std::vector<Bump> bumps;
  for (int i = 0; i < 24; ++i) {
    const double x = normal(random), y = normal(random), z = normal(random);
    Bump bump{Eigen::Vector3d(x, y, z).normalized(), 0.0, 0.0};
    if (i < 4) { // horns
      bump.rise = 0.5 + 0.5 * uniform(random);
      bump.narrowness = 15.0 + 25.0 * uniform(random);
    }
    else {
      bump.rise = -0.2 + 0.5 * uniform(random);
      bump.narrowness = 8.0 + 60.0 * uniform(random);
    }
    bumps.push_back(bump);
  }
  return bumps;
}

/** \brief What the camera sees at a pixel. */
struct Image {
  std::vector<double> depths =
      std::vector<double>(width * height, std::numeric_limits<double>::infinity());
  std::vector<bool> steep = std::vector<bool>(width * height);
};

/** \brief Draw a triangle, by its corners in the frame of the camera. */
void
draw(const std::array<Eigen::Vector3d, 3>& corners, double focal_length, Image& image)
{
  const Eigen::Vector3d normal =
      (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  const double offset = normal.dot(corners[0]);
  const double cosine = std::abs(offset) / (normal.norm() * corners[0].norm() + 1e-300);
  Eigen::AlignedBox2d box;
  std::array<Eigen::Vector2d, 3> at;
  for (int i = 0; i < 3; ++i) {
    if (corners[i].z() <= 0.0)
      return;
    at[i] = focal_length * corners[i].head<2>() / corners[i].z() +
            Eigen::Vector2d(width / 2.0, height / 2.0);
    box.extend(at[i]);
  }
  const auto area = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                       const Eigen::Vector2d& c) {
    return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
  };
  const double whole = area(at[0], at[1], at[2]);
  const int left = std::max(0, static_cast<int>(std::floor(box.min().x() - 0.5)));
  const int top = std::max(0, static_cast<int>(std::floor(box.min().y() - 0.5)));
  for (int v = top; v < height && v + 0.5 <= box.max().y(); ++v)
    for (int u = left; u < width && u + 0.5 <= box.max().x(); ++u) {
      const Eigen::Vector2d pixel(u + 0.5, v + 0.5);
      if (area(at[0], at[1], pixel) * whole < 0.0 ||
          area(at[1], at[2], pixel) * whole < 0.0 ||
          area(at[2], at[0], pixel) * whole < 0.0 || whole == 0.0)
        continue;
      const Eigen::Vector3d sight((u + 0.5 - width / 2.0) / focal_length,
                                  (v + 0.5 - height / 2.0) / focal_length, 1.0);
      const double depth = offset / normal.dot(sight);
      if (depth > 0.0 && depth < image.depths[v * width + u]) {
        image.depths[v * width + u] = depth;
        image.steep[v * width + u] = cosine < std::cos(80.0 * M_PI / 180.0);
      }
    }
}

} // namespace

TriangleMesh
readMesh(const std::string& path, double size)
{
  const tool::Geometry geometry = tool::readGeometry(path);
  TriangleMesh mesh;
  mesh.points = tool::positionsOf(geometry);
  for (const pcl::Vertices& face : geometry.faces)
    for (std::size_t i = 2; i < face.vertices.size(); ++i)
      mesh.triangles.push_back({static_cast<std::size_t>(face.vertices[0]),
                                static_cast<std::size_t>(face.vertices[i - 1]),
                                static_cast<std::size_t>(face.vertices[i])});
  if (mesh.triangles.empty())
    throw std::runtime_error(path + " has no faces; give a mesh");
  fitToSize(mesh, size);
  return mesh;
}

TriangleMesh
makeLump(unsigned int seed, double size)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0.6, 1.3);
  const double x = uniform(random), y = uniform(random), z = uniform(random);
  const std::vector<Bump> bumps = makeBumps(random);
  TriangleMesh lump = makeBall(180, 360);
  for (Eigen::Vector3d& point : lump.points) {
    double radius = 1.0;
    for (const Bump& bump : bumps)
      radius +=
          bump.rise * std::exp(bump.narrowness * (bump.direction.dot(point) - 1.0));
    point = radius * point.cwiseProduct(Eigen::Vector3d(x, y, z));
  }
  fitToSize(lump, size);
  return lump;
}

Cloud::Ptr
photograph(const TriangleMesh& mesh,
           const Eigen::Isometry3d& camera,
           double focal_length,
           double noise,
           unsigned int seed)
{
  std::vector<Eigen::Vector3d> seen;
  seen.reserve(mesh.points.size());
  for (const Eigen::Vector3d& point : mesh.points)
    seen.push_back(camera.inverse() * point);
  Image image;
  for (const auto& [a, b, c] : mesh.triangles)
    draw({seen[a], seen[b], seen[c]}, focal_length, image);

  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0.0, noise);
  Cloud::Ptr cloud(new Cloud);
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u) {
      const double exact = image.depths[v * width + u];
      if (!std::isfinite(exact) || image.steep[v * width + u])
        continue;
      const double depth = exact + normal(random);
      cloud->emplace_back((u + 0.5 - width / 2.0) / focal_length * depth,
                          (v + 0.5 - height / 2.0) / focal_length * depth, depth);
    }
  return cloud;
}

} // namespace benchmarks
