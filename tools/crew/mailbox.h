/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <boost/mpi/communicator.hpp>
#include <boost/mpi/request.hpp>

#include <chrono>
#include <cstdint>
#include <list>
#include <optional>
#include <string>

namespace tool {

/** \brief What ranks tell each other. */
struct Letter {
  enum class Kind : int {
    READY,    ///< to the one that leads: so many threads as the ticket says
    JOB,      ///< to be done
    ANSWER,   ///< to a job
    FAILURE,  ///< to a job, in words
    ALIVE,    ///< from time to time; from the one that leads while it has jobs
    REST,     ///< there are no jobs for now, and maybe for long
    DISMISSED ///< there are none any more
  };

  /** \brief Who it is for, or from. */
  int rank;
  Kind kind;
  std::uint64_t ticket = 0;
  std::string bytes = {};
};

/** \brief Letters between ranks. Sending waits for nobody, be it a rank that is gone;
 * of the main thread alone.
 */
class Mailbox {
public:
  explicit Mailbox(const boost::mpi::communicator& ranks);

  void
  send(const Letter& letter);

  /** \brief The next letter, if one has come. */
  std::optional<Letter>
  receive();

  /** \brief Wait until all letters are on their way, but not forever: those to a rank
   * that is gone never are. */
  void
  flush(std::chrono::milliseconds patience);

private:
  struct Sent {
    std::string bytes;
    boost::mpi::request request;
  };

  void
  forgetWhatHasGone();

  boost::mpi::communicator ranks_;
  std::list<Sent> sent_;
};

} // namespace tool
