/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <cstddef>
#include <functional>
#include <string>

/** \file
 * Those who do jobs that do not depend on each other: the threads of this process, and
 * those of other processes where there are some (Processes).
 */

namespace tool {

/** \brief Does a job; called from several threads. Jobs and their answers are bytes, so
 * that they can travel between processes. What it throws is the job's failure. */
using JobHandler = std::function<std::string(const std::string& job)>;

/** \brief What has come of a job. */
struct JobAnswer {
  std::string bytes;
  /** \brief Why there is no answer, in words; empty where there is one. */
  std::string failure;
};

/** \brief Does jobs, as the one who leads sees it. */
class Crew {
public:
  virtual ~Crew() = default;

  /** \brief Do jobs, side by side and in any order. Both functions are called from this
   * thread alone; what they throw is thrown here, and then the rest is not done.
   * \param[in] jobs how many
   * \param[in] job gives the bytes of one: asked for when somebody is free to do it, or
   * nearly so, in the order of their numbers
   * \param[in] done told of each once, as it ends
   */
  virtual void
  run(std::size_t jobs,
      const std::function<std::string(std::size_t)>& job,
      const std::function<void(std::size_t, JobAnswer)>& done) = 0;
};

} // namespace tool
