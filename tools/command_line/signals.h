/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <string>

namespace tool {

/** \brief From now on SIGINT, SIGTERM and SIGHUP end the program at once, with the exit
 * status 128 + signal and without temporary files, whatever it does; and pipes and
 * disks that take no more are errors like others.
 * \param[in] program whose name the message has; must stay; null: no message
 */
void
endCleanlyOnSignals(const char* program);

/** \brief What a signal that ends the program does, too; what is named must stay. */
struct LastWords {
  /** \brief An open file that takes some; -1: none. */
  int file = -1;
  const char* text = "";
  /** \brief What is said to the user, in a line. */
  const char* advice = "";
};

/** \brief From now on a signal that ends the program does this, too. */
void
setLastWords(const LastWords& words);

/** \brief While it lives, a signal that ends the program removes a file.
 * \pre no more than eight at a time
 */
class RemovedOnSignal {
public:
  /** \param[in] path must outlive this object and stay as it is */
  explicit RemovedOnSignal(const std::string& path);
  ~RemovedOnSignal();

  RemovedOnSignal(const RemovedOnSignal&) = delete;
  RemovedOnSignal&
  operator=(const RemovedOnSignal&) = delete;

private:
  std::size_t slot_;
};

/** \brief While it lives, a signal that ends the program has to wait. Of one thread at
 * a time.
 */
class SignalsHeld {
public:
  SignalsHeld();
  ~SignalsHeld();

  SignalsHeld(const SignalsHeld&) = delete;
  SignalsHeld&
  operator=(const SignalsHeld&) = delete;
};

} // namespace tool
