/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "batch.h"
#include "batch_options.h"
#include "command_line/device_list.h"
#include "command_line/program.h"
#include "command_line/signals.h"
#include "crew/processes.h"
#include "pair_answer.h"

#include <memory>

/** \file
 * Registers many pairs of files, in threads and, under mpirun, in several processes.
 */

namespace {

using namespace tool;

constexpr const char* PROGRAM = "pcl_kss_icp_batch";

int
registerPairs(const BatchOptions& options, const Processes& processes)
{
  const JobHandler handler = [&](const std::string& job) {
    return answerTo(job, options.how);
  };
  if (!processes.leads()) {
    checkDevice(options.how.settings.device);
    processes.serve(handler, options.threads);
    return SUCCESS;
  }
  // before all that may be wrong here: its end dismisses the other processes
  const std::unique_ptr<Crew> crew = processes.crew(handler, options.threads);
  checkDevice(options.how.settings.device);
  Batch batch(options);
  batch.run(*crew);
  return batch.conclude() ? SUCCESS : NOT_ALL;
}

} // namespace

int
main(int argc, char** argv)
{
  return guarded(PROGRAM, [&] {
    const Processes processes;
    endCleanlyOnSignals(processes.leads() ? PROGRAM : nullptr);
    return runAsAsked<BatchOptions>(
        PROGRAM, processes.leads(), [&] { return parseBatchOptions(argc, argv); },
        batchHelpText,
        [&](const BatchOptions& options) { return registerPairs(options, processes); });
  });
}
