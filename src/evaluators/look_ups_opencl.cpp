/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "evaluators/distances_of_devices.h"
#include "evaluators/look_up_field.h"
#include "geometry/clouds.h"
#include "geometry/distance_field.h"

#include <algorithm>
#include <tuple>

namespace pcl {
namespace kss {
namespace {

constexpr Eigen::Index lanes = 8; // of a tile of points

/** One cloud on the device: its points in tiles and its distance field. */
struct Cloud {
  Points all;
  cl::Buffer x, y, z, field;
  cl_uint points = 0;
  cl_float4 lower = {};
  cl_int4 size = {};
};

/** The look-ups of one device. */
class DeviceLookUps {
public:
  DeviceLookUps(std::shared_ptr<OpenCLProgram> program, unsigned int probes)
  : program_(std::move(program))
  , probes_(probes)
  {
  }

  void
  setClouds(const Points& source, const Points& target, float limit)
  {
    // what has not changed stays on the device
    if (limit != limit_)
      source_ = target_ = Cloud();
    limit_ = limit;
    for (const auto& [cloud, points] :
         {std::tie(source_, source), std::tie(target_, target)})
      if (!areEqual(cloud.all, points))
        cloud = upload(points);
  }

  void
  evaluate(const Placement* placements, std::size_t size, DirectedDistances* distances)
  {
    const double operations =
        static_cast<double>(source_.points) + static_cast<double>(target_.points);
    dispatches_.run(program_->limits(), size, 16 * sizeof(float), operations,
                    [&](std::size_t begin, std::size_t end) {
                      dispatch(placements + begin, end - begin, distances + begin);
                    });
  }

private:
  void
  dispatch(const Placement* placements, std::size_t size, DirectedDistances* distances)
  {
    const cl::Buffer candidates =
        program_->upload(placements->data(), size * Placement::SizeAtCompileTime);
    const cl::Buffer result = program_->allocate<float>(4 * size);
    program_->run("look_ups", size, source_.x, source_.y, source_.z, source_.points,
                  source_.field, source_.lower, source_.size, target_.x, target_.y,
                  target_.z, target_.points, target_.field, target_.lower, target_.size,
                  candidates, static_cast<cl_uint>(size), limit_, result);
    static_assert(sizeof(DirectedDistances) == 4 * sizeof(float),
                  "the kernel's float4");
    program_->download(result, &distances->source_to_target, 4 * size);
  }

  Cloud
  upload(const Points& points)
  {
    Cloud cloud;
    cloud.all = points;
    const Eigen::Index probes = std::min<Eigen::Index>(probes_, points.cols());
    const Eigen::Index filled = (probes + lanes - 1) / lanes * lanes;
    Eigen::MatrixX3f tiled(filled, 3);
    tiled.topRows(probes) = points.leftCols(probes).transpose();
    tiled.bottomRows(filled - probes).rowwise() = points.col(probes - 1).transpose();
    cloud.x = program_->upload(tiled.col(0).data(), filled);
    cloud.y = program_->upload(tiled.col(1).data(), filled);
    cloud.z = program_->upload(tiled.col(2).data(), filled);
    cloud.points = static_cast<cl_uint>(probes);
    const DistanceField field = lookUpField(points, limit_);
    cloud.field = program_->upload(field.distances().data(), field.distances().size());
    cloud.lower = {
        {field.lower().x(), field.lower().y(), field.lower().z(), field.inverseEdge()}};
    cloud.size = {{field.size().x(), field.size().y(), field.size().z(), 0}};
    return cloud;
  }

  std::shared_ptr<OpenCLProgram> program_;
  Dispatches dispatches_;
  unsigned int probes_;
  Cloud source_, target_;
  float limit_ = 0.0f;
};

} // namespace

std::unique_ptr<DistanceEvaluator>
makeOpenCLLookUps(const std::string& device,
                          unsigned int threads,
                          unsigned int probes)
{
  return std::make_unique<DistancesOfDevices<DeviceLookUps>>(device, threads, probes);
}

} // namespace kss
} // namespace pcl
