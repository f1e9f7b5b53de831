/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "surfaces/pair_equations.h"

#include "geometry/turns.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace pcl {
namespace kss {
namespace {

/** The fewest pairs that a step is found from: twice as many as there are unknowns. */
constexpr double fewest_pairs = 14.0;

/** Pairs longer than so many medians have no counterpart: of random points on a
 * surface, one in five hundred is as far from the nearest of another such sampling. */
constexpr double longest_pair = 3.0;

/** Normals that disagree by more than this beside their errors, in radians, are those
 * of other parts. */
constexpr double other_part = 0.79;

/** Normal errors that are no worse than what surfaces bend from point to point. */
constexpr double harmless_normal_error = 0.1;

/** Mean squared sine between matched normals from which on they say nothing: half of
 * what random ones have. */
constexpr double random_normals = 1.0 / 3.0;

/** The width of Tukey's biweight at which 95 % of the information of Gaussian errors is
 * kept, in standard deviations, and the median of such errors' absolute values. */
constexpr double biweight_width = 4.685;
constexpr double gaussian_median = 0.6745;
constexpr double gaussian_quarter = 0.3186; // the same of their lower quartile

/** What rounding leaves of an eigenvalue per pair. */
constexpr double rounding_eigenvalue = 1e-6;

double
quantileOf(std::vector<double> values, double share)
{
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(
                                       share * static_cast<double>(values.size()));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

double
medianOf(const std::vector<double>& values)
{
  return quantileOf(values, 0.5);
}

/** The pairs that have a counterpart: short ones whose normals mean the same part. */
std::vector<Eigen::Index>
counterparts(const SurfacePairs& pairs, const SurfaceStepSettings& settings)
{
  const Eigen::Index size = pairs.source.cols();
  std::vector<double> lengths(size);
  for (Eigen::Index i = 0; i < size; ++i)
    lengths[i] = (pairs.source.col(i) - pairs.target.col(i)).norm();
  const double longest =
      std::max(longest_pair * medianOf(lengths), settings.rounding_error);
  const double widest = other_part + 3.0 * std::hypot(settings.source_normal_error,
                                                      settings.target_normal_error);
  const double least = widest < M_PI_2 ? std::cos(widest) : 0.0;
  std::vector<Eigen::Index> kept;
  for (Eigen::Index i = 0; i < size; ++i)
    if (lengths[i] <= longest &&
        std::abs(pairs.source_normals.col(i).dot(pairs.target_normals.col(i))) >= least)
      kept.push_back(i);
  return kept;
}

} // namespace

Eigen::MatrixXd
freeChanges(const SurfaceStepSettings& settings, bool with_scale)
{
  const Turns turns = turnsOf(settings.rotation_axis);
  const Eigen::Index others = with_scale ? 4 : 3;
  Eigen::MatrixXd free = Eigen::MatrixXd::Zero(3 + others, turns.cols() + others);
  free.topLeftCorner(3, turns.cols()) = turns;
  free.bottomRightCorner(others, others).setIdentity();
  return free;
}

PairEquations
equationsOf(const SurfacePairs& pairs, const SurfaceStepSettings& settings)
{
  PairEquations equations;
  if (pairs.source.cols() < fewest_pairs)
    return equations;
  const std::vector<Eigen::Index> kept = counterparts(pairs, settings);
  if (kept.size() < fewest_pairs)
    return equations;
  const auto size = static_cast<Eigen::Index>(kept.size());
  equations.places =
      0.5 * (pairs.source(Eigen::all, kept) + pairs.target(Eigen::all, kept));
  const Eigen::Matrix3Xd& places = equations.places;
  equations.center = places.rowwise().mean();
  equations.radius =
      std::sqrt((places.colwise() - equations.center).squaredNorm() / size);
  if (!(equations.radius > 0.0))
    return equations;

  // halves cancel what the surface bends between the two points; where one of the
  // normals is noise, the other one counts
  const auto squared = [](double error) {
    return error * error + harmless_normal_error * harmless_normal_error;
  };
  const double source_error = squared(settings.source_normal_error);
  const double target_error = squared(settings.target_normal_error);
  const double share = target_error / (source_error + target_error);
  double disagreement = 0.0;
  equations.columns.resize(7, size);
  equations.residuals.resize(size);
  for (Eigen::Index i = 0; i < size; ++i) {
    const Eigen::Vector3d target_normal = pairs.target_normals.col(kept[i]);
    Eigen::Vector3d source_normal = pairs.source_normals.col(kept[i]);
    const double agreement = source_normal.dot(target_normal);
    if (agreement < 0.0)
      source_normal = -source_normal;
    disagreement += 1.0 - agreement * agreement;
    const Eigen::Vector3d normal =
        share * source_normal + (1.0 - share) * target_normal;
    const Eigen::Vector3d arm = (places.col(i) - equations.center) / equations.radius;
    equations.columns.col(i) << arm.cross(normal), normal, arm.dot(normal);
    equations.residuals[i] =
        normal.dot(pairs.source.col(kept[i]) - pairs.target.col(kept[i]));
  }
  disagreement /= static_cast<double>(size);
  equations.are_usable = disagreement < random_normals;
  const double both =
      share * share * source_error + (1.0 - share) * (1.0 - share) * target_error;
  // an error turns the lever of a pair in any of three directions
  equations.normal_error = disagreement * both / (source_error + target_error) / 3.0;
  return equations;
}

NormalEquations
normalEquationsAt(const PairEquations& equations,
                  const Change& change,
                  const SurfaceStepSettings& settings)
{
  const double rounding_error = settings.rounding_error;
  const Eigen::VectorXd residuals =
      equations.residuals + equations.columns.transpose() * change;
  std::vector<double> absolute(residuals.size());
  for (Eigen::Index i = 0; i < residuals.size(); ++i)
    absolute[i] = std::abs(residuals[i]);
  const double spread =
      std::max(settings.has_skins ? quantileOf(absolute, 0.25) / gaussian_quarter
                                  : medianOf(absolute) / gaussian_median,
               rounding_error);
  const double width = std::max(biweight_width * spread, 1e-300);
  const Eigen::ArrayXd ratios = residuals.array() / width;
  const Eigen::ArrayXd roots = (1.0 - ratios.square()).max(0.0);
  const Eigen::VectorXd weights = roots.square();
  NormalEquations normal;
  normal.matrix =
      equations.columns * weights.asDiagonal() * equations.columns.transpose();
  normal.pulls = weights.cwiseProduct(residuals);
  normal.gradient = -(equations.columns * normal.pulls);
  normal.weights = weights.sum();
  normal.slopes = (roots * (1.0 - 5.0 * ratios.square())).sum();
  const double squares = normal.pulls.dot(residuals);
  normal.variance = std::max(squares / std::max(normal.weights - 7.0, 1.0),
                             rounding_error * rounding_error);
  return normal;
}

double
smallestDetermined(const PairEquations& equations, const NormalEquations& normal)
{
  return std::max(2.0 * equations.normal_error, rounding_eigenvalue) * normal.weights;
}

} // namespace kss
} // namespace pcl
