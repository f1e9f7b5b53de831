/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "model.h"

#include "command_line/quantities.h"
#include "picture/short_text.h"

#include <Eigen/LU>

#include <cmath>
#include <filesystem>
#include <map>
#include <set>

namespace tool {

namespace kss = pcl::kss;

bool
isUsable(const kss::ScanPose& scan)
{
  return scan.failure.cause == kss::FailureCause::NONE;
}

ModelCounts
countsOf(const kss::Multiview& result)
{
  ModelCounts counts;
  counts.scans = result.scans.size();
  for (const auto& group : result.groups)
    if (group.size() > 1) {
      ++counts.groups;
      counts.grouped += group.size();
    }
  for (const auto& scan : result.scans)
    counts.unusable += isUsable(scan) ? 0 : 1;
  counts.alone = counts.scans - counts.unusable - counts.grouped;
  for (const auto& pair : result.pairs)
    switch (pair.verdict) {
    case kss::PairVerdict::KEPT:
      ++counts.kept;
      break;
    case kss::PairVerdict::REJECTED:
      ++counts.rejected;
      break;
    case kss::PairVerdict::REFUSED:
      ++counts.refused;
      break;
    case kss::PairVerdict::FAILED:
      ++counts.failed;
      break;
    }
  return counts;
}

std::vector<std::vector<std::size_t>>
connectedGroups(const kss::Multiview& result)
{
  std::vector<std::vector<std::size_t>> groups;
  for (const auto& group : result.groups)
    if (group.size() > 1)
      groups.push_back(group);
  return groups;
}

std::vector<std::string>
scanNames(const std::vector<std::string>& files)
{
  namespace fs = std::filesystem;
  constexpr std::size_t longest = 200; // names of files have 255 bytes
  const std::vector<std::function<std::string(std::size_t)>> ways{
      [&](std::size_t i) { return fs::path(files[i]).stem().string(); },
      [&](std::size_t i) {
        const fs::path path(files[i]);
        return path.parent_path().filename().string() + '_' + path.stem().string();
      },
      [&](std::size_t i) {
        return fs::path(files[i]).stem().string().substr(0, longest) + '_' +
               std::to_string(i + 1);
      }};
  std::vector<std::string> names(files.size());
  std::set<std::string> taken;
  for (const auto& way : ways) {
    std::map<std::string, std::size_t> times;
    for (std::size_t i = 0; i < files.size(); ++i)
      if (names[i].empty())
        ++times[way(i)];
    for (std::size_t i = 0; i < files.size(); ++i)
      if (std::string name = names[i].empty() ? way(i) : std::string();
          !name.empty() && name.size() <= longest + 8 && times[name] == 1 &&
          taken.insert(name).second)
        names[i] = std::move(name);
  }
  for (std::size_t i = 0; i < files.size(); ++i)
    for (std::string name = "scan_" + std::to_string(i + 1); names[i].empty();
         name += '_')
      if (taken.insert(name).second)
        names[i] = name;
  return names;
}

const kss::PairPose*
poseOf(const kss::GraphPair& pair)
{
  const auto& poses = pair.result.poses;
  if (poses.empty())
    return nullptr;
  const bool is_chosen =
      pair.verdict == kss::PairVerdict::KEPT && pair.pose < poses.size();
  return &poses[is_chosen ? pair.pose : 0];
}

const char*
wordOf(kss::PairVerdict verdict)
{
  switch (verdict) {
  case kss::PairVerdict::KEPT:
    return "kept";
  case kss::PairVerdict::REJECTED:
    return "rejected";
  case kss::PairVerdict::REFUSED:
    return "refused";
  case kss::PairVerdict::FAILED:
    break;
  }
  return "failed";
}

std::vector<std::string>
linksInWords(const kss::Multiview& result, const std::vector<std::string>& names)
{
  const auto nameOf = [&](std::size_t group) {
    const auto& scans = result.groups[group];
    return scans.size() == 1 ? names[scans.front()]
                             : "group " + std::to_string(group + 1);
  };
  std::vector<std::string> words;
  for (const kss::GroupLink& link : result.links) {
    const Eigen::Matrix4d transformation = link.transformation;
    const double scale = std::cbrt(transformation.topLeftCorner<3, 3>().determinant());
    words.push_back(nameOf(link.source) + " fits " + nameOf(link.target) + " at " +
                    shortText(scale) + " times its size, with confidence " +
                    shortText(link.confidence) +
                    (link.ambiguous ? "; other poses fit as well" : ""));
  }
  return words;
}

std::string
headlineOf(const kss::Multiview& result)
{
  const ModelCounts counts = countsOf(result);
  const std::string text = counted(counts.scans, "scan");
  const std::string groups =
      counts.groups == 1 ? "one group" : counted(counts.groups, "group");
  if (counts.groups > 0 && counts.grouped == counts.scans)
    return text + (counts.groups == 1 ? ": " : " in ") + groups;
  std::string parts;
  const auto add = [&](std::size_t number, const std::string& what) {
    if (number > 0)
      parts += (parts.empty() ? "" : ", ") + std::to_string(number) + ' ' + what;
  };
  if (counts.groups == 0 && counts.alone > 1)
    parts = "none lies on another";
  else {
    add(counts.grouped, "in " + groups);
    add(counts.alone, "alone");
  }
  add(counts.unusable, "could not be used");
  return parts.empty() ? text : text + ": " + parts;
}

} // namespace tool
