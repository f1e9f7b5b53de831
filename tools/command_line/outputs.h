/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "io/geometry.h"
#include "options.h"
#include "output_file.h"
#include "registration.h"

#include <memory>

namespace tool {

/** \brief The files that the command line asks for. */
class Outputs {
public:
  /** \brief Check that all files can be written, before minutes of work.
   * \throws std::runtime_error naming the file that cannot
   */
  explicit Outputs(const Options& options);

  /** \brief Check that the source can be written in the format asked for.
   * \throws std::runtime_error naming the file where it cannot
   */
  void
  checkFormat(const Geometry& source) const;

  /** \brief Write all files, or only the report and the picture where nothing has been
   * registered.
   *
   * All of them or none are put in their places.
   * \throws std::runtime_error naming the file that cannot be written
   */
  void
  write(const Result& result, Geometry source, const Geometry& target);

private:
  Options options_;
  std::unique_ptr<OutputFile> aligned_, transform_, report_, picture_;
};

} // namespace tool
