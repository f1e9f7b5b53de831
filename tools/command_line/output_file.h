/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "signals.h"

#include <functional>
#include <optional>
#include <ostream>
#include <string>

namespace tool {

/** \brief A file that is there as a whole or not at all.
 *
 * It is written next to its place and then moved there; devices and pipes are written
 * directly.
 */
class OutputFile {
public:
  /** \brief Check that the file could be written, without leaving a trace.
   * \throws std::runtime_error naming the file where it could not
   */
  explicit OutputFile(const std::string& path);

  /** \brief Remove what was written but not put in place. */
  ~OutputFile();

  OutputFile(const OutputFile&) = delete;
  OutputFile&
  operator=(const OutputFile&) = delete;

  /** \brief Write the file, but not in its place yet.
   * \param[in] writer writes what the file shall hold
   * \throws std::runtime_error naming the file where it fails
   */
  void
  write(const std::function<void(std::ostream&)>& writer);

  /** \brief Put the file in its place, if it has been written. */
  void
  putInPlace();

private:
  std::string path_;
  /** \brief Where the file is written; the path itself for devices and pipes. */
  std::string temporary_path_;
  std::optional<RemovedOnSignal> removed_on_signal_;
  bool written_ = false;
};

} // namespace tool
