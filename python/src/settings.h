/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * The table of settings, for Python.
 */

#pragma once

#include <pcl/registration/kss/settings.h>

#include <pybind11/pybind11.h>

namespace pcl_kss_icp {

/** \brief Settings by their names in the table, values by their words.
 * \throws pybind11::type_error where there is no such setting
 * \throws pybind11::value_error where a value is out of bounds, in the table's words
 */
pcl::kss::Settings
settingsOf(const pybind11::dict& given);

/** \brief What the table says of each setting: name, default, meaning, and what its
 * values may be. */
pybind11::list
settingsTable();

} // namespace pcl_kss_icp
