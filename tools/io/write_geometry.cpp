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

using Writer = void (*)(std::ostream&, const Geometry&);

/** Numbers from text have no type to keep, and most programs read floats only. */
bool
suitsFloats(const Geometry& geometry)
{
  return geometry.from_text && singlePrecisionError(boundingBox(geometry)) < NEGLIGIBLE;
}

Writer
writerOf(FileFormat format)
{
  switch (format) {
  case FileFormat::PCD:
    return writePCD;
  case FileFormat::PLY:
    return writePLY;
  case FileFormat::OBJ:
    return writeOBJ;
  case FileFormat::STL:
    return writeSTL;
  case FileFormat::OFF:
    return writeOFF;
  case FileFormat::TEXT:
    return writeText;
  }
  throw std::logic_error("format without a writer");
}

} // namespace

void
writeGeometry(const Geometry& geometry, FileFormat format, std::ostream& stream)
{
  const Writer write = writerOf(format);
  const bool has_types = format == FileFormat::PCD || format == FileFormat::PLY;
  if (!has_types || !suitsFloats(geometry))
    return write(stream, geometry);
  Geometry narrow = geometry;
  setCoordinateType(narrow, pcl::PCLPointField::FLOAT32);
  write(stream, narrow);
}

} // namespace tool
