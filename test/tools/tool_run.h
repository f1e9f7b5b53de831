/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "own_folder.h"
#include "tool_path.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include <sys/wait.h>

namespace kss_test {

using Points = std::vector<Eigen::Vector3d>;

inline constexpr int blob_points = 1500;

/** \brief A point of a closed surface without any symmetry. */
inline Eigen::Vector3d
onBlob(double z, double angle)
{
  const double radius = std::sqrt(1.0 - z * z);
  const Eigen::Vector3d p(radius * std::cos(angle), radius * std::sin(angle), z);
  return p * (1.0 + 0.5 * p.x() * p.y() + 0.4 * std::pow(p.z(), 3) + 0.3 * p.x());
}

/** \brief Random points of it: ICP would lock into the regular pattern of a lattice, a
 * few points beside the right place. */
inline Points
blob()
{
  std::mt19937 random(1);
  const auto uniform = [&] { return random() / 4294967296.0; };
  Points points;
  for (int i = 0; i < blob_points; ++i) {
    const double z = 2.0 * uniform() - 1.0;
    points.push_back(onBlob(z, 2.0 * M_PI * uniform()));
  }
  return points;
}

/** \brief A lattice of it: the points 13 and 21 places on are neighbours. */
inline Points
latticeOfBlob()
{
  Points points;
  for (int i = 0; i < blob_points; ++i)
    points.push_back(
        onBlob(1.0 - (2.0 * i + 1.0) / blob_points, i * M_PI * (3.0 - std::sqrt(5.0))));
  return points;
}

inline Points
moved(const Points& points, const Eigen::Affine3d& transform)
{
  Points result;
  for (const auto& point : points)
    result.push_back(transform * point);
  return result;
}

/** \brief A large rotation, a scale, and a place in the world. */
inline Eigen::Affine3d
similarity(double scale)
{
  return Eigen::Translation3d(4512345.678, 512345.678, 1234.5) *
         Eigen::AngleAxisd(2.2, Eigen::Vector3d(1, -2, 3).normalized()) *
         Eigen::Scaling(scale);
}

inline double
largestDistance(const Points& a, const Points& b)
{
  EXPECT_EQ(a.size(), b.size());
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size() && i < b.size(); ++i)
    largest = std::max(largest, (a[i] - b[i]).norm());
  return largest;
}

inline std::string
contentOf(const std::filesystem::path& path)
{
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream content;
  content << stream.rdbuf();
  return content.str();
}

/** \brief What a run of the tool left on the console, and its exit status. */
struct Outcome {
  int status;
  std::string output, errors;
};

/** \brief Runs the tool in a folder with some files. */
class ToolRun : public OwnFolder {
protected:
  using OwnFolder::write;

  void
  SetUp() override
  {
    std::filesystem::create_directories(directory_ / "console");
    // a source near the origin, a target far away
    write("source.xyz", blob());
    write("target.xyz", moved(blob(), similarity(2.5)));
    write("rigid.xyz", moved(blob(), similarity(1.0)));
    write("line.xyz", Points{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}});
    write("triangle.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
    write("short.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n");
    write("shear.txt", "1 0 0 0\n0 1 0.5 0\n0 0 1 0\n0 0 0 1\n");
    write("binary.xyz", "1 2 3\n4 \x1b[31m\v\a\r 6\n");
    std::filesystem::create_directory(directory_ / "a_directory.ply");
  }

  void
  write(const std::string& name, const Points& points) const
  {
    std::ofstream stream(directory_ / name);
    stream.precision(17);
    for (const auto& point : points)
      stream << point.x() << ' ' << point.y() << ' ' << point.z() << '\n';
  }

  Points
  read(const std::string& name) const
  {
    std::ifstream stream(directory_ / name);
    Points points;
    for (Eigen::Vector3d p; stream >> p.x() >> p.y() >> p.z();)
      points.push_back(p);
    return points;
  }

  std::filesystem::path
  path(const std::string& name) const
  {
    return directory_ / name;
  }

  std::string
  content(const std::string& name) const
  {
    return contentOf(directory_ / name);
  }

  bool
  exists(const std::string& name) const
  {
    return std::filesystem::exists(directory_ / name);
  }

  /** \brief Run the tool in the directory with its files. */
  Outcome
  run(const std::string& arguments) const
  {
    const std::string command = "cd '" + directory_.string() + "' && '" + toolPath() +
                                "' " + arguments +
                                " > console/output 2> console/errors";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content("console/output"),
            content("console/errors")};
  }

  /** \brief Run a small search on the CPU, which is quick and the same everywhere. */
  Outcome
  search(const std::string& arguments) const
  {
    return run("--device host --points 300 " + arguments);
  }
};

} // namespace kss_test
