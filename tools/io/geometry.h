/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/PCLPointCloud2.h>
#include <pcl/Vertices.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <optional>
#include <string>
#include <vector>

namespace tool {

/** \brief The positions of a cloud, whatever type they are stored in. */
using Points = std::vector<Eigen::Vector3d>;

/** \brief The statements of an OBJ file in their order, so that all of them can be
 * written again.
 */
struct OBJStatements {
  /** \brief The lines; those of normals are their keywords alone, and those of points
   * their keywords and colours. */
  std::string text;
  Points normals;
  /** \brief What other formats cannot hold of them, in words for the user. */
  std::vector<std::string> others;
};

/** \brief How the numbers of a file stand in it. */
enum class Storage { UNSAID, TEXT, BINARY, BINARY_BIG, COMPRESSED };

/** \brief What a point cloud or mesh file holds. */
struct Geometry {
  /** \brief All fields as the file names them; x, y and z are of any numeric type. */
  pcl::PCLPointCloud2 cloud;
  /** \brief The faces of a mesh, by the numbers of their points; empty for points. */
  std::vector<pcl::Vertices> faces;
  /** \brief Where and how the sensor stood, for files that say so. */
  Eigen::Vector4f sensor_origin = Eigen::Vector4f::Zero();
  Eigen::Quaternionf sensor_orientation = Eigen::Quaternionf::Identity();
  /** \brief Whether the numbers were written out in the file, so that their type is not
   * the file's but the reader's choice. */
  bool from_text = false;
  /** \brief How the numbers stood in the file, for formats that have more than one way.
   */
  Storage storage = Storage::UNSAID;
  /** \brief What marks the line that names the columns of a text as a comment, where
   * there is such a line. */
  std::optional<std::string> header_mark;
  /** \brief What somebody has written about the file, line by line. */
  std::vector<std::string> comments;
  /** \brief The statements of an OBJ file, which it is written with again. */
  OBJStatements statements;
  /** \brief What the reader took for granted, in words for the user. */
  std::vector<std::string> assumed;
  /** \brief What else the file holds, which was not read. */
  std::vector<std::string> left_out;
};

/** \brief The positions of all points, in their order; points that are not finite too.
 */
Points
positionsOf(const Geometry& geometry);

/** \brief The normals of all points as the file has them, in their order; none where it
 * has none.
 */
Points
normalsOf(const Geometry& geometry);

/** \brief Whether the points have normals that readers of columns without names would
 * take for some, as they have unit length.
 */
bool
areNormalsByLength(const Geometry& geometry);

/** \brief The box around all finite points; empty where there are none. */
Eigen::AlignedBox3d
boundingBox(const Geometry& geometry);

/** \brief How far single precision rounds coordinates in a box, as a fraction of the
 * box's diagonal.
 */
double
singlePrecisionError(const Eigen::AlignedBox3d& box);

/** \brief Whether single precision rounds coordinates in a box so much that a
 * registration feels it.
 */
bool
singlePrecisionIsCoarse(const Eigen::AlignedBox3d& box);

/** \brief Whether x, y and z are stored in single precision. */
bool
hasSinglePrecision(const Geometry& geometry);

/** \brief Store x, y and z as another floating point type; all else stays.
 * \param[in] datatype pcl::PCLPointField::FLOAT32 or FLOAT64
 */
void
setCoordinateType(Geometry& geometry, std::uint8_t datatype);

/** \brief Apply a similarity: positions take all of it, normals and the sensor's
 * orientation the rotation, points that are not finite stay as they are.
 *
 * Coordinates become doubles where they were no floats, or where floats would be too
 * coarse in their new place.
 */
Geometry
transformed(Geometry geometry, const Eigen::Matrix4d& similarity);

} // namespace tool
