/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * What a rank does that does not lead.
 */

#include "rank_crew.h"

#include <stdexcept>
#include <utility>

namespace tool {

void
serveRankCrew(const boost::mpi::communicator& ranks,
              JobHandler handler,
              unsigned int threads)
{
  using Clock = std::chrono::steady_clock;
  constexpr int LEADER = 0;
  const Patience patience = Patience::ofEnvironment();
  Mailbox mailbox(ranks);
  Workers workers(std::move(handler), threads);
  mailbox.send({LEADER, Letter::Kind::READY, workers.threads()});
  bool is_resting = true;
  Pace pace;
  for (auto heard = Clock::now(), gave_sign = heard;;) {
    while (auto letter = mailbox.receive()) {
      heard = Clock::now();
      if (letter->kind == Letter::Kind::DISMISSED)
        return;
      is_resting = letter->kind == Letter::Kind::REST;
      if (letter->kind == Letter::Kind::JOB) {
        workers.give(letter->ticket, std::move(letter->bytes));
        pace.reset();
      }
    }
    if (auto done = workers.take(pace.next())) {
      const bool failed = !done->answer.failure.empty();
      mailbox.send({LEADER, failed ? Letter::Kind::FAILURE : Letter::Kind::ANSWER,
                    done->ticket,
                    std::move(failed ? done->answer.failure : done->answer.bytes)});
      pace.reset();
    }
    const auto now = Clock::now();
    if (now - gave_sign >= patience.between_signs) {
      mailbox.send({LEADER, Letter::Kind::ALIVE});
      gave_sign = now;
    }
    if (!is_resting && now - heard > patience.with_leader)
      throw std::runtime_error("the rank that leads is not heard of any more");
  }
}

} // namespace tool
