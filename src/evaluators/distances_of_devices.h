/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "evaluators/distance_evaluator.h"
#include "opencl/several_devices.h"

namespace pcl {
namespace kss {

static_assert(sizeof(DirectedDistances) == 4 * sizeof(float), "the kernels' float4");

/** \brief An evaluator whose placements all devices share; each has a Worker with
 * setClouds(source, target, limit) and evaluate(placements, size, distances).
 */
template <typename Worker>
class DistancesOfDevices : public DistanceEvaluator {
public:
  /** \param[in] name see openCLPrograms()
   * \param[in] threads see openCLPrograms()
   * \param[in] arguments what a worker needs beside its program
   */
  template <typename... Arguments>
  DistancesOfDevices(const std::string& name,
                     unsigned int threads,
                     const Arguments&... arguments)
  : devices_(name, threads, arguments...)
  {
  }

  void
  setClouds(const Points& source, const Points& target, float limit) override
  {
    devices_.forEach([&](Worker& worker) { worker.setClouds(source, target, limit); });
  }

  std::vector<DirectedDistances>
  evaluate(const std::vector<Placement>& placements) override
  {
    std::vector<DirectedDistances> distances(placements.size());
    devices_.share(placements.size(), [&](Worker& worker, std::size_t begin,
                                          std::size_t end) {
      worker.evaluate(placements.data() + begin, end - begin, distances.data() + begin);
    });
    return distances;
  }

  std::string
  deviceName() const override
  {
    return devices_.name();
  }

private:
  SeveralDevices<Worker> devices_;
};

} // namespace kss
} // namespace pcl
