/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <stdexcept>
#include <string>

namespace pcl {
namespace kss {

/** \brief Work on a cloud; what it finds wrong is said with the cloud's name.
 * \param[in] cloud "source" or "target"
 * \param[in] work its std::invalid_argument says what is wrong, without a full stop
 */
template <typename Work>
auto
naming(const char* cloud, const Work& work)
{
  try {
    return work();
  }
  catch (const std::invalid_argument& error) {
    throw std::invalid_argument(std::string("The ") + cloud +
                                " cloud determines no pose: " + error.what() + ".");
  }
}

} // namespace kss
} // namespace pcl
