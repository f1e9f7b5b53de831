/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "kss_icp_methods.h"

#include <pcl/registration/kss_icp.h>

#include <cmath>

namespace evaluation {
namespace {

using pcl::kss::Mode;
using pcl::kss::Settings;

Answer
registerWith(const Settings& settings, const Task& task)
{
  pcl::KSSICP<pcl::PointXYZ, pcl::PointXYZ> kss_icp;
  kss_icp.setSettings(settings);
  kss_icp.setScaleEstimation(!task.same_scale);
  kss_icp.setInputSource(task.source);
  kss_icp.setInputTarget(task.target);
  Cloud aligned;
  kss_icp.align(aligned);
  return {kss_icp.getFinalTransformation().cast<double>(), kss_icp.hasConverged()};
}

/** \brief Two small clouds, for the kernels to be loaded. */
Task
smallTask()
{
  const auto spiral = [](double shift) {
    const auto cloud = pcl::make_shared<Cloud>();
    for (int i = 0; i < 400; ++i) {
      const double z = (i + shift) / 200.0 - 1.0, angle = 2.4 * i;
      const double radius = std::sqrt(std::max(0.0, 1.0 - z * z)) * (1.0 + 0.3 * z);
      cloud->push_back({static_cast<float>(2.0 * radius * std::cos(angle)),
                        static_cast<float>(radius * std::sin(angle)),
                        static_cast<float>(z + 0.5 * z * z)});
    }
    return cloud;
  };
  Task task;
  task.source = spiral(0.2);
  task.target = spiral(0.7);
  return task;
}

Settings
asShipped(const Task&)
{
  return Settings();
}

/** \brief The paper knows which clouds are incomplete. */
Settings
asInThePaper(const Task& task)
{
  Settings settings;
  settings.mode = task.overlap < 1.0 ? Mode::PARTIAL_GLOBAL : Mode::GLOBAL_GLOBAL;
  return pcl::kss::paperSettings(settings);
}

} // namespace

Method
kssICPMethod(const std::string& name,
             const std::function<Settings(const Task&)>& settings)
{
  Method method;
  method.name = name;
  method.estimates_scale = true;
  method.run = [settings](const Task& task) {
    return registerWith(settings(task), task);
  };
  method.warm_up = [settings] {
    const Task task = smallTask();
    registerWith(settings(task), task);
  };
  return method;
}

std::vector<Method>
kssICPMethods()
{
  const auto onHost = [](Settings settings) {
    settings.device = "host";
    return settings;
  };
  return {kssICPMethod("KSS-ICP", asShipped),
          kssICPMethod("KSS-ICP (host)",
                       [=](const Task& task) { return onHost(asShipped(task)); }),
          kssICPMethod("KSS-ICP (paper)", asInThePaper),
          kssICPMethod("KSS-ICP (paper, host)",
                       [=](const Task& task) { return onHost(asInThePaper(task)); })};
}

} // namespace evaluation
