/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include <pcl/registration/kss/detail/grid_index.h>

#include "evaluators/shift_sums.h"
#include "support/parallel.h"

#include <array>
#include <cstring>

namespace pcl {
namespace kss {
namespace {

constexpr int lanes = ShiftLattice::lanes;
constexpr int rows_at_once = ShiftLattice::rows_at_once;

/** The sums of a row's bytes, two to a word: those of whole words, modulo their size,
 * less those of their upper bytes are those of the lower ones. */
class RowSums {
public:
  void
  add(const std::uint8_t* bytes)
  {
    Words words;
    std::memcpy(&words, bytes, sizeof words);
    both_ += words;
    upper_ += words >> 8;
  }

  void
  write(std::uint16_t* sums) const
  {
    const Words lower = both_ - (upper_ << 8);
    for (int i = 0; i < lanes / 2; ++i) {
      sums[2 * i + !is_little_endian] = lower[i];
      sums[2 * i + is_little_endian] = upper_[i];
    }
  }

private:
  /** What compilers do not make of a loop over an array. */
  using Words [[gnu::vector_size(lanes)]] = std::uint16_t;

  static constexpr bool is_little_endian = __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__;

  Words both_ = {}, upper_ = {};
};

/** Rows of sums, \ref rows_at_once: of the fields under each point. */
void
sumRows(const std::uint8_t* field,
        const std::uint32_t* first,
        int points,
        const std::uint32_t* rows,
        std::uint16_t* sums)
{
  constexpr int few = 4; // whose sums stay in registers
  for (int row = 0; row < rows_at_once; row += few) {
    RowSums sum[few];
    for (int i = 0; i < points; ++i) {
      const std::uint8_t* const under = field + first[i];
      for (int r = 0; r < few; ++r)
        sum[r].add(under + rows[row + r]);
    }
    for (int r = 0; r < few; ++r)
      sum[r].write(sums + (row + r) * lanes);
  }
}

class HostShiftSums : public ShiftSums {
public:
  explicit HostShiftSums(unsigned int threads)
  : threads_(threads)
  {
  }

  void
  setField(const Points& cloud, const ShiftLattice& lattice) override
  {
    field_ = lattice.field(cloud);
    rows_ = lattice.rows();
    last_ = lattice.last();
    nodes_ = lattice.nodes();
  }

  std::vector<std::uint16_t>
  sums(const Points& points, const std::vector<Placement>& placements) override
  {
    const std::size_t block = lanes * rows_.size();
    std::vector<std::uint16_t> sums(block * placements.size());
    inParallel(placements.size(), threads_, 16, [&](std::ptrdiff_t i) {
      std::uint32_t first[most_points];
      for (Eigen::Index p = 0; p < points.cols(); ++p)
        first[p] = firstOf(placements[i] * points.col(p).homogeneous());
      for (std::size_t row = 0; row < rows_.size(); row += rows_at_once)
        sumRows(field_.data(), first, static_cast<int>(points.cols()),
                rows_.data() + row, sums.data() + i * block + row * lanes);
    });
    return sums;
  }

private:
  std::uint32_t
  firstOf(const Eigen::Vector3f& node) const
  {
    const Eigen::Array3i at = toIndices(node, last_);
    return nodes_[0][at[0]] + nodes_[1][at[1]] + nodes_[2][at[2]];
  }

  unsigned int threads_;
  std::vector<std::uint8_t> field_;
  std::vector<std::uint32_t> rows_;
  Eigen::Array3i last_;
  std::array<std::vector<std::uint32_t>, 3> nodes_;
};

} // namespace

std::unique_ptr<ShiftSums>
makeHostShiftSums(unsigned int threads)
{
  return std::make_unique<HostShiftSums>(threads);
}

} // namespace kss
} // namespace pcl
