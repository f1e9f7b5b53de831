/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/detail/points.h>
#include <pcl/registration/kss/export.h>
#include <pcl/registration/kss/result.h>
#include <pcl/registration/kss/settings.h>
#include <pcl/registration/kss/stages.h>

#include <memory>
#include <optional>
#include <string>

namespace pcl {
namespace kss {

struct PreparedCloud;
struct ShapePair;

/** \brief What the points of two clouds say of poses of the source on the target. */
class PCL_KSS_ICP_EXPORT PoseScorer {
public:
  /** \param[in] shapes the two clouds; kept */
  explicit PoseScorer(std::shared_ptr<const ShapePair> shapes);

  /** \brief A transformation with its overlap and evidence, which rank it; none where
   * it is no similarity, or one of a scale that determines no pose.
   */
  Alternative
  scored(const Eigen::Matrix4d& transformation) const;

  /** \brief Whether two transformations are the same for the purpose of listing
   * alternatives. */
  bool
  areSame(const Eigen::Matrix4d& a, const Eigen::Matrix4d& b) const;

  /** \brief How far apart two transformations place the source, root mean square, in
   * root mean square radii of the target. */
  double
  distance(const Eigen::Matrix4d& a, const Eigen::Matrix4d& b) const;

  /** \brief A transformation at which the surfaces explain many more of the source's
   * points, near one at which ICP has come to rest: on another skin of a wall, say.
   * \return none where there is no such place
   */
  std::optional<StoredPose>
  skinBeside(const Eigen::Matrix4d& transformation) const;

  /** \brief The spacing of the points of both clouds where a transformation has placed
   * the source: the wider one, median, in units of the target. */
  double
  spacingAt(const Eigen::Matrix4d& transformation) const;

  /** \brief Unit normals of the source's surface where it is nearest to positions;
   * their signs mean something only where both clouds have sides.
   * \param[in] positions in the coordinates of the source
   * \param[out] normals a column per position, which the caller has made: what one side
   * allocates, the other one cannot free where it is compiled for other vectors
   */
  void
  sourceNormals(const Eigen::Matrix3Xd& positions, Points& normals) const;

  /** \brief Unit normals of the target's surface where it is nearest to positions;
   * their signs mean something only where both clouds have sides.
   * \param[in] positions in the coordinates of the target
   * \param[out] normals as above
   */
  void
  targetNormals(const Eigen::Matrix3Xd& positions, Points& normals) const;

  /** \brief How far the normals of the source are off, typically, in radians. */
  double
  sourceNormalError() const;

  /** \brief How far the normals of the target are off, typically, in radians. */
  double
  targetNormalError() const;

private:
  std::shared_ptr<const ShapePair> shapes_;
};

/** \brief The poses that an alignment has found, at least one, and what compares others
 * with them.
 */
struct Aligned {
  Alternatives alternatives; ///< the likeliest first
  PoseScorer scorer;         ///< of the same two clouds
};

/** \brief How thoroughly poses are searched for. */
enum class Thoroughness {
  USUAL, ///< again in finer steps, where no pose convinces
  QUICK  ///< in coarse steps alone: a third of the time, for pairs that are many
};

/** \brief The alignment stage of KSS-ICP: from two clouds to the distinct poses at
 * which they resemble each other most, without a guess (Algorithm 1 of the paper up to
 * the ICP on the clouds themselves).
 *
 * What has been made of a cloud is kept for the next time that it comes.
 */
class PCL_KSS_ICP_EXPORT Alignment {
public:
  /** \brief Devices come up beside what follows, unless there is to be one thread.
   * \param[in] settings copied
   */
  explicit Alignment(const Settings& settings);

  ~Alignment();

  /** \brief Find the distinct poses at which two clouds resemble each other most.
   * \param[in] source cloud to be placed
   * \param[in] target cloud to be placed upon
   * \param[in] guessed_scale the scale of all poses where the settings do not have it
   * estimated; none: 1
   * \param[in,out] stages preparation, simplification, search and refinement
   * \return as far as they have come where the work has been stopped
   * \throws std::invalid_argument where a cloud does not determine a pose, or the two
   * do not at the guessed scale
   * \throws DeviceError where the device asked for cannot be had
   * \throws Stopped before any pose has been found
   */
  Aligned
  align(const LocalCloud& source,
        const LocalCloud& target,
        const std::optional<double>& guessed_scale,
        Stages& stages);

  /** \brief A cloud made ready for any number of alignments, by whatever object with
   * the same settings. */
  std::shared_ptr<const PreparedCloud>
  prepared(const LocalCloud& cloud) const;

  /** \brief Find the distinct poses at which two clouds that have been made ready
   * resemble each other most; otherwise as above. */
  Aligned
  align(const std::shared_ptr<const PreparedCloud>& source,
        const std::shared_ptr<const PreparedCloud>& target,
        const std::optional<double>& guessed_scale,
        Thoroughness thoroughness,
        Stages& stages);

  /** \brief What the points of two clouds say of poses, without a search.
   * \throws std::invalid_argument as above
   */
  PoseScorer
  scorerOf(const std::shared_ptr<const PreparedCloud>& source,
           const std::shared_ptr<const PreparedCloud>& target,
           const std::optional<double>& guessed_scale);

  /** \brief What the work is done with. */
  const Settings&
  settings() const;

  /** \brief The name of the device that evaluates the candidates. */
  std::string
  deviceName() const;

private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

} // namespace kss
} // namespace pcl
