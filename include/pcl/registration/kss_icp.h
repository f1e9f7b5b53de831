/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/point_types.h>
#include <pcl/registration/icp.h>
#include <pcl/registration/kss/alignment.h>
#include <pcl/registration/kss/detail/final_stage.h>
#include <pcl/registration/kss/detail/misfit.h>
#include <pcl/registration/kss/detail/stopping.h>
#include <pcl/registration/kss/detail/surface_step.h>
#include <pcl/registration/kss/detail/usable_points.h>
#include <pcl/registration/kss/devices.h>
#include <pcl/registration/kss/failure.h>
#include <pcl/registration/kss/result.h>
#include <pcl/registration/kss/settings.h>
#include <pcl/registration/kss/stages.h>

#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace pcl {

/** \brief @b KSSICP registers two point clouds whatever their positions, scales,
 * rotations and densities: a drop-in for IterativeClosestPoint that needs no initial
 * guess.
 *
 * Both clouds are simplified to k uniform points and brought to Kendall's pre-shape
 * space; the candidates, rotations times centres times scales, are searched on an
 * OpenCL device; the local minima are refined; and IterativeClosestPoint, governed by
 * the settings inherited from it, finishes with points of the source on the target as
 * it is. What has been made of a cloud is kept as long as the next call brings the same
 * cloud. Either cloud may be incomplete, or both (setMode); stray points are left out
 * and heavy noise is averaged in the search. The method is Algorithm 1 of C. Lv, W.
 * Lin, B. Zhao, "KSS-ICP: Point Cloud Registration based on Kendall Shape Space", IEEE
 * Transactions on Image Processing, 2023.
 *
 * \code
 * pcl::KSSICP<pcl::PointXYZ, pcl::PointXYZ> registration;
 * registration.setInputSource (source);
 * registration.setInputTarget (target);
 * pcl::PointCloud<pcl::PointXYZ> aligned;
 * registration.align (aligned);
 * if (registration.hasConverged ())
 *   std::cout << registration.getFinalTransformation () << '\n';
 * \endcode
 *
 * <b>The transformation is a similarity</b>: final rotation and translation, and the
 * scale unless setScaleEstimation(false) says that it is known. Code that expects a
 * rigid transformation (registration::ELCH, registration::IncrementalRegistration)
 * wants setScaleEstimation(false).
 *
 * <b>Inherited settings</b> govern the final IterativeClosestPoint and keep their
 * meaning, with these defaults of KSSICP's own: at most 300 iterations
 * (setMaximumIterations); a relative change of the mean squared error below 1e-5
 * (setEuclideanFitnessEpsilon), an unchanged transformation (setTransformationEpsilon
 * 0) or a step of less than a tenth of the pose's standard error ends it: all are free
 * of units; a run that moves by more than that error, and than rounding, at the
 * iteration limit has not converged
 * (getConvergeCriteria()->setFailureAfterMaximumIterations(false) restores ICP's
 * reading). Correspondences longer than a few point spacings are left out, since one of
 * the points has no counterpart, unless the mode is GLOBAL_GLOBAL;
 * setMaxCorrespondenceDistance() can narrow that. Where that ICP would lessen the
 * overlap, under heavy noise, the pose that it started from is the result.
 * setRANSACIterations() and setRANSACOutlierRejectionThreshold() have no effect, as in
 * IterativeClosestPoint. setTransformationEstimation() may change the scale of the
 * result; the default one lays points on each other's tangent planes
 * (kss::SurfaceEstimation), with the scale, within its bounds, where that is estimated.
 *
 * <b>What is mended against IterativeClosestPoint of PCL 1.13</b>: indices are
 * respected; normals take the pure rotation; points that are not finite are skipped and
 * stay as they are in the output; after a failure the output is the source transformed
 * by the guess; an empty cloud replaces the one set before, and align() then reports
 * the failure; nothing is thrown out of align(). align(), getFitnessScore() and
 * registerVisualizationCallback() are not virtual in PCL: calls through a pointer to a
 * base class reach PCL's own, which get the same transformation, but do not skip points
 * that are not finite in the fitness, do not check indices, and need both clouds before
 * a callback.
 *
 * \tparam PointSource any point type with x, y and z
 * \tparam PointTarget the same type: IterativeClosestPoint of PCL 1.13 does not compile
 * for two different ones
 * \tparam Scalar float or double: the type of the transformation
 * \ingroup registration
 */
