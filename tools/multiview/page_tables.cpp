/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "page_tables.h"

#include "command_line/quantities.h"
#include "html.h"
#include "picture/short_text.h"

#include <algorithm>

namespace tool {
namespace {

namespace kss = pcl::kss;

/** More rows are left out. */
constexpr std::size_t MOST_SCANS = 500, MOST_PAIRS = 200, MOST_MISSES = 8;

std::string
cell(const std::string& content, const std::string& kind = "")
{
  return "<td" + (kind.empty() ? "" : " class=\"" + kind + '"') + '>' + content +
         "</td>";
}

/** A row that says what has been left out. */
std::string
leftOut(std::size_t number, const std::string& thing, const char* file, int columns)
{
  return "<tr><td class=\"more\" colspan=\"" + std::to_string(columns) + "\">and " +
         counted(number, "more " + thing) + ", which " + file + " lists</td></tr>\n";
}

std::string
barOf(double share)
{
  const double width = 100.0 * std::min(std::max(share, 0.0), 1.0);
  return "<td class=\"number bar\" style=\"--share:" + fixedText(width, 0) + "%\">" +
         fixedText(share, 2) + "</td>";
}

std::string
headOf(std::initializer_list<const char*> columns)
{
  std::string row = "<thead><tr>";
  for (const char* column : columns) {
    const bool is_number = column[0] == '#';
    row += std::string(is_number ? "<th class=\"number\">" : "<th>") +
           (is_number ? column + 1 : column) + "</th>";
  }
  return row + "</tr></thead>\n";
}

/** The pairs that a function chooses, the surest first. */
template <typename Function>
std::vector<const kss::GraphPair*>
surestPairs(const kss::Multiview& result, Function&& chosen)
{
  std::vector<const kss::GraphPair*> pairs;
  for (const auto& pair : result.pairs)
    if (chosen(pair))
      pairs.push_back(&pair);
  std::stable_sort(pairs.begin(), pairs.end(), [](const auto* a, const auto* b) {
    return a->result.confidence > b->result.confidence;
  });
  return pairs;
}

std::string
rowOf(const kss::GraphPair& pair, const std::vector<std::string>& names)
{
  const auto* pose = poseOf(pair);
  const bool is_kept = pair.verdict == kss::PairVerdict::KEPT;
  std::string words = pair.reason;
  if (is_kept && words.empty())
    words = pair.loops > 0 ? "agrees with other pairs" : "";
  if (pair.result.ambiguous)
    words += std::string(words.empty() ? "" : "; ") + "another pose fits about as well";
  return "<tr>" + cell(scanLabel(pair.result.source, names)) +
         cell(scanLabel(pair.result.target, names)) + barOf(pair.result.confidence) +
         cell(pose ? percent(pose->overlap.source) : "", "number") +
         cell(pose ? percent(pose->overlap.target) : "", "number") +
         cell(is_kept || pair.deviation > 0.0 ? shortText(pair.deviation) : "",
              "number") +
         cell(std::to_string(pair.loops), "number") + cell(escaped(words), "words") +
         "</tr>\n";
}

std::string
tableOf(const std::vector<const kss::GraphPair*>& pairs,
        const std::vector<std::string>& names,
        std::size_t most)
{
  std::string table =
      "<div class=\"scroll\"><table>" +
      headOf({"Source", "Target", "#Confidence", "#Source covered", "#Target covered",
              "#Deviation", "#Loops", "What speaks for or against it"}) +
      "<tbody>\n";
  for (std::size_t i = 0; i < std::min(most, pairs.size()); ++i)
    table += rowOf(*pairs[i], names);
  if (pairs.size() > most)
    table += leftOut(pairs.size() - most, "pair", "pairs.csv", 8);
  return table + "</tbody></table></div>\n";
}

const char*
meaningOf(kss::PairVerdict verdict)
{
  switch (verdict) {
  case kss::PairVerdict::KEPT:
    return "the poses rest on them";
  case kss::PairVerdict::REJECTED:
    return "they fit by themselves, but not with the others";
  case kss::PairVerdict::REFUSED:
    return "the scans do not lie on each other at any pose that was found";
  case kss::PairVerdict::FAILED:
    break;
  }
  return "they could not be tried";
}

} // namespace

std::string
scanLabel(std::size_t scan, const std::vector<std::string>& names)
{
  return "<span class=\"scan\"><span class=\"chip\" style=\"background:" +
         cssColour(colourOfNumber(scan)) + "\">" + std::to_string(scan + 1) +
         "</span>" + escaped(names[scan]) + "</span>";
}

std::string
scanTable(const Model& model, const std::vector<std::string>& names)
{
  std::vector<std::size_t> kept(names.size(), 0), tried(names.size(), 0);
  for (const auto& pair : model.result.pairs)
    for (const std::size_t scan : {pair.result.source, pair.result.target}) {
      ++tried[scan];
      kept[scan] += pair.verdict == kss::PairVerdict::KEPT ? 1 : 0;
    }
  std::string table =
      "<div class=\"scroll\"><table>" +
      headOf({"Scan", "File", "#Group", "#Kept pairs", "#Tried", "Pose", "Remarks"}) +
      "<tbody>\n";
  const auto& result = model.result;
  for (std::size_t i = 0; i < std::min(MOST_SCANS, names.size()); ++i) {
    const auto& scan = result.scans[i];
    const bool is_alone =
        scan.group >= result.groups.size() || result.groups[scan.group].size() == 1;
    const std::string file = "poses/" + names[i] + ".txt";
    const std::string remark = !isUsable(scan) ? scan.failure.reason
                               : is_alone      ? "nothing connects it"
                                               : "";
    table += std::string("<tr") + (is_alone ? " class=\"alone\">" : ">") +
             cell(scanLabel(i, names)) + cell(escaped(model.files[i]), "file") +
             cell(isUsable(scan) ? std::to_string(scan.group + 1) : "–", "number") +
             cell(std::to_string(kept[i]), "number") +
             cell(std::to_string(tried[i]), "number") +
             cell(isUsable(scan) ? escaped(file) : "–", "file") +
             cell(escaped(remark), "words") + "</tr>\n";
  }
  if (names.size() > MOST_SCANS)
    table += leftOut(names.size() - MOST_SCANS, "scan", "poses.json", 7);
  return table + "</tbody></table></div>\n";
}

std::string
pairTables(const Model& model, const std::vector<std::string>& names)
{
  std::string tables;
  for (const auto verdict : {kss::PairVerdict::KEPT, kss::PairVerdict::REJECTED,
                             kss::PairVerdict::REFUSED, kss::PairVerdict::FAILED}) {
    const auto pairs = surestPairs(model.result, [&](const kss::GraphPair& pair) {
      return pair.verdict == verdict;
    });
    if (pairs.empty())
      continue;
    const bool is_open = verdict == kss::PairVerdict::REJECTED ||
                         (verdict == kss::PairVerdict::KEPT && pairs.size() <= 60);
    tables += std::string("<details") + (is_open ? " open" : "") +
              "><summary><span class=\"verdict " + wordOf(verdict) + "\">" +
              groupedText(pairs.size()) + ' ' + wordOf(verdict) +
              "</span> <span class=\"quiet\">" + meaningOf(verdict) +
              "</span></summary>\n" + tableOf(pairs, names, MOST_PAIRS) +
              "</details>\n";
  }
  return tables;
}

std::string
nearMisses(const Model& model, const std::vector<std::string>& names)
{
  const auto& scans = model.result.scans;
  const auto pairs = surestPairs(model.result, [&](const kss::GraphPair& pair) {
    return pair.verdict != kss::PairVerdict::KEPT && !pair.result.poses.empty() &&
           scans[pair.result.source].group != scans[pair.result.target].group;
  });
  return pairs.empty() ? "" : tableOf(pairs, names, MOST_MISSES);
}

} // namespace tool
