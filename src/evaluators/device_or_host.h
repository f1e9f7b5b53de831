/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/devices.h>

#include <functional>
#include <memory>
#include <utility>

namespace pcl {
namespace kss {

/** \brief Tell the user, once per process, that the host does a device's work. */
void
warnOfHost(const DeviceError& error);

/** \brief An evaluator on a device for as long as that works; then one on the host,
 * which is given what the other had been given, and goes on.
 */
template <typename Evaluator>
class DeviceOrHost {
public:
  using Make = std::function<std::unique_ptr<Evaluator>()>;
  using Setting = std::function<void(Evaluator&)>;

  DeviceOrHost(const Make& on_device, Make on_host)
  : make_on_host_(std::move(on_host))
  {
    onDevice([&] { evaluator_ = on_device(); });
  }

  /** \brief What every call depends on. */
  void
  set(Setting setting)
  {
    setting_ = std::move(setting);
    if (is_on_host_)
      setting_(*evaluator_);
    else
      onDevice([&] { setting_(*evaluator_); });
  }

  /** \brief Call it, once more where the device fails. */
  template <typename Call>
  auto
  call(const Call& call)
  {
    decltype(call(*evaluator_)) result;
    if (is_on_host_ || !onDevice([&] { result = call(*evaluator_); }))
      result = call(*evaluator_);
    return result;
  }

  const Evaluator&
  evaluator() const
  {
    return *evaluator_;
  }

private:
  /** \return false: the host has taken over */
  template <typename Work>
  bool
  onDevice(const Work& work)
  {
    try {
      work();
      return true;
    }
    catch (const DeviceError& error) {
      warnOfHost(error);
    }
    evaluator_ = make_on_host_();
    is_on_host_ = true;
    if (setting_)
      setting_(*evaluator_);
    return false;
  }

  Make make_on_host_;
  std::unique_ptr<Evaluator> evaluator_;
  Setting setting_;
  bool is_on_host_ = false;
};

} // namespace kss
} // namespace pcl
