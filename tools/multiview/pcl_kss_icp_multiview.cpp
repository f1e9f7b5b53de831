/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "command_line/device_list.h"
#include "command_line/program.h"
#include "command_line/quantities.h"
#include "command_line/report.h"
#include "command_line/signals.h"
#include "crew/processes.h"
#include "folder.h"
#include "io/read_geometry.h"
#include "model.h"
#include "multiview_options.h"
#include "picture/short_text.h"
#include "scan_jobs.h"
#include "scan_journal.h"
#include "scan_loader.h"
#include "stage_progress.h"
#include "summary.h"

#include <nlohmann/json.hpp>

#include <chrono>
#include <filesystem>
#include <iostream>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

/** \file
 * Finds the poses of many scans, in threads and, under mpirun, in several processes.
 */

namespace {

using namespace tool;
namespace fs = std::filesystem;

constexpr const char* PROGRAM = "pcl_kss_icp_multiview";

/** What the work is about: what was done in another run is of no use. */
nlohmann::ordered_json
runOf(const MultiviewOptions& options)
{
  auto scans = nlohmann::ordered_json::array();
  for (const std::string& scan : options.scans)
    scans.push_back({scan, stateOf(scan)});
  return {{"version", PCL_KSS_ICP_VERSION},
          {"scans", scans},
          {"settings", settingsAsJSON(options.how)}};
}

/** What was set, for people: what decides about the results. */
std::vector<std::pair<std::string, std::string>>
settingsForPeople(const MultiviewOptions& options)
{
  std::vector<std::pair<std::string, std::string>> settings = {
      {"all-pairs", std::to_string(options.multiview.all_pairs)},
      {"partners", std::to_string(options.multiview.partners)},
      {"joint refinement", options.multiview.refine ? "yes" : "no"},
      {"free scale", options.multiview.scale_between_groups ? "yes" : "no"},
      {"spacing of merged points", shortText(options.spacing)}};
  nlohmann::ordered_json how = settingsAsJSON(options.how);
  for (const char* of_pairs :
       {"estimate_scale", "smallest_scale", "largest_scale", "threads"})
    how.erase(of_pairs); // many scans have one scale, each pair one thread
  for (auto setting = how.begin(); setting != how.end(); ++setting)
    if (!setting->is_null())
      settings.emplace_back(setting.key(), setting->is_string()
                                               ? setting->get<std::string>()
                                               : textOf(*setting, -1));
  return settings;
}

std::vector<std::pair<std::string, std::size_t>>
tasksDone(const ScanJobs& jobs)
{
  using Kind = pcl::kss::ScanTask::Kind;
  const std::map<Kind, std::string> names = {{Kind::DESCRIBE, "scans"},
                                             {Kind::TRY, "quick pairs"},
                                             {Kind::REGISTER, "thorough pairs"},
                                             {Kind::CONNECT, "pairs of groups"},
                                             {Kind::STEP, "steps of refinement"}};
  std::vector<std::pair<std::string, std::size_t>> tasks;
  for (const auto& [kind, number] : jobs.counts())
    tasks.emplace_back(names.at(kind), number);
  return tasks;
}

int
connect(const MultiviewOptions& options, Crew& crew)
{
  const auto start = std::chrono::steady_clock::now();
  prepareFolder(options.folder, options.scans);
  ScanJournal journal((fs::path(options.folder) / "journal.txt").string(),
                      runOf(options), options.restart);
  if (journal.size() > 0 && !options.quiet)
    std::cerr << counted(journal.size(), "piece") << " of work are done already\n";
  if (journal.numberDamaged() > 0 && !options.quiet)
    std::cerr << "warning: " << counted(journal.numberDamaged(), "line")
              << " of the journal cannot be read: that work is done again\n";

  StageProgress progress(options.quiet);
  const auto show = [&progress](const std::string& stage, double done) {
    progress.show(stage, done);
  };
  ScanJobs jobs(crew, journal);
  Model model;
  model.result =
      pcl::kss::connectScans(options.scans.size(), options.multiview, jobs, show);
  if (model.result.failure.cause != pcl::kss::FailureCause::NONE)
    throw std::runtime_error(model.result.failure.reason);
  model.files = options.scans;
  model.read = [&options](std::size_t number) {
    return readGeometry(options.scans[number]);
  };
  model.samples = options.how.samples;
  model.spacing = options.spacing;
  model.maker = std::string(PROGRAM) + " " PCL_KSS_ICP_VERSION;
  model.settings = settingsForPeople(options);
  model.tasks = tasksDone(jobs);
  const std::chrono::duration<double> seconds =
      std::chrono::steady_clock::now() - start;
  model.seconds = seconds.count();
  writeFolder(model, options.folder, [&](double done) { show("files", done); });
  progress.end();
  journal.remove();

  if (!options.quiet)
    std::cout << modelSummary(model, scanNames(model.files), options.folder);
  const ModelCounts counts = countsOf(model.result);
  return counts.groups == 1 && counts.alone == 0 && counts.unusable == 0 ? SUCCESS
                                                                         : NOT_ALL;
}

int
connectFiles(const MultiviewOptions& options, const Processes& processes)
{
  pcl::kss::ScanWorker worker(
      options.how.settings,
      [&](std::size_t number) {
        return cloudOf(readGeometry(options.scans.at(number)), options.how.samples);
      },
      options.room);
  if (!processes.leads()) {
    checkDevice(options.how.settings.device);
    processes.serve(handlerOf(worker), options.threads);
    return SUCCESS;
  }
  // before all that may be wrong here: its end dismisses the other processes
  const std::unique_ptr<Crew> crew = processes.crew(handlerOf(worker), options.threads);
  checkDevice(options.how.settings.device);
  return connect(options, *crew);
}

} // namespace

int
main(int argc, char** argv)
{
  return guarded(PROGRAM, [&] {
    const Processes processes;
    endCleanlyOnSignals(processes.leads() ? PROGRAM : nullptr);
    return runAsAsked<MultiviewOptions>(
        PROGRAM, processes.leads(), [&] { return parseMultiviewOptions(argc, argv); },
        multiviewHelpText,
        [&](const MultiviewOptions& options) {
          return connectFiles(options, processes);
        });
  });
}
