/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "crew.h"

#include <memory>

namespace tool {

/** \brief The processes that a program runs as: itself alone, or as many as mpirun or a
 * batch system has started.
 *
 * One of them, at the start and until the end of main(). MPI is not touched where the
 * program was started alone, or built without MPI.
 */
class Processes {
public:
  Processes();
  ~Processes();

  Processes(const Processes&) = delete;
  Processes&
  operator=(const Processes&) = delete;

  /** \brief Whether this one hands out the jobs and speaks for all. */
  bool
  leads() const;

  /** \brief How many there are. */
  std::size_t
  number() const;

  /** \brief For the one that leads: all of them; the others are dismissed at its end.
   * \param[in] handler does the jobs that this process does
   * \param[in] threads of this process; 0: its share of the cores
   */
  std::unique_ptr<Crew>
  crew(JobHandler handler, unsigned int threads) const;

  /** \brief For all others: do jobs until dismissed.
   * \param[in] handler the same as that of the one that leads
   * \param[in] threads of this process; 0: its share of the cores
   * \throws std::runtime_error where the one that leads is gone
   */
  void
  serve(JobHandler handler, unsigned int threads) const;

private:
  class Ranks;
  std::unique_ptr<Ranks> ranks_;
};

} // namespace tool
