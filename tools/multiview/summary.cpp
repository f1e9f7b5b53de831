/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "summary.h"

#include "command_line/quantities.h"
#include "command_line/wrapped.h"

#include <algorithm>

namespace tool {
namespace {

namespace kss = pcl::kss;

constexpr std::size_t WIDTH = 79, INDENT = 11;

/** A line with what it is about, and more lines as far as it is long. */
std::string
lineOn(const std::string& what, const std::string& text)
{
  return what + std::string(INDENT - what.size(), ' ') + wrapped(text, WIDTH, INDENT) +
         '\n';
}

/** Some names, and how many more there are. */
std::string
listed(const std::vector<std::size_t>& scans, const std::vector<std::string>& names)
{
  constexpr std::size_t most = 12;
  std::string text;
  for (std::size_t i = 0; i < std::min(most, scans.size()); ++i)
    text += (i == 0 ? "" : ", ") + names[scans[i]];
  return scans.size() > most
             ? text + " and " + std::to_string(scans.size() - most) + " more"
             : text;
}

} // namespace

std::string
modelSummary(const Model& model,
             const std::vector<std::string>& names,
             const std::string& folder)
{
  constexpr std::size_t most_groups = 10;
  const auto& result = model.result;
  const ModelCounts counts = countsOf(result);
  std::string text = headlineOf(result) + '\n';
  if (result.failure.cause != kss::FailureCause::NONE)
    text += lineOn("Stopped:", result.failure.reason);
  const auto groups = connectedGroups(result);
  for (std::size_t i = 0; i < std::min(most_groups, groups.size()); ++i)
    text += lineOn("Group " + std::to_string(i + 1) + ':', listed(groups[i], names));
  if (groups.size() > most_groups)
    text += lineOn("", "and " + counted(groups.size() - most_groups, "more group"));
  std::vector<std::size_t> alone, unusable;
  for (std::size_t i = 0; i < result.scans.size(); ++i)
    if (!isUsable(result.scans[i]))
      unusable.push_back(i);
    else if (result.groups[result.scans[i].group].size() == 1)
      alone.push_back(i);
  if (!alone.empty())
    text += lineOn("Alone:", listed(alone, names));
  const auto links = linksInWords(result, names);
  for (std::size_t i = 0; i < std::min(most_groups, links.size()); ++i)
    text += lineOn("Scales:", links[i]);
  if (links.size() > most_groups)
    text += lineOn("", "and " + std::to_string(links.size() - most_groups) + " more");
  for (std::size_t i = 0; i < std::min(most_groups, unusable.size()); ++i)
    text += lineOn("Not used:", names[unusable[i]] + ": " +
                                    result.scans[unusable[i]].failure.reason);
  if (unusable.size() > most_groups)
    text += lineOn("", "and " + counted(unusable.size() - most_groups, "more scan"));
  std::string pairs = std::to_string(counts.kept) + " kept, " +
                      std::to_string(counts.rejected) + " rejected, " +
                      std::to_string(counts.refused) + " refused";
  if (counts.failed > 0)
    pairs += ", " + std::to_string(counts.failed) + " failed";
  return text + lineOn("Pairs:", pairs) +
         lineOn("Files:", folder +
                              "/index.html shows it; poses.json and poses/ have "
                              "the poses" +
                              (groups.empty() ? "" : ", merged_1.ply the points"));
}

} // namespace tool
