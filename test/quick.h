/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/settings.h>

namespace kss_test {

/** \brief Settings with as many points as it takes: 2000 are for real scans.
 *
 * One thread: on a busy machine, threads that wait for each other take many times as
 * long over so little work. Both clouds complete: what does not hang on the mode need
 * not wait for the others.
 * \param[in] points that clouds are simplified to
 * \param[in] settings that stay otherwise
 */
inline pcl::kss::Settings
quickSettings(unsigned int points, pcl::kss::Settings settings = {})
{
  settings.mode = pcl::kss::Mode::GLOBAL_GLOBAL;
  settings.sample_points = points;
  settings.threads = 1;
  return settings;
}

} // namespace kss_test