template <typename PointSource, typename PointTarget, typename Scalar = float>
class PCL_KSS_ICP_EXPORT KSSICP
: public IterativeClosestPoint<PointSource, PointTarget, Scalar> {
  using Base = IterativeClosestPoint<PointSource, PointTarget, Scalar>;

public:
  /** \brief What PCL's programs hold objects by. */
  using Ptr = shared_ptr<KSSICP<PointSource, PointTarget, Scalar>>;
  /** \brief The same to objects that do not change. */
  using ConstPtr = shared_ptr<const KSSICP<PointSource, PointTarget, Scalar>>;

  using typename Base::Matrix4;
  using typename Base::PointCloudSource;
  using typename Base::PointCloudSourceConstPtr;
  using typename Base::PointCloudSourcePtr;
  using typename Base::PointCloudTarget;
  using typename Base::PointCloudTargetConstPtr;
  using typename Base::PointCloudTargetPtr;
  using typename Base::UpdateVisualizerCallbackSignature;

  using Base::convergence_criteria_;
  using Base::getClassName;

  /** \brief One of the poses that compete: the result, or one that came close. */
  using Alternative = kss::Alternative;

  /** \brief Empty constructor. */
  KSSICP();

  /** \brief Empty destructor. */
  ~KSSICP() override = default;

  /** \brief Set the cloud to be aligned. A null or empty cloud leaves no source:
   * align() then reports it.
   */
  void
  setInputSource(const PointCloudSourceConstPtr& cloud) override;

  /** \brief Set the cloud that the source is aligned to. A null or empty cloud leaves
   * no target: align() then reports it.
   */
  void
  setInputTarget(const PointCloudTargetConstPtr& cloud) override;

  /** \brief Register the two clouds, without a guess.
   * \param[out] output the source (its indexed points) transformed by
   * getFinalTransformation(); may be the source itself
   */
  void
  align(PointCloudSource& output);

  /** \brief Register the two clouds; the pose that ICP reaches from \a guess competes
   * with those that the search finds.
   * \param[out] output the source (its indexed points) transformed by
   * getFinalTransformation(); may be the source itself
   * \param[in] guess a similarity that maps the source near the target; identity means
   * that there is no guess. It keeps its scale, which setScaleRange() does not bound
   */
  void
  align(PointCloudSource& output, const Matrix4& guess);

  /** \brief Mean squared distance from the (finite) aligned source points to their
   * nearest neighbours in the target.
   * \param[in] max_range pairs whose \e squared distance exceeds it are left out, as in
   * PCL
   * \param[in] use_indices whether the indexed points alone count; PCL has it after
   * 1.15, and there it is false unless given
   * \return the score, or the largest double where no pair is left
   */
  double
  getFitnessScore(double max_range = std::numeric_limits<double>::max(),
                  bool use_indices = true);

  /** \brief Mean difference between two sets of distances, as in PCL: by name, since
   * what else the base class has of this name differs with PCL's version.
   */
  double
  getFitnessScore(const std::vector<float>& distances_a,
                  const std::vector<float>& distances_b)
  {
    return Base::getFitnessScore(distances_a, distances_b);
  }

  /** \brief Register a function that is called with every iteration of the final ICP.
   * \return whether the function can be called
   */
  bool
  registerVisualizationCallback(
      std::function<UpdateVisualizerCallbackSignature>& callback);

  /** \brief Set all that is in the table of settings (settings_table.h) at once. A
   * value that is out of bounds is refused: the one before stays, and an error is
   * printed. So is a warning where the search that was asked for is not the one that
   * runs (kss::searchOf()).
   *
   * setSettings(kss::paperSettings(getSettings())) is the paper's own method.
   */
  void
  setSettings(const kss::Settings& settings);

  /** \brief Get all settings. */
  const kss::Settings&
  getSettings() const
  {
    return settings_;
  }

  /** \brief Set which parts of the object the clouds show. */
  void
  setMode(kss::Mode mode)
  {
    set(&kss::Settings::mode, mode);
  }

  /** \brief Get which parts of the object the clouds were said to show. */
  kss::Mode
  getMode() const
  {
    return settings_.mode;
  }

  /** \brief Set whether the relative scale is estimated. Otherwise the result has
   * exactly the guess's scale, or 1 without a guess.
   */
  void
  setScaleEstimation(bool estimate)
  {
    set(&kss::Settings::estimate_scale, estimate);
  }

  /** \brief Get whether the relative scale is estimated. */
  bool
  getScaleEstimation() const
  {
    return settings_.estimate_scale;
  }

  /** \brief Set the bounds of the scale where it is estimated.
   * \param[in] smallest positive, or 0 for no bound
   * \param[in] largest at least \a smallest; may be infinite
   */
  void
  setScaleRange(double smallest, double largest);

  /** \brief Get the smallest scale that the result may have. */
  double
  getSmallestScale() const
  {
    return settings_.smallest_scale;
  }

  /** \brief Get the largest scale that the result may have. */
  double
  getLargestScale() const
  {
    return settings_.largest_scale;
  }

  /** \brief Set what the rotation is about: where both clouds are upright along an
   * axis of their frames, as levelled scans are, fewer poses are tried, and less looks
   * alike; what is tilted by more than the noise is refused. A guess is turned upright;
   * an estimation that is set by setTransformationEstimation() may tilt the result.
   */
  void
  setRotationAxis(kss::RotationAxis axis)
  {
    set(&kss::Settings::rotation_axis, axis);
  }

  /** \brief Get what the rotation is about. */
  kss::RotationAxis
  getRotationAxis() const
  {
    return settings_.rotation_axis;
  }

  /** \brief Set where the search runs.
   * \param[in] device "auto" for the first OpenCL device, GPUs first, or the host, with
   * a warning, where there is none; "host" for no OpenCL; otherwise all OpenCL devices
   * of the platform whose name contains \a device, else the device whose name does, and
   * align() fails where there is none.
   */
  void
  setDevice(const std::string& device)
  {
    set(&kss::Settings::device, device);
  }

  /** \brief Get where the search was asked to run. */
  const std::string&
  getDevice() const
  {
    return settings_.device;
  }

  /** \brief Set the number of threads on the host and on OpenCL CPU devices; 0: as many
   * as there are cores. The result does not depend on it.
   */
  void
  setNumberOfThreads(unsigned int threads)
  {
    set(&kss::Settings::threads, threads);
  }

  /** \brief Get the number of threads; 0: as many as there are cores. */
  unsigned int
  getNumberOfThreads() const
  {
    return settings_.threads;
  }

  /** \brief Set how many points of the source, spread over it, take part in the final
   * ICP; 0: all. The target takes part as it is.
   */
  void
  setNumberOfICPPoints(unsigned int points)
  {
    set(&kss::Settings::icp_points, points);
  }

  /** \brief Get how many points of the source take part in the final ICP; 0: all. */
  unsigned int
  getNumberOfICPPoints() const
  {
    return settings_.icp_points;
  }

  /** \brief Set the confidence, in [0, 1], from which on hasConverged() is true. */
  void
  setMinimumConfidence(double confidence)
  {
    set(&kss::Settings::minimum_confidence, confidence);
  }

  /** \brief Get the confidence from which on hasConverged() is true. */
  double
  getMinimumConfidence() const
  {
    return settings_.minimum_confidence;
  }

  /** \brief Set how long align() may take. It then ends with the best pose so far, not
   * converged, within some two tenths of a second; only what a rejector or an
   * estimation of the user's own does meanwhile is not interrupted.
   * \param[in] seconds of wall time; 0: as long as it takes
   */
  void
  setTimeLimit(double seconds)
  {
    set(&kss::Settings::time_limit, seconds);
  }

  /** \brief Get how long align() may take, in seconds; 0: as long as it takes. */
  double
  getTimeLimit() const
  {
    return settings_.time_limit;
  }

  /** \brief End the align() that is running, as if its time limit had passed: from
   * another thread, or from a signal's handler. The next one is not affected.
   */
  void
  cancel() noexcept
  {
    stop_.cancel();
  }

  /** \brief Set a function that is told how far align() has come; may be empty.
   *
   * What it throws, of whatever type, ends align(), which reports a failure; no pose is
   * kept.
   */
  void
  setProgressCallback(const kss::ProgressCallback& callback)
  {
    settings_.progress = callback;
  }

  /** \brief Get the scale of the final transformation. */
  double
  getScale() const;

  /** \brief Get how much of the clouds lies on each other at the final transformation;
   * zeros before the first align() and after a failure.
   */
  kss::Overlap
  getOverlap() const
  {
    return alternatives_.empty() ? kss::Overlap() : alternatives_.front().overlap;
  }

  /** \brief Get how much of what the surfaces of the clouds say about the pose speaks
   * for the final transformation; zeros before the first align() and after a failure.
   */
  kss::Evidence
  getEvidence() const
  {
    return alternatives_.empty() ? kss::Evidence() : alternatives_.front().evidence;
  }

  /** \brief Get how many points the last align() left out since they lie thousands of
   * times as far from the middle of their cloud as half of its points do (kss::Bulk);
   * zeros after a failure. The output has them, transformed as the others.
   */
  const kss::FarPoints&
  getNumberOfFarPoints() const
  {
    return far_points_;
  }

  /** \brief Get which parts of the object the clouds turned out to show: the mode that
   * was set, or, where it was AUTOMATIC, the one that the overlap speaks for.
   */
  kss::Mode
  getFoundMode() const;

  /** \brief Get how sure it is that the clouds show one object, and that the pose is
   * right or an equivalent one: in [0, 1]; 0 before the first align() and after a
   * failure.
   */
  double
  getConfidence() const
  {
    return kss::confidenceOf(alternatives_);
  }

  /** \brief Get whether another pose is about as good as the result, as for a symmetric
   * object: it is the next of getAlternatives().
   */
  bool
  isAmbiguous() const
  {
    return kss::isAmbiguous(alternatives_);
  }

  /** \brief Get the covariance of the result: of its rotation, in radians about the
   * axes of the target's frame, of the place of the source's centroid, in the unit of
   * the target, and, where the scale is estimated, of the logarithm of the scale.
   *
   * The true pose is x -> c + d + e^s exp([r]) (x' - c), x' being where the result
   * takes x to, c where it takes the mean of the source's (indexed) points to, without
   * those that are not finite or far from all others (getNumberOfFarPoints()),
   * and (r, d, s) of zero mean and this covariance. It comes from the distances to
   * tangent planes and from how much they scatter from patch to patch, which has the
   * noise of both clouds in it. It is that of the listed pose alone: where
   * isAmbiguous(), others are as good. Along directions that the surfaces do not
   * determine (see getUndeterminedDirections()) the clouds' own size is the standard
   * deviation. What is known has none: with setRotationAxis() the rotations about the
   * other two axes have zeros, and there is no inverse.
   * \return 6 x 6, or 7 x 7 where the scale has been estimated rather than taken for
   * the guess's or 1; empty where nothing is known: without a result, with a
   * transformation estimation of the user's own, and where the final ICP has not found
   * surfaces or would have lessened the overlap
   */
  Eigen::MatrixXd
  getCovariance() const
  {
    return precision_.covariance.topLeftCorner(precision_.unknowns,
                                               precision_.unknowns);
  }

  /** \brief Get the standard deviation of the result's scale; 0 where getCovariance()
   * does not have it.
   */
  double
  getScaleDeviation() const
  {
    return getScale() * std::sqrt(precision_.covariance(6, 6));
  }

  /** \brief Get in how many directions the surfaces leave the pose undetermined, as in
   * three for a ball that may turn: the result is not moved along them, and none of its
   * accuracy along them is told.
   */
  int
  getUndeterminedDirections() const
  {
    return precision_.undetermined;
  }

  /** \brief Get the distinct poses that competed: the final transformation, then the
   * others, the likeliest first, in the end those that the final ICP has not run from.
   */
  const kss::Alternatives&
  getAlternatives() const
  {
    return alternatives_;
  }

  /** \brief Get the seconds of wall time that the stages of the last align() took, in
   * the order in which they ran.
   */
  const std::vector<kss::StageSeconds>&
  getStageSeconds() const
  {
    return stages_.seconds();
  }

  /** \brief Get the name of the device that the last align() searched on. */
  const std::string&
  getDeviceName() const
  {
    return device_name_;
  }

  /** \brief Get one sentence on why the last align() did not converge; empty if it did.
   */
  const std::string&
  getFailureReason() const
  {
    return failure_.reason;
  }

  /** \brief Get what kind of reason that is. */
  kss::FailureCause
  getFailureCause() const
  {
    return failure_.cause;
  }

protected:
  using Base::converged_;
  using Base::corr_dist_threshold_;
  using Base::correspondence_estimation_;
  using Base::correspondences_;
  using Base::final_transformation_;
  using Base::indices_;
  using Base::input_;
  using Base::nr_iterations_;
  using Base::previous_transformation_;
  using Base::reg_name_;
  using Base::target_;
  using Base::transformation_;
  using Base::tree_;
  using Base::update_visualizer_;

  /** \brief What ICP moves points by: place() where all of them stay finite; otherwise
   * the run ends, and the pose that it started from is kept.
   */
  void
  transformCloud(const PointCloudSource& input,
                 PointCloudSource& output,
                 const Matrix4& transform) override;

  /** \brief Algorithm 1 of the paper.
   * \param[out] output the transformed source
   * \param[in] guess a similarity; identity: none
   */
  void
  computeTransformation(PointCloudSource& output, const Matrix4& guess) override;

private:
  struct Run;
  class FinalICP;

  /** \brief Take settings; say which are refused, and keep those before. */
  void
  take(const kss::Settings& asked);

  /** \brief Take a single setting, or say why it is refused and keep the one before. */
  template <typename Value>
  void
  set(Value kss::Settings::*setting, const Value& value);

  /** \brief Apply a similarity; normals take the pure rotation, points that are not
   * finite stay.
   * \return whether the others are finite still
   */
  static bool
  place(const PointCloudSource& input,
        PointCloudSource& output,
        const Matrix4& transform);

  /** \brief Check what align() needs before it can start. */
  void
  throwOnBadInput() const;

  /** \brief The indexed source points as they are. */
  void
  copyIndexedSource(PointCloudSource& output) const;

  /** \brief Algorithm 1; throws where no pose can be found. */
  void
  registerClouds(const Matrix4& guess);

  /** \brief The points of both clouds that a registration goes by.
   * \param[in] guess where the source is taken to; none: nowhere
   * \throws std::invalid_argument where a cloud has none, or the guess takes the source
   * far away from the target
   */
  std::pair<kss::UsablePoints<index_t>, kss::UsablePoints<index_t>>
  usablePoints(const std::optional<kss::StoredPose>& guess) const;

  /** \brief The alignment stage for the settings: the one of the last time, which has
   * kept what it made of the clouds, where they ask for the same work.
   */
  kss::Alignment&
  alignmentForSettings();

  /** \brief Take a contender as the result; one that has no run as it is.
   * \param[in] source_indices of the points that took part
   */
  void
  accept(const kss::FinalContender& contender, const Indices& source_indices);

  /** \brief Take the first of the poses at which the source is a copy of the target. */
  void
  acceptCopies(const kss::Alternatives& copies);

  /** \brief The scale at which the clouds fit otherwise, if they do, by a registration
   * of its own.
   * \param[in] mirror what makes the source its mirror image, at the scale given
   */
  std::optional<double>
  scaleOfFit(kss::Mirror mirror, double given_scale, const kss::Settings& settings);

  /** \brief Say why there is no result, and leave the guess as the transformation. */
  void
  giveUp(const Matrix4& guess, const kss::Failure& failure);

  kss::Settings settings_;
  std::unique_ptr<kss::Alignment> alignment_; ///< keeps what the next align() can use
  kss::Stages stages_;
  kss::StopSignal stop_;
  bool source_is_output_ = false;
  kss::SurfacePrecision precision_;

  kss::Alternatives alternatives_;
  kss::FarPoints far_points_;
  std::string device_name_;
  kss::Failure failure_;
  bool explains_misfits_ = true; ///< not where it is itself a part of an explanation
};

} // namespace pcl

#include <pcl/registration/impl/kss_icp.hpp>

// A program compiled for wider vectors lays out PCL's classes otherwise than the
// library does, and compiles what it needs itself.
#if !defined PCL_NO_PRECOMPILE &&                                                      \
    EIGEN_MAX_STATIC_ALIGN_BYTES == PCL_KSS_ICP_COMPILED_ALIGNMENT
#define PCL_KSS_ICP_COMPILED(PointT)                                                   \
  extern template class pcl::KSSICP<PointT, PointT, float>;                            \
  extern template class pcl::KSSICP<PointT, PointT, double>;
PCL_KSS_ICP_COMPILED(pcl::PointXYZ)
PCL_KSS_ICP_COMPILED(pcl::PointXYZI)
PCL_KSS_ICP_COMPILED(pcl::PointXYZRGB)
PCL_KSS_ICP_COMPILED(pcl::PointXYZRGBA)
PCL_KSS_ICP_COMPILED(pcl::PointNormal)
PCL_KSS_ICP_COMPILED(pcl::PointXYZINormal)
PCL_KSS_ICP_COMPILED(pcl::PointXYZRGBNormal)
#undef PCL_KSS_ICP_COMPILED
#endif
