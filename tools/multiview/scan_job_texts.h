/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/scan_work.h>

#include <string>

namespace tool {

/** \brief What is done with scans, as a line of text: the same task gives the same
 * line, and the numbers that are read are those that were written. */
std::string
jobOf(const pcl::kss::ScanTask& task);

/** \brief The task that a line tells.
 * \throws std::exception where it is none
 */
pcl::kss::ScanTask
taskFrom(const std::string& job);

/** \brief What has come of a task, as a line of text.
 * \param[in] kind of the task
 */
std::string
textOf(const pcl::kss::ScanAnswer& answer, pcl::kss::ScanTask::Kind kind);

/** \brief The answer that a line tells.
 * \throws std::exception where it is none
 */
pcl::kss::ScanAnswer
answerFrom(const std::string& text);

} // namespace tool
