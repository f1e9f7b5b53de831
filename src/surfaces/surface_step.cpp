/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include <pcl/registration/kss/detail/surface_step.h>

#include "surfaces/pair_equations.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace pcl {
namespace kss {
namespace {

/** Solutions of the equations with weights from the one before, for one step. */
constexpr int rounds = 2;

/** The change that the equations ask for, in the directions that they determine.
 * \param[in] free a basis of the changes that there may be
 * \return how many of its directions they do not */
int
solve(const NormalEquations& normal,
      const Eigen::MatrixXd& free,
      double least,
      Change& change)
{
  const Eigen::Index unknowns = free.rows();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(
      free.transpose() * normal.matrix.topLeftCorner(unknowns, unknowns) * free);
  int undetermined = 0;
  change.setZero();
  for (Eigen::Index i = 0; i < free.cols(); ++i) {
    const double value = solver.eigenvalues()[i];
    const Eigen::VectorXd direction = free * solver.eigenvectors().col(i);
    if (value < least)
      ++undetermined;
    else
      change.head(unknowns) +=
          direction * (direction.dot(normal.gradient.head(unknowns)) / value);
  }
  return undetermined;
}

/** The similarity of a solution, both halves of it. */
StoredPose
similarityOf(const Change& unknowns, const Eigen::Vector3d& center, double radius)
{
  const Eigen::Vector3d half_turn = unknowns.head<3>() / (2.0 * radius);
  const double angle = std::atan(half_turn.norm());
  const Eigen::Matrix3d turn =
      angle > 0.0 ? Eigen::AngleAxisd(angle, half_turn.normalized()).toRotationMatrix()
                  : Eigen::Matrix3d(Eigen::Matrix3d::Identity());
  const Eigen::Matrix3d half = std::exp(0.5 * unknowns[6] / radius) * turn;
  const Eigen::Vector3d shift = std::cos(angle) * unknowns.segment<3>(3);
  // x -> center + half (half (x - center) + shift)
  StoredPose similarity = StoredPose::Identity();
  similarity.topLeftCorner<3, 3>() = half * half;
  similarity.topRightCorner<3, 1>() = center + half * (shift - half * center);
  return similarity;
}

} // namespace

SurfaceStep
surfaceStep(const SurfacePairs& pairs, const SurfaceStepSettings& settings)
{
  SurfaceStep step;
  const PairEquations equations = equationsOf(pairs, settings);
  if (!equations.are_usable)
    return step;
  const double smallest = equations.radius * std::log(settings.smallest_scale);
  const double largest = equations.radius * std::log(settings.largest_scale);
  const bool estimates_scale = smallest < largest;
  const Eigen::MatrixXd free = freeChanges(settings, estimates_scale);
  Change unknowns = Change::Zero();
  unknowns[6] = std::min(std::max(0.0, smallest), largest);
  NormalEquations normal;
  for (int round = 0; round < rounds; ++round) {
    normal = normalEquationsAt(equations, unknowns, settings);
    const double least = smallestDetermined(equations, normal);
    Change change;
    step.undetermined = solve(normal, free, least, change);
    if (estimates_scale &&
        (unknowns[6] + change[6] < smallest || unknowns[6] + change[6] > largest)) {
      // at the bound, and the best that the others can do there
      const double bound = unknowns[6] + change[6] < smallest ? smallest : largest;
      const double held = bound - unknowns[6];
      normal.gradient -= held * normal.matrix.col(6);
      step.undetermined = solve(normal, freeChanges(settings, false), least, change);
      change[6] = held;
    }
    unknowns += change;
  }
  const double rounding = settings.rounding_error * settings.rounding_error;
  // points average their own rounding out, but not that of the pose, which they share
  const double squared_errors =
      std::min(unknowns.dot(normal.matrix * unknowns) / normal.variance,
               unknowns.squaredNorm() / std::max(rounding, 1e-300));
  step.squared_errors_moved = squared_errors / static_cast<double>(free.cols());
  step.transformation = similarityOf(unknowns, equations.center, equations.radius);
  step.is_found = step.transformation.allFinite();
  return step;
}

} // namespace kss
} // namespace pcl
