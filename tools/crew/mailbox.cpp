/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "mailbox.h"

#include <boost/mpi/status.hpp>

#include <cstring>
#include <limits>
#include <stdexcept>
#include <thread>

namespace tool {

namespace mpi = boost::mpi;

Mailbox::Mailbox(const mpi::communicator& ranks)
: ranks_(ranks)
{
}

void
Mailbox::send(const Letter& letter)
{
  forgetWhatHasGone();
  std::string bytes(sizeof letter.ticket, '\0');
  std::memcpy(bytes.data(), &letter.ticket, sizeof letter.ticket);
  bytes += letter.bytes;
  if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    throw std::length_error("a job is too long for MPI");
  sent_.push_back({std::move(bytes), {}}); // stays in its place until it has gone
  Sent& sent = sent_.back();
  sent.request = ranks_.isend(letter.rank, static_cast<int>(letter.kind),
                              sent.bytes.data(), static_cast<int>(sent.bytes.size()));
}

std::optional<Letter>
Mailbox::receive()
{
  forgetWhatHasGone();
  const auto status = ranks_.iprobe(mpi::any_source, mpi::any_tag);
  if (!status)
    return std::nullopt;
  std::string bytes(static_cast<std::size_t>(*status->count<char>()), '\0');
  ranks_.recv(status->source(), status->tag(), bytes.data(),
              static_cast<int>(bytes.size()));
  Letter letter{status->source(), static_cast<Letter::Kind>(status->tag())};
  std::memcpy(&letter.ticket, bytes.data(), sizeof letter.ticket);
  letter.bytes = bytes.substr(sizeof letter.ticket);
  return letter;
}

void
Mailbox::flush(std::chrono::milliseconds patience)
{
  const auto end = std::chrono::steady_clock::now() + patience;
  for (forgetWhatHasGone(); !sent_.empty() && std::chrono::steady_clock::now() < end;
       forgetWhatHasGone())
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

void
Mailbox::forgetWhatHasGone()
{
  sent_.remove_if([](Sent& sent) { return sent.request.test().has_value(); });
}

} // namespace tool
