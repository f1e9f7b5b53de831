/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "drawings.h"

#include "command_line/quantities.h"
#include "graph_layout.h"
#include "html.h"
#include "picture/short_text.h"

#include <algorithm>
#include <cmath>

namespace tool {
namespace {

namespace kss = pcl::kss;

/** Refused pairs are drawn from this confidence on, and so many at most of all pairs.
 */
constexpr double NOT_OUT_OF_QUESTION = 0.05;
constexpr std::size_t MOST_EDGES = 3000;

/** What is said of a pair where somebody points at it. */
std::string
wordsOn(const kss::GraphPair& pair, const std::vector<std::string>& names)
{
  std::string words = names[pair.result.source] + " on " + names[pair.result.target] +
                      ": " + wordOf(pair.verdict) + ", confidence " +
                      fixedText(pair.result.confidence, 2);
  if (const auto* pose = poseOf(pair))
    words += ", overlap " + percent(pose->overlap.source) + " and " +
             percent(pose->overlap.target);
  words += ", " + counted(pair.loops, "loop") + " agree" + (pair.loops == 1 ? "s" : "");
  return pair.reason.empty() ? words : words + ". " + pair.reason;
}

/** Those that are drawn, the most important last, on top of the others. */
std::vector<const kss::GraphPair*>
drawnPairs(const kss::Multiview& result)
{
  std::vector<const kss::GraphPair*> pairs;
  for (const auto& pair : result.pairs)
    if (pair.verdict == kss::PairVerdict::KEPT ||
        pair.verdict == kss::PairVerdict::REJECTED ||
        (pair.verdict == kss::PairVerdict::REFUSED &&
         pair.result.confidence >= NOT_OUT_OF_QUESTION))
      pairs.push_back(&pair);
  std::stable_sort(pairs.begin(), pairs.end(), [](const auto* a, const auto* b) {
    return a->verdict != b->verdict ? a->verdict < b->verdict
                                    : a->result.confidence > b->result.confidence;
  });
  if (pairs.size() > MOST_EDGES)
    pairs.resize(MOST_EDGES);
  std::reverse(pairs.begin(), pairs.end());
  return pairs;
}

} // namespace

std::string
drawGraph(const Model& model, const std::vector<std::string>& names)
{
  constexpr double WIDTH = 960.0;
  const GraphLayout layout = layOut(model, WIDTH);
  std::string svg = "<svg class=\"graph\" viewBox=\"-1 -1 " +
                    fixedText(layout.width + 2.0, 0) + ' ' +
                    fixedText(layout.height + 2.0, 0) +
                    "\" role=\"img\" aria-label=\"The graph of pairs\">\n";
  for (const auto& cell : layout.cells) {
    svg += "<rect class=\"cell\" x=\"" + fixedText(cell.x, 1) + "\" y=\"" +
           fixedText(cell.y, 1) + "\" width=\"" + fixedText(cell.width, 1) +
           "\" height=\"" + fixedText(cell.height, 1) + "\" rx=\"10\"/>\n";
    if (!cell.title.empty())
      svg += "<text class=\"cell-title\" x=\"" + fixedText(cell.x + 10.0, 1) +
             "\" y=\"" + fixedText(cell.y + 19.0, 1) + "\">" + cell.title + "</text>\n";
  }
  const auto pairs = drawnPairs(model.result);
  // the more lines, the finer they are
  const double fine =
      1.0 / std::max(1.0, std::sqrt(static_cast<double>(pairs.size()) / 60.0));
  for (const auto* pair : pairs) {
    const auto& from = layout.places[pair->result.source];
    const auto& to = layout.places[pair->result.target];
    svg += std::string("<line class=\"") + wordOf(pair->verdict) + "\" x1=\"" +
           fixedText(from.x(), 1) + "\" y1=\"" + fixedText(from.y(), 1) + "\" x2=\"" +
           fixedText(to.x(), 1) + "\" y2=\"" + fixedText(to.y(), 1) +
           "\" stroke-width=\"" +
           fixedText(std::max(0.6, fine * (1.0 + 3.5 * pair->result.confidence)), 1) +
           "\"><title>" + escaped(wordsOn(*pair, names)) + "</title></line>\n";
  }
  for (std::size_t i = 0; i < layout.places.size(); ++i) {
    const auto& place = layout.places[i];
    const auto& scan = model.result.scans[i];
    const std::string title =
        std::to_string(i + 1) + ": " + model.files[i] +
        (scan.failure.reason.empty() ? "" : ". " + scan.failure.reason);
    const std::string x = fixedText(place.x(), 1);
    svg += std::string("<g class=\"") + (isUsable(scan) ? "node" : "node unusable") +
           "\"><title>" + escaped(title) + "</title><circle cx=\"" + x + "\" cy=\"" +
           fixedText(place.y(), 1) + "\" r=\"" + fixedText(layout.radius, 1) +
           "\" fill=\"" + cssColour(colourOfNumber(i)) + "\"/>";
    if (layout.radius > 6.0)
      svg += "<text x=\"" + x + "\" y=\"" + fixedText(place.y() + 3.6, 1) + "\">" +
             std::to_string(i + 1) + "</text>";
    svg += "</g>\n";
  }
  return svg + "</svg>\n";
}

std::string
drawConfidences(const kss::Multiview& result)
{
  constexpr int BINS = 20, VERDICTS = 4;
  constexpr double WIDTH = 460.0, HEIGHT = 130.0, TOP = 16.0, STEP = WIDTH / BINS;
  std::size_t number[BINS][VERDICTS] = {}, sums[BINS] = {}, most = 1;
  for (const auto& pair : result.pairs) {
    if (pair.verdict == kss::PairVerdict::FAILED)
      continue; // has none
    const double share = std::min(std::max(pair.result.confidence, 0.0), 1.0);
    const int bin = std::min(static_cast<int>(BINS * share), BINS - 1);
    ++number[bin][static_cast<int>(pair.verdict)];
    most = std::max(most, ++sums[bin]);
  }
  std::string svg = "<svg class=\"histogram\" viewBox=\"-4 0 468 168\" role=\"img\" "
                    "aria-label=\"Confidences of the pairs\">\n";
  for (int bin = 0; bin < BINS; ++bin) {
    double y = TOP + HEIGHT;
    for (int verdict = 0; verdict < VERDICTS; ++verdict) {
      if (number[bin][verdict] == 0)
        continue;
      const double height = std::max(2.0, HEIGHT * number[bin][verdict] / most);
      y -= height;
      svg += std::string("<rect class=\"") +
             wordOf(static_cast<kss::PairVerdict>(verdict)) + "\" x=\"" +
             fixedText(STEP * bin + 1.5, 1) + "\" y=\"" + fixedText(y, 1) +
             "\" width=\"" + fixedText(STEP - 3.0, 1) + "\" height=\"" +
             fixedText(height, 1) + "\"/>";
    }
    if (sums[bin] > 0)
      svg += "<text x=\"" + fixedText(STEP * (bin + 0.5), 1) + "\" y=\"" +
             fixedText(y - 4.0, 1) + "\">" + std::to_string(sums[bin]) + "</text>\n";
  }
  svg += "<line class=\"axis\" x1=\"0\" y1=\"146.5\" x2=\"460\" y2=\"146.5\"/>";
  for (const char* label : {"0", "0.25", "0.5", "0.75", "1"})
    svg += "<text x=\"" + fixedText(WIDTH * std::stod(label), 0) + "\" y=\"162\">" +
           label + "</text>";
  return svg + "\n</svg>\n";
}

} // namespace tool
