/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include <pcl/registration/kss/failure.h>

#include <pcl/registration/kss/detail/stopping.h>
#include <pcl/registration/kss/devices.h>

#include <new>
#include <stdexcept>

namespace pcl {
namespace kss {

Failure
failureOfException()
{
  try {
    throw;
  }
  catch (const RegistrationError& error) {
    return {error.cause(), error.what()};
  }
  catch (const std::invalid_argument& error) {
    return {FailureCause::INPUT, error.what()};
  }
  catch (const DeviceError& error) {
    return {FailureCause::DEVICE, error.what()};
  }
  catch (const Stopped& stopped) {
    return {FailureCause::STOPPED,
            std::string(stopped.what()) + " before any pose was found."};
  }
  catch (const std::bad_alloc&) {
    return {FailureCause::OTHER, "There is not enough memory; use fewer points or "
                                 "candidates."};
  }
  catch (const std::exception& error) {
    return {FailureCause::OTHER, error.what()};
  }
  catch (...) {
    return {FailureCause::OTHER, "A callback threw something that is no exception of "
                                 "the standard library."};
  }
}

} // namespace kss
} // namespace pcl
