/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "rank_crew.h"

#include <algorithm>
#include <iostream>
#include <utility>

namespace tool {

RankCrew::RankCrew(const boost::mpi::communicator& ranks,
                   JobHandler handler,
                   unsigned int threads)
: mailbox_(ranks)
, workers_(std::move(handler), threads)
, members_(static_cast<std::size_t>(ranks.size()))
{
  members_[0].threads = workers_.threads();
}

RankCrew::~RankCrew()
{
  try {
    sendToAll(Letter::Kind::DISMISSED);
    mailbox_.flush(std::chrono::seconds(2));
  }
  catch (const std::exception&) {
    // they will notice
  }
}

void
RankCrew::run(std::size_t jobs,
              const std::function<std::string(std::size_t)>& job,
              const std::function<void(std::size_t, JobAnswer)>& done)
{
  first_ticket_ = ticket_;
  taken_back_.clear();
  looked_ = gave_sign_ = Clock::time_point();
  const std::uint64_t end = first_ticket_ + jobs;
  std::vector<Workers::Done> answers;
  Pace pace;
  for (std::size_t ended = 0; ended < jobs;) {
    giveAgain();
    giveNew(end, job);
    bool is_news = receive(answers);
    if (auto own = workers_.take(is_news ? std::chrono::microseconds() : pace.next())) {
      takeAnswer(0, std::move(*own), answers);
      is_news = true;
    }
    checkSilence(answers);
    if (is_news)
      pace.reset();
    ended += answers.size();
    for (Workers::Done& answer : answers)
      done(answer.ticket - first_ticket_, std::move(answer.answer));
    answers.clear();
  }
  sendToAll(Letter::Kind::REST);
}

void
RankCrew::give(Job job, int rank)
{
  job.rank = rank;
  ++members_[rank].jobs;
  if (rank == 0)
    workers_.give(job.ticket, job.bytes);
  else
    mailbox_.send({rank, Letter::Kind::JOB, job.ticket, job.bytes});
  given_[job.ticket] = std::move(job);
}

int
RankCrew::freeRank(int first_rank, std::size_t more) const
{
  int best = NOBODY;
  std::size_t most_room = 0;
  for (int rank = first_rank; rank < static_cast<int>(members_.size()); ++rank) {
    const Member& member = members_[rank];
    if (member.threads == 0 || member.is_lost)
      continue;
    const std::size_t capacity = member.threads + (rank > 0 ? more : 0);
    const std::size_t room = capacity - std::min(capacity, member.jobs);
    if (room > most_room) {
      most_room = room;
      best = rank;
    }
  }
  return best;
}

void
RankCrew::giveAgain()
{
  const bool has_one =
      std::any_of(given_.begin(), given_.end(), [this](const auto& given) {
        return given.first >= first_ticket_ && given.second.losses > 0;
      });
  // alone, so that the next loss tells which one it was
  if (taken_back_.empty() || has_one)
    return;
  // not here, as long as there are others: this rank's end would be the end of all
  const bool has_others =
      std::any_of(members_.begin() + 1, members_.end(), [](const Member& member) {
        return member.threads > 0 && !member.is_lost;
      });
  const int rank = freeRank(has_others ? 1 : 0, 0);
  if (rank == NOBODY)
    return;
  give(std::move(taken_back_.front()), rank);
  taken_back_.pop_front();
}

void
RankCrew::giveNew(std::uint64_t end, const std::function<std::string(std::size_t)>& job)
{
  std::size_t threads = 0;
  for (const Member& member : members_)
    threads += member.is_lost ? 0 : member.threads;
  while (ticket_ < end) {
    // one in hand spares others the way here and back, but not when the jobs run out
    const int rank = freeRank(0, end - ticket_ > threads ? 1 : 0);
    if (rank == NOBODY)
      return;
    Job next{ticket_, job(ticket_ - first_ticket_)};
    ++ticket_;
    give(std::move(next), rank);
  }
}

void
RankCrew::sendToAll(Letter::Kind kind)
{
  for (int rank = 1; rank < static_cast<int>(members_.size()); ++rank)
    if (!members_[rank].is_lost)
      mailbox_.send({rank, kind});
}

bool
RankCrew::receive(std::vector<Workers::Done>& answers)
{
  bool is_news = false;
  while (auto letter = mailbox_.receive()) {
    Member& sender = members_[letter->rank];
    sender.heard = Clock::now();
    sender.is_lost = false; // it was only slow
    if (letter->kind == Letter::Kind::READY)
      sender.threads = letter->ticket;
    else if (letter->kind == Letter::Kind::ANSWER)
      takeAnswer(letter->rank, {letter->ticket, {std::move(letter->bytes), ""}},
                 answers);
    else if (letter->kind == Letter::Kind::FAILURE)
      takeAnswer(letter->rank, {letter->ticket, {"", std::move(letter->bytes)}},
                 answers);
    is_news = is_news || letter->kind != Letter::Kind::ALIVE;
  }
  return is_news;
}

void
RankCrew::takeAnswer(int rank, Workers::Done done, std::vector<Workers::Done>& answers)
{
  const auto found = given_.find(done.ticket);
  if (found == given_.end() || found->second.rank != rank)
    return;
  --members_[rank].jobs;
  given_.erase(found);
  if (done.ticket >= first_ticket_)
    answers.push_back(std::move(done));
}

void
RankCrew::checkSilence(std::vector<Workers::Done>& answers)
{
  const auto now = Clock::now();
  if (now - gave_sign_ >= patience_.between_signs) {
    sendToAll(Letter::Kind::ALIVE);
    gave_sign_ = now;
  }
  // who has not listened for long cannot say that others have been silent
  if (now - looked_ >= patience_.with_worker / 2)
    for (Member& member : members_)
      member.heard = now;
  looked_ = now;
  for (int rank = 1; rank < static_cast<int>(members_.size()); ++rank) {
    Member& member = members_[rank];
    if (member.threads > 0 && !member.is_lost &&
        now - member.heard > patience_.with_worker) {
      member.is_lost = true;
      std::cerr << "warning: rank " << rank
                << " is not heard of any more; others do its work\n";
      takeJobsOf(rank, answers);
    }
  }
}

void
RankCrew::takeJobsOf(int rank, std::vector<Workers::Done>& answers)
{
  members_[rank].jobs = 0;
  for (auto given = given_.begin(); given != given_.end();) {
    Job& job = given->second;
    if (job.rank != rank) {
      ++given;
      continue;
    }
    if (++job.losses > 1)
      answers.push_back(
          {job.ticket, {"", "the processes that did it ended, two of them"}});
    else if (job.ticket >= first_ticket_)
      taken_back_.push_back(std::move(job));
    given = given_.erase(given);
  }
}

} // namespace tool
