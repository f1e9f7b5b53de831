/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "write_geometry.h"

#include "format_writers.h"

#include <stdexcept>

namespace tool {
namespace {

/** Less than the last digit that matters in any use of a point cloud. */
constexpr double NEGLIGIBLE = 1e-6;

/** Numbers from text have no type to keep, and most programs read floats only. */
bool
suitsFloats(const Geometry& geometry)
{
  return geometry.from_text && singlePrecisionError(boundingBox(geometry)) < NEGLIGIBLE;
}

void
writeAs(FileFormat format, std::ostream& stream, const Geometry& geometry)
{
  switch (format) {
  case FileFormat::PCD:
    return writePCD(stream, geometry);
  case FileFormat::PLY:
    return writePLY(stream, geometry);
  case FileFormat::OBJ:
    return writeOBJ(stream, geometry);
  case FileFormat::STL:
    return writeSTL(stream, geometry);
  case FileFormat::OFF:
    return writeOFF(stream, geometry);
  case FileFormat::PTX:
    return writePTX(stream, geometry);
  case FileFormat::TEXT:
  case FileFormat::CSV:
  case FileFormat::PTS:
    return writeText(stream, geometry, format);
  }
  throw std::logic_error("format without a writer");
}

} // namespace

void
writeGeometry(const Geometry& geometry, FileFormat format, std::ostream& stream)
{
  const bool has_types = format == FileFormat::PCD || format == FileFormat::PLY;
  if (!has_types || !suitsFloats(geometry))
    return writeAs(format, stream, geometry);
  Geometry narrow = geometry;
  setCoordinateType(narrow, pcl::PCLPointField::FLOAT32);
  writeAs(format, stream, narrow);
}

} // namespace tool
