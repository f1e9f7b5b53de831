/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "batch.h"
#include "batch_options.h"
#include "command_line/device_list.h"
#include "command_line/signals.h"
#include "crew/processes.h"
#include "pair_answer.h"

#include <pcl/console/print.h>

#include <exception>
#include <iostream>
#include <new>
#include <optional>

/** \file
 * Registers many pairs of files, in threads and, under mpirun, in several processes.
 */

namespace {

using namespace tool;

constexpr int SUCCESS = 0, NOT_ALL_REGISTERED = 1, FAILED = 2;

void
complain(const std::string& message)
{
  std::cerr << "pcl_kss_icp_batch: " << message << '\n';
}

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
  return batch.conclude() ? SUCCESS : NOT_ALL_REGISTERED;
}

int
run(int argc, char** argv, const Processes& processes)
{
  std::optional<BatchOptions> options;
  try {
    options = parseBatchOptions(argc, argv);
  }
  catch (const std::exception& problem) {
    if (processes.leads()) // one speaks for all
      complain(problem.what());
    return FAILED;
  }
  if (options->action == BatchOptions::Action::REGISTER)
    return registerPairs(*options, processes);
  if (processes.leads())
    std::cout << (options->action == BatchOptions::Action::SHOW_HELP
                      ? batchHelpText()
                      : "pcl_kss_icp_batch " PCL_KSS_ICP_VERSION "\n");
  return SUCCESS;
}

} // namespace

int
main(int argc, char** argv)
{
  // All that PCL has to say about files and registrations is said in the results.
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  try {
    const Processes processes;
    endCleanlyOnSignals(processes.leads() ? "pcl_kss_icp_batch" : nullptr);
    const int status = run(argc, argv, processes);
    if (!std::cout.flush())
      throw std::runtime_error("cannot write to standard output");
    return status;
  }
  catch (const std::bad_alloc&) {
    complain("needs more memory than there is");
  }
  catch (const std::exception& problem) {
    complain(problem.what());
  }
  return FAILED;
}
