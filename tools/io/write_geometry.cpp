/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "write_geometry.h"

#include "format_writers.h"

#include <pcl/io/pcd_io.h>

#include <stdexcept>

namespace tool {
namespace {

/** Less than the last digit that matters in any use of a point cloud. */
constexpr double NEGLIGIBLE = 1e-6;

using Writer = void (*)(std::ostream&, const Geometry&);

/** Numbers from text have no type to keep, and most programs read floats only. */
Geometry
withSensibleType(const Geometry& geometry)
{
  Geometry result = geometry;
  if (geometry.from_text &&
      singlePrecisionError(boundingBox(positionsOf(geometry))) < NEGLIGIBLE)
    setCoordinateType(result, pcl::PCLPointField::FLOAT32);
  return result;
}

/** PCL would map the file into memory, where a full disk ends the program. */
void
writePCD(std::ostream& stream, const Geometry& geometry)
{
  stream << pcl::PCDWriter().generateHeaderBinary(
                geometry.cloud, geometry.sensor_origin, geometry.sensor_orientation)
         << "DATA binary\n";
  stream.write(reinterpret_cast<const char*>(geometry.cloud.data.data()),
               static_cast<std::streamsize>(geometry.cloud.data.size()));
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
  const bool has_types = format == FileFormat::PCD || format == FileFormat::PLY;
  writerOf(format)(stream, has_types ? withSensibleType(geometry) : geometry);
}

} // namespace tool
