/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "device_list.h"
#include "geometry_registration.h"
#include "io/read_geometry.h"
#include "options.h"
#include "outputs.h"
#include "program.h"
#include "progress_bar.h"
#include "registration.h"
#include "report.h"
#include "signals.h"
#include "transformation_file.h"
#include "viewer.h"
#include "words.h"
#include "wrapped.h"

#include <boost/algorithm/string/join.hpp>

#include <algorithm>
#include <iostream>
#include <optional>
#include <utility>

/** \file
 * The command line tool: registers two files and writes the result.
 */

namespace {

using namespace tool;

constexpr const char* PROGRAM = "pcl_kss_icp";

/** Read a file, with warnings. */
Geometry
read(const std::string& path, bool quiet)
{
  Geometry geometry = readGeometry(path);
  if (!quiet)
    for (const auto& warning : warningsOf(geometry))
      complain(PROGRAM, "warning: " + path + ": " + warning);
  return geometry;
}

Result
registerWithProgress(const Geometry& source,
                     const Geometry& target,
                     const std::optional<Eigen::Matrix4d>& guess,
                     Options options)
{
  ProgressBar bar;
  if (!options.quiet && ProgressBar::hasAudience())
    options.settings.progress = [&](const std::string& stage, double done) {
      bar.show(stage, done);
    };
  return registerGeometries(source, target, guess, options, !options.report.empty());
}

/** Say how many points were left out, far away from all others. */
void
warnOfFarPoints(std::size_t number, const std::string& path)
{
  if (number > 0)
    complain(PROGRAM, "warning: " + path + ": " + std::to_string(number) +
                          (number == 1 ? " point lies" : " points lie") +
                          " far away from all others; the search went without");
}

/** Say what of the source the aligned file does not hold. */
void
warnOfLosses(const std::vector<std::string>& losses, const Options& options)
{
  if (!losses.empty())
    complain(PROGRAM, "warning: " + options.aligned + ": does not hold all of " +
                          options.source + "; lost are " +
                          boost::algorithm::join(losses, ", "));
}

/** Tell people the result, and what it means. */
void
say(const Result& result,
    const std::vector<std::string>& losses,
    const Options& options)
{
  if (!result.converged) {
    complain(PROGRAM, "not registered: " + result.reason);
    const std::string advice = whatToTry(result, options);
    if (!options.quiet && !advice.empty())
      std::cerr << wrapped(advice, 79, 0) << '\n';
  }
  else if (!options.quiet) {
    warnOfFarPoints(result.far_points.source, options.source);
    warnOfFarPoints(result.far_points.target, options.target);
    warnOfLosses(losses, options);
    std::cout << summaryText(result, options) << std::flush;
  }
}

int
registerFiles(const Options& options)
{
  if (options.view)
    checkViewer();
  Outputs outputs(options);
  checkDevice(options.settings.device);
  Geometry source = read(options.source, options.quiet);
  const Geometry target = read(options.target, options.quiet);
  outputs.checkFormat(source);
  const auto losses = outputs.lossesOf(source);
  std::optional<Eigen::Matrix4d> guess;
  if (!options.guess.empty())
    guess = readTransformation(options.guess);

  const Result result = registerWithProgress(source, target, guess, options);

  const std::string report =
      options.view ? reportText(result, options, source, target) : "";
  outputs.write(result, std::move(source), target);
  say(result, losses, options);
  if (options.view)
    showInWindow(options, report);
  if (result.converged)
    return SUCCESS;
  return saysNothingOfClouds(result) ? FAILED : NOT_ALL;
}

int
run(const Options& options)
{
  if (options.action == Options::Action::LIST_DEVICES) {
    std::cout << deviceList(options.settings);
    return SUCCESS;
  }
  return registerFiles(options);
}

} // namespace

int
main(int argc, char** argv)
{
  endCleanlyOnSignals(PROGRAM);
  return guarded(PROGRAM, [&] {
    return runAsAsked<Options>(
        PROGRAM, true, [&] { return parseOptions(argc, argv); }, helpText, run);
  });
}
