/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "clouds.h"

#include <pcl/common/transforms.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <vector>

namespace benchmarks {
namespace {

/** \brief A ball with a bump or dent wherever a fixed seed puts one. */
class Surface {
public:
  Surface()
  {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> uniform;
    for (int i = 0; i < 24; ++i) {
      Bump bump;
      bump.middle = drawDirection(random);
      bump.height = -0.2 + 0.7 * uniform(random);
      bump.narrowness = 6.0 + 34.0 * uniform(random);
      bumps_.push_back(bump);
    }
    for (int i = 0; i < 100000; ++i)
      largest_weight_ = std::max(largest_weight_, at(drawDirection(random)).weight);
    largest_weight_ *= 1.05;
  }

  /** \brief A point of the surface; all parts of it are equally likely. */
  Eigen::Vector3d
  draw(std::mt19937& random) const
  {
    std::uniform_real_distribution<double> weight(0.0, largest_weight_);
    while (true) {
      const Eigen::Vector3d direction = drawDirection(random);
      const Sight sight = at(direction);
      if (weight(random) < sight.weight)
        return sight.radius * direction;
    }
  }

  /** \brief The area, by the mean area per direction. */
  double
  area() const
  {
    std::mt19937 random(3);
    double sum = 0.0;
    const int draws = 100000;
    for (int i = 0; i < draws; ++i)
      sum += at(drawDirection(random)).weight;
    return 4.0 * M_PI * sum / draws;
  }

private:
  struct Bump {
    Eigen::Vector3d middle;
    double height, narrowness;
  };

  /** \brief The surface in one direction: its distance, and its area per solid angle.
   */
  struct Sight {
    double radius, weight;
  };

  static Eigen::Vector3d
  drawDirection(std::mt19937& random)
  {
    std::normal_distribution<double> gauss;
    const double x = gauss(random), y = gauss(random), z = gauss(random);
    return Eigen::Vector3d(x, y, z).normalized();
  }

  Sight
  at(const Eigen::Vector3d& direction) const
  {
    double radius = 1.0;
    Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
    for (const Bump& bump : bumps_) {
      const double cosine = bump.middle.dot(direction);
      const double height = bump.height * std::exp(bump.narrowness * (cosine - 1.0));
      radius += height;
      gradient += bump.narrowness * height * (bump.middle - cosine * direction);
    }
    return {radius, radius * std::hypot(radius, gradient.norm())};
  }

  std::vector<Bump> bumps_;
  double largest_weight_ = 0.0;
};

Eigen::Affine3d
makePose(double degrees,
         const Eigen::Vector3d& axis,
         const Eigen::Vector3d& translation)
{
  return Eigen::Translation3d(translation) *
         Eigen::AngleAxisd(degrees * M_PI / 180.0, axis.normalized());
}

/** \brief The target and one of its sources; the target is shared by all of them. */
Pair
makePair(const Cloud::Ptr& target, unsigned int seed, const Eigen::Affine3d& pose)
{
  Cloud::Ptr source = sampleSurface(target->size(), seed);
  pcl::transformPointCloud(*source, *source, pose.cast<float>());
  return {source, target, pose.inverse()};
}

} // namespace

Cloud::Ptr
sampleSurface(std::size_t size, unsigned int seed)
{
  static const Surface surface;
  static const double area = surface.area();

  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0.0, 0.3 * std::sqrt(area / size));
  Cloud::Ptr cloud(new Cloud);
  cloud->reserve(size);
  for (std::size_t i = 0; i < size; ++i) {
    Eigen::Vector3d point = surface.draw(random);
    for (int axis = 0; axis < 3; ++axis)
      point[axis] += noise(random);
    cloud->emplace_back(point.x(), point.y(), point.z());
  }
  return cloud;
}

const Pair&
pairOf(std::size_t size)
{
  static std::map<std::size_t, Pair> pairs;
  const auto found = pairs.find(size);
  if (found != pairs.end())
    return found->second;
  const Eigen::Affine3d pose = makePose(140.0, {1.0, 2.0, 3.0}, {5.0, -3.0, 2.0});
  return pairs[size] = makePair(sampleSurface(size, 11), 12, pose);
}

const Pair&
secondPairOf(std::size_t size)
{
  static std::map<std::size_t, Pair> pairs;
  const auto found = pairs.find(size);
  if (found != pairs.end())
    return found->second;
  const Eigen::Affine3d pose = makePose(100.0, {-3.0, 1.0, -1.0}, {-4.0, 1.0, 3.0});
  return pairs[size] = makePair(pairOf(size).target, 13, pose);
}

} // namespace benchmarks
