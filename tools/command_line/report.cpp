/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "report.h"

#include "io/fields.h"
#include "picture/short_text.h"
#include "words.h"
#include "wrapped.h"

#include <pcl/registration/kss/result.h>
#include <pcl/registration/kss/settings_text.h>

#include <nlohmann/json.hpp>

#include <charconv>
#include <iomanip>
#include <sstream>

namespace tool {
namespace {

/** A matrix as its rows. */
nlohmann::json
toJSON(const Eigen::MatrixXd& matrix)
{
  auto rows = nlohmann::json::array();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    auto row = nlohmann::json::array();
    for (Eigen::Index j = 0; j < matrix.cols(); ++j)
      row.push_back(matrix(i, j));
    rows.push_back(row);
  }
  return rows;
}

/** The matrix in columns, with as many digits as it takes to read the same numbers. */
std::string
table(const Eigen::Matrix4d& matrix)
{
  std::ostringstream text;
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      char digits[32];
      const auto end = std::to_chars(digits, digits + sizeof digits, matrix(i, j)).ptr;
      text << std::setw(25) << std::string(digits, end);
    }
    text << '\n';
  }
  return text.str();
}

/** A value of an enumeration by the word that the command line has for it. */
template <auto member, typename Value>
std::string
wordOf(Value value)
{
  namespace setting = pcl::kss::setting;
  return valueText(setting::rowOf<member>(), value, setting::For::COMMAND_LINE);
}

/** What a mode found says about the clouds. */
const char*
inWords(pcl::kss::Mode mode)
{
  switch (mode) {
  case pcl::kss::Mode::GLOBAL_GLOBAL:
    return "both show the same";
  case pcl::kss::Mode::PARTIAL_GLOBAL:
    return "one is a part of the other";
  default:
    return "both lack parts of the other";
  }
}

nlohmann::ordered_json
toJSON(const pcl::kss::Overlap& overlap)
{
  return {overlap.source, overlap.target};
}

nlohmann::ordered_json
toJSON(const pcl::kss::Support& support)
{
  return {{"near", support.near},
          {"explained", support.explained},
          {"worst", support.worst},
          {"consistent", support.consistent},
          {"points", support.points}};
}

nlohmann::ordered_json
toJSON(const pcl::kss::Evidence& evidence)
{
  return {{"source", toJSON(evidence.source)}, {"target", toJSON(evidence.target)},
          {"residual", evidence.residual},     {"noise", evidence.noise},
          {"reach", evidence.reach},           {"size", evidence.size}};
}

/** \name The value of a setting as the command line has it. */
/** \{ */
nlohmann::ordered_json
valueOf(const pcl::kss::setting::Flag&, bool value)
{
  return value;
}

template <typename Value>
nlohmann::ordered_json
valueOf(const pcl::kss::setting::Number<Value>& row, Value value)
{
  const double size = row.typed.unit.size;
  return size == 1.0 ? nlohmann::ordered_json(value)
                     : nlohmann::ordered_json(std::stod(valueText(
                           row, value, pcl::kss::setting::For::COMMAND_LINE)));
}

template <typename Row, typename Value>
nlohmann::ordered_json
valueOf(const Row& row, const Value& value)
{
  return valueText(row, value, pcl::kss::setting::For::COMMAND_LINE);
}
/** \} */

nlohmann::ordered_json
toJSON(const std::string& file, const Geometry& geometry)
{
  return {{"file", file},
          {"points", numberOfPoints(geometry.cloud)},
          {"faces", geometry.faces.size()}};
}

/** A line with what it is about, and more lines as far as it is long. */
std::string
lineOn(const std::string& what, const std::string& text)
{
  constexpr std::size_t WIDTH = 79, INDENT = 11;
  return what + std::string(INDENT - what.size(), ' ') + wrapped(text, WIDTH, INDENT) +
         '\n';
}

} // namespace

