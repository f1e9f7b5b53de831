/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "evaluators/kernel_arguments.h"
#include "evaluators/shift_sums.h"
#include "opencl/several_devices.h"

namespace pcl {
namespace kss {
namespace {

/** The sums of one device. */
class DeviceShiftSums {
public:
  explicit DeviceShiftSums(std::shared_ptr<OpenCLProgram> program)
  : program_(std::move(program))
  {
  }

  void
  setField(const std::vector<std::uint8_t>& field, const ShiftLattice& lattice)
  {
    field_ = program_->upload(field.data(), field.size());
    rows_ = program_->upload(lattice.rows().data(), lattice.rows().size());
    number_of_rows_ = static_cast<cl_uint>(lattice.rows().size());
    last_ = toInt4(lattice.last());
    std::vector<std::uint32_t> nodes;
    for (int axis = 0; axis < 3; ++axis) {
      const std::vector<std::uint32_t>& along = lattice.nodes()[axis];
      first_nodes_.s[axis] = static_cast<cl_int>(nodes.size());
      nodes.insert(nodes.end(), along.begin(), along.end());
    }
    nodes_ = program_->upload(nodes.data(), nodes.size());
  }

  /** The sums of some placements, written to where there is room for them. */
  void
  sum(const Points& points,
      const Placement* placements,
      std::size_t size,
      std::uint16_t* sums)
  {
    const cl::Buffer probes = homogeneousCloud(*program_, points);
    const std::size_t sums_of_placement =
        ShiftLattice::lanes * std::size_t(number_of_rows_);
    const std::size_t bytes =
        sizeof(Placement) + sizeof(std::uint16_t) * sums_of_placement;
    const double operations = static_cast<double>(points.cols()) * number_of_rows_;
    sums_.run(program_->limits(), size, bytes, operations,
              [&](std::size_t begin, std::size_t end) {
                const std::size_t number = end - begin;
                const cl::Buffer result =
                    program_->allocate<std::uint16_t>(sums_of_placement * number);
                program_->run("shift_sums", number, probes,
                              static_cast<cl_uint>(points.cols()),
                              program_->upload(placements + begin, number),
                              static_cast<cl_uint>(number), field_, nodes_,
                              first_nodes_, last_, rows_, number_of_rows_, result);
                program_->download(result, sums + sums_of_placement * begin,
                                   sums_of_placement * number);
              });
  }

private:
  std::shared_ptr<OpenCLProgram> program_;
  Dispatches sums_;
  cl::Buffer field_, nodes_, rows_;
  cl_uint number_of_rows_ = 0;
  cl_int4 first_nodes_ = {}, last_;
};

class OpenCLShiftSums : public ShiftSums {
public:
  OpenCLShiftSums(const std::string& device, unsigned int threads)
  : devices_(device, threads)
  {
  }

  void
  setField(const Points& cloud, const ShiftLattice& lattice) override
  {
    const std::vector<std::uint8_t> field = lattice.field(cloud);
    devices_.forEach([&](DeviceShiftSums& device) { device.setField(field, lattice); });
    sums_of_placement_ = ShiftLattice::lanes * lattice.rows().size();
  }

  std::vector<std::uint16_t>
  sums(const Points& points, const std::vector<Placement>& placements) override
  {
    std::vector<std::uint16_t> sums(sums_of_placement_ * placements.size());
    devices_.share(placements.size(),
                   [&](DeviceShiftSums& device, std::size_t begin, std::size_t end) {
                     device.sum(points, placements.data() + begin, end - begin,
                                sums.data() + begin * sums_of_placement_);
                   });
    return sums;
  }

private:
  SeveralDevices<DeviceShiftSums> devices_;
  std::size_t sums_of_placement_ = 0;
};

} // namespace

std::unique_ptr<ShiftSums>
makeOpenCLShiftSums(const std::string& device, unsigned int threads)
{
  return std::make_unique<OpenCLShiftSums>(device, threads);
}

} // namespace kss
} // namespace pcl
