/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include <pcl/registration/kss/detail/surface_step.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
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
constexpr Eigen::Index fewest_pairs = 14;

/** A median absolute value of Gaussian errors, in standard deviations. */
constexpr double gaussian_median = 0.6745;

double
quantile(std::vector<double> values, double share)
{
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * (values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/** The linear equations of the pairs, a row each: rotation, translation, scale. */
struct Rows {
  Eigen::Matrix<double, 7, Eigen::Dynamic> columns;
  Eigen::VectorXd residuals;
  Eigen::VectorXd weights;
  Eigen::Vector3d center;
  double radius;
  double normal_noise;
};

Rows
rowsOf(const SurfacePairs& pairs, double rounding_error)
{
  const Eigen::Index size = pairs.source.cols();
  static const double reach = knob("K_REACH", 3.0), agree = knob("K_AGREE", 0.7);
  // what has no counterpart is matched with the border of the other surface
  std::vector<double> distances(size);
  for (Eigen::Index i = 0; i < size; ++i)
    distances[i] = (pairs.source.col(i) - pairs.target.col(i)).norm();
  const double longest =
      std::max(reach * quantile(distances, 0.5), rounding_error);

  Rows rows;
  rows.columns.resize(7, size);
  rows.residuals.resize(size);
  rows.weights.resize(size);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double count = 0.0;
  for (Eigen::Index i = 0; i < size; ++i) {
    const double agreement =
        std::abs(pairs.source_normals.col(i).dot(pairs.target_normals.col(i)));
    rows.weights[i] = distances[i] <= longest && agreement >= agree ? 1.0 : 0.0;
    if (rows.weights[i] > 0.0) {
      sum += 0.5 * (pairs.source.col(i) + pairs.target.col(i));
      count += 1.0;
    }
  }
  rows.center = sum / std::max(count, 1.0);
  double squared = 0.0, disagreement = 0.0;
  for (Eigen::Index i = 0; i < size; ++i)
    if (rows.weights[i] > 0.0) {
      const Eigen::Vector3d place =
          0.5 * (pairs.source.col(i) + pairs.target.col(i)) - rows.center;
      squared += place.squaredNorm();
      const double agreement =
          pairs.source_normals.col(i).dot(pairs.target_normals.col(i));
      disagreement += 1.0 - agreement * agreement;
    }
  rows.radius = std::sqrt(squared / std::max(count, 1.0));
  rows.normal_noise = disagreement / std::max(count, 1.0);
  const double unit = rows.radius > 0.0 ? 1.0 / rows.radius : 0.0;
  for (Eigen::Index i = 0; i < size; ++i) {
    const Eigen::Vector3d target_normal = pairs.target_normals.col(i);
    Eigen::Vector3d source_normal = pairs.source_normals.col(i);
    if (source_normal.dot(target_normal) < 0.0)
      source_normal = -source_normal;
    const Eigen::Vector3d normal = 0.5 * (source_normal + target_normal);
    const Eigen::Vector3d place =
        unit * (0.5 * (pairs.source.col(i) + pairs.target.col(i)) - rows.center);
    rows.columns.col(i) << place.cross(normal), normal, place.dot(normal);
    rows.residuals[i] = normal.dot(pairs.source.col(i) - pairs.target.col(i));
  }
  return rows;
}

} // namespace

SurfaceStep
surfaceStep(const SurfacePairs& pairs, const SurfaceStepBounds& bounds)
{
  static const double k_width = knob("K_WIDTH", 3.0), k_floor = knob("K_FLOOR", 0.0),
                      k_quant = knob("K_QUANT", 0.5), k_rounds = knob("K_ROUNDS", 2),
                      k_trunc = knob("K_TRUNC", 0.5), debug = knob("K_DEBUG", 0);
  SurfaceStep step;
  if (pairs.source.cols() < fewest_pairs)
    return step;
  Rows rows = rowsOf(pairs, bounds.rounding_error);
  const Eigen::VectorXd gate = rows.weights;
  const Eigen::Index size = gate.size();
  if (gate.sum() < fewest_pairs || !(rows.radius > 0.0))
    return step;
  std::vector<double> distances;
  for (Eigen::Index i = 0; i < size; ++i)
    if (gate[i] > 0.0)
      distances.push_back((pairs.source.col(i) - pairs.target.col(i)).norm());
  const double typical = quantile(distances, 0.5);

  Vector7 unknowns = Vector7::Zero();
  Matrix7 equations;
  double variance = 0.0;
  const int n = bounds.estimate_scale ? 7 : 6;
  for (int round = 0; round < static_cast<int>(k_rounds); ++round) {
    const Eigen::VectorXd residuals =
        rows.residuals + rows.columns.transpose() * unknowns;
    std::vector<double> absolute;
    for (Eigen::Index i = 0; i < size; ++i)
      if (gate[i] > 0.0)
        absolute.push_back(std::abs(residuals[i]));
    const double spread =
        std::max({quantile(absolute, k_quant) / gaussian_median, k_floor * typical,
                  bounds.rounding_error});
    const double width = std::max(k_width * spread, 1e-300);
    equations.setZero();
    Vector7 gradient = Vector7::Zero();
    double weighted = 0.0, weights = 0.0;
    for (Eigen::Index i = 0; i < size; ++i) {
      if (gate[i] <= 0.0)
        continue;
      const double ratio = residuals[i] / width;
      const double root = std::max(0.0, 1.0 - ratio * ratio);
      const double weight = root * root;
      const Vector7 column = rows.columns.col(i);
      equations.noalias() += weight * column * column.transpose();
      gradient -= weight * residuals[i] * column;
      weighted += weight * residuals[i] * residuals[i];
      weights += weight;
    }
    variance = std::max(weighted / std::max(weights - n, 1.0),
                        bounds.rounding_error * bounds.rounding_error);
    Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(
        equations.topLeftCorner(n, n));
    const Eigen::VectorXd values = solver.eigenvalues();
    step.undetermined = 0;
    Eigen::VectorXd change = Eigen::VectorXd::Zero(n);
    const double least = std::max(k_trunc * rows.normal_noise / 4.0, 1e-6) * weights;
    for (int i = 0; i < n; ++i) {
      if (values[i] < least) {
        ++step.undetermined;
        continue;
      }
      const Eigen::VectorXd v = solver.eigenvectors().col(i);
      change += v * (v.dot(gradient.head(n)) / values[i]);
    }
    unknowns.head(n) += change;
    if (debug > 0)
      std::fprintf(stderr,
                   "  pairs %ld of %ld typical %.3g spread %.3g nn %.3g und %d eig0 %.3g "
                   "%.3g (%.3g)\n",
                   long(gate.sum()), long(size), typical, spread, rows.normal_noise,
                   step.undetermined, values[0] / weights, values[1] / weights,
                   least / weights);
  }
  step.squared_errors_moved =
      unknowns.dot(equations * unknowns) / (n * variance);
  if (n == 7) {
    // TODO bounds
    const double log_scale = unknowns[6] / rows.radius;
    (void)log_scale;
  }
  const Eigen::Vector3d half = unknowns.head<3>() / (2.0 * rows.radius);
  const double angle = std::atan(half.norm());
  const Eigen::Matrix3d turn =
      half.norm() > 0.0
          ? Eigen::AngleAxisd(angle, half.normalized()).toRotationMatrix()
          : Eigen::Matrix3d::Identity();
  const double root_scale = std::exp(0.5 * unknowns[6] / rows.radius);
  const Eigen::Vector3d shift = unknowns.segment<3>(3) * std::cos(angle);
  const Eigen::Matrix3d part = root_scale * turn;
  // x -> c + part (part (x - c) + shift)
  step.transformation.topLeftCorner<3, 3>() = part * part;
  step.transformation.topRightCorner<3, 1>() =
      rows.center + part * shift - part * part * rows.center;
  step.is_found = step.transformation.allFinite();
  if (debug > 0)
    std::fprintf(stderr, "step rot %.3g deg, trans %.3g, log scale %.3g, errors %.3g\n",
                 2 * angle * 57.3, shift.norm(), unknowns[6] / rows.radius,
                 std::sqrt(step.squared_errors_moved));
  return step;
}

} // namespace kss
} // namespace pcl
