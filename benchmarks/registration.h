/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "clouds.h"
#include "options.h"

#include <pcl/registration/kss_icp.h>

#include <benchmark/benchmark.h>

namespace benchmarks {

/** \brief As it comes, but with as many threads as the command line says. */
class KSSICP : public pcl::KSSICP<pcl::PointXYZ, pcl::PointXYZ> {
public:
  KSSICP() { setNumberOfThreads(options().threads); }
};

/** \brief Register once, so that the kernels are compiled and the device is in use
 * before anything is measured; later calls do nothing.
 */
void
warmUp();

/** \brief Measure the whole registration: a new object, both clouds, align(). Reports
 * what judge() does, and whether the object says that the clouds are registered.
 */
void
registerPair(benchmark::State& state,
             const Pair& pair,
             const pcl::kss::Settings& settings);

} // namespace benchmarks
