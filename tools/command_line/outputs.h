/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "io/file_format.h"
#include "io/geometry.h"
#include "options.h"
#include "output_file.h"
#include "registration.h"

#include <memory>
#include <string>
#include <vector>

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

  /** \brief What of the source the aligned file does not hold, in words for the user.
   */
  std::vector<std::string>
  lossesOf(const Geometry& source) const;

private:
  Options options_;
  FileFormat aligned_format_ = FileFormat::PLY;
  std::unique_ptr<OutputFile> aligned_, transform_, report_, picture_;
};

} // namespace tool
