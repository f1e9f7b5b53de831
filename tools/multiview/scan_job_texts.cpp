/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "scan_job_texts.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <stdexcept>

namespace tool {
namespace {

using nlohmann::json;
using pcl::kss::ScanAnswer;
using pcl::kss::ScanTask;

/** A number; JSON has none that are not finite: "inf", "-inf" and "nan" stand for them.
 */
json
toJSON(double number)
{
  return std::isfinite(number) ? json(number) : json(std::to_string(number));
}

double
numberFrom(const json& value)
{
  return value.is_string() ? std::stod(value.get<std::string>()) : value.get<double>();
}

/** A matrix, column by column. */
template <typename Matrix>
json
toJSON(const Eigen::PlainObjectBase<Matrix>& matrix)
{
  json numbers = json::array();
  for (Eigen::Index i = 0; i < matrix.size(); ++i)
    numbers.push_back(toJSON(static_cast<double>(matrix.data()[i])));
  return numbers;
}

/** \param[in,out] matrix of the size that it is to have */
template <typename Matrix>
void
fromJSON(const json& numbers, Matrix& matrix)
{
  if (static_cast<std::size_t>(matrix.size()) != numbers.size())
    throw std::runtime_error("a job has come with other numbers than it should have");
  for (Eigen::Index i = 0; i < matrix.size(); ++i)
    matrix.data()[i] = static_cast<typename Matrix::Scalar>(numberFrom(numbers[i]));
}

json
toJSON(const pcl::kss::Failure& failure)
{
  return {static_cast<int>(failure.cause), failure.reason};
}

pcl::kss::Failure
failureFrom(const json& value)
{
  return {static_cast<pcl::kss::FailureCause>(value.at(0).get<int>()),
          value.at(1).get<std::string>()};
}

json
toJSON(const pcl::kss::ScanDescription& scan)
{
  json outline = json::array();
  for (const Eigen::Vector3f& point : scan.outline)
    outline.push_back(toJSON(point));
  return {{"centroid", toJSON(scan.centroid)},
          {"spread", toJSON(scan.spread)},
          {"outline", outline},
          {"spacing", toJSON(scan.spacing)},
          {"octave", scan.octave},
          {"wide_features", scan.wide_features},
          {"narrow_features", scan.narrow_features},
          {"far", scan.far_points},
          {"gap", toJSON(scan.gap)},
          {"reach", toJSON(scan.reach)}};
}

pcl::kss::ScanDescription
descriptionFrom(const json& value)
{
  pcl::kss::ScanDescription scan;
  fromJSON(value.at("centroid"), scan.centroid);
  fromJSON(value.at("spread"), scan.spread);
  for (const json& point : value.at("outline"))
    fromJSON(point, scan.outline.emplace_back());
  scan.spacing = numberFrom(value.at("spacing"));
  value.at("wide_features").get_to(scan.wide_features);
  value.at("narrow_features").get_to(scan.narrow_features);
  scan.gap = numberFrom(value.at("gap"));
  scan.reach = numberFrom(value.at("reach"));
  scan.octave = value.at("octave");
  scan.far_points = value.at("far");
  return scan;
}

json
toJSON(const pcl::kss::PairResult& pair)
{
  json poses = json::array();
  for (const auto& pose : pair.poses)
    poses.push_back({{"transformation", toJSON(pose.transformation)},
                     {"information", toJSON(pose.information)},
                     {"overlap",
                      {toJSON(pose.overlap.source), toJSON(pose.overlap.target),
                       toJSON(pose.overlap.score)}},
                     {"log_odds", toJSON(pose.log_odds)}});
  return {{"source", pair.source},
          {"target", pair.target},
          {"poses", poses},
          {"confidence", toJSON(pair.confidence)},
          {"ambiguous", pair.ambiguous},
          {"of_groups", pair.of_groups},
          {"failure", toJSON(pair.failure)}};
}

pcl::kss::PairResult
pairFrom(const json& value)
{
  pcl::kss::PairResult pair;
  pair.source = value.at("source");
  pair.target = value.at("target");
  for (const json& each : value.at("poses")) {
    pcl::kss::PairPose pose;
    fromJSON(each.at("transformation"), pose.transformation);
    fromJSON(each.at("information"), pose.information);
    pose.overlap = {numberFrom(each.at("overlap").at(0)),
                    numberFrom(each.at("overlap").at(1)),
                    numberFrom(each.at("overlap").at(2))};
    pose.log_odds = numberFrom(each.at("log_odds"));
    pair.poses.push_back(pose);
  }
  pair.confidence = numberFrom(value.at("confidence"));
  pair.ambiguous = value.at("ambiguous");
  pair.of_groups = value.at("of_groups");
  pair.failure = failureFrom(value.at("failure"));
  return pair;
}

json
toJSON(const std::vector<pcl::kss::PlacedScan>& group)
{
  json scans = json::array();
  for (const auto& placed : group)
    scans.push_back({{"scan", placed.scan}, {"pose", toJSON(placed.pose)}});
  return scans;
}

std::vector<pcl::kss::PlacedScan>
groupFrom(const json& value)
{
  std::vector<pcl::kss::PlacedScan> group(value.size());
  for (std::size_t i = 0; i < group.size(); ++i) {
    group[i].scan = value[i].at("scan");
    fromJSON(value[i].at("pose"), group[i].pose);
  }
  return group;
}

/** \note Reasons may quote what files hold, which need not be text. */
std::string
written(const json& value)
{
  return value.dump(-1, ' ', false, json::error_handler_t::replace);
}

} // namespace

std::string
jobOf(const ScanTask& task)
{
  json value = {{"kind", static_cast<int>(task.kind)},
                {"source", task.source},
                {"target", task.target}};
  if (task.kind == ScanTask::Kind::STEP)
    value["pose"] = toJSON(task.pose);
  if (task.kind == ScanTask::Kind::CONNECT) {
    value["source_group"] = toJSON(task.source_group);
    value["target_group"] = toJSON(task.target_group);
    value["estimates_scale"] = task.estimates_scale;
  }
  return written(value);
}

ScanTask
taskFrom(const std::string& job)
{
  const json value = json::parse(job);
  ScanTask task;
  task.kind = static_cast<ScanTask::Kind>(value.at("kind").get<int>());
  task.source = value.at("source");
  task.target = value.at("target");
  if (value.contains("pose"))
    fromJSON(value.at("pose"), task.pose);
  if (value.contains("source_group")) {
    task.source_group = groupFrom(value.at("source_group"));
    task.target_group = groupFrom(value.at("target_group"));
    task.estimates_scale = value.at("estimates_scale");
  }
  return task;
}

std::string
textOf(const ScanAnswer& answer, ScanTask::Kind kind)
{
  json value = {{"failure", toJSON(answer.failure)}};
  if (kind == ScanTask::Kind::DESCRIBE)
    value["description"] = toJSON(answer.description);
  else
    value["pair"] = toJSON(answer.pair);
  return written(value);
}

ScanAnswer
answerFrom(const std::string& text)
{
  const json value = json::parse(text);
  ScanAnswer answer;
  answer.failure = failureFrom(value.at("failure"));
  if (value.contains("description"))
    answer.description = descriptionFrom(value.at("description"));
  if (value.contains("pair"))
    answer.pair = pairFrom(value.at("pair"));
  return answer;
}

} // namespace tool
