/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "run.h"

#include "../benchmarks/process.h"

#include <exception>

namespace evaluation {
namespace {

constexpr double bytes_in_megabyte = 1e6;

void
addMetrics(const Metrics& metrics, Record& record)
{
  record["solved"] = metrics.solved;
  record["by_symmetry"] = metrics.by_symmetry;
  record["mse"] = metrics.distance.mse;
  record["rmse"] = metrics.distance.rmse;
  record["mae"] = metrics.distance.mae;
  record["mse_r"] = metrics.angle.mse;
  record["rmse_r"] = metrics.angle.rmse;
  record["mae_r"] = metrics.angle.mae;
  record["rotation_deg"] = metrics.rotation_degrees;
  record["translation"] = metrics.translation;
  record["scale"] = metrics.scale;
  record["tre"] = metrics.target_registration_error;
}

/** \brief Register; the record gets what that cost. */
Answer
registered(const Run& run, const Case& work, Record& record)
{
  Task task;
  task.source = work.source;
  task.target = work.target;
  task.overlap = work.overlap;
  task.same_scale = run.scale_given;
  task.seed = work.seed;

  const double resident = benchmarks::residentBytes();
  if (run.method.warm_up)
    run.method.warm_up();
  const double cpu = benchmarks::cpuSeconds(), wall = benchmarks::wallSeconds();
  const Answer answer = run.method.run(task);
  record["cpu_s"] = benchmarks::cpuSeconds() - cpu;
  record["wall_s"] = benchmarks::wallSeconds() - wall;
  record["peak_mb"] = (benchmarks::peakResidentBytes() - resident) / bytes_in_megabyte;
  return answer;
}

Case
asGiven(const Run& run, const Case& work)
{
  return run.scale_given ? withTrueScale(work) : work;
}

} // namespace

Record
keyOf(const Run& run)
{
  return {{"condition", run.condition.name},
          {"model", run.model},
          {"repetition", run.repetition},
          {"method", run.method.name},
          {"scale_given", run.scale_given}};
}

std::string
lineOf(const Record& record)
{
  return record.dump(-1, ' ', false, Record::error_handler_t::replace);
}

Record
numbersOf(const Eigen::Matrix4d& matrix)
{
  Record numbers = Record::array();
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column)
      numbers.push_back(matrix(row, column));
  return numbers;
}

Record
performed(const Run& run, const Case& work)
{
  Record record = keyOf(run);
  const Case given = asGiven(run, work);
  Answer answer;
  try {
    answer = registered(run, given, record);
    record["status"] = "ok";
    record["message"] = "";
  }
  catch (const std::exception& problem) {
    record["status"] = "failed";
    record["message"] = problem.what();
  }
  record["claimed"] = answer.claimed;
  addMetrics(metricsOf(given, answer.pose), record);
  record["pose"] = numbersOf(answer.pose);
  return record;
}

Record
unanswered(const Run& run,
           const Case& work,
           const std::string& status,
           const std::string& message)
{
  Record record = keyOf(run);
  record["status"] = status;
  record["message"] = message;
  record["claimed"] = false;
  addMetrics(metricsOf(asGiven(run, work), Eigen::Matrix4d::Identity()), record);
  record["solved"] = record["by_symmetry"] = false;
  return record;
}

} // namespace evaluation
