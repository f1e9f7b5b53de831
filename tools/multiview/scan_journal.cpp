/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "scan_journal.h"

#include <filesystem>
#include <stdexcept>

namespace tool {
namespace {

[[noreturn]] void
complain(const std::string& path)
{
  throw std::runtime_error(path + ": cannot be written; is the disk full?");
}

} // namespace

ScanJournal::ScanJournal(const std::string& path, const std::string& subject)
: path_(path)
{
  const std::uintmax_t whole = read(subject);
  if (whole > 0) {
    // what was being written when the work was cut off
    std::filesystem::resize_file(path, whole);
    file_.open(path, std::ios::app | std::ios::binary);
  }
  else {
    file_.open(path, std::ios::trunc | std::ios::binary);
    file_ << subject << '\n' << std::flush;
  }
  if (!file_)
    complain(path_);
}

std::uintmax_t
ScanJournal::read(const std::string& subject)
{
  std::ifstream file(path_, std::ios::binary);
  std::string line;
  if (!std::getline(file, line) || file.eof() || line != subject)
    return 0;
  std::uintmax_t whole = line.size() + 1;
  // each job is a line, and so is its answer
  for (std::string answer;
       std::getline(file, line) && std::getline(file, answer) && !file.eof();) {
    whole += line.size() + answer.size() + 2;
    known_[line] = answer;
  }
  return whole;
}

std::optional<std::string>
ScanJournal::answerTo(const std::string& job) const
{
  const auto found = known_.find(job);
  if (found == known_.end())
    return {};
  return found->second;
}

void
ScanJournal::add(const std::string& job, const std::string& answer)
{
  file_ << job << '\n' << answer << '\n' << std::flush;
  if (!file_)
    complain(path_);
}

void
ScanJournal::close()
{
  file_.close();
  std::filesystem::remove(path_);
}

} // namespace tool