nlohmann::ordered_json
settingsAsJSON(const Options& options)
{
  nlohmann::ordered_json settings;
  pcl::kss::setting::forEach([&](const auto& row) {
    settings[row.name] = valueOf(row, options.settings.*row.member);
  });
  settings["samples"] = options.samples;
  settings["iterations"] = options.iterations;
  settings["guess"] = nullptr;
  if (!options.guess.empty())
    settings["guess"] = options.guess;
  return settings;
}

nlohmann::ordered_json
reportOf(const Result& result,
         const Options& options,
         const Geometry& source,
         const Geometry& target)
{
  nlohmann::ordered_json report;
  // JSON has no infinity or NaN: the library writes null for them.
  report["version"] = PCL_KSS_ICP_VERSION;
  report["inputs"] = {{"source", toJSON(options.source, source)},
                      {"target", toJSON(options.target, target)}};
  report["units"] = {
      {"lengths", "unit of target"}, {"angles", "radians"}, {"times", "seconds"}};
  report["converged"] = result.converged;
  if (!result.converged)
    report["reason"] = result.reason;
  report["transformation"] = nullptr;
  report["scale"] = nullptr;
  report["scale_deviation"] = nullptr;
  report["covariance"] = nullptr;
  report["undetermined"] = nullptr;
  report["mode"] = nullptr;
  report["overlap"] = nullptr;
  report["score"] = nullptr;
  report["confidence"] = result.confidence;
  report["ambiguous"] = result.ambiguous;
  report["fitness"] = nullptr;
  report["alternatives"] = nlohmann::ordered_json::array();
  if (!result.poses.empty()) {
    report["transformation"] = toJSON(result.poses.front().transformation);
    report["scale"] = result.scale;
    if (result.covariance.size() > 0) {
      report["scale_deviation"] = result.scale_deviation;
      report["covariance"] = toJSON(result.covariance);
      report["undetermined"] = result.undetermined;
    }
    report["mode"] = wordOf<&pcl::kss::Settings::mode>(result.mode);
    report["overlap"] = toJSON(result.poses.front().overlap);
    report["score"] = result.poses.front().overlap.score;
    if (result.fitness)
      report["fitness"] = *result.fitness;
  }
  for (const auto& pose : result.poses)
    report["alternatives"].push_back({{"transformation", toJSON(pose.transformation)},
                                      {"overlap", toJSON(pose.overlap)},
                                      {"score", pose.overlap.score},
                                      {"evidence", toJSON(pose.evidence)}});
  report["far_points"] = {result.far_points.source, result.far_points.target};
  report["settings"] = settingsAsJSON(options);
  report["search"] = wordOf<&pcl::kss::Settings::search>(result.search);
  report["device"] = result.device;
  return report;
}

std::string
textOf(const nlohmann::ordered_json& json, int indent)
{
  return json.dump(indent, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string
reportText(const Result& result,
           const Options& options,
           const Geometry& source,
           const Geometry& target)
{
  nlohmann::ordered_json report = reportOf(result, options, source, target);
  for (const auto& stage : result.stages)
    report["seconds"][stage.stage] = stage.seconds;
  report["seconds"]["total"] = result.seconds;
  return textOf(report, 2) + '\n';
}

std::string
summaryText(const Result& result, const Options& options)
{
  const Pose& pose = result.poses.front();
  const std::string hint = scaleHint(result, options.settings);
  std::ostringstream time;
  time << std::setprecision(4) << result.seconds << " s on " << result.device
       << ", search " << wordOf<&pcl::kss::Settings::search>(result.search);
  std::string text =
      "Transformation of SOURCE onto TARGET:\n" + table(pose.transformation) +
      lineOn("Scale:", scaleText(result) + (hint.empty() ? "" : ": " + hint)) +
      lineOn("Overlap:", percent(pose.overlap.source) + " of SOURCE, " +
                             percent(pose.overlap.target) + " of TARGET (" +
                             inWords(result.mode) + ")") +
      lineOn("Sure:", sureText(result));
  if (result.ambiguous)
    text += lineOn("Ambiguous:", ambiguityText(result) +
                                     ". --picture FILE shows them, --report FILE lists "
                                     "them");
  return text + lineOn("Time:", time.str());
}

} // namespace tool
