/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "journal_file.h"

#include "report.h"
#include "signals.h"

#include <cerrno>
#include <cstring>
#include <stdexcept>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace tool {
namespace {

using JSON = nlohmann::ordered_json;

constexpr const char* ANEW =
    "; --restart begins anew, and another folder for --out keeps what there is";

/** What another run has where a part of what it tells of itself is another one. */
std::string
otherThing(const std::string& part)
{
  return part == "manifest"  ? "another manifest"
         : part == "scans"   ? "other scans, or scans that have changed since"
         : part == "version" ? "another version of this program"
                             : "other settings";
}

} // namespace

JournalFile::JournalFile(const std::string& path, const JSON& run, bool anew)
: path_(path)
{
  open();
  try {
    if (anew)
      cut(0);
    if (!readRun(run)) {
      cut(0);
      append(textOf({{"run", run}}, -1));
      reader_.clear();
    }
  }
  catch (...) {
    close(file_);
    throw;
  }
}

JournalFile::~JournalFile()
{
  close(file_);
}

void
JournalFile::open()
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
JournalFile::readRun(const JSON& run)
{
  std::string text;
  if (!std::getline(reader_, text) || reader_.eof())
    return false; // torn, if it is there
  const JSON line = JSON::parse(text, nullptr, false);
  if (!line.is_object() || !line.contains("run") || !line["run"].is_object())
    fail(std::string("is no journal of this program") + ANEW);
  const JSON wanted = JSON::parse(textOf(run, -1)); // as it is when it is read
  for (const auto& [key, value] : wanted.items())
    if (!line["run"].contains(key) || line["run"][key] != value)
      fail("is of a run with " + otherThing(key) + ANEW);
  end_ = text.size() + 1;
  return true;
}

void
JournalFile::read(
    const std::function<void(const std::string& line, std::uint64_t place)>& take)
{
  reader_.seekg(static_cast<std::streamoff>(end_));
  for (std::string line; std::getline(reader_, line) && !reader_.eof();) {
    const std::uint64_t place = end_;
    end_ += line.size() + 1;
    take(line, place);
  }
  if (reader_.bad())
    fail("cannot be read to its end");
  cut(end_);
}

void
JournalFile::cut(std::uint64_t length)
{
  if (ftruncate(file_, static_cast<off_t>(length)) != 0)
    fail(std::strerror(errno));
}

std::uint64_t
JournalFile::append(const std::string& line)
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

std::string
JournalFile::lineAt(std::uint64_t place) const
{
  std::string line;
  reader_.clear();
  reader_.seekg(static_cast<std::streamoff>(place));
  std::getline(reader_, line);
  return line;
}

void
JournalFile::fail(const std::string& problem) const
{
  throw std::runtime_error(path_ + ": " + problem);
}

JSON
stateOf(const std::string& path)
{
  struct stat file = {};
  if (path.empty() || stat(path.c_str(), &file) != 0)
    return nullptr;
  return {file.st_size, file.st_mtim.tv_sec, file.st_mtim.tv_nsec};
}

} // namespace tool
