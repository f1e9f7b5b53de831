/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include <pcl/registration/kss/detail/surface_step.h>

#include "surfaces/pair_equations.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

namespace pcl {
namespace kss {
namespace {

/** Pairs of a patch, about: what they share (target points, the neighbourhoods that
 * normals are from) reaches no farther than a few points. */
constexpr double pairs_in_patch = 40.0;

/** Slopes of the pulls, relative to their weights, that are less are chance: errors of
 * a normal distribution have 0.83. */
constexpr double least_slope = 0.3;

/** What the pairs of each patch pull by, together. */
std::vector<Change>
pullsOfPatches(const PairEquations& equations, const NormalEquations& normal)
{
  const Eigen::Index size = equations.places.cols();
  // an area of some four thirds of a sphere's with that radius
  const double edge = equations.radius * std::sqrt(4.0 * M_PI * pairs_in_patch / size);
  std::map<std::vector<int>, Change> patches;
  for (Eigen::Index i = 0; i < size; ++i) {
    const Eigen::Vector3d cell =
        ((equations.places.col(i) - equations.center) / edge).array().floor();
    const auto [patch, is_new] =
        patches.try_emplace({static_cast<int>(cell.x()), static_cast<int>(cell.y()),
                             static_cast<int>(cell.z())},
                            Change::Zero());
    patch->second += normal.pulls[i] * equations.columns.col(i);
  }
  std::vector<Change> pulls;
  for (const auto& [cell, pull] : patches)
    pulls.push_back(pull);
  return pulls;
}

} // namespace

SurfacePrecision
surfacePrecision(const SurfacePairs& pairs,
                 const SurfaceStepSettings& settings,
                 const Eigen::Vector3d& center)
{
  SurfacePrecision precision;
  const PairEquations equations = equationsOf(pairs, settings);
  if (!equations.are_usable)
    return precision;
  const NormalEquations normal = normalEquationsAt(equations, Change::Zero(), settings);
  const Eigen::MatrixXd free =
      freeChanges(settings, settings.smallest_scale < settings.largest_scale);
  const auto n = static_cast<int>(free.rows());
  precision.unknowns = n;

  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(
      free.transpose() * normal.matrix.topLeftCorner(n, n) * free);
  const Eigen::MatrixXd directions = free * solver.eigenvectors();
  const double least = smallestDetermined(equations, normal);
  const std::vector<Change> pulls = pullsOfPatches(equations, normal);
  // patches scatter by the variance of their pairs and what these have in common
  double variance = 0.0;
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index i = 0; i < directions.cols(); ++i)
    if (solver.eigenvalues()[i] >= least)
      for (const Change& pull : pulls)
        variance +=
            std::pow(directions.col(i).dot(pull.head(n)), 2) / solver.eigenvalues()[i];
    else
      ++precision.undetermined;
  const auto count = static_cast<double>(pulls.size());
  variance *= count / std::max(count - 1.0, 1.0) /
              std::max(static_cast<int>(free.cols()) - precision.undetermined, 1);
  variance = std::max(variance, normal.variance);
  // matches and weights follow the pose and take back a part of what the equations
  // promise: the error is larger by as much as steps fall short
  // (what weights take back, the slope of the pulls tells; about half of that is in the
  // contraction of the steps already, by Monte Carlo)
  const double slope = std::max(normal.slopes / normal.weights, least_slope);
  const double kept = std::sqrt(slope) * (1.0 - settings.contraction);
  variance /= kept * kept;
  for (Eigen::Index i = 0; i < directions.cols(); ++i) {
    const Eigen::VectorXd direction = directions.col(i);
    const double squared = solver.eigenvalues()[i] >= least
                               ? variance / solver.eigenvalues()[i]
                               : equations.radius * equations.radius;
    covariance += squared * direction * direction.transpose();
  }

  // from the unit of coordinates, and from the center of the pairs
  ChangeMatrix units = ChangeMatrix::Identity();
  units.topLeftCorner<3, 3>() /= equations.radius;
  units(6, 6) /= equations.radius;
  const Eigen::Vector3d arm = center - equations.center;
  for (int axis = 0; axis < 3; ++axis)
    units.block<3, 1>(3, axis) =
        Eigen::Vector3d::Unit(axis).cross(arm) / equations.radius;
  units.block<3, 1>(3, 6) = arm / equations.radius;
  const Eigen::MatrixXd to = units.topLeftCorner(n, n);
  precision.covariance.topLeftCorner(n, n) = to * covariance * to.transpose();
  return precision;
}

} // namespace kss
} // namespace pcl
