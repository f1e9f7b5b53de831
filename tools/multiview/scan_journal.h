/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "command_line/journal_file.h"

#include <pcl/registration/kss/scan_work.h>

#include <string>
#include <unordered_map>

namespace tool {

/** \brief Remembers what has been done in a file, so that work that was cut off goes on
 * where it was: in each line a job, a tab and its answer.
 */
class ScanJournal {
public:
  /** \param[in] path of the file
   * \param[in] run what the work is about: scans, settings, version
   * \param[in] anew whether to forget what there is
   * \throws std::runtime_error naming the file where it is of another run, in use, or
   * cannot be written
   */
  ScanJournal(const std::string& path, const nlohmann::ordered_json& run, bool anew);
  ~ScanJournal();

  /** \brief The answer to a job that an earlier start has done; null where there is
   * none. */
  const pcl::kss::ScanAnswer*
  answerTo(const std::string& job) const;

  /** \brief Remember an answer for later starts.
   * \throws std::runtime_error naming the file where it cannot be written
   */
  void
  add(const std::string& job, const std::string& answer);

  /** \brief How many answers of earlier starts there are. */
  std::size_t
  size() const
  {
    return known_.size();
  }

  /** \brief How many lines are damaged: their jobs are done again. */
  std::size_t
  numberDamaged() const
  {
    return damaged_;
  }

  /** \brief The work is done: nothing of it needs to be remembered. */
  void
  remove();

private:
  std::string path_;
  JournalFile file_;
  std::unordered_map<std::string, pcl::kss::ScanAnswer> known_;
  std::size_t damaged_ = 0;
};

} // namespace tool
