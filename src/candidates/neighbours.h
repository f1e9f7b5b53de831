/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "candidates/candidates.h"

#include <vector>

namespace pcl {
namespace kss {

/** \brief The neighbourhoods of all candidates at once: those in which
 * Candidates::localMinima() compares them.
 *
 * They are rotations x scales x centres, so that what is largest or smallest in them is
 * found axis by axis. Values lie in rows, one per rotation.
 */
class CandidateNeighbours {
public:
  /** \param[in] candidates whose neighbours are wanted; their rotations are kept by
   * reference
   * \param[in] kernel edge of the kernel of rotations, in steps
   */
  CandidateNeighbours(const Candidates& candidates, unsigned int kernel);

  /** \brief The length of a row. */
  std::size_t
  rowSize() const
  {
    return row_size_;
  }

  /** \brief The lowest value among a candidate and its neighbours.
   * \param[in] values one per candidate
   * \param[in] rows for each rotation, whether it is asked for
   * \return for each candidate of these rows; others are left at their values
   */
  std::vector<float>
  lowestAround(const std::vector<float>& values, const std::vector<char>& rows) const;

  /** \brief The highest value among a candidate and those whose neighbour it is.
   * \param[in] values one per candidate
   * \param[in] rows for each rotation, whether its values count
   * \return for each candidate; lowest() where no value counts
   */
  std::vector<float>
  highestAround(const std::vector<float>& values, const std::vector<char>& rows) const;

  /** \brief Whether it holds for any neighbour of a candidate. */
  template <typename Predicate>
  bool
  anyAround(std::size_t candidate, const Predicate& predicate) const;

private:
  /** \brief Values of a row along an axis: their number and how far they lie apart. */
  struct Axis {
    std::size_t size, stride;
  };

  /** \brief The rows of a rotation's neighbours, and its own. */
  std::vector<std::size_t>
  rowsAround(std::size_t row) const;

  template <typename Better>
  void
  spreadInRow(float* row, const Better& better) const;

  std::size_t row_size_;
  std::vector<Axis> axes_; ///< of a row: scales and the three axes of the centres
  const CandidateRotations& rotations_;
  unsigned int kernel_;
};

template <typename Predicate>
bool
CandidateNeighbours::anyAround(std::size_t candidate, const Predicate& predicate) const
{
  // the places in the row that differ by one step at most along each axis
  const std::size_t place = candidate % row_size_;
  std::vector<std::size_t> places{place};
  for (const Axis& axis : axes_) {
    const std::size_t at = place / axis.stride % axis.size;
    const std::size_t number = places.size();
    for (std::size_t i = 0; i < number; ++i) {
      if (at > 0)
        places.push_back(places[i] - axis.stride);
      if (at + 1 < axis.size)
        places.push_back(places[i] + axis.stride);
    }
  }
  for (const std::size_t rotation : rowsAround(candidate / row_size_))
    for (const std::size_t p : places)
      if (rotation * row_size_ + p != candidate && predicate(rotation * row_size_ + p))
        return true;
  return false;
}

} // namespace kss
} // namespace pcl
