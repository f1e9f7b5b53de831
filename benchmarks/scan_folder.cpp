/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "scan_folder.h"

#include <io/fields.h>
#include <io/file_format.h>
#include <io/read_geometry.h>
#include <io/write_geometry.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <random>
#include <stdexcept>

namespace benchmarks {
namespace {

/** \brief A rotation drawn evenly from all there are. */
Eigen::Quaterniond
randomTurn(std::mt19937& random)
{
  std::normal_distribution<double> normal;
  const double w = normal(random), x = normal(random), y = normal(random),
               z = normal(random);
  return Eigen::Quaterniond(w, x, y, z).normalized();
}

Eigen::Isometry3d
randomFrame(Turn turn, double size, std::mt19937& random)
{
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  if (turn == Turn::YAW)
    frame.rotate(
        Eigen::AngleAxisd(std::uniform_real_distribution<double>(-M_PI, M_PI)(random),
                          Eigen::Vector3d::UnitZ()));
  if (turn == Turn::ANY) {
    std::normal_distribution<double> normal(0.0, size / 2.0);
    const double x = normal(random), y = normal(random), z = normal(random);
    frame.translation() = Eigen::Vector3d(x, y, z);
    frame.rotate(randomTurn(random));
  }
  return frame;
}

nlohmann::json
jsonOf(const Eigen::Matrix4d& matrix)
{
  nlohmann::json rows = nlohmann::json::array();
  for (int row = 0; row < 4; ++row)
    rows.push_back({matrix(row, 0), matrix(row, 1), matrix(row, 2), matrix(row, 3)});
  return rows;
}

Eigen::Matrix4d
matrixOf(const nlohmann::json& rows)
{
  Eigen::Matrix4d matrix;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column)
      matrix(row, column) = rows.at(row).at(column).get<double>();
  return matrix;
}

/** \brief Poses of a few digits are no exact rotations: the nearest one. */
Eigen::Isometry3d
rigid(const Eigen::Matrix4d& matrix)
{
  const Eigen::Affine3d pose(matrix);
  Eigen::Isometry3d nearest = Eigen::Isometry3d::Identity();
  nearest.linear() = pose.rotation();
  nearest.translation() = pose.translation();
  return nearest;
}

/** \brief Where a scan lies in its own frame, and how far it reaches from there: what
 * errors of its pose are measured by. */
struct Extent {
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  double radius = 0.0; ///< root mean square
};

Extent
extentOf(const tool::Geometry& geometry)
{
  Extent extent;
  double number = 0.0, squares = 0.0;
  for (const Eigen::Vector3d& point : tool::positionsOf(geometry))
    if (point.allFinite()) {
      number += 1.0;
      extent.centroid += point;
      squares += point.squaredNorm();
    }
  extent.centroid /= number;
  extent.radius = std::sqrt(squares / number - extent.centroid.squaredNorm());
  return extent;
}

void
writeFile(const std::filesystem::path& path,
          const std::function<void(std::ostream&)>& writer)
{
  std::ofstream file(path, std::ios::binary);
  if (file)
    writer(file);
  if (!file.flush())
    throw std::runtime_error("cannot write " + path.string());
}

} // namespace

VirtualScan
virtualScan(const Cloud& cloud,
            const std::string& thing,
            std::size_t view,
            const Eigen::Isometry3d& pose)
{
  std::vector<double> numbers;
  for (const pcl::PointXYZ& point : cloud)
    numbers.insert(numbers.end(), {point.x, point.y, point.z});
  VirtualScan scan{{}, thing, std::to_string(view), pose};
  scan.geometry.cloud = tool::cloudOfDoubles(numbers, {"x", "y", "z"});
  tool::setCoordinateType(scan.geometry, pcl::PCLPointField::FLOAT32);
  return scan;
}

void
move(VirtualScans& scans, Turn turn, unsigned int seed)
{
  std::mt19937 random(seed);
  for (VirtualScan& scan : scans) {
    const double size = tool::boundingBox(scan.geometry).diagonal().norm();
    const Eigen::Isometry3d frame = randomFrame(turn, size, random);
    // where the sensor stood would give the frame away
    scan.geometry.sensor_origin.setZero();
    scan.geometry.sensor_orientation.setIdentity();
    scan.geometry = tool::transformed(std::move(scan.geometry), frame.matrix());
    scan.geometry.sensor_origin.setZero();
    scan.geometry.sensor_orientation.setIdentity();
    scan.pose = scan.pose * frame.inverse();
  }
}

void
shuffle(VirtualScans& scans, unsigned int seed)
{
  std::mt19937 random(seed);
  std::shuffle(scans.begin(), scans.end(), random);
}

void
writeScans(const VirtualScans& scans, const std::string& folder)
{
  const std::filesystem::path path(folder);
  std::filesystem::create_directories(path);
  nlohmann::json truth;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    const std::string number = std::to_string(i);
    const std::string file =
        "scan_" + std::string(3 - std::min<std::size_t>(3, number.size()), '0') +
        number + ".pcd";
    tool::Geometry points = scans[i].geometry;
    points.faces.clear();
    points.storage = tool::Storage::BINARY;
    writeFile(path / file, [&](std::ostream& stream) {
      tool::writeGeometry(points, tool::FileFormat::PCD, stream);
    });
    const Extent extent = extentOf(points);
    const Eigen::Vector3d& centroid = extent.centroid;
    truth["scans"].push_back({{"file", file},
                              {"thing", scans[i].thing},
                              {"name", scans[i].name},
                              {"centroid", {centroid.x(), centroid.y(), centroid.z()}},
                              {"radius", extent.radius},
                              {"transformation", jsonOf(scans[i].pose.matrix())}});
  }
  writeFile(path / "truth.json",
            [&](std::ostream& stream) { stream << truth.dump(1) << '\n'; });
}

VirtualScans
readScans(const std::string& truth)
{
  std::ifstream file(truth);
  if (!file)
    throw std::runtime_error("cannot read " + truth);
  VirtualScans scans;
  try {
    const std::filesystem::path folder = std::filesystem::path(truth).parent_path();
    const nlohmann::json contents = nlohmann::json::parse(file);
    for (const nlohmann::json& entry : contents.at("scans")) {
      const std::string name = entry.at("file");
      scans.push_back({tool::readGeometry((folder / name).string()), entry.at("thing"),
                       entry.value("name", name),
                       entry.contains("transformation") // it is in the thing's frame
                           ? rigid(matrixOf(entry["transformation"]))
                           : Eigen::Isometry3d::Identity()});
    }
  }
  catch (const nlohmann::json::exception& error) {
    throw std::runtime_error(truth + ": " + error.what());
  }
  return scans;
}

} // namespace benchmarks
