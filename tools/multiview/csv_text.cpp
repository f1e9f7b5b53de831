/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "texts.h"

#include <charconv>

namespace tool {
namespace {

/** A number with as many digits as it takes to read the same one. */
std::string
digitsOf(double number)
{
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof digits, number).ptr};
}

/** A text between quotes, which may hold commas and line breaks. */
std::string
quoted(const std::string& text)
{
  std::string quoted = "\"";
  for (const char letter : text)
    quoted += letter == '"' ? std::string("\"\"") : std::string(1, letter);
  return quoted + '"';
}

} // namespace

std::string
pairsText(const Model& model)
{
  std::string text = "source,target,source_file,target_file,verdict,confidence,"
                     "ambiguous,loops,deviation,overlap_source,overlap_target,score,"
                     "reason,of_groups,log_odds\n";
  for (const auto& pair : model.result.pairs) {
    const auto& result = pair.result;
    std::string overlap = ",,", log_odds;
    if (const auto* pose = poseOf(pair)) {
      overlap = digitsOf(pose->overlap.source) + ',' + digitsOf(pose->overlap.target) +
                ',' + digitsOf(pose->overlap.score);
      log_odds = digitsOf(pose->log_odds);
    }
    text += std::to_string(result.source + 1) + ',' +
            std::to_string(result.target + 1) + ',' +
            quoted(model.files[result.source]) + ',' +
            quoted(model.files[result.target]) + ',' + wordOf(pair.verdict) + ',' +
            digitsOf(result.confidence) + ',' + (result.ambiguous ? "true" : "false") +
            ',' + std::to_string(pair.loops) + ',' + digitsOf(pair.deviation) + ',' +
            overlap + ',' + quoted(pair.reason) + ',' +
            (result.of_groups ? "true" : "false") + ',' + log_odds + '\n';
  }
  return text;
}

} // namespace tool
