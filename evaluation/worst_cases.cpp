/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "worst_cases.h"

#include "cases.h"

#include <pcl/io/ply_io.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <tuple>
#include <vector>

namespace evaluation {
namespace {

constexpr std::size_t most_cases = 6;

const char* const judged = "KSS-ICP";

/** \brief The runs of KSS-ICP as shipped that are in the log, the worst ones first. */
std::vector<Run>
worstRuns(const Plan& plan, const Protocol& protocol, const RunLog& log)
{
  std::vector<Run> runs;
  for (const auto& run : runsOfTables(plan, protocol))
    if (run.method.name == judged && !run.scale_given && log.find(run))
      runs.push_back(run);
  const auto badness = [&](const Run& run) {
    const Record& record = *log.find(run);
    return std::make_tuple(!record.at("solved").get<bool>(),
                           record.at("tre").get<double>());
  };
  std::stable_sort(runs.begin(), runs.end(),
                   [&](const Run& a, const Run& b) { return badness(a) > badness(b); });
  runs.resize(std::min(runs.size(), most_cases));
  return runs;
}

void
write(const Run& run, const Case& work, const Record& record, const std::string& folder)
{
  std::filesystem::create_directories(folder);
  pcl::io::savePLYFileASCII(folder + "/source.ply", *work.source);
  pcl::io::savePLYFileASCII(folder + "/target.ply", *work.target);
  Record meta = keyOf(run);
  for (const char* name : {"solved", "claimed", "rotation_deg", "scale", "tre", "pose"})
    if (record.contains(name))
      meta[name] = record.at(name);
  meta["truth"] = numbersOf(work.truth);
  std::ofstream(folder + "/meta.json") << meta.dump(2) << '\n';
}

} // namespace

void
writeWorstCases(const Plan& plan,
                const Protocol& protocol,
                const RunLog& log,
                const std::string& folder)
{
  std::filesystem::remove_all(folder);
  Cases cases(plan.models, protocol);
  std::size_t rank = 0;
  for (const auto& run : worstRuns(plan, protocol, log)) {
    std::string name = std::to_string(++rank) + '-' + run.model + '-' +
                       run.condition.name + '-' + std::to_string(run.repetition);
    std::replace(name.begin(), name.end(), '/', '_');
    write(run, *cases.of(run), *log.find(run), folder + '/' + name);
  }
}

} // namespace evaluation
