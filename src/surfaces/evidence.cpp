/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "surfaces/evidence.h"

#include "geometry/take.h"
#include "surfaces/pose_rows.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace pcl {
namespace kss {
namespace {

/** What a direction of a pose has to say to count, relative to an average one. */
constexpr double silent = 1e-4;

using Information = Eigen::Matrix<float, 7, 7>;

/** The information of some points, summed up. */
struct Sums {
  Information information = Information::Zero();
  Eigen::Index points = 0;

  void
  add(const PoseRow& row)
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
          Eigen::Index most,
          Residuals& residuals)
{
  const Eigen::Index size = from.points->points().cols();
  const Eigen::Index count = std::min(most, size);
  const PlacedSurface placed(from, T_to_from);
  Sums all, near, explained;
  for (Eigen::Index n = 0; n < count; ++n) {
    const Eigen::Index i = evenlySpaced(n, count, size);
    const PoseRow row = placed.row(placed.point(i), placed.normal(i));
    all.add(row);
    const Explanation found = explanationOf(to, placed, i, noise);
    if (found.is_near)
      near.add(row);
    if (!found.is_explained)
      continue;
    explained.add(row);
    residuals.squared += found.off * found.off;
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
           bool scale_is_free,
           Eigen::Index most)
{
  const auto scale = static_cast<float>(T_target_source.scale);
  const float noise = std::max(scale * source.planes.noise, target.planes.noise);
  Residuals residuals;
  Evidence evidence;
  evidence.source =
      supportOf(source, target, T_target_source, noise, scale_is_free, most, residuals);
  evidence.target = supportOf(target, source, T_target_source.inverse(), noise / scale,
                              scale_is_free, most, residuals);
  if (residuals.points > 0)
    evidence.residual = std::sqrt(residuals.squared / residuals.points);
  const float spacing =
      std::max(scale * source.points->usualSpacing(), target.points->usualSpacing());
  evidence.noise = noise / spacing;
  const float source_radius = scale * source.points->radius(),
              target_radius = target.points->radius();
  evidence.reach = near_spacings * spacing / std::min(source_radius, target_radius);
  evidence.size = source_radius / target_radius;
  return evidence;
}

} // namespace kss
} // namespace pcl
