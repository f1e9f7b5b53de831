/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "report.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>

namespace tool {
namespace {

/** A matrix as its rows. */
nlohmann::json
toJSON(const Eigen::Matrix4d& matrix)
{
  auto rows = nlohmann::json::array();
  for (int i = 0; i < 4; ++i)
    rows.push_back({matrix(i, 0), matrix(i, 1), matrix(i, 2), matrix(i, 3)});
  return rows;
}

/** The matrix to be looked at: in columns, and without rounding errors for zeros. */
std::string
table(const Eigen::Matrix4d& matrix)
{
  const double noise = 1e-15 * matrix.cwiseAbs().maxCoeff();
  std::ostringstream text;
  text << std::setprecision(9);
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j)
      text << std::setw(17) << (std::abs(matrix(i, j)) < noise ? 0.0 : matrix(i, j));
    text << '\n';
  }
  return text.str();
}

/** What the residual of a success means: two samplings of one surface come out near
 * 0.5.
 */
std::string
inWords(double residual)
{
  return residual < 0.6 ? "as close as two scans of one surface"
                        : "close, but for noise or parts that differ";
}

} // namespace

std::string
transformationText(const Eigen::Matrix4d& transformation)
{
  std::ostringstream text;
  text << std::setprecision(std::numeric_limits<double>::max_digits10);
  for (int i = 0; i < 4; ++i)
    text << transformation(i, 0) << ' ' << transformation(i, 1) << ' '
         << transformation(i, 2) << ' ' << transformation(i, 3) << '\n';
  return text.str();
}

std::string
reportText(const Result& result)
{
  nlohmann::ordered_json report;
  // JSON has no infinity or NaN: the library writes null for them.
  report["converged"] = result.converged;
  if (!result.converged)
    report["reason"] = result.reason;
  report["transformation"] = nullptr;
  report["scale"] = nullptr;
  report["energy"] = nullptr;
  report["residual"] = result.residual;
  report["fitness"] = nullptr;
  report["alternatives"] = nlohmann::ordered_json::array();
  if (!result.poses.empty()) {
    report["transformation"] = toJSON(result.poses.front().transformation);
    report["scale"] = result.scale;
    report["energy"] = result.poses.front().energy;
    report["fitness"] = result.fitness;
  }
  for (const auto& pose : result.poses)
    report["alternatives"].push_back(
        {{"transformation", toJSON(pose.transformation)}, {"energy", pose.energy}});
  report["device"] = result.device;
  for (const auto& stage : result.stages)
    report["seconds"][stage.stage] = stage.seconds;
  report["seconds"]["total"] = result.seconds;
  // Names of devices may hold anything.
  return report.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + '\n';
}

std::string
summaryText(const Result& result)
{
  const Pose& pose = result.poses.front();
  std::ostringstream text;
  text << std::setprecision(4) << "Transformation of SOURCE onto TARGET:\n"
       << table(pose.transformation) << "Scale:    " << result.scale
       << "\nEnergy:   " << pose.energy
       << "  (largest distance, as a fraction of the target's radius)"
       << "\nResidual: " << result.residual
       << "  (mean distance in sampling distances: " << inWords(result.residual) << ")"
       << "\nTime:     " << result.seconds << " s on " << result.device << '\n';
  return text.str();
}

} // namespace tool
