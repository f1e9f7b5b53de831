/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "evaluators/grid_bounds.h"
#include "evaluators/kernel_arguments.h"
#include "opencl/several_devices.h"

#include <algorithm>

namespace pcl {
namespace kss {
namespace {

/** The grid around a cloud, on the device. */
struct DeviceBoundingCells {
  cl::Buffer bounds, nodes;
  cl_float4 lower = {};
  cl_int4 size = {};
  float largest_known = 0.0f, rounding = 0.0f;
};

/** The look-ups of one device. */
class DeviceBounds {
public:
  explicit DeviceBounds(std::shared_ptr<OpenCLProgram> program)
  : program_(std::move(program))
  {
    for (DeviceBoundingCells* cells : {&source_cells_, &target_cells_}) {
      cells->bounds = nothing();
      cells->nodes = nothing();
    }
  }

  void
  setCells(bool is_source, const Points& cloud, const BoundingGrid& grid)
  {
    DeviceBoundingCells& cells = is_source ? source_cells_ : target_cells_;
    cells.lower = toFloat4(grid.lower, grid.edge);
    cells.size = toInt4(grid.size);
    cells.largest_known = grid.largest_known;
    cells.rounding = grid.rounding;
    const std::size_t nodes = grid.size.cast<std::size_t>().prod();
    cells.nodes = program_->allocate<float>(nodes);
    const cl::Buffer points = homogeneousCloud(*program_, cloud);
    const cl::Buffer nearest = program_->allocate<cl_int>(nodes);
    const DispatchLimits& limits = program_->limits();
    nodes_.run(limits, static_cast<std::size_t>(grid.size.y()) * grid.size.z(),
               (sizeof(float) + sizeof(cl_int)) * grid.size.x(),
               static_cast<double>(cloud.cols()) * grid.size.x(),
               [&](std::size_t begin, std::size_t end) {
                 program_->run("nearest_to_nodes", end - begin,
                               static_cast<cl_uint>(begin), points,
                               static_cast<cl_uint>(cloud.cols()), cells.lower,
                               cells.size, nearest, cells.nodes);
               });
    const Eigen::Vector3i size = grid.size.array() - 1;
    cells.bounds = program_->allocate<float>(4 * size.cast<std::size_t>().prod());
    fills_.run(limits, static_cast<std::size_t>(size.y()) * size.z(),
               4 * sizeof(float) * size.x(), size.x(),
               [&](std::size_t begin, std::size_t end) {
                 program_->run("cell_bounds", end - begin, static_cast<cl_uint>(begin),
                               points, nearest, cells.lower, cells.size, grid.rounding,
                               grid.border, cells.bounds);
               });
  }

  void
  lookUp(const Placement* placements,
         std::size_t size,
         const Probes& source_probes,
         const Probes& target_probes,
         bool interpolate,
         float limit,
         DistanceBounds* bounds)
  {
    const cl::Buffer of_source = uploaded(source_probes),
                     of_target = uploaded(target_probes);
    const auto tiles = [](const Probes& probes) {
      return static_cast<cl_uint>(probes.rows() / tile);
    };
    const double operations =
        static_cast<double>(source_probes.rows() + target_probes.rows());
    look_ups_.run(
        program_->limits(), size, 20 * sizeof(float), std::max(1.0, operations),
        [&](std::size_t begin, std::size_t end) {
          const std::size_t number = end - begin;
          const cl::Buffer result = program_->allocate<float>(8 * number);
          program_->run("distance_bounds", number, of_source, tiles(source_probes),
                        source_cells_.bounds, source_cells_.nodes, source_cells_.lower,
                        source_cells_.size, source_cells_.largest_known,
                        interpolate ? source_cells_.rounding : 0.0f, of_target,
                        tiles(target_probes), target_cells_.bounds, target_cells_.nodes,
                        target_cells_.lower, target_cells_.size,
                        target_cells_.largest_known,
                        interpolate ? target_cells_.rounding : 0.0f,
                        program_->upload(placements + begin, number),
                        static_cast<cl_uint>(number), limit, result);
          std::vector<float> found(8 * number);
          program_->download(result, found.data(), found.size());
          for (std::size_t i = 0; i < number; ++i) {
            const float* f = found.data() + 8 * i;
            bounds[begin + i] = {{f[0], f[2], f[4], f[6]}, {f[1], f[3], f[5], f[7]}};
          }
        });
  }

private:
  cl::Buffer
  uploaded(const Probes& probes)
  {
    return probes.size() > 0 ? program_->upload(probes.data(), probes.size())
                             : nothing();
  }

  /** What stands for the cells and the probes of a direction that does not matter. */
  cl::Buffer
  nothing()
  {
    return program_->allocate<float>(8);
  }

  std::shared_ptr<OpenCLProgram> program_;
  Dispatches nodes_, fills_, look_ups_;
  DeviceBoundingCells source_cells_, target_cells_;
};

class OpenCLBounds : public GridBounds {
public:
  OpenCLBounds(const std::string& device, unsigned int threads)
  : devices_(device, threads)
  {
  }

private:
  void
  setCells(bool is_source, const Points& cloud, const BoundingGrid& grid) override
  {
    devices_.forEach(
        [&](DeviceBounds& device) { device.setCells(is_source, cloud, grid); });
  }

  std::vector<DistanceBounds>
  lookedUp(const std::vector<Placement>& placements,
           const ProbesOfBoth& probes,
           bool interpolate,
           float limit) override
  {
    std::vector<DistanceBounds> bounds(placements.size());
    devices_.share(placements.size(), [&](DeviceBounds& device, std::size_t begin,
                                          std::size_t end) {
      device.lookUp(placements.data() + begin, end - begin, probes.source,
                    probes.target, interpolate, limit, bounds.data() + begin);
    });
    return bounds;
  }

  SeveralDevices<DeviceBounds> devices_;
};

} // namespace

std::unique_ptr<BoundsEvaluator>
makeOpenCLBounds(const std::string& device, unsigned int threads)
{
  return std::make_unique<OpenCLBounds>(device, threads);
}

} // namespace kss
} // namespace pcl
