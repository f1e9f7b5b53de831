/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "crew.h"
#include "workers.h"

namespace tool {

/** \brief A crew of threads of this process. */
class ThreadCrew : public Crew {
public:
  /** \param[in] threads 0: as many as there are cores for this process */
  ThreadCrew(JobHandler handler, unsigned int threads);

  void
  run(std::size_t jobs,
      const std::function<std::string(std::size_t)>& job,
      const std::function<void(std::size_t, JobAnswer)>& done) override;

private:
  Workers workers_;
  /** \brief That of the first job of the next run: answers of a run that was given up
   * are not taken for others. */
  std::uint64_t ticket_ = 0;
};

} // namespace tool
