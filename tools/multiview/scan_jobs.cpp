/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "scan_jobs.h"

#include "scan_job_texts.h"
#include "scan_journal.h"

#include <utility>

namespace tool {

using pcl::kss::ScanAnswer;
using pcl::kss::ScanTask;

JobHandler
handlerOf(pcl::kss::ScanWorker& worker)
{
  return [&worker](const std::string& job) {
    const ScanTask task = taskFrom(job);
    return textOf(worker.answer(task), task.kind);
  };
}

ScanJobs::ScanJobs(Crew& crew, ScanJournal& journal)
: crew_(crew)
, journal_(journal)
{
}

void
ScanJobs::work(const std::vector<ScanTask>& tasks,
               const std::function<void(std::size_t, ScanAnswer)>& done)
{
  std::vector<std::size_t> left;
  for (std::size_t i = 0; i < tasks.size(); ++i)
    if (const ScanAnswer* known = journal_.answerTo(jobOf(tasks[i])))
      done(i, *known);
    else
      left.push_back(i);
  crew_.run(
      left.size(), [&](std::size_t i) { return jobOf(tasks[left[i]]); },
      [&](std::size_t i, JobAnswer answer) {
        const ScanTask& task = tasks[left[i]];
        ++counts_[task.kind];
        ScanAnswer result;
        result.pair.source = task.source;
        result.pair.target = task.target;
        if (answer.failure.empty()) {
          result = answerFrom(answer.bytes);
          // what could not be done, as without a file or memory, may be possible later
          if (result.failure.cause == pcl::kss::FailureCause::NONE)
            journal_.add(jobOf(task), answer.bytes);
        }
        else
          result.failure = {pcl::kss::FailureCause::OTHER, answer.failure};
        done(left[i], std::move(result));
      });
}

} // namespace tool
