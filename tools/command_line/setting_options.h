/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/settings.h>

#include <boost/program_options/options_description.hpp>
#include <boost/program_options/variables_map.hpp>

namespace tool {

/** \brief Who needs a setting. */
enum class Users { EVERYBODY, EXPERTS };

/** \brief What --upright means that names no axis: as most scanners have it. */
constexpr const char* USUAL_AXIS = "z";

/** \brief The options that set the settings, as the table of settings has them: those
 * with a setter of their own are everybody's. */
boost::program_options::options_description
settingOptions(Users users);

/** \brief The settings that options ask for.
 * \throws UsageError naming the option that is wrong
 */
pcl::kss::Settings
settingsOf(const boost::program_options::variables_map& values);

} // namespace tool
