/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "execution.h"

#include "cases.h"
#include "process_pool.h"
#include "progress.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace evaluation {
namespace {

/** \brief The runs that the log does not hold yet, or gave up sooner than now. */
std::vector<Run>
missing(const std::vector<Run>& runs, const RunLog& log, double time_limit)
{
  std::vector<Run> result;
  std::copy_if(
      runs.begin(), runs.end(), std::back_inserter(result), [&](const Run& run) {
        const Record* record = log.find(run);
        return !record || record->value("gave_up_after_s", time_limit) < time_limit;
      });
  return result;
}

Record
timedOut(const Run& run,
         const Case& work,
         double time_limit,
         const std::string& message)
{
  Record record = unanswered(run, work, "timeout", message);
  record["gave_up_after_s"] = time_limit;
  return record;
}

/** \brief The record of a run, whatever became of its process. */
Record
recordOf(const Run& run, const Case& work, const Outcome& outcome, double time_limit)
{
  if (outcome.end == Outcome::TIMED_OUT)
    return timedOut(run, work, time_limit,
                    "took longer than " + std::to_string(std::lround(time_limit)) +
                        " s of CPU time");
  const Record record = Record::parse(outcome.answer, nullptr, false);
  if (outcome.end == Outcome::CRASHED || record.is_discarded())
    return unanswered(run, work, "crashed",
                      outcome.signal
                          ? std::string("ended by ") + strsignal(outcome.signal)
                          : "ended without an answer");
  return record;
}

/** \brief Whether the method ran out of time on a smaller cloud of the model already.
 */
bool
tookTooLongBefore(const Run& run,
                  const std::vector<Run>& runs,
                  double time_limit,
                  const RunLog& log)
{
  return std::any_of(runs.begin(), runs.end(), [&](const Run& other) {
    const Record* record = log.find(other);
    return other.model == run.model && other.method.name == run.method.name &&
           other.condition.points < run.condition.points && record &&
           record->value("gave_up_after_s", 0.0) >= time_limit;
  });
}

} // namespace

void
perform(const std::vector<Run>& runs,
        const std::vector<Model>& models,
        const Options& options,
        unsigned int jobs,
        RunLog& log)
{
  const std::vector<Run> to_do = missing(runs, log, options.time_limit);
  if (to_do.empty())
    return;
  const bool grow = to_do.front().condition.table == "size";
  Cases cases(models, options.protocol);
  Progress progress(to_do, jobs);
  ProcessPool pool(jobs, options.time_limit, options.out + "/messages.txt");
  for (const Run& run : to_do) {
    const auto work = cases.of(run);
    if (grow && tookTooLongBefore(run, runs, options.time_limit, log)) {
      log.add(timedOut(run, *work, options.time_limit,
                       "not run: a smaller cloud took too long"));
      progress.add(run, 0.0);
      continue;
    }
    pool.start([&run, work] { return lineOf(performed(run, *work)); },
               [&, work](const Outcome& outcome) {
                 log.add(recordOf(run, *work, outcome, options.time_limit));
                 progress.add(run, outcome.wall_seconds);
               });
  }
  pool.finish();
}

} // namespace evaluation
