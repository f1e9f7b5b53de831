/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "ray_casting.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace benchmarks {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/** \brief The part of a ray that is inside of something: from where to where. */
struct Stretch {
  double begin, end;
};

/** \brief Between two planes across one axis, \a half away from the origin. */
Stretch
betweenPlanes(double origin, double direction, double half)
{
  if (direction == 0.0)
    return std::abs(origin) < half ? Stretch{-infinity, infinity}
                                   : Stretch{infinity, -infinity};
  const double a = (-half - origin) / direction, b = (half - origin) / direction;
  return {std::min(a, b), std::max(a, b)};
}

/** \brief Inside of a circle or a ball around the origin, of as many dimensions as the
 * vectors have.
 */
template <typename Vector>
Stretch
withinRadius(const Vector& origin, const Vector& direction, double radius)
{
  const double a = direction.squaredNorm(), b = origin.dot(direction);
  const double inside = b * b - a * (origin.squaredNorm() - radius * radius);
  if (inside < 0.0 || a == 0.0)
    return {infinity, -infinity};
  const double root = std::sqrt(inside);
  return {(-b - root) / a, (-b + root) / a};
}

Stretch
common(const Stretch& a, const Stretch& b)
{
  return {std::max(a.begin, b.begin), std::min(a.end, b.end)};
}

} // namespace

void
Place::addGround(const Eigen::Vector2d& slope)
{
  ground_ = Eigen::Vector3d(-slope.x(), -slope.y(), 1.0);
}

void
Place::addBox(const Eigen::Vector3d& middle, const Eigen::Vector3d& size, double yaw)
{
  add(Form::BOX, middle, size / 2.0, yaw);
}

void
Place::addCylinder(const Eigen::Vector3d& foot, double radius, double height)
{
  add(Form::CYLINDER, foot + Eigen::Vector3d(0.0, 0.0, height / 2.0),
      {radius, radius, height / 2.0}, 0.0);
}

void
Place::addBall(const Eigen::Vector3d& middle, double radius)
{
  add(Form::BALL, middle, {radius, 0.0, 0.0}, 0.0);
}

void
Place::add(Form form,
           const Eigen::Vector3d& middle,
           const Eigen::Vector3d& half,
           double yaw)
{
  bodies_.push_back({form, middle, half, std::cos(yaw), std::sin(yaw), half.norm()});
}

double
Place::distance(const Ray& ray) const
{
  double nearest = infinity;
  const double sinking = -ground_.dot(ray.direction);
  if (sinking > 0.0)
    nearest = std::max(0.0, ground_.dot(ray.origin) / sinking);
  for (const Body& body : bodies_) {
    const Eigen::Vector3d way = body.middle - ray.origin;
    const double along = way.dot(ray.direction);
    if (way.squaredNorm() - along * along > body.reach * body.reach ||
        along - body.reach > nearest)
      continue;
    Eigen::Matrix3d turn;
    turn << body.cosine, body.sine, 0.0, -body.sine, body.cosine, 0.0, 0.0, 0.0, 1.0;
    nearest = std::min(nearest, distance(body, {-(turn * way), turn * ray.direction}));
  }
  return nearest;
}

Place
Place::slice(const Ray& edge, const Eigen::Vector3d& normal) const
{
  Place slice;
  slice.ground_ = ground_;
  for (const Body& body : bodies_) {
    const Eigen::Vector3d way = body.middle - edge.origin;
    if (std::abs(way.dot(normal)) <= body.reach &&
        way.dot(edge.direction) >= -body.reach)
      slice.bodies_.push_back(body);
  }
  return slice;
}

double
Place::distance(const Body& body, const Ray& ray)
{
  Stretch inside{0.0, infinity};
  if (body.form == Form::BALL)
    inside = common(inside, withinRadius(ray.origin, ray.direction, body.half.x()));
  if (body.form == Form::CYLINDER)
    inside = common(inside, withinRadius<Eigen::Vector2d>(ray.origin.head<2>(),
                                                          ray.direction.head<2>(),
                                                          body.half.x()));
  if (body.form == Form::BOX)
    for (int axis = 0; axis < 2; ++axis)
      inside = common(inside, betweenPlanes(ray.origin[axis], ray.direction[axis],
                                            body.half[axis]));
  if (body.form != Form::BALL)
    inside =
        common(inside, betweenPlanes(ray.origin.z(), ray.direction.z(), body.half.z()));
  return inside.begin < inside.end ? inside.begin : infinity;
}

} // namespace benchmarks
