/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "page.h"

#include "command_line/quantities.h"
#include "drawings.h"
#include "html.h"
#include "page_style.h"
#include "page_tables.h"
#include "picture/short_text.h"

#include <algorithm>

namespace tool {
namespace {

namespace kss = pcl::kss;

/** The graph of more scans is a blot. */
constexpr std::size_t MOST_DRAWN_SCANS = 400, MOST_CHIPS = 60;

std::string
section(const std::string& title, const std::string& content, const char* kind = "")
{
  return std::string("<section") +
         (*kind ? std::string(" class=\"") + kind + '"' : "") + "><h2>" + title +
         "</h2>\n" + content + "</section>\n";
}

std::string
fact(std::size_t number, const char* what)
{
  return "<li><b>" + groupedText(number) + "</b> " + what + "</li>";
}

std::string
header(const Model& model)
{
  const ModelCounts counts = countsOf(model.result);
  const bool is_one = counts.groups == 1 && counts.grouped == counts.scans;
  std::string text = std::string("<h1") + (is_one ? "" : " class=\"part\"") + '>' +
                     escaped(headlineOf(model.result)) + "</h1>\n";
  if (model.result.failure.cause != kss::FailureCause::NONE)
    text +=
        "<p><b>Not complete:</b> " + escaped(model.result.failure.reason) + "</p>\n";
  text += "<ul class=\"facts\">" +
          fact(counts.kept + counts.rejected + counts.refused + counts.failed,
               "pairs tried") +
          fact(counts.kept, "kept") + fact(counts.rejected, "rejected") +
          fact(counts.refused, "refused");
  if (counts.failed > 0)
    text += fact(counts.failed, "failed");
  return text + "</ul>\n";
}

std::string
figure(const SidePicture& picture, std::size_t group)
{
  return "<figure><img alt=\"Group " + std::to_string(group) + ", " + picture.side +
         "\" src=\"data:image/png;base64," + base64(picture.png) +
         "\"><div class=\"ruler\" style=\"width:" +
         fixedText(100.0 * picture.ruler_share, 1) + "%\"></div><figcaption>" +
         picture.side + "; the rule is " + shortText(picture.ruler) +
         " long</figcaption></figure>\n";
}

std::string
groupSections(const Model& model,
              const std::vector<std::string>& names,
              const std::vector<GroupShow>& shows)
{
  const auto groups = connectedGroups(model.result);
  std::string text;
  std::size_t without = 0;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    if (shows[i].pictures.empty()) {
      ++without;
      continue;
    }
    std::string content = "<div class=\"pictures\">\n";
    for (const auto& picture : shows[i].pictures)
      content += figure(picture, i + 1);
    content += "</div>\n<div class=\"chips\">";
    for (std::size_t s = 0; s < std::min(MOST_CHIPS, groups[i].size()); ++s)
      content += scanLabel(groups[i][s], names);
    if (groups[i].size() > MOST_CHIPS)
      content += "<span class=\"quiet\">and " +
                 groupedText(groups[i].size() - MOST_CHIPS) + " more</span>";
    const std::string file = "merged_" + std::to_string(i + 1) + ".ply";
    content += "</div>\n<p class=\"quiet\"><code>" + file +
               "</code>: " + groupedText(shows[i].points) + " points in the frame of " +
               escaped(names[groups[i].front()]) + "</p>\n";
    text += section("Group " + std::to_string(i + 1) + ": " +
                        counted(groups[i].size(), "scan"),
                    content);
  }
  if (without > 0)
    text += "<p class=\"quiet\">" + counted(without, "group") +
            (canDrawGroups() ? " without pictures, so that this page stays small."
                             : " without pictures: this program was built without "
                               "cairo, which draws them.") +
            "</p>\n";
  return text;
}

/** A line as the graph has it, and what it stands for. */
std::string
keyEntry(const char* kind, const char* meaning)
{
  return std::string("<span><svg viewBox=\"0 0 34 10\"><line class=\"") + kind +
         "\" x1=\"0\" y1=\"5\" x2=\"34\" y2=\"5\" stroke-width=\"3\"/></svg>" +
         meaning + "</span>";
}

std::string
graphSection(const Model& model, const std::vector<std::string>& names)
{
  if (model.result.scans.size() > MOST_DRAWN_SCANS)
    return section("The graph of pairs",
                   "<p class=\"quiet\">Not drawn: more than " +
                       std::to_string(MOST_DRAWN_SCANS) +
                       " scans. <code>graph.json</code> and <code>pairs.csv</code> "
                       "have all of it.</p>\n");
  return section(
      "The graph of pairs",
      drawGraph(model, names) + "<div class=\"key\">" + keyEntry("kept", "kept") +
          keyEntry("rejected", "rejected") +
          keyEntry("refused", "refused, but not out of the question") +
          "<span>the wider, the surer; point at a line or a scan for "
          "more</span></div>\n"
          "<p class=\"quiet\">Scans lie as they do in the frame of their group, on its "
          "two widest axes, moved apart where they would hide one another.</p>\n");
}

/** What fits at another scale. */
std::string
scalesSection(const Model& model, const std::vector<std::string>& names)
{
  std::string list;
  for (const std::string& link : linksInWords(model.result, names))
    list += "<li>" + escaped(link) + "</li>\n";
  return list.empty() ? ""
                      : section("What fits at another scale",
                                "<ul>" + list +
                                    "</ul>\n<p class=\"quiet\">"
                                    "<code>poses.json</code> has how, in "
                                    "<code>links</code>. To unite them, scale the "
                                    "files.</p>\n");
}

/** What helps where not all scans are in one group. */
std::string
adviceSection(const Model& model, const std::vector<std::string>& names)
{
  const ModelCounts counts = countsOf(model.result);
  const bool are_apart = counts.groups + counts.alone > 1;
  if (!are_apart)
    return "";
  std::string text =
      "<ul><li>Scans have to share a third of their surface or so: add a scan that "
      "overlaps two groups, an anchor between them.</li>\n"
      "<li>A scan alone may be symmetrical or without features, as a bare wall, a "
      "cylinder or a floor is: take one that shows an edge or a corner, too.</li>\n"
      "<li>Where the scans are levelled, say so with <code>--upright</code>: there are "
      "fewer poses to confuse.</li>\n"
      "<li>Register two scans of different groups by themselves, with a rough pose as "
      "<code>pcl_kss_icp --guess</code>: it says why it refuses them.</li>\n";
  const std::string misses = nearMisses(model, names);
  if (misses.empty())
    return section("What connects the groups", text + "</ul>\n", "advice");
  text += "<li>Look at the pairs below, which come nearest to connecting groups.</li>"
          "</ul>\n" +
          misses;
  return section("What connects the groups", text, "advice");
}

std::string
makingSection(const Model& model)
{
  std::string list = "<dl>";
  const auto add = [&](const std::string& name, const std::string& value) {
    list += "<dt>" + escaped(name) + "</dt><dd>" + escaped(value) + "</dd>\n";
  };
  add("made by", model.maker);
  for (const auto& [name, value] : model.settings)
    add(name, value);
  for (const auto& stage : model.result.seconds)
    add("time: " + stage.stage, shortText(stage.seconds) + " s");
  if (model.seconds > 0.0)
    add("time in all", shortText(model.seconds) + " s");
  return section("How it was made", list + "</dl>\n");
}

} // namespace

std::string
pageText(const Model& model,
         const std::vector<std::string>& names,
         const std::vector<GroupShow>& groups)
{
  std::string page = "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta "
                     "charset=\"utf-8\">\n<meta name=\"viewport\" "
                     "content=\"width=device-width, initial-scale=1\">\n<title>" +
                     escaped(headlineOf(model.result)) + "</title>\n<style>" +
                     PAGE_STYLE + "</style>\n</head>\n<body>\n<main>\n" +
                     header(model) + groupSections(model, names, groups) +
                     graphSection(model, names) + scalesSection(model, names) +
                     adviceSection(model, names);
  if (!model.result.pairs.empty())
    page += section("Pairs", pairTables(model, names) +
                                 "<h3>How sure the pairs are</h3>\n" +
                                 drawConfidences(model.result) +
                                 "<p class=\"quiet\">Pairs by the confidence of their "
                                 "likeliest pose, by itself.</p>\n");
  return page + section("Scans", scanTable(model, names)) + makingSection(model) +
         "</main>\n</body>\n</html>\n";
}

} // namespace tool
