/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * The module pcl_kss_icp._core: what the package's Python is written on.
 */

#include "arrays.h"
#include "attended.h"
#include "settings.h"

#include <pcl/registration/kss/detail/warnings.h>
#include <pcl/registration/kss/devices.h>

#include <pybind11/stl.h>

#include <atomic>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace pcl_kss_icp {
namespace {

namespace py = pybind11;
namespace kss = pcl::kss;

/** Warnings wait here for a thread of Python's. */
std::mutex warnings_mutex;
std::vector<std::string> warnings;

void
keepWarning(const char* warning)
{
  const std::lock_guard<std::mutex> lock(warnings_mutex);
  warnings.emplace_back(warning);
}

std::vector<std::string>
takeWarnings()
{
  const std::lock_guard<std::mutex> lock(warnings_mutex);
  return std::exchange(warnings, {});
}

/** A CloudRegistration that Python can wait for. */
class Registration {
public:
  Registration(const py::dict& given, int iterations)
  : registration_(withProgress(settingsOf(given)))
  {
    registration_.setMaximumIterations(iterations);
  }

  /** Before Python converts the clouds: from here on cancel() is heeded. */
  void
  begin()
  {
    if (at_work_.exchange(true))
      throw std::runtime_error("This Registration is at work; take another one.");
    cancelled_ = false;
  }

  /** After align(), or what Python has raised instead. */
  void
  end(const py::args&)
  {
    at_work_ = false;
  }

  py::dict
  align(const Rows<double>& source,
        const Rows<float>& source_normals,
        const Rows<double>& target,
        const Rows<float>& target_normals,
        const std::optional<Rows<double>>& guess,
        const py::object& progress)
  {
    const kss::Cloud from = cloudOf(source, source_normals);
    const kss::Cloud to = cloudOf(target, target_normals);
    std::optional<kss::StoredPose> start;
    if (guess)
      start = poseOf(*guess);
    kss::Registered result;
    Attended attended(progress, cancelled_, [this] { registration_.cancel(); });
    attended_ = &attended;
    attended.run([&] { result = registration_.align(from, to, start); });
    return dictOf(result);
  }

  void
  cancel()
  {
    cancelled_ = true;
    registration_.cancel();
  }

private:
  kss::Settings
  withProgress(kss::Settings settings)
  {
    settings.progress = [this](const std::string& stage, double done) {
      attended_->told(stage, done);
    };
    return settings;
  }

  kss::CloudRegistration registration_;
  Attended* attended_ = nullptr; ///< that of the align() that is running
  std::atomic<bool> at_work_{false};
  std::atomic<bool> cancelled_{false}; ///< since begin()
};

} // namespace
} // namespace pcl_kss_icp

PYBIND11_MODULE(_core, module)
{
  using namespace pcl_kss_icp;
  kss::setWarningSink(keepWarning);
  module.attr("version") = PCL_KSS_ICP_VERSION;
  module.def("settings_table", settingsTable);
  module.def("take_warnings", takeWarnings);
  module.def("device_names", kss::openCLDeviceNames,
             py::call_guard<py::gil_scoped_release>());
  py::class_<Registration>(module, "Registration")
      .def(py::init<const py::dict&, int>(), py::arg("settings"), py::arg("iterations"))
      .def("__enter__", &Registration::begin)
      .def("__exit__", &Registration::end)
      .def("align", &Registration::align, py::arg("source"), py::arg("source_normals"),
           py::arg("target"), py::arg("target_normals"), py::arg("guess"),
           py::arg("progress"))
      .def("cancel", &Registration::cancel);
}
