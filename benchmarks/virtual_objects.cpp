/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "scanners.h"
#include "triangle_mesh.h"
#include "virtual_sets.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <random>

namespace benchmarks {
namespace {

constexpr double object_size = 0.2;

/** \brief Views from all around, from somewhat above and now and then from below; few
 * of them go around a part of it, so that neighbours have half in common.
 */
VirtualScans
viewsOf(const TriangleMesh& mesh,
        const std::string& thing,
        std::size_t views,
        unsigned int seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> jitter(-5.0, 5.0), height(-20.0, 45.0);
  const double step = std::min(360.0 / views, 55.0);
  VirtualScans scans;
  for (std::size_t i = 0; i < views; ++i) {
    const double around = (step * i + jitter(random)) * M_PI / 180.0;
    const double up = height(random) * M_PI / 180.0;
    const Eigen::Vector3d direction(std::cos(up) * std::cos(around),
                                    std::cos(up) * std::sin(around), std::sin(up));
    const Eigen::Isometry3d camera =
        lookAt(3.0 * object_size * direction, Eigen::Vector3d::Zero());
    // the object fills about half of the image's height
    const Cloud::Ptr cloud = photograph(mesh, camera, 1000.0, 0.001 * object_size,
                                        seed + 100 * static_cast<unsigned int>(i));
    scans.push_back(virtualScan(*cloud, thing, i, camera));
  }
  return scans;
}

/** \brief An object, read or made up. */
VirtualScans
objectScans(const std::string& model, std::size_t scans, unsigned int seed)
{
  if (model.empty())
    return viewsOf(makeLump(seed, object_size), "lump " + std::to_string(seed), scans,
                   seed);
  return viewsOf(readMesh(model, object_size),
                 std::filesystem::path(model).stem().string(), scans, seed);
}

void
append(VirtualScans& all, VirtualScans scans)
{
  for (VirtualScan& scan : scans)
    all.push_back(std::move(scan));
}

} // namespace

VirtualScans
turntableScans(const std::vector<std::string>& models,
               std::size_t scans,
               unsigned int seed)
{
  VirtualScans all;
  for (std::size_t i = 0; i < std::max<std::size_t>(1, models.size()); ++i)
    append(all, objectScans(models.empty() ? "" : models[i], scans == 0 ? 10 : scans,
                            seed + 100 * static_cast<unsigned int>(i)));
  return all;
}

VirtualScans
bagScans(const std::vector<std::string>& models, unsigned int seed)
{
  std::mt19937 random(seed);
  std::uniform_int_distribution<std::size_t> views(4, 6);
  VirtualScans all;
  for (std::size_t i = 0; i < std::max<std::size_t>(5, models.size()); ++i)
    append(all, objectScans(i < models.size() ? models[i] : "", views(random),
                            seed + 100 * static_cast<unsigned int>(i)));
  // of one plan with other furniture, scans of walls alone would fit both
  append(all, roomScans(views(random), seed));
  append(all, roomScans(views(random), seed + 100, largeRoom()));
  return all;
}

} // namespace benchmarks
