/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace pcl {
namespace kss {

/** \brief The energies of a few of millions of candidates: a bit for each candidate
 * says whether its energy is known, and counting bits says where it is.
 */
class SomeEnergies {
public:
  /** \param[in] candidates indices of those whose energies are known, rising
   * \param[in] all how many candidates there are
   */
  SomeEnergies(std::vector<std::size_t> candidates, std::size_t all)
  : candidates_(std::move(candidates))
  , energies_(candidates_.size(), std::numeric_limits<float>::infinity())
  , words_(all / bits + 1)
  {
    for (const std::size_t candidate : candidates_)
      words_[candidate / bits].known |= std::uint64_t(1) << candidate % bits;
    std::size_t before = 0;
    for (Word& word : words_) {
      word.before = before;
      before += __builtin_popcountll(word.known);
    }
  }

  /** \brief Those whose energies are known. */
  const std::vector<std::size_t>&
  candidates() const
  {
    return candidates_;
  }

  /** \brief The energy of one of them, by its place among them. */
  float&
  ofPlace(std::size_t place)
  {
    return energies_[place];
  }

  /** \brief The energy of a candidate; infinite: it is not known. */
  float
  operator[](std::size_t candidate) const
  {
    const Word& word = words_[candidate / bits];
    const std::uint64_t bit = std::uint64_t(1) << candidate % bits;
    return word.known & bit
               ? energies_[word.before + __builtin_popcountll(word.known & (bit - 1))]
               : std::numeric_limits<float>::infinity();
  }

private:
  static constexpr std::size_t bits = 64;

  /** Which of so many candidates are known, and how many of those before them. */
  struct Word {
    std::uint64_t known = 0;
    std::size_t before = 0;
  };

  std::vector<std::size_t> candidates_;
  std::vector<float> energies_;
  std::vector<Word> words_;
};

} // namespace kss
} // namespace pcl
