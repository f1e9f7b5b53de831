/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "execution.h"
#include "manifest.h"
#include "models.h"
#include "options.h"
#include "plan.h"
#include "run_log.h"
#include "worst_cases.h"

#include <boost/algorithm/string/join.hpp>
#include <boost/process/args.hpp>
#include <boost/process/exe.hpp>
#include <boost/process/system.hpp>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <thread>

namespace evaluation {
namespace {

/** \brief Tables, plots and pictures are made in Python. */
int
report(const std::string& out)
{
  const char* const python = PCL_KSS_ICP_PYTHON;
  const char* const script = PCL_KSS_ICP_REPORT;
  std::error_code problem;
  const int result = boost::process::system(
      boost::process::exe = python, boost::process::args = {script, out}, problem);
  if (problem || result != 0) {
    std::cerr << "pcl_kss_icp_evaluate: all runs are in " << out
              << "/runs.jsonl, but no tables were made; mend what is said above, then: "
              << python << ' ' << script << ' ' << out << '\n';
    return 1;
  }
  std::cout << out << "/report.md\n";
  return 0;
}

ModelFolder
readFolder(const std::string& folder)
{
  const ModelFolder result = modelsOf(folder);
  for (const auto& file : result.skipped)
    std::cerr << file.path << ": " << file.reason << "; passed over\n";
  if (result.models.empty())
    throw std::runtime_error(folder +
                             ": holds no model that can be read (OFF, PLY, OBJ, "
                             "STL or PCD)");
  return result;
}

/** \brief What is written must not be read as a model the next time. */
void
refuseOutAmongModels(const Options& options)
{
  const auto models = std::filesystem::weakly_canonical(options.models);
  const auto out = std::filesystem::weakly_canonical(options.out);
  const auto ends = std::mismatch(models.begin(), models.end(), out.begin(), out.end());
  if (ends.first == models.end())
    throw std::runtime_error("--out " + options.out +
                             ": lies in the folder of the models; name another one");
}

int
evaluate(const Options& options, const std::string& command)
{
  refuseOutAmongModels(options);
  const ModelFolder folder = readFolder(options.models);
  const Plan plan = planFor(options, folder);
  std::filesystem::create_directories(options.out);
  writeManifest(options.out + "/run.json", command, options, folder, plan);
  RunLog log(options.out + "/runs.jsonl");

  const unsigned int cores = std::max(1u, std::thread::hardware_concurrency());
  std::cerr << plan.models.size() << " of " << folder.models.size() << " models, "
            << plan.conditions.size() << " conditions, " << plan.methods.size()
            << " methods, seed " << options.protocol.seed << std::endl;
  perform(runsOfTables(plan, options.protocol), plan.models, options,
          options.jobs ? options.jobs : cores, log);
  perform(runsOfSizes(plan), plan.size_models, options, 1, log);

  writeWorstCases(plan, options.protocol, log, options.out + "/worst");
  return report(options.out);
}

} // namespace
} // namespace evaluation

int
main(int argc, char** argv)
{
  evaluation::Options options;
  int exit_code = 0;
  if (!evaluation::parse(argc, argv, options, exit_code))
    return exit_code;
  try {
    const std::string command =
        boost::algorithm::join(std::vector<std::string>(argv, argv + argc), " ");
    return evaluation::evaluate(options, command);
  }
  catch (const std::exception& problem) {
    std::cerr << "pcl_kss_icp_evaluate: " << problem.what() << '\n';
    return 1;
  }
}
