/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <nlohmann/json.hpp>

#include <cstdint>
#include <fstream>
#include <functional>
#include <string>

namespace tool {

/** \brief A file that says what has been done, in lines that are added as the work goes
 * on: whatever ends the program, all but the last one are whole, and it is of one run,
 * which its first line tells of.
 */
class JournalFile {
public:
  /** \brief Open one, or begin it.
   * \param[in] run what the work is about, as an object: its parts are told apart
   * \param[in] anew whether to forget what there is
   * \throws std::runtime_error naming the file where it is of another run, or another
   * process has it
   */
  JournalFile(const std::string& path, const nlohmann::ordered_json& run, bool anew);
  ~JournalFile();

  JournalFile(const JournalFile&) = delete;
  JournalFile&
  operator=(const JournalFile&) = delete;

  /** \brief Read the lines that are there but the first one, and cut off a last one
   * that is torn; once, before lines are added.
   * \param[in] take is given each of them, and where it stands
   */
  void
  read(const std::function<void(const std::string& line, std::uint64_t place)>& take);

  /** \brief Add a line; a signal that ends the program waits for it.
   * \return where it stands
   */
  std::uint64_t
  append(const std::string& line);

  /** \brief The line at a place; empty where there is none. */
  std::string
  lineAt(std::uint64_t place) const;

  /** \brief The open file, for what a signal adds. */
  int
  descriptor() const
  {
    return file_;
  }

  /** \brief Throw what has gone wrong, with the name of the file. */
  [[noreturn]] void
  fail(const std::string& problem) const;

private:
  /** \brief Open the file, for this process alone. */
  void
  open();

  /** \brief Compare the run that the file is of with this one.
   * \return whether there is one
   */
  bool
  readRun(const nlohmann::ordered_json& run);

  void
  cut(std::uint64_t length);

  std::string path_;
  int file_ = -1;
  std::uint64_t end_ = 0;
  mutable std::ifstream reader_;
};

/** \brief What is said where a signal ends a program that has a journal. */
constexpr const char* SAME_COMMAND_GOES_ON =
    "what is done is kept; the same command goes on with the rest\n";

/** \brief What tells whether a file has changed: its size and time; null where there is
 * no file. */
nlohmann::ordered_json
stateOf(const std::string& path);

} // namespace tool
