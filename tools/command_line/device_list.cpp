/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "device_list.h"

#include "io/fields.h"
#include "registration.h"

#include <pcl/registration/kss/devices.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace tool {
namespace {

/** Points of a closed surface without any symmetry. */
pcl::PCLPointCloud2
lump()
{
  constexpr int POINTS = 200;
  std::vector<double> coordinates;
  for (int i = 0; i < POINTS; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / POINTS, angle = 2.4 * i;
    const double x = std::sqrt(1.0 - z * z) * std::cos(angle);
    const double y = std::sqrt(1.0 - z * z) * std::sin(angle);
    const double radius = 1.0 + 0.5 * x * y + 0.4 * z * z * z + 0.3 * x;
    coordinates.insert(coordinates.end(), {radius * x, radius * y, radius * z});
  }
  return cloudOfDoubles(coordinates, {"x", "y", "z"});
}

/** Where a registration runs. */
std::string
deviceOfTrial(const pcl::kss::Settings& settings)
{
  pcl::kss::Settings small;
  small.device = settings.device;
  small.threads = settings.threads;
  small.estimate_scale = false;
  small.sample_points = 100;
  small.even_rotations = 100;
  const pcl::PCLPointCloud2 cloud = lump();
  const Result result = registerClouds(cloud, cloud, small, {}, 1, false);
  if (result.cause == pcl::kss::FailureCause::DEVICE)
    throw std::runtime_error(result.reason);
  return result.device;
}

} // namespace

std::string
deviceList(const pcl::kss::Settings& settings)
{
  const std::string used = deviceOfTrial(settings);
  std::vector<std::string> names = pcl::kss::openCLDeviceNames();
  names.push_back("host");
  std::string list;
  for (const std::string& name : names)
    // several devices of a platform are used together, and named so
    list += (used.find(name) != std::string::npos ? "* " : "  ") + name + '\n';
  return list + "* runs registrations with --device " + settings.device + '\n';
}

void
checkDevice(const std::string& device)
{
  if (device == "auto" || device == "host")
    return;
  const auto names = pcl::kss::openCLDeviceNames();
  if (std::none_of(names.begin(), names.end(), [&](const std::string& name) {
        return name.find(device) != std::string::npos;
      }))
    throw std::runtime_error("--device " + device +
                             ": there is no such OpenCL device; " +
                             "use host, or a name that --list-devices shows");
}

} // namespace tool
