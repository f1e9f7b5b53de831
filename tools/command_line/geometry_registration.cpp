/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "geometry_registration.h"

#include "io/mesh_sampling.h"

namespace tool {
namespace {

/** Points that stand for a mesh; none for what is no mesh. */
pcl::PCLPointCloud2
samplesOf(const Geometry& geometry, std::size_t number)
{
  return geometry.faces.empty() ? pcl::PCLPointCloud2()
                                : cloudOf(sampleMesh(geometry, number));
}

} // namespace

std::vector<std::string>
warningsOf(const Geometry& geometry)
{
  std::vector<std::string> warnings = geometry.assumed;
  if (hasSinglePrecision(geometry) && singlePrecisionIsCoarse(boundingBox(geometry)))
    warnings.push_back(
        "its coordinates are far from the origin and held in single precision, which "
        "rounds them; doubles in .ply or .xyz would be exact");
  return warnings;
}

Result
registerGeometries(const Geometry& source,
                   const Geometry& target,
                   const std::optional<Eigen::Matrix4d>& guess,
                   const Options& options,
                   bool with_fitness)
{
  const pcl::PCLPointCloud2 source_samples = samplesOf(source, options.samples);
  const pcl::PCLPointCloud2 target_samples = samplesOf(target, options.samples);
  return registerClouds(source.faces.empty() ? source.cloud : source_samples,
                        target.faces.empty() ? target.cloud : target_samples,
                        options.settings, guess, options.iterations, with_fitness);
}

bool
saysNothingOfClouds(const Result& result)
{
  return result.cause == pcl::kss::FailureCause::DEVICE ||
         result.cause == pcl::kss::FailureCause::OTHER;
}

} // namespace tool
