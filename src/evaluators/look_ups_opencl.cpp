/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "evaluators/distances_of_devices.h"
#include "evaluators/kernel_arguments.h"
#include "evaluators/look_up_clouds.h"
#include "evaluators/look_ups.h"

namespace pcl {
namespace kss {
namespace {

/** What look-ups need of one cloud, on the device. */
struct DeviceLookUpCloud {
  TiledCloud probes;
  cl::Buffer field;
  cl_float4 lower = {};
  cl_int4 size = {};
};

/** The look-ups of one device. */
class DeviceLookUps {
public:
  DeviceLookUps(std::shared_ptr<OpenCLProgram> program, unsigned int probes)
  : program_(std::move(program))
  , clouds_(probes)
  {
  }

  void
  setClouds(const Points& source, const Points& target, float limit)
  {
    clouds_.set(source, target, limit,
                [this](const Points& probes, const DistanceField& field) {
                  return upload(probes, field);
                });
  }

  void
  evaluate(const Placement* placements, std::size_t size, DirectedDistances* distances)
  {
    const double operations = static_cast<double>(clouds_.source().probes.points) +
                              static_cast<double>(clouds_.target().probes.points);
    dispatches_.run(program_->limits(), size, 16 * sizeof(float), operations,
                    [&](std::size_t begin, std::size_t end) {
                      dispatch(placements + begin, end - begin, distances + begin);
                    });
  }

private:
  void
  dispatch(const Placement* placements, std::size_t size, DirectedDistances* distances)
  {
    const DeviceLookUpCloud &source = clouds_.source(), &target = clouds_.target();
    const cl::Buffer candidates = program_->upload(placements, size);
    const cl::Buffer result = program_->allocate<DirectedDistances>(size);
    program_->run("look_ups", size, source.probes.x, source.probes.y, source.probes.z,
                  source.probes.points, source.field, source.lower, source.size,
                  target.probes.x, target.probes.y, target.probes.z,
                  target.probes.points, target.field, target.lower, target.size,
                  candidates, static_cast<cl_uint>(size), clouds_.limit(), result);
    program_->download(result, distances, size);
  }

  DeviceLookUpCloud
  upload(const Points& probes, const DistanceField& field)
  {
    return {tiledCloud(*program_, probes),
            program_->upload(field.distances().data(), field.distances().size()),
            toFloat4(field.lower(), field.inverseEdge()), toInt4(field.size())};
  }

  std::shared_ptr<OpenCLProgram> program_;
  Dispatches dispatches_;
  LookUpClouds<DeviceLookUpCloud> clouds_;
};

} // namespace

std::unique_ptr<DistanceEvaluator>
makeOpenCLLookUps(const std::string& device, unsigned int threads, unsigned int probes)
{
  return std::make_unique<DistancesOfDevices<DeviceLookUps>>(device, threads, probes);
}

} // namespace kss
} // namespace pcl
