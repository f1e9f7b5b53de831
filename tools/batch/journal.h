/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "command_line/journal_file.h"

#include <nlohmann/json.hpp>

#include <cstdint>
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

  /** \brief How many lines are damaged: what they told of is not known any more. */
  std::size_t
  numberDamaged() const
  {
    return damaged_;
  }

  void
  noteBegun(std::size_t pair);

  /** \brief Keep what has come of a pair. */
  void
  noteDone(std::size_t pair, const nlohmann::ordered_json& answer);

  /** \brief A pair that is done is to be done again. */
  void
  forget(std::size_t pair);

  /** \brief What has come of a pair that is done. */
  nlohmann::ordered_json
  operator[](std::size_t pair) const;

private:
  /** \brief Says that the program ended as it should. */
  static constexpr const char* END = "{\"ended\":true}\n";
  static constexpr std::uint64_t NOWHERE = ~std::uint64_t(0);

  void
  take(const nlohmann::ordered_json& line, std::uint64_t place, std::set<std::size_t>&);

  JournalFile file_;
  /** \brief Where the pairs that are done stand. */
  std::vector<std::uint64_t> places_;
  std::vector<std::uint8_t> deaths_;
  std::size_t done_ = 0, damaged_ = 0;
};

} // namespace tool
