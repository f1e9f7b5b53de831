/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "run.h"

#include <fstream>
#include <map>
#include <string>
#include <vector>

namespace evaluation {

/** \brief All runs of a folder: a line of JSON each, written as soon as it is known, so
 * that an evaluation that was stopped goes on where it was.
 */
class RunLog {
public:
  /** \brief Read what there is; a last line that was cut short is dropped.
   * \throws std::runtime_error naming the file where it cannot be read or written
   */
  explicit RunLog(const std::string& path);

  /** \brief The record of a run, or null. */
  const Record*
  find(const Run& run) const;

  /** \brief Add a record, and write it. */
  void
  add(const Record& record);

  /** \brief All records, sorted by their keys. */
  const std::map<std::string, Record>&
  records() const
  {
    return records_;
  }

private:
  /** \brief Read all records. \return the lines that hold them */
  std::string
  read(const std::string& path);

  std::map<std::string, Record> records_;
  std::ofstream file_;
};

} // namespace evaluation
