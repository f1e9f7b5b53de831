/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "command_line/job_options.h"

#include <pcl/registration/kss/scan_work.h>

#include <cstddef>
#include <string>
#include <vector>

namespace tool {

/** \brief What the command line asks for. */
struct MultiviewOptions : JobOptions {
  std::vector<std::string> scans;
  /** \brief Which pairs are tried. */
  pcl::kss::MultiviewSettings multiview;
  /** \brief The edge of the cubes of which merged clouds have one point each; 0: they
   * have all points. */
  double spacing = 0.0;
  /** \brief What may be kept of scans in each process, in bytes. */
  std::size_t room = 0;
};

/** \brief Read the command line.
 * \throws std::exception naming the option that is wrong
 */
MultiviewOptions
parseMultiviewOptions(int argc, const char* const* argv);

/** \brief What --help shows. */
std::string
multiviewHelpText();

} // namespace tool
