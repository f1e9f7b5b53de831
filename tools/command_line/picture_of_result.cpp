/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "picture_of_result.h"

#include "picture/picture.h"
#include "picture/short_text.h"
#include "words.h"

#include <Eigen/Geometry>

#include <cmath>

namespace tool {
namespace {

/** How a pose differs from another one, and how well it fits. */
std::string
captionOf(const Pose& pose, const Pose& first)
{
  const auto linear = [](const Pose& pose) -> Eigen::Matrix3d {
    return pose.transformation.topLeftCorner<3, 3>();
  };
  const auto scale = [&](const Pose& pose) {
    return std::cbrt(linear(pose).determinant());
  };
  const double factor = scale(pose) / scale(first);
  const Eigen::AngleAxisd turn(
      Eigen::Matrix3d(linear(pose) * linear(first).inverse() / factor));
  const double degrees = turn.angle() * 180.0 / M_PI;
  std::string caption =
      degrees < 1.0 ? "shifted" : "turned by " + shortText(std::round(degrees)) + "°";
  if (std::abs(factor - 1.0) > 0.005)
    caption += ", scaled by " + shortText(factor);
  return caption + " (score " + shortText(pose.overlap.score) + ")";
}

PictureText
textOf(const Result& result, const Options& options)
{
  PictureText text;
  text.maker = "pcl_kss_icp " PCL_KSS_ICP_VERSION;
  if (!result.converged) {
    text.verdict = PictureText::Verdict::NOT_REGISTERED;
    text.title = "Not registered";
    text.details = result.reason;
    return text;
  }
  text.verdict = result.ambiguous ? PictureText::Verdict::AMBIGUOUS
                                  : PictureText::Verdict::REGISTERED;
  text.title = result.ambiguous ? "Registered, but ambiguous" : "Registered";
  const auto& overlap = result.poses.front().overlap;
  text.details = "Sure: " + sureText(result) + ". Overlap: " + percent(overlap.source) +
                 " of SOURCE, " + percent(overlap.target) +
                 " of TARGET. Scale: " + scaleText(result) +
                 (options.settings.estimate_scale ? "." : ", as given.");
  if (result.ambiguous)
    text.details += " Ambiguous: " + ambiguityText(result) + ".";
  return text;
}

} // namespace

void
checkPictures()
{
  // what draws them has been linked
}

void
writePicture(const Result& result,
             const Options& options,
             const Geometry& source,
             const Geometry& target,
             std::ostream& stream)
{
  std::vector<PicturePose> poses;
  const std::size_t rivals = numberOfRivals(result);
  for (const Pose& pose : result.poses) {
    if (poses.size() > rivals)
      break; // the likeliest come first
    poses.push_back({pose.transformation, captionOf(pose, result.poses.front())});
  }
  drawPicture(subjectOf(options.source, source, 1),
              subjectOf(options.target, target, 2), poses, textOf(result, options),
              stream);
}

} // namespace tool
