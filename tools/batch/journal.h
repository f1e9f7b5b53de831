/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <nlohmann/json.hpp>

#include <cstdint>
#include <fstream>
#include <set>
#include <string>
#include <vector>

namespace tool {

/** \brief What has been done so far, in a file that is written to as it goes: whatever
 * ends the program, all pairs but those that were running are there.
 *
 * One JSON object per line: the run that it is of, then for each start that there was
 * one, the pairs as they begin, and as they end, and that it ended as it should.
 */
class Journal {
public:
  /** \brief Open one, or begin it.
   * \param[in] run what the pairs are done with
   * \param[in] pairs how many there are
   * \param[in] anew whether to forget what there is
   * \throws std::runtime_error where it is of another run, or in use
   */
  Journal(const std::string& path,
          const nlohmann::ordered_json& run,
          std::size_t pairs,
          bool anew);
  /** \brief Notes that the program ends as it should: no pair has ended it. */
  ~Journal();

  Journal(const Journal&) = delete;
  Journal&
  operator=(const Journal&) = delete;

  bool
  isDone(std::size_t pair) const
  {
    return places_[pair] != NOWHERE;
  }

  std::size_t
  numberDone() const
  {
    return done_;
  }

  /** \brief In how many starts the program died while it did a pair. */
  unsigned int
  deaths(std::size_t pair) const
  {
    return deaths_[pair];
  }

  void
  noteBegun(std::size_t pair);

  /** \brief Keep what has come of a pair. */
  void
  noteDone(std::size_t pair, const nlohmann::ordered_json& answer);

  /** \brief What has come of a pair that is done. */
  nlohmann::ordered_json
  operator[](std::size_t pair) const;

private:
  /** \brief Says that the program ended as it should. */
  static constexpr const char* END = "{\"ended\":true}\n";
  static constexpr std::uint64_t NOWHERE = ~std::uint64_t(0);

  /** \brief Open the file, for this process alone. */
  void
  open();

  /** \brief Take in what is in the file. \return whether there was a run */
  bool
  read(const nlohmann::ordered_json& wanted);

  void
  take(const nlohmann::ordered_json& line, std::uint64_t place, std::set<std::size_t>&);

  /** \return where the line stands */
  std::uint64_t
  append(const std::string& line);

  [[noreturn]] void
  fail(const std::string& problem) const;

  std::string path_;
  int file_ = -1;
  std::uint64_t end_ = 0;
  mutable std::ifstream reader_;
  /** \brief Where the pairs that are done stand. */
  std::vector<std::uint64_t> places_;
  std::vector<std::uint8_t> deaths_;
  std::size_t done_ = 0;
};

} // namespace tool
