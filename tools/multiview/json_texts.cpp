/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "texts.h"

#include <nlohmann/json.hpp>

namespace tool {
namespace {

namespace kss = pcl::kss;
using JSON = nlohmann::ordered_json;

/** A matrix as its rows. */
JSON
toJSON(const Eigen::MatrixXd& matrix)
{
  auto rows = JSON::array();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    auto row = JSON::array();
    for (Eigen::Index j = 0; j < matrix.cols(); ++j)
      row.push_back(matrix(i, j));
    rows.push_back(std::move(row));
  }
  return rows;
}

/** A text, or null where it is empty. */
JSON
orNull(const std::string& text)
{
  return text.empty() ? JSON() : JSON(text);
}

JSON
toJSON(const kss::PairPose& pose)
{
  return {{"transformation", toJSON(Eigen::MatrixXd(pose.transformation))},
          {"information", toJSON(Eigen::MatrixXd(pose.information))},
          {"overlap", {pose.overlap.source, pose.overlap.target}},
          {"score", pose.overlap.score},
          {"log_odds", pose.log_odds}};
}

JSON
toJSON(const kss::GraphPair& pair, const std::vector<std::string>& files)
{
  const auto& result = pair.result;
  JSON json{
      {"source", result.source + 1},         {"target", result.target + 1},
      {"source_file", files[result.source]}, {"target_file", files[result.target]},
      {"verdict", wordOf(pair.verdict)},     {"reason", orNull(pair.reason)},
      {"confidence", result.confidence},     {"ambiguous", result.ambiguous},
      {"of_groups", result.of_groups},       {"loops", pair.loops},
      {"deviation", pair.deviation}};
  for (const char* key : {"transformation", "information", "overlap", "score"})
    json[key] = nullptr;
  if (const auto* pose = poseOf(pair))
    json.update(toJSON(*pose));
  json["poses"] = JSON::array();
  for (const auto& pose : result.poses)
    json["poses"].push_back(toJSON(pose));
  return json;
}

/** What all files of a model begin with. */
JSON
headOf(const Model& model)
{
  return {{"maker", model.maker},
          {"complete", model.result.failure.cause == kss::FailureCause::NONE},
          {"reason", orNull(model.result.failure.reason)}};
}

/** \note Names of files may hold anything, which JSON does not. */
std::string
written(const JSON& json)
{
  return json.dump(2, ' ', false, JSON::error_handler_t::replace) + '\n';
}

} // namespace

std::string
posesText(const Model& model, const std::vector<std::string>& names)
{
  JSON json = headOf(model);
  json["groups"] = JSON::array();
  for (std::size_t i = 0; i < model.result.groups.size(); ++i) {
    const auto& group = model.result.groups[i];
    const std::string number = std::to_string(i + 1);
    JSON entry{{"group", i + 1}, {"scans", JSON::array()}};
    for (const std::size_t scan : group)
      entry["scans"].push_back(scan + 1);
    if (group.size() > 1) {
      entry["merged"] = "merged_" + number + ".ply";
      entry["graph"] = "graph_" + number + ".g2o";
    }
    json["groups"].push_back(std::move(entry));
  }
  json["links"] = JSON::array();
  for (const pcl::kss::GroupLink& link : model.result.links)
    json["links"].push_back(
        {{"source", link.source + 1},
         {"target", link.target + 1},
         {"transformation", toJSON(Eigen::MatrixXd(link.transformation))},
         {"confidence", link.confidence},
         {"ambiguous", link.ambiguous}});
  json["scans"] = JSON::array();
  for (std::size_t i = 0; i < model.result.scans.size(); ++i) {
    const auto& scan = model.result.scans[i];
    JSON entry{{"scan", i + 1},        {"file", model.files[i]},
               {"group", nullptr},     {"transformation", nullptr},
               {"pose_file", nullptr}, {"reason", orNull(scan.failure.reason)}};
    if (isUsable(scan)) {
      entry["group"] = scan.group + 1;
      entry["transformation"] = toJSON(Eigen::MatrixXd(scan.transformation));
      entry["pose_file"] = "poses/" + names[i] + ".txt";
    }
    json["scans"].push_back(std::move(entry));
  }
  return written(json);
}

std::string
graphText(const Model& model)
{
  JSON json = headOf(model);
  json["pairs"] = JSON::array();
  for (const auto& pair : model.result.pairs)
    json["pairs"].push_back(toJSON(pair, model.files));
  return written(json);
}

std::string
timesText(const Model& model)
{
  JSON json{{"maker", model.maker}, {"stages", JSON::array()}};
  for (const auto& stage : model.result.seconds)
    json["stages"].push_back({{"stage", stage.stage}, {"seconds", stage.seconds}});
  json["tasks"] = JSON::object();
  for (const auto& [kind, number] : model.tasks)
    json["tasks"][kind] = number;
  json["seconds"] = model.seconds;
  return written(json);
}

} // namespace tool
