/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/alignment.h>
#include <pcl/registration/kss/detail/stopping.h>
#include <pcl/registration/kss/detail/surface_step.h>
#include <pcl/registration/kss/export.h>
#include <pcl/registration/kss/failure.h>
#include <pcl/registration/kss/result.h>
#include <pcl/registration/kss/settings.h>
#include <pcl/registration/kss/stages.h>

#include <Eigen/Core>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace pcl {
namespace kss {

/** \brief A cloud of points. */
struct Cloud {
  /** \brief Coordinates, a column per point; those that are not finite are left out. */
  Eigen::Matrix3Xd points;
  /** \brief Normals of any length, a column per point; zeros and what is not finite are
   * unknown. No columns: to be found from the points.
   */
  Eigen::Matrix3Xf normals{};
};

/** \brief A cloud made ready once, for any number of registrations: see
 * CloudRegistration::prepared(). */
struct PreparedScan;

/** \brief What a registration of two clouds has come to: what KSSICP's getters say. */
struct Registered {
  /** \brief The similarity that maps the source onto the target; after a failure the
   * guess, or the identity. */
  StoredPose transformation = StoredPose::Identity();
  /** \brief Why it cannot be relied on; FailureCause::NONE: it can. */
  Failure failure;
  /** \brief The distinct poses that competed, the result first, then the others, the
   * likeliest first; empty where no pose was found. */
  Alternatives alternatives;
  /** \brief How precise the result is: KSSICP::getCovariance(). */
  SurfacePrecision precision;
  /** \brief Iterations of the result's final ICP. */
  int iterations = 0;
  /** \brief What the clouds turned out to show. */
  Mode mode = Mode::AUTOMATIC;
  /** \brief How many points are too far away from the others to be held. */
  FarPoints far_points;
  /** \brief Wall time of the stages. */
  std::vector<StageSeconds> seconds;
  /** \brief The name of the device that searched. */
  std::string device;
};

/** \brief KSS-ICP on clouds in double precision, without PCL: the same stages as
 * KSSICP's, and a final ICP of its own that goes by the same steps.
 *
 * What has been made of a cloud is kept for the next time that it comes.
 */
class PCL_KSS_ICP_EXPORT CloudRegistration {
public:
  /** \param[in] settings where one is out of bounds, the default stands: checked()
   */
  explicit CloudRegistration(const Settings& settings = {});

  ~CloudRegistration();

  /** \brief Set how many iterations the final ICP may make, one at least; 300 by
   * default. */
  void
  setMaximumIterations(int iterations);

  /** \brief Register two clouds. Nothing is thrown: Registered::failure says why there
   * is no result.
   * \param[in] source the cloud to be placed
   * \param[in] target the cloud to be placed upon
   * \param[in] guess a similarity that competes with the poses that the search finds,
   * and keeps its scale; none: there is none
   */
  Registered
  align(const Cloud& source,
        const Cloud& target,
        const std::optional<StoredPose>& guess = {});

  /** \brief Make a cloud ready for any number of registrations, by whatever object with
   * the same settings.
   * \throws std::invalid_argument where it determines no pose
   */
  std::shared_ptr<const PreparedScan>
  prepared(const Cloud& cloud);

  /** \brief Register two clouds that have been made ready. It costs less where each
   * cloud is registered with several others; where nothing fits, it is not looked for
   * what would at another scale.
   */
  Registered
  align(const PreparedScan& source,
        const PreparedScan& target,
        Thoroughness thoroughness = Thoroughness::USUAL);

  /** \brief One step of ICP, of all points that match at a pose.
   * \return where it leads, and how precise that is; no alternatives, and a failure
   * only where the clouds determine no pose
   */
  Registered
  step(const PreparedScan& source, const PreparedScan& target, const StoredPose& pose);

  /** \brief End the align() that is running, from another thread or a signal's handler;
   * the next one is not affected. */
  void
  cancel() noexcept;

private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

} // namespace kss
} // namespace pcl
