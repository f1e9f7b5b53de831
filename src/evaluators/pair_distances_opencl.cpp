/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "evaluators/distances_of_devices.h"
#include "evaluators/kernel_arguments.h"
#include "evaluators/pair_distances.h"

namespace pcl {
namespace kss {
namespace {

constexpr Eigen::Index together = 4; // source points held against a tile at once

/** The distances of one device. */
class DevicePairDistances {
public:
  explicit DevicePairDistances(std::shared_ptr<OpenCLProgram> program)
  : program_(std::move(program))
  {
  }

  void
  setClouds(const Points& source, const Points& target, float limit)
  {
    limit_ = limit;
    target_ = tiledCloud(*program_, target);
    source_ =
        homogeneousCloud(*program_, coordinateColumns(source, together).transpose());
    source_points_ = static_cast<cl_uint>(source.cols());
  }

  void
  evaluate(const Placement* placements, std::size_t size, DirectedDistances* distances)
  {
    const std::size_t bytes = sizeof(float) * (scratch() + 16);
    const double operations = static_cast<double>(source_points_) * target_.points;
    dispatches_.run(program_->limits(), size, bytes, operations,
                    [&](std::size_t begin, std::size_t end) {
                      dispatch(placements + begin, end - begin, distances + begin);
                    });
  }

private:
  void
  dispatch(const Placement* placements, std::size_t size, DirectedDistances* distances)
  {
    const cl::Buffer candidates = program_->upload(placements, size);
    const cl::Buffer nearest = program_->allocate<float>(size * scratch());
    const cl::Buffer result = program_->allocate<DirectedDistances>(size);
    program_->run("pair_distances", size, target_.x, target_.y, target_.z,
                  target_.points, source_, source_points_, candidates,
                  static_cast<cl_uint>(size), limit_, nearest, result);
    program_->download(result, distances, size);
  }

  /** Floats that a placement needs: one for each target point of whole tiles. */
  std::size_t
  scratch() const
  {
    return roundedUp<std::size_t>(target_.points, tile);
  }

  std::shared_ptr<OpenCLProgram> program_;
  Dispatches dispatches_;
  TiledCloud target_;
  cl::Buffer source_;
  cl_uint source_points_ = 0;
  float limit_ = 0.0f;
};

} // namespace

std::unique_ptr<DistanceEvaluator>
makeOpenCLPairDistances(const std::string& device, unsigned int threads)
{
  return std::make_unique<DistancesOfDevices<DevicePairDistances>>(device, threads);
}

} // namespace kss
} // namespace pcl
