/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "fields.h"
#include "format_readers.h"
#include "text_lines.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

namespace tool {
namespace {

const std::vector<double>&
nextNumbers(TextLines& lines, std::size_t number, const char* what)
{
  if (!lines.next())
    throw std::runtime_error(
        "holds fewer lines than its scans announce; the file is damaged or incomplete");
  const auto& numbers = lines.numbers();
  if (numbers.size() != number)
    lines.fail("has " + std::to_string(numbers.size()) + " numbers instead of " +
               std::to_string(number) + ' ' + what +
               "; the file is damaged or incomplete");
  return numbers;
}

/** A number of rows or columns of the line that the lines are at. */
std::uint64_t
countOf(const TextLines& lines, const std::vector<double>& numbers)
{
  const double count = numbers.size() == 1 ? numbers[0] : -1.0;
  if (!(count >= 0.0 && count <= std::numeric_limits<std::int32_t>::max()) ||
      count != std::floor(count))
    lines.fail("is not the number of columns or rows of a scan");
  return static_cast<std::uint64_t>(count);
}

/** The place of a scan, whose points are rows that are multiplied from the left. */
Eigen::Affine3d
readPlace(TextLines& lines)
{
  for (int i = 0; i < 4; ++i) // where the scanner stood, which the matrix says again
    nextNumbers(lines, 3, "of the scanner's place");
  Eigen::Matrix4d matrix;
  for (int row = 0; row < 4; ++row) {
    const auto& numbers = nextNumbers(lines, 4, "of the scan's matrix");
    matrix.row(row) = Eigen::Map<const Eigen::RowVector4d>(numbers.data());
    if (!matrix.row(row).allFinite() || numbers[3] != (row == 3 ? 1.0 : 0.0))
      lines.fail("is no row of a scan's matrix, which ends with 0, and in its last row "
                 "with 1");
  }
  return Eigen::Affine3d(matrix.transpose());
}

/** Points, and what colours they have. */
class Scans {
public:
  void
  add(const TextLines& lines,
      const Eigen::Affine3d& place,
      const double* numbers,
      std::size_t size)
  {
    const Eigen::Vector3d point(numbers[0], numbers[1], numbers[2]);
    if (point.isZero(0.0) || !point.allFinite()) { // the scanner saw nothing there
      ++missing_;
      return;
    }
    if (columns_ == 0)
      columns_ = size;
    if (size != columns_)
      lines.fail("has " + std::to_string(size) + " numbers instead of " +
                 std::to_string(columns_) +
                 ", as the points before it; save all scans with colours or none");
    const Eigen::Vector3d placed = place * point;
    values_.insert(values_.end(), placed.begin(), placed.end());
    values_.push_back(numbers[3]);
    std::uint32_t colour = 0;
    for (std::size_t i = 4; i < size; ++i) {
      if (!(numbers[i] >= 0.0 && numbers[i] <= 255.0))
        lines.fail("has a colour that is not between 0 and 255");
      colour = colour << 8 | static_cast<std::uint32_t>(std::lround(numbers[i]));
    }
    colours_.push_back(colour);
  }

  Geometry
  geometry() const
  {
    Geometry geometry;
    geometry.from_text = true;
    geometry.cloud = cloudOf();
    if (missing_ > 0)
      geometry.assumed.push_back(
          std::to_string(missing_) +
          (missing_ == 1 ? " place of its grid has no point and is left out"
                         : " places of its grids have no point and are left out"));
    return geometry;
  }

private:
  pcl::PCLPointCloud2
  cloudOf() const
  {
    pcl::PCLPointCloud2 cloud;
    for (const char* name : {"x", "y", "z", "intensity"})
      addField(cloud, name, pcl::PCLPointField::FLOAT64);
    const bool has_colours = columns_ == 7;
    if (has_colours)
      addField(cloud, "rgb", pcl::PCLPointField::FLOAT32);
    setNumberOfPoints(cloud, colours_.size());
    constexpr std::size_t numbers = 4;
    for (std::size_t i = 0; i < colours_.size(); ++i) {
      std::uint8_t* point = &cloud.data[i * cloud.point_step];
      std::memcpy(point, &values_[numbers * i], numbers * sizeof(double));
      if (has_colours)
        std::memcpy(point + cloud.fields.back().offset, &colours_[i],
                    sizeof colours_[i]);
    }
    return cloud;
  }

  std::size_t columns_ = 0, missing_ = 0;
  std::vector<double> values_;
  std::vector<std::uint32_t> colours_;
};

} // namespace

Geometry
readPTX(std::istream& stream)
{
  TextLines lines(stream, TextLines::Style::RAW);
  Scans scans;
  bool has_grid = false;
  while (lines.next()) {
    const std::uint64_t columns = countOf(lines, lines.numbers());
    const std::uint64_t rows = countOf(lines, nextNumbers(lines, 1, "of rows"));
    has_grid = has_grid || (columns > 1 && rows > 1);
    const Eigen::Affine3d place = readPlace(lines);
    for (std::uint64_t point = columns * rows; point > 0; --point) {
      if (!lines.next())
        throw std::runtime_error("holds fewer points than its scans announce; the file "
                                 "is damaged or incomplete");
      const auto& numbers = lines.numbers();
      if (numbers.size() != 4 && numbers.size() != 7)
        lines.fail("has " + std::to_string(numbers.size()) +
                   " numbers, which is not a point like x y z intensity or x y z "
                   "intensity r g b; the file is damaged or incomplete");
      scans.add(lines, place, numbers.data(), numbers.size());
    }
  }
  Geometry geometry = scans.geometry();
  if (has_grid)
    geometry.left_out.push_back("the grids of the scans");
  return geometry;
}

} // namespace tool
