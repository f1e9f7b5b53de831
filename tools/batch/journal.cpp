/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "journal.h"

#include "command_line/report.h"
#include "command_line/signals.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

namespace tool {
namespace {

using JSON = nlohmann::ordered_json;

constexpr const char* ANEW =
    "; --restart begins anew, and another folder for --out keeps what there is";

} // namespace

Journal::Journal(const std::string& path, const JSON& run, std::size_t pairs, bool anew)
: path_(path)
, places_(pairs, NOWHERE)
, deaths_(pairs, 0)
{
  open();
  try {
    if (anew && ftruncate(file_, 0) != 0)
      fail(std::strerror(errno));
    if (!read(run))
      append(textOf({{"run", run}}, -1));
    append(textOf({{"start", true}}, -1));
    setLastWords(
        {file_, END, "what is done is kept; the same command goes on with the rest\n"});
  }
  catch (...) {
    close(file_);
    throw;
  }
}

Journal::~Journal()
{
  setLastWords({});
  try {
    append(std::string(END, std::strlen(END) - 1));
  }
  catch (const std::exception&) {
    // pairs that were running are suspected for nothing
  }
  close(file_);
}

void
Journal::open()
{
  file_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (file_ < 0)
    fail(std::strerror(errno));
  // what cannot be locked, on some network disks, is used without
  if (flock(file_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    close(file_);
    fail("is in use by another run; wait for its end, or give --out another folder");
  }
  reader_.open(path_, std::ios::binary);
  if (!reader_) {
    close(file_);
    fail(std::strerror(errno));
  }
}

bool
Journal::read(const JSON& wanted)
{
  const JSON run = JSON::parse(textOf(wanted, -1)); // as it is when it is read
  bool has_run = false;
  std::set<std::size_t> running;
  std::string text;
  while (std::getline(reader_, text)) {
    if (reader_.eof())
      break; // the last line is torn
    const std::uint64_t place = end_;
    end_ += text.size() + 1;
    const JSON line = JSON::parse(text, nullptr, false);
    if (!line.is_object())
      continue; // damaged: what it told of is done again
    if (!has_run) {
      if (!line.contains("run"))
        fail(std::string("is no journal of this program") + ANEW);
      for (const auto& [key, value] : run.items())
        if (!line["run"].contains(key) || line["run"][key] != value)
          fail("is of a run with " +
               std::string(key == "manifest"  ? "another manifest"
                           : key == "version" ? "another version of this program"
                                              : "other settings") +
               ANEW);
      has_run = true;
    }
    else
      take(line, place, running);
  }
  if (reader_.bad())
    fail("cannot be read to its end");
  if (ftruncate(file_, static_cast<off_t>(end_)) != 0)
    fail(std::strerror(errno));
  for (const std::size_t pair : running)
    ++deaths_[pair];
  return has_run;
}

void
Journal::take(const JSON& line, std::uint64_t place, std::set<std::size_t>& running)
{
  const auto numberAt = [&](const char* key) {
    const auto found = line.find(key);
    const std::size_t pair = found != line.end() && found->is_number_unsigned()
                                 ? found->get<std::size_t>()
                                 : 0;
    return pair <= places_.size() ? pair : 0;
  };
  if (line.contains("ended"))
    running.clear();
  else if (line.contains("start")) {
    for (const std::size_t pair : running)
      ++deaths_[pair];
    running.clear();
  }
  else if (const std::size_t begun = numberAt("begun"))
    running.insert(begun - 1);
  else if (const std::size_t done = numberAt("done")) {
    running.erase(done - 1);
    done_ += isDone(done - 1) ? 0 : 1;
    places_[done - 1] = place;
  }
}

void
Journal::noteBegun(std::size_t pair)
{
  append(textOf({{"begun", pair + 1}}, -1));
}

void
Journal::noteDone(std::size_t pair, const JSON& answer)
{
  JSON line{{"done", pair + 1}};
  line.update(answer);
  places_[pair] = append(textOf(line, -1));
  ++done_;
}

JSON
Journal::operator[](std::size_t pair) const
{
  std::string text;
  reader_.clear();
  reader_.seekg(static_cast<std::streamoff>(places_.at(pair)));
  const JSON line =
      std::getline(reader_, text) ? JSON::parse(text, nullptr, false) : JSON();
  if (!line.is_object() || line.value("done", std::size_t(0)) != pair + 1)
    fail("has changed while it was in use; start again");
  return line;
}

std::uint64_t
Journal::append(const std::string& line)
{
  const SignalsHeld held; // whole lines alone
  const std::string text = line + '\n';
  for (std::size_t written = 0; written < text.size();) {
    const ssize_t more = write(file_, text.data() + written, text.size() - written);
    if (more < 0 && errno != EINTR)
      fail(std::string("cannot be written: ") + std::strerror(errno));
    written += more > 0 ? static_cast<std::size_t>(more) : 0;
  }
  const std::uint64_t place = end_;
  end_ += text.size();
  return place;
}

void
Journal::fail(const std::string& problem) const
{
  throw std::runtime_error(path_ + ": " + problem);
}

} // namespace tool
