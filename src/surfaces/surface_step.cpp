/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include <pcl/registration/kss/detail/surface_step.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

namespace pcl {
namespace kss {
namespace {

double
knob(const char* name, double standard)
{
  const char* text = std::getenv(name);
  return text ? std::atof(text) : standard;
}

using Vector7 = Eigen::Matrix<double, 7, 1>;
using Matrix7 = Eigen::Matrix<double, 7, 7>;

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

/** Solutions of the equations with weights from the one before, for one step. */
constexpr int rounds = 2;

double
medianOf(std::vector<double> values)
{
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/** The pairs that count, as linear equations: a column each, over rotation,
 * translation and logarithm of the scale, all in the unit of the coordinates. */
struct Equations {
  Eigen::Matrix<double, 7, Eigen::Dynamic> columns;
  Eigen::VectorXd residuals;
  Eigen::Vector3d center;
  double radius = 0.0;
  /** How large an eigenvalue per pair the errors of normals alone account for. */
  double normal_error = 0.0;
  bool are_usable = false;
};

/** How far the normals of a pair disagree: the sine of the angle, and whether they mean
 * the same part. */
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

Equations
equationsOf(const SurfacePairs& pairs, const SurfaceStepSettings& settings)
{
  Equations equations;
  if (pairs.source.cols() < fewest_pairs)
    return equations;
  const std::vector<Eigen::Index> kept = counterparts(pairs, settings);
  if (kept.size() < fewest_pairs)
    return equations;
  const auto size = static_cast<Eigen::Index>(kept.size());
  const Eigen::Matrix3Xd places = 0.5 * (pairs.source(Eigen::all, kept) +
                                         pairs.target(Eigen::all, kept));
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
  const double both = share * share * source_error +
                      (1.0 - share) * (1.0 - share) * target_error;
  // an error turns the lever of a pair in any of three directions
  equations.normal_error = disagreement * both / (source_error + target_error) / 3.0;
  return equations;
}

/** The weighted normal equations about a solution. */
struct Normal {
  Matrix7 matrix = Matrix7::Zero();
  Vector7 gradient = Vector7::Zero();
  double weights = 0.0;
  double variance = 0.0;
};

Normal
normalAt(const Equations& equations, const Vector7& unknowns, double rounding_error)
{
  const Eigen::VectorXd residuals =
      equations.residuals + equations.columns.transpose() * unknowns;
  std::vector<double> absolute(residuals.size());
  for (Eigen::Index i = 0; i < residuals.size(); ++i)
    absolute[i] = std::abs(residuals[i]);
  const double spread = std::max(medianOf(absolute) / gaussian_median, rounding_error);
  const double width = std::max(biweight_width * spread, 1e-300);
  Normal normal;
  double squares = 0.0;
  for (Eigen::Index i = 0; i < residuals.size(); ++i) {
    const double ratio = residuals[i] / width;
    const double root = std::max(0.0, 1.0 - ratio * ratio);
    const double weight = root * root;
    const Vector7 column = equations.columns.col(i);
    normal.matrix.noalias() += weight * column * column.transpose();
    normal.gradient -= weight * residuals[i] * column;
    normal.weights += weight;
    squares += weight * residuals[i] * residuals[i];
  }
  normal.variance = std::max(squares / std::max(normal.weights - 7.0, 1.0),
                             rounding_error * rounding_error);
  return normal;
}

/** The change that the equations ask for, in the directions that they determine.
 * \return how many they do not */
int
solve(const Normal& normal, int unknowns, double normal_error, Vector7& change)
{
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(
      normal.matrix.topLeftCorner(unknowns, unknowns));
  const double least = std::max(2.0 * normal_error, 1e-6) * normal.weights;
  int undetermined = 0;
  change.setZero();
  for (int i = 0; i < unknowns; ++i) {
    const double value = solver.eigenvalues()[i];
    const Eigen::VectorXd direction = solver.eigenvectors().col(i);
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
similarityOf(const Vector7& unknowns, const Eigen::Vector3d& center, double radius)
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
  const Equations equations = equationsOf(pairs, settings);
  if (!equations.are_usable)
    return step;
  const double smallest = equations.radius * std::log(settings.smallest_scale);
  const double largest = equations.radius * std::log(settings.largest_scale);
  const bool estimates_scale = smallest < largest;
  Vector7 unknowns = Vector7::Zero();
  unknowns[6] = std::min(std::max(0.0, smallest), largest);
  Normal normal;
  for (int round = 0; round < rounds; ++round) {
    normal = normalAt(equations, unknowns, settings.rounding_error);
    Vector7 change;
    step.undetermined =
        solve(normal, estimates_scale ? 7 : 6, equations.normal_error, change);
    if (estimates_scale && (unknowns[6] + change[6] < smallest ||
                            unknowns[6] + change[6] > largest)) {
      // at the bound, and the best that the others can do there
      const double bound = unknowns[6] + change[6] < smallest ? smallest : largest;
      const double held = bound - unknowns[6];
      normal.gradient -= held * normal.matrix.col(6);
      step.undetermined = solve(normal, 6, equations.normal_error, change);
      change[6] = held;
    }
    unknowns += change;
  }
  step.squared_errors_moved = unknowns.dot(normal.matrix * unknowns) /
                              ((estimates_scale ? 7.0 : 6.0) * normal.variance);
  step.transformation = similarityOf(unknowns, equations.center, equations.radius);
  step.is_found = step.transformation.allFinite();
  static const double debug = knob("K_DEBUG", 0);
  if (debug > 0)
    std::fprintf(stderr,
                 "step rot %.3g deg, trans %.3g, log scale %.3g, errors %.3g, und %d "
                 "normal error %.3g pairs %ld sd %.3g\n",
                 unknowns.head<3>().norm() / equations.radius * 57.3,
                 unknowns.segment<3>(3).norm(), unknowns[6] / equations.radius,
                 std::sqrt(step.squared_errors_moved), step.undetermined,
                 equations.normal_error, long(equations.columns.cols()),
                 std::sqrt(normal.variance));
  return step;
}

} // namespace kss
} // namespace pcl
