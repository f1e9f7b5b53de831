/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "crew.h"
#include "mailbox.h"
#include "pace.h"
#include "workers.h"

#include <deque>
#include <map>
#include <vector>

namespace tool {

/** \brief A crew of the threads of all ranks, this one's, which leads, among them.
 *
 * This thread hands out jobs and collects answers; it alone calls MPI. The jobs of a
 * rank that is not heard of any more are given to others, one after another and once
 * each: a job that two ranks have died of is a failure.
 */
class RankCrew : public Crew {
public:
  /** \param[in] ranks this one's number is 0
   * \param[in] threads of this one, at least one
   */
  RankCrew(const boost::mpi::communicator& ranks,
           JobHandler handler,
           unsigned int threads);

  /** \brief Dismisses the others. */
  ~RankCrew() override;

  void
  run(std::size_t jobs,
      const std::function<std::string(std::size_t)>& job,
      const std::function<void(std::size_t, JobAnswer)>& done) override;

private:
  using Clock = std::chrono::steady_clock;

  struct Member {
    std::size_t threads = 0; ///< none before it has said so
    std::size_t jobs = 0;
    Clock::time_point heard;
    bool is_lost = false;
  };

  struct Job {
    std::uint64_t ticket;
    std::string bytes;
    int losses = 0; ///< how many ranks have died of it
    int rank = 0;   ///< who does it
  };

  /** \brief Nobody is free. */
  static constexpr int NOBODY = -1;

  void
  give(Job job, int rank);

  /** \brief Who has most room for one more job.
   * \param[in] first_rank the first one that may take it
   * \param[in] more how many jobs others may have beyond those that they are doing
   */
  int
  freeRank(int first_rank, std::size_t more) const;

  /** \brief Give a job that a rank has died of to another, if it is its turn. */
  void
  giveAgain();

  /** \brief Give out new jobs, up to a ticket, to whoever has room. */
  void
  giveNew(std::uint64_t end, const std::function<std::string(std::size_t)>& job);

  void
  sendToAll(Letter::Kind kind);

  /** \brief Take what others say; an answer to a job is put in its place.
   * \return whether anybody said anything
   */
  bool
  receive(std::vector<Workers::Done>& answers);

  /** \brief An answer, unless the job has been given to somebody else since. */
  void
  takeAnswer(int rank, Workers::Done done, std::vector<Workers::Done>& answers);

  /** \brief Take the jobs from those that are silent. */
  void
  checkSilence(std::vector<Workers::Done>& answers);

  void
  takeJobsOf(int rank, std::vector<Workers::Done>& answers);

  Mailbox mailbox_;
  Workers workers_;
  const Patience patience_ = Patience::ofEnvironment();
  std::vector<Member> members_;
  /** \brief What is being done, by its ticket. */
  std::map<std::uint64_t, Job> given_;
  /** \brief What is to be given to others. */
  std::deque<Job> taken_back_;
  /** \brief That of the next job; answers of a run that was given up are not taken for
   * others. */
  std::uint64_t ticket_ = 0, first_ticket_ = 0;
  Clock::time_point looked_, gave_sign_;
};

/** \brief Do jobs until dismissed by rank 0, this being another.
 * \throws std::runtime_error where rank 0 is gone
 */
void
serveRankCrew(const boost::mpi::communicator& ranks,
              JobHandler handler,
              unsigned int threads);

} // namespace tool
