/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "pair_answer.h"

#include "command_line/geometry_registration.h"
#include "command_line/journal_file.h"
#include "command_line/report.h"
#include "command_line/transformation_file.h"
#include "csv.h"
#include "io/read_geometry.h"

#include <nlohmann/json.hpp>

#include <charconv>
#include <chrono>
#include <filesystem>
#include <new>
#include <sstream>

namespace tool {
namespace {

using JSON = nlohmann::ordered_json;

std::string
resolved(const std::string& path, const std::string& folder)
{
  return path.empty() ? path : (std::filesystem::path(folder) / path).string();
}

/** A number with as many digits as it takes to read the same one. */
std::string
digits(double number)
{
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, number).ptr};
}

/** The columns of results.csv from the confidence on. */
std::string
rowOf(const Result* result, const std::string& reason)
{
  constexpr int NUMBERS = 20; // of the transformation on
  std::string row = result ? digits(result->confidence) : "";
  if (result && result->converged) {
    const Pose& pose = result->poses.front();
    for (int i = 0; i < 16; ++i)
      row += ',' + digits(pose.transformation(i / 4, i % 4));
    for (const double number :
         {result->scale, pose.overlap.source, pose.overlap.target})
      row += ',' + digits(number);
    row += ',' + (result->fitness ? digits(*result->fitness) : "");
  }
  else
    row += std::string(NUMBERS, ',');
  return row + ',' + asField(reason);
}

/** What has come of a pair, with its report. */
JSON
answerOf(const Result& result, JSON report)
{
  const char* const status =
      result.converged ? (result.ambiguous ? AMBIGUOUS : REGISTERED)
                       : (saysNothingOfClouds(result) ? FAILED_PAIR : REFUSED);
  return {{"status", status},
          {"row", rowOf(&result, result.converged ? "" : result.reason)},
          {"report", std::move(report)}};
}

JSON
registerPair(const Pair& pair, const std::string& folder, Options options)
{
  const Geometry source = readGeometry(resolved(pair.source, folder));
  const Geometry target = readGeometry(resolved(pair.target, folder));
  std::optional<Eigen::Matrix4d> guess;
  if (!pair.guess.empty())
    guess = readTransformation(resolved(pair.guess, folder));
  const Result result = registerGeometries(source, target, guess, options, true);

  options.source = pair.source;
  options.target = pair.target;
  options.guess = pair.guess;
  JSON report;
  auto& warnings = report["warnings"] = JSON::array();
  for (const auto& warning : warningsOf(source))
    warnings.push_back(pair.source + ": " + warning);
  for (const auto& warning : warningsOf(target))
    warnings.push_back(pair.target + ": " + warning);
  report.update(reportOf(result, options, source, target));
  return answerOf(result, std::move(report));
}

JSON
withoutResult(const Pair& pair, const std::string& reason)
{
  return {
      {"status", FAILED_PAIR},
      {"row", rowOf(nullptr, reason)},
      {"report",
       {{"inputs",
         {{"source", {{"file", pair.source}}}, {"target", {{"file", pair.target}}}}},
        {"converged", false},
        {"reason", reason}}}};
}

} // namespace

std::string
rowHeader()
{
  std::string header = "confidence";
  for (int i = 0; i < 16; ++i)
    header += ",t" + std::to_string(i / 4) + std::to_string(i % 4);
  return header + ",scale,overlap_source,overlap_target,fitness,reason";
}

std::string
jobOf(const Pair& pair, const std::string& folder)
{
  // no path has a zero in it, and not all are UTF-8, as JSON would have them
  std::string job;
  for (const std::string& part : {pair.source, pair.target, pair.guess, folder})
    job += part + '\0';
  return job;
}

std::string
answerTo(const std::string& job, const Options& how)
{
  const auto start = std::chrono::steady_clock::now();
  std::istringstream parts(job);
  Pair pair;
  std::string folder;
  for (std::string* part : {&pair.source, &pair.target, &pair.guess, &folder})
    std::getline(parts, *part, '\0');
  // before they are read: what changes meanwhile has changed
  JSON inputs = stateOfInputs(pair, folder);
  JSON answer;
  try {
    answer = registerPair(pair, folder, how);
  }
  catch (const std::bad_alloc&) {
    answer = withoutResult(pair, "needs more memory than there is");
  }
  catch (const std::exception& problem) {
    answer = withoutResult(pair, problem.what());
  }
  const std::chrono::duration<double> seconds =
      std::chrono::steady_clock::now() - start;
  answer["seconds"] = seconds.count();
  answer["inputs"] = std::move(inputs);
  return textOf(answer, -1);
}

JSON
failedPair(const Pair& pair, const std::string& folder, const std::string& reason)
{
  JSON answer = withoutResult(pair, reason);
  answer["seconds"] = nullptr;
  answer["inputs"] = stateOfInputs(pair, folder);
  return answer;
}

JSON
stateOfInputs(const Pair& pair, const std::string& folder)
{
  JSON state = JSON::array();
  for (const std::string& path : {pair.source, pair.target, pair.guess})
    state.push_back(stateOf(resolved(path, folder)));
  return state;
}

} // namespace tool
