/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "scan_journal.h"

#include "command_line/signals.h"
#include "scan_job_texts.h"

#include <filesystem>

namespace tool {

ScanJournal::ScanJournal(const std::string& path,
                         const nlohmann::ordered_json& run,
                         bool anew)
: path_(path)
, file_(path, run, anew)
{
  file_.read([&](const std::string& line, std::uint64_t) {
    const std::size_t tab = line.find('\t');
    try {
      known_[line.substr(0, tab)] = answerFrom(line.substr(tab + 1));
    }
    catch (const std::exception&) {
      ++damaged_;
    }
  });
  setLastWords({-1, "", SAME_COMMAND_GOES_ON});
}

ScanJournal::~ScanJournal()
{
  setLastWords({});
}

const pcl::kss::ScanAnswer*
ScanJournal::answerTo(const std::string& job) const
{
  const auto found = known_.find(job);
  return found == known_.end() ? nullptr : &found->second;
}

void
ScanJournal::add(const std::string& job, const std::string& answer)
{
  file_.append(job + '\t' + answer);
}

void
ScanJournal::remove()
{
  std::filesystem::remove(path_);
}

} // namespace tool
