/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "evaluators/distances_of_devices.h"

namespace pcl {
namespace kss {
namespace {

constexpr Eigen::Index lanes = 8;    // of a tile of target points
constexpr Eigen::Index together = 4; // source points held against a tile at once

/** The distances of one device. */
class DeviceDistances {
public:
  explicit DeviceDistances(std::shared_ptr<OpenCLProgram> program)
  : program_(std::move(program))
  {
  }

  void
  setClouds(const Points& source, const Points& target, float limit)
  {
    limit_ = limit;
    target_points_ = target.cols();
    tiles_ = (target_points_ + lanes - 1) / lanes;
    for (int axis = 0; axis < 3; ++axis) {
      // filled up to whole tiles with copies of the last point
      Eigen::VectorXf tiled =
          Eigen::VectorXf::Constant(tiles_ * lanes, target(axis, target_points_ - 1));
      tiled.head(target_points_) = target.row(axis);
      target_[axis] = program_->upload(tiled.data(), tiled.size());
    }
    source_points_ = source.cols();
    const Eigen::Index filled = (source_points_ + together - 1) / together * together;
    Eigen::Matrix4Xf homogeneous =
        source.col(source_points_ - 1).homogeneous().replicate(1, filled);
    homogeneous.leftCols(source_points_) = source.colwise().homogeneous();
    source_ = program_->upload(homogeneous.data(), homogeneous.size());
  }

  void
  evaluate(const Placement* placements, std::size_t size, DirectedDistances* distances)
  {
    const std::size_t bytes = sizeof(float) * (tiles_ * lanes + 16);
    const double operations = static_cast<double>(source_points_) * target_points_;
    dispatches_.run(program_->limits(), size, bytes, operations,
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
    const cl::Buffer nearest = program_->allocate<float>(size * tiles_ * lanes);
    const cl::Buffer result = program_->allocate<float>(4 * size);
    program_->run("pair_distances", size, target_[0], target_[1], target_[2],
                  static_cast<cl_uint>(target_points_), source_,
                  static_cast<cl_uint>(source_points_), candidates,
                  static_cast<cl_uint>(size), limit_, nearest, result);
    static_assert(sizeof(DirectedDistances) == 4 * sizeof(float),
                  "the kernel's float4");
    program_->download(result, &distances->source_to_target, 4 * size);
  }

  std::shared_ptr<OpenCLProgram> program_;
  Dispatches dispatches_;
  cl::Buffer target_[3], source_;
  Eigen::Index target_points_ = 0, source_points_ = 0, tiles_ = 0;
  float limit_ = 0.0f;
};

} // namespace

std::unique_ptr<DistanceEvaluator>
makeOpenCLPairDistances(const std::string& device, unsigned int threads)
{
  return std::make_unique<DistancesOfDevices<DeviceDistances>>(device, threads);
}

} // namespace kss
} // namespace pcl
