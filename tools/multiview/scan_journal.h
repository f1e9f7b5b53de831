/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <fstream>
#include <optional>
#include <string>
#include <unordered_map>

namespace tool {

/** \brief Remembers what has been done in a file, so that work that was cut off goes on
 * where it was.
 */
class ScanJournal {
public:
  /** \param[in] path of the file
   * \param[in] subject what the work is about: files, their sizes and times, settings.
   * What has been done for another one is forgotten.
   * \throws std::runtime_error naming the file where it cannot be written
   */
  ScanJournal(const std::string& path, const std::string& subject);

  /** \brief The answer to a job that an earlier run has done. */
  std::optional<std::string>
  answerTo(const std::string& job) const;

  /** \brief Remember an answer.
   * \throws std::runtime_error naming the file where it cannot be written
   */
  void
  add(const std::string& job, const std::string& answer);

  /** \brief How many answers of earlier runs there are. */
  std::size_t
  size() const
  {
    return known_.size();
  }

  /** \brief The work is done: nothing of it needs to be remembered. */
  void
  close();

private:
  /** \brief Read what is there, as far as it is whole.
   * \return the bytes that are
   */
  std::uintmax_t
  read(const std::string& subject);

  std::string path_;
  std::unordered_map<std::string, std::string> known_;
  std::ofstream file_;
};

} // namespace tool
