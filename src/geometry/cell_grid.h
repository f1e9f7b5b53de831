/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/detail/grid_index.h>
#include <pcl/registration/kss/detail/points.h>

#include "geometry/clouds.h"

#include <cstdint>
#include <vector>

namespace pcl {
namespace kss {

/** \brief A cell's coordinates. */
using Cell = Eigen::Vector3i;

/** \brief A cell's coordinates in one number: 21 bits each. */
inline std::uint64_t
keyOf(const Cell& cell)
{
  return (static_cast<std::uint64_t>(cell.x()) << 42) |
         (static_cast<std::uint64_t>(cell.y()) << 21) |
         static_cast<std::uint64_t>(cell.z());
}

/** \brief Cells of one edge over a cloud's bounding box, numbered from 2: those around
 * them, two away, then have numbers from 0.
 */
class CellLattice {
public:
  /** \brief The most cells along an axis: they have 21 bits. Those beyond fall
   * together. */
  static constexpr int most = 1 << 20;

  /** \param[in] box around the cloud
   * \param[in] edge of a cell
   */
  CellLattice(const Eigen::AlignedBox3f& box, float edge)
  : lower_(box.min())
  , edge_(edge)
  {
  }

  Cell
  of(const Eigen::Vector3f& point) const
  {
    return toIndices(Eigen::Vector3f((point - lower_) / edge_), Cell::Constant(most)) +
           2;
  }

  /** \brief The lower corner of a cell. */
  Eigen::Vector3f
  cornerOf(const Cell& cell) const
  {
    return lower_ + edge_ * (cell.array() - 2).cast<float>().matrix();
  }

  float
  edge() const
  {
    return edge_;
  }

private:
  Eigen::Vector3f lower_;
  float edge_;
};

/** \brief Numbers the keys that it is given in the order in which they come first. */
class KeyTable {
public:
  /** \param[in] keys as many different ones as are expected; it grows for more */
  explicit KeyTable(std::size_t keys)
  {
    std::size_t size = 64;
    while (size < 2 * keys)
      size *= 2;
    resize(size);
  }

  /** \brief Have memory fetch what the number of a key is found by. */
  void
  prefetch(std::uint64_t key) const
  {
    __builtin_prefetch(&slots_[firstSlotOf(key)], 1);
  }

  /** \brief The number of a key; a new one gets the next. */
  int
  add(std::uint64_t key)
  {
    const std::size_t slot = slotOf(key);
    if (slots_[slot].number >= 0)
      return slots_[slot].number;
    slots_[slot] = {key, size_};
    if (2 * static_cast<std::size_t>(++size_) > slots_.size())
      resize(2 * slots_.size());
    return size_ - 1;
  }

  /** \brief The number of a key; -1: it has none. */
  int
  find(std::uint64_t key) const
  {
    return slots_[slotOf(key)].number;
  }

  /** \brief How many keys have a number. */
  int
  size() const
  {
    return size_;
  }

private:
  struct Slot {
    std::uint64_t key;
    int number;
  };

  /** By Fibonacci hashing. */
  std::size_t
  firstSlotOf(std::uint64_t key) const
  {
    return key * 0x9e3779b97f4a7c15u >> shift_;
  }

  /** Its own, or the next free one. */
  std::size_t
  slotOf(std::uint64_t key) const
  {
    std::size_t slot = firstSlotOf(key);
    while (slots_[slot].number >= 0 && slots_[slot].key != key)
      slot = (slot + 1) & (slots_.size() - 1);
    return slot;
  }

  void
  resize(std::size_t size)
  {
    std::vector<Slot> old(size, {0, -1});
    old.swap(slots_);
    for (shift_ = 64; size > 1; size /= 2)
      --shift_;
    for (const Slot& slot : old)
      if (slot.number >= 0)
        slots_[slotOf(slot.key)] = slot;
  }

  std::vector<Slot> slots_;
  int shift_ = 0;
  int size_ = 0;
};

/** \brief A cloud sorted by the cells that its points lie in. */
class CellGrid {
public:
  CellGrid(const Points& cloud, float edge)
  : cells_(boxOf(cloud), edge)
  , table_(cloud.cols() / 4)
  {
    std::vector<int> cell_of(cloud.cols());
    for (Eigen::Index i = 0; i < cloud.cols(); ++i) {
      const Cell cell = cells_.of(cloud.col(i));
      cell_of[i] = table_.add(keyOf(cell));
      if (cell_of[i] == static_cast<int>(occupied_.size()))
        occupied_.push_back(cell);
    }
    begin_.assign(occupied_.size() + 1, 0);
    for (const int cell : cell_of)
      ++begin_[cell + 1];
    for (std::size_t c = 0; c < occupied_.size(); ++c)
      begin_[c + 1] += begin_[c];
    order_.resize(cloud.cols());
    std::vector<int> next(begin_.begin(), begin_.end() - 1);
    for (Eigen::Index i = 0; i < cloud.cols(); ++i)
      order_[next[cell_of[i]]++] = static_cast<int>(i);
  }

  const CellLattice&
  cells() const
  {
    return cells_;
  }

  /** \brief The cells that hold points. */
  const std::vector<Cell>&
  occupied() const
  {
    return occupied_;
  }

  /** \brief The points of all cells, cell by cell. */
  const std::vector<int>&
  order() const
  {
    return order_;
  }

  /** \brief The number of a cell among the occupied ones; -1: it is empty. */
  int
  find(const Cell& cell) const
  {
    return table_.find(keyOf(cell));
  }

  /** \brief Where the points of an occupied cell begin; those of the next are its end.
   */
  int
  begin(int cell) const
  {
    return begin_[cell];
  }

private:
  CellLattice cells_;
  KeyTable table_;
  std::vector<Cell> occupied_;
  std::vector<int> begin_, order_;
};

} // namespace kss
} // namespace pcl
