/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "write_geometry.h"

#include "format_writers.h"

#include <pcl/io/pcd_io.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>

namespace tool {
namespace {

/** Less than the last digit that matters in any use of a point cloud. */
constexpr double NEGLIGIBLE = 1e-6;

using Writer = void (*)(std::ostream&, const Geometry&);

Writer
writerOf(FileFormat format)
{
  switch (format) {
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
  case FileFormat::PCD:
    break;
  }
  throw std::logic_error("format without a writer");
}

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

void
writePCD(const Geometry& geometry, const std::string& path)
{
  if (pcl::PCDWriter().writeBinary(path, geometry.cloud, geometry.sensor_origin,
                                   geometry.sensor_orientation) < 0)
    throw std::runtime_error("cannot be written");
}

void
writeStream(Writer write, const Geometry& geometry, const std::string& path)
{
  std::ofstream stream(path, std::ios::binary);
  write(stream, geometry);
  stream.close();
  if (!stream)
    throw std::runtime_error(std::string("cannot be written: ") + std::strerror(errno));
}

} // namespace

void
writeGeometry(const Geometry& geometry, FileFormat format, const std::string& path)
{
  if (format == FileFormat::PCD)
    writePCD(withSensibleType(geometry), path);
  else if (format == FileFormat::PLY)
    writeStream(writerOf(format), withSensibleType(geometry), path);
  else
    writeStream(writerOf(format), geometry, path);
}

} // namespace tool
