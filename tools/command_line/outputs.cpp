/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "outputs.h"

#include "io/losses.h"
#include "io/write_geometry.h"
#include "picture_of_result.h"
#include "report.h"
#include "transformation_file.h"

#include <filesystem>
#include <set>
#include <stdexcept>
#include <utility>

namespace tool {
namespace {

/** The path by which files can be compared that do not exist yet. */
std::string
canonical(const std::string& path)
{
  return std::filesystem::weakly_canonical(std::filesystem::absolute(path)).string();
}

} // namespace

Outputs::Outputs(const Options& options)
: options_(options)
{
  std::set<std::string> taken{canonical(options.source), canonical(options.target)};
  if (!options.guess.empty())
    taken.insert(canonical(options.guess));
  const auto prepare = [&](const std::string& path, std::unique_ptr<OutputFile>& file) {
    if (path.empty())
      return;
    if (!taken.insert(canonical(path)).second)
      throw std::runtime_error(path +
                               ": is named twice; give each output its own file");
    file = std::make_unique<OutputFile>(path);
  };
  if (!options.aligned.empty())
    aligned_format_ = fileFormatLike(options.aligned, options.source);
  prepare(options.aligned, aligned_);
  prepare(options.transform, transform_);
  prepare(options.report, report_);
  if (!options.picture.empty())
    checkPictures();
  prepare(options.picture, picture_);
}

void
Outputs::checkFormat(const Geometry& source) const
{
  if (aligned_ && aligned_format_ == FileFormat::STL && source.faces.empty())
    throw std::runtime_error(options_.aligned + ": STL holds only triangles, and " +
                             options_.source + " has none; use .ply, .pcd or .xyz");
}

std::vector<std::string>
Outputs::lossesOf(const Geometry& source) const
{
  return aligned_ ? tool::lossesOf(source, aligned_format_)
                  : std::vector<std::string>();
}

void
Outputs::write(const Result& result, Geometry source, const Geometry& target)
{
  const bool registered = result.converged;
  // what has to see the source, before it is moved away
  const std::string report =
      report_ ? reportText(result, options_, source, target) : "";
  if (picture_)
    picture_->write([&](std::ostream& stream) {
      writePicture(result, options_, source, target, stream);
    });
  if (aligned_ && registered)
    aligned_->write([&](std::ostream& stream) {
      writeGeometry(transformed(std::move(source), result.poses.front().transformation),
                    aligned_format_, stream);
    });
  if (transform_ && registered)
    transform_->write([&](std::ostream& stream) {
      stream << transformationText(result.poses.front().transformation);
    });
  if (report_)
    report_->write([&](std::ostream& stream) { stream << report; });

  const SignalsHeld held; // all of them or none
  for (auto* file : {aligned_.get(), transform_.get(), report_.get(), picture_.get()})
    if (file)
      file->putInPlace();
}

} // namespace tool
