/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/export.h>

#include <stdexcept>
#include <string>

namespace pcl {
namespace kss {

/** \brief Why a registration has no result that can be relied on. */
enum class FailureCause {
  NONE,      ///< it has one
  INPUT,     ///< the clouds, the guess or the settings determine no pose
  DEVICE,    ///< the OpenCL device asked for is not there, or failed
  STOPPED,   ///< it was cancelled, or its time limit has passed
  UNSETTLED, ///< the final ICP found too few correspondences, or still moved at the end
  NO_FIT,    ///< the clouds do not lie on each other at any pose that was found
  OTHER      ///< memory ran out, or a callback threw
};

/** \brief A cause, and one sentence on it; empty where there is none. */
struct Failure {
  FailureCause cause = FailureCause::NONE; ///< what kind of failure it is
  std::string reason;                      ///< one sentence
};

/** \brief A failure that is thrown. */
class PCL_KSS_ICP_EXPORT RegistrationError : public std::runtime_error {
public:
  /** \brief A cause, and one sentence on it, which is what() says. */
  RegistrationError(FailureCause cause, const std::string& reason)
  : std::runtime_error(reason)
  , cause_(cause)
  {
  }

  /** \brief What kind of failure it is. */
  FailureCause
  cause() const
  {
    return cause_;
  }

private:
  FailureCause cause_;
};

/** \brief The exception that is being handled, as a failure. */
PCL_KSS_ICP_EXPORT Failure
failureOfException();

} // namespace kss
} // namespace pcl
