/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "surfaces/evidence.h"

#include "geometry/clouds.h"
#include "geometry/median.h"
#include "geometry/take.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace pcl {
namespace kss {
namespace {

/** Points of each cloud that speak. */
constexpr Eigen::Index most_speakers = 4000;

/** How near a surface a point has to be, in spacings: beyond, none of the other
 * sampling of the same surface is expected to be found. */
constexpr float near_spacings = 2.5f;

/** How far off its plane, in standard deviations of the noise: one in eighty of a
 * normal distribution is farther. */
constexpr float within_noise = 2.5f;

/** Noise, in spacings, below which planes of a dozen neighbours cannot be trusted. */
constexpr float least_noise = 0.05f;

/** Cosine of the angle between normals that agree. */
constexpr float agreeing = 0.8f;

/** What a direction of a pose has to say to count, relative to an average one. */
constexpr double silent = 1e-4;

using Row = Eigen::Matrix<float, 7, 1>;
using Information = Eigen::Matrix<float, 7, 7>;

/** The information of some points, summed up. */
struct Sums {
  Information information = Information::Zero();
  Eigen::Index points = 0;

  void
  add(const Row& row)
  {
    information.selfadjointView<Eigen::Lower>().rankUpdate(row);
    ++points;
  }
};

/** The share of \a all that \a some is in the direction where it is least. */
double
worstShare(const Sums& some, const Sums& all, int directions)
{
  if (all.points == 0)
    return 0.0;
  const auto full = [directions](const Sums& sums) {
    const Information full = sums.information.selfadjointView<Eigen::Lower>();
    return Eigen::MatrixXd(full.topLeftCorner(directions, directions).cast<double>());
  };
  Eigen::MatrixXd part = full(some), whole = full(all);
  const double ground = silent * whole.trace() / directions;
  part.diagonal().array() += ground;
  whole.diagonal().array() += ground;
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(
      part, whole, Eigen::EigenvaluesOnly);
  return solver.info() == Eigen::Success ? std::clamp(solver.eigenvalues()[0], 0.0, 1.0)
                                         : 0.0;
}

/** The residuals of explained points. */
struct Residuals {
  double squared = 0.0;
  Eigen::Index points = 0;
};

Support
supportOf(const OrientedPoints& from,
          const OrientedPoints& to,
          const Similarity& T_to_from,
          float noise,
          bool scale_is_free,
          Residuals& residuals)
{
  const Points& points = from.points->points();
  const Eigen::Index size = points.cols(), count = std::min(most_speakers, size);
  const Eigen::Affine3f placement = T_to_from.affine();
  const Eigen::Matrix3f rotation = T_to_from.rotation.cast<float>();
  const auto scale = static_cast<float>(T_to_from.scale);
  const Eigen::Vector3f center = placement * points.rowwise().mean().eval();
  const float radius = scale * rootMeanSquareRadius(points, points.rowwise().mean());

  Sums all, near, explained;
  for (Eigen::Index n = 0; n < count; ++n) {
    const Eigen::Index i = evenlySpaced(n, count, size);
    const Eigen::Vector3f x = placement * points.col(i);
    const Eigen::Vector3f normal = rotation * from.normals.col(i);
    const Eigen::Vector3f arm = (x - center) / radius;
    const Eigen::Vector3f turn = arm.cross(normal);
    Row row;
    row << normal.x(), normal.y(), normal.z(), turn.x(), turn.y(), turn.z(),
        normal.dot(arm);
    all.add(row);

    float squared;
    const int other = to.points->nearest(x, squared);
    const float spacing =
        std::max(scale * from.points->spacing()[i], to.points->spacing()[other]);
    if (squared > near_spacings * near_spacings * spacing * spacing)
      continue;
    near.add(row);
    const Eigen::Vector3f to_normal = to.normals.col(other);
    const float cosine = normal.dot(to_normal);
    const float agreement = from.has_sides && to.has_sides ? cosine : std::abs(cosine);
    const float off = std::abs(to_normal.dot(x - to.points->points().col(other)));
    const float deviation = std::max(noise, least_noise * spacing);
    if (agreement < agreeing || off > within_noise * deviation)
      continue;
    explained.add(row);
    residuals.squared += off * off / (deviation * deviation);
    ++residuals.points;
  }
  const int directions = scale_is_free ? 7 : 6;
  Support support;
  support.near = static_cast<double>(near.points) / count;
  support.explained = static_cast<double>(explained.points) / count;
  support.worst = worstShare(explained, all, directions);
  support.consistent = worstShare(explained, near, directions);
  support.points = support.explained * static_cast<double>(size);
  return support;
}

} // namespace

Evidence
evidenceAt(const OrientedPoints& source,
           const OrientedPoints& target,
           const Similarity& T_target_source,
           bool scale_is_free)
{
  const auto scale = static_cast<float>(T_target_source.scale);
  const float noise = std::max(scale * source.noise, target.noise);
  Residuals residuals;
  Evidence evidence;
  evidence.source =
      supportOf(source, target, T_target_source, noise, scale_is_free, residuals);
  evidence.target = supportOf(target, source, T_target_source.inverse(), noise / scale,
                              scale_is_free, residuals);
  if (residuals.points > 0)
    evidence.residual = std::sqrt(residuals.squared / residuals.points);
  const auto radiusOf = [](const OrientedPoints& cloud) {
    const Points& points = cloud.points->points();
    return rootMeanSquareRadius(points, points.rowwise().mean());
  };
  const float spacing = std::max(scale * median(source.points->spacing()),
                                 median(target.points->spacing()));
  evidence.noise = noise / spacing;
  evidence.reach =
      near_spacings * spacing / std::min(scale * radiusOf(source), radiusOf(target));
  return evidence;
}

} // namespace kss
} // namespace pcl
