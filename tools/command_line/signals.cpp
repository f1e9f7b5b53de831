/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "signals.h"

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <stdexcept>

#include <unistd.h>

namespace tool {
namespace {

std::array<std::atomic<const char*>, 8> paths{};

enum State { RUNNING, HELD, ENDING };
std::atomic<int> state{RUNNING};
std::atomic<int> pending{0};
const char* program = nullptr;
LastWords last_words;
/** Whether standard error is one. */
std::atomic<bool> is_terminal{false};

// A handler may use nothing that locks.
static_assert(std::atomic<int>::is_always_lock_free &&
              std::atomic<bool>::is_always_lock_free &&
              std::atomic<const char*>::is_always_lock_free);

void
say(const char* text, int file = STDERR_FILENO)
{
  [[maybe_unused]] const auto ignored = write(file, text, std::strlen(text));
}

/** End the program unless it has to wait. Nothing but calls that are safe in a handler,
 * which may run on any thread. */
void
endIfRunning(int signal)
{
  int expected = RUNNING;
  if (!state.compare_exchange_strong(expected, ENDING))
    return;
  for (const auto& path : paths)
    if (const char* name = path.load())
      unlink(name);
  if (last_words.file >= 0)
    say(last_words.text, last_words.file);
  if (program) {
    if (is_terminal)
      say("\r\033[K"); // what shows progress
    say(program);
    say(signal == SIGINT    ? ": ended by SIGINT\n"
        : signal == SIGTERM ? ": ended by SIGTERM\n"
                            : ": ended by SIGHUP\n");
    say(last_words.advice);
  }
  _exit(128 + signal);
}

void
handle(int signal)
{
  const int error = errno;
  pending = signal;
  endIfRunning(signal);
  errno = error;
}

} // namespace

void
endCleanlyOnSignals(const char* name)
{
  program = name;
  is_terminal = isatty(STDERR_FILENO) == 1;
  struct sigaction action = {};
  action.sa_handler = handle;
  action.sa_flags = SA_RESTART;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP})
    sigaddset(&action.sa_mask, signal);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction before = {};
    // nohup and shells ignore some of them for us
    if (sigaction(signal, nullptr, &before) == 0 && before.sa_handler != SIG_IGN)
      sigaction(signal, &action, nullptr);
  }
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

void
setLastWords(const LastWords& words)
{
  const SignalsHeld held;
  last_words = words;
}

RemovedOnSignal::RemovedOnSignal(const std::string& path)
{
  for (slot_ = 0; slot_ < paths.size(); ++slot_) {
    const char* expected = nullptr;
    if (paths[slot_].compare_exchange_strong(expected, path.c_str()))
      return;
  }
  throw std::logic_error("too many temporary files");
}

RemovedOnSignal::~RemovedOnSignal()
{
  paths[slot_] = nullptr;
}

SignalsHeld::SignalsHeld()
{
  int expected = RUNNING;
  while (!state.compare_exchange_strong(expected, HELD)) {
    pause(); // another thread is ending the program
    expected = RUNNING;
  }
}

SignalsHeld::~SignalsHeld()
{
  state = RUNNING;
  if (const int signal = pending)
    endIfRunning(signal);
}

} // namespace tool
