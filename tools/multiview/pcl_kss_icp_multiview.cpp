/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "command_line/device_list.h"
#include "command_line/program.h"
#include "command_line/report.h"
#include "command_line/signals.h"
#include "crew/processes.h"
#include "folder.h"
#include "io/read_geometry.h"
#include "model.h"
#include "multiview_options.h"
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

/** What the work is about: what was done for another subject is of no use. */
std::string
subjectOf(const MultiviewOptions& options)
{
  nlohmann::ordered_json files;
  for (const std::string& scan : options.scans) {
    std::error_code error; // a file that is not there has no size and no time
    files.push_back({scan, fs::file_size(scan, error),
                     fs::last_write_time(scan, error).time_since_epoch().count()});
  }
  return textOf({{"version", PCL_KSS_ICP_VERSION},
                 {"files", files},
                 {"settings", settingsAsJSON(options.how)}},
                -1);
}

/** What was set, for people. */
std::vector<std::pair<std::string, std::string>>
settingsForPeople(const MultiviewOptions& options)
{
  std::vector<std::pair<std::string, std::string>> settings = {
      {"all-pairs", std::to_string(options.multiview.all_pairs)},
      {"partners", std::to_string(options.multiview.partners)}};
  const nlohmann::ordered_json how = settingsAsJSON(options.how);
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
  prepareFolder(options.folder);
  const std::string journal_path = (fs::path(options.folder) / "journal.txt").string();
  if (options.restart)
    fs::remove(journal_path);
  ScanJournal journal(journal_path, subjectOf(options));
  if (journal.size() > 0 && !options.quiet)
    std::cerr << journal.size() << " pieces of work are done already\n";

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
  journal.close();

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
