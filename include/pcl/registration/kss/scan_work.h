/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * What is done with scans one by one and two by two: tasks that do not depend on each
 * other, for threads or for processes.
 */

#pragma once

#include <pcl/registration/kss/multiview.h>

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace pcl {
namespace kss {

/** \brief A scan, and a pose that takes it to a frame that others are in, too. */
struct PlacedScan {
  /** \brief Its number. */
  std::size_t scan = 0;
  /** \brief Maps it to that frame. */
  StoredPose pose = StoredPose::Identity();
};

/** \brief A piece of work. */
struct ScanTask {
  /** \brief What is done with the source, the target, or both. */
  enum class Kind {
    DESCRIBE, ///< what the source is like
    REGISTER, ///< register the source and the target without a guess
    TRY,      ///< the same, but quickly: see Thoroughness
    CONNECT,  ///< register the points of all scans of the source's group with those of
              ///< the target's
    STEP      ///< where one step of ICP leads from the pose, and how precise that is
  };

  Kind kind = Kind::DESCRIBE; ///< what is to be done
  std::size_t source = 0;     ///< the number of a scan
  std::size_t target = 0;     ///< the number of another one
  /** \brief A pose of the source on the target. */
  StoredPose pose = StoredPose::Identity();
  std::vector<PlacedScan> source_group; ///< all scans of the source's group
  std::vector<PlacedScan> target_group; ///< all scans of the target's group
  /** \brief Whether the scale between the two groups is unknown. */
  bool estimates_scale = false;
};

/** \brief What the surface is like around a point, however it is turned: square roots
 * of shares, 255 being 1. */
using LocalFeature = std::array<std::uint8_t, 100>;

/** \brief What a scan is like.
 *
 * No matrices of dynamic size, here and in what else is handed over: what a program
 * compiled for wider vectors has allocated for one, the library must not free.
 */
struct ScanDescription {
  /** \brief The mean of its points. */
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  /** \brief The covariance of its points. */
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  /** \brief Points of it, a few hundred, that cover it evenly, relative to the
   * centroid.
   */
  std::vector<Eigen::Vector3f> outline;
  /** \brief How far neighbouring points of the outline are apart. */
  double gap = 0.0;
  /** \brief How far the farthest one of them is from the centroid. */
  double reach = 0.0;
  /** \brief The usual spacing of its points, as those are that judge. */
  double spacing = 0.0;
  /** \brief What its surface is like within 2^octave around the first points of the
   * outline. */
  std::vector<LocalFeature> wide_features;
  /** \brief The same within half of that. */
  std::vector<LocalFeature> narrow_features;
  int octave = 0;             ///< see \ref wide_features
  std::size_t far_points = 0; ///< points that are too far away from the others
};

/** \brief What has come of a task. */
struct ScanAnswer {
  /** \brief Why there is nothing: a scan that cannot be read or used. */
  Failure failure;
  ScanDescription description; ///< of DESCRIBE
  /** \brief Of REGISTER, TRY, CONNECT and STEP: the latter has one pose at most. */
  PairResult pair;
};

/** \brief Those who do the work. */
class PCL_KSS_ICP_EXPORT ScanCrew {
public:
  virtual ~ScanCrew();

  /** \brief Do tasks, side by side and in any order.
   * \param[in] tasks
   * \param[in] done told of each as it ends, its number first; from one thread at a
   * time
   */
  virtual void
  work(const std::vector<ScanTask>& tasks,
       const std::function<void(std::size_t, ScanAnswer)>& done) = 0;
};

/** \brief Where scans come from: called with a scan's number, from several threads;
 * throws where it cannot be had. */
using ScanLoader = std::function<std::shared_ptr<const Cloud>(std::size_t)>;

/** \brief Does tasks; those of several threads may run at the same time.
 *
 * What has been made of a scan is kept as long as there is room.
 */
class PCL_KSS_ICP_EXPORT ScanWorker {
public:
  /** \param[in] settings of all registrations; each runs in one thread
   * \param[in] load gives the scans
   * \param[in] room for what is made of scans, in bytes
   */
  ScanWorker(const Settings& settings, ScanLoader load, std::size_t room);

  ~ScanWorker();

  /** \brief Do a task; nothing is thrown. */
  ScanAnswer
  answer(const ScanTask& task);

private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/** \brief A crew of threads around a worker. */
class PCL_KSS_ICP_EXPORT ThreadCrew : public ScanCrew {
public:
  /** \param[in] worker kept by reference
   * \param[in] threads 0: as many as there are cores
   */
  ThreadCrew(ScanWorker& worker, unsigned int threads);

  void
  work(const std::vector<ScanTask>& tasks,
       const std::function<void(std::size_t, ScanAnswer)>& done) override;

private:
  ScanWorker& worker_;
  unsigned int threads_;
};

/** \brief How many scans become a model. */
struct MultiviewSettings {
  /** \brief Up to so many scans, all pairs are tried. */
  std::size_t all_pairs = 25;
  /** \brief Of more scans, so many partners are tried for each to begin with. */
  std::size_t partners = 8;
  /** \brief Whether groups that nothing connects may have units of their own: their
   * similarities to each other are looked for, see Multiview::links. */
  bool scale_between_groups = false;
  /** \brief Whether the poses are refined by all overlapping pairs at once. */
  bool refine = true;
  /** \brief Threads that compare the descriptions of scans, which is not work for a
   * crew; 0: as many as there are cores. */
  unsigned int threads = 0;
};

/** \brief Find the poses of scans.
 *
 * Pairs are registered; loops of pairs, and what other scans show, tell right ones from
 * wrong ones; poses follow from all right ones, and are refined jointly. Nothing is
 * thrown.
 * \param[in] scans how many there are
 * \param[in] settings
 * \param[in] crew does the work
 * \param[in] progress told of stages and the share of them that is done; may be empty
 */
PCL_KSS_ICP_EXPORT Multiview
connectScans(std::size_t scans,
             const MultiviewSettings& settings,
             ScanCrew& crew,
             const ProgressCallback& progress = {});

} // namespace kss
} // namespace pcl
