/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <sys/types.h>

#include <functional>
#include <list>
#include <string>

namespace evaluation {

/** \brief What became of work that was done in a process of its own. */
struct Outcome {
  enum { FINISHED, TIMED_OUT, CRASHED } end = CRASHED;
  std::string answer;        ///< of work that finished
  int signal = 0;            ///< of work that crashed
  double wall_seconds = 0.0; ///< from its start to its end
};

/** \brief Does work in processes of their own, a few at a time: a method that crashes
 * or does not come to an end takes nothing with it, and each starts with fresh memory.
 */
class ProcessPool {
public:
  using Work = std::function<std::string()>;
  using Done = std::function<void(const Outcome&)>;

  /** \param[in] jobs how many processes run at once
   * \param[in] time_limit seconds of CPU time after which a process is killed, so that
   * other work on the machine decides nothing; or four times as much wall time
   * \param[in] messages file that takes what the processes print
   */
  ProcessPool(unsigned int jobs, double time_limit, const std::string& messages);

  ~ProcessPool();

  ProcessPool(const ProcessPool&) = delete;
  ProcessPool&
  operator=(const ProcessPool&) = delete;

  /** \brief Start work as soon as a process is free for it.
   * \param[in] work in the new process; the answer reaches \a done
   * \param[in] done in this process, during start() or finish()
   */
  void
  start(const Work& work, Done done);

  /** \brief Wait until all work is done. */
  void
  finish();

private:
  struct Process {
    pid_t id;
    int answer; ///< end of the pipe
    double start;
    Done done;
    Outcome outcome;
  };

  void
  waitForOne();

  void
  end(std::list<Process>::iterator process);

  unsigned int jobs_;
  double time_limit_, wall_limit_;
  int messages_;
  std::list<Process> running_;
};

} // namespace evaluation
