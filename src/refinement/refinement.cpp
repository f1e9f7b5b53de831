/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "refinement/refinement.h"

#include "geometry/pre_shape.h"
#include "geometry/turns.h"
#include "refinement/plane_pulls.h"
#include "support/rounded_up.h"
#include "support/wide_vectors.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace pcl {
namespace kss {
namespace {

/** Correspondences, coordinates apart, filled up to whole vectors. */
struct Pairs {
  using Rows = PlanePulls::Rows;

  Rows source, target;
  Eigen::RowVectorXf squared; // distances; infinite: there is no pair
};

/** Sums of a pair that a similarity follows from. */
enum Sum {
  WEIGHT,
  SOURCE,               // x, y, z
  TARGET = SOURCE + 3,  // x, y, z
  PRODUCT = TARGET + 3, // target times source, row by row
  SOURCE_SQUARED = PRODUCT + 9,
  TARGET_SQUARED,
  SUMS
};

/** Add up pairs, each with the weight of Geman and McClure. */
PCL_KSS_WIDE void
addUp(const float* const source[3],
      const float* const target[3],
      const float* squared,
      Eigen::Index n,
      float squared_reach,
      double* sums)
{
  float sum[SUMS][lanes] = {};
  for (Eigen::Index i = 0; i < n; i += lanes)
    for (int l = 0; l < lanes; ++l) {
      const float share = squared_reach / (squared_reach + squared[i + l]);
      const float w = share * share;
      const float sx = source[0][i + l], sy = source[1][i + l], sz = source[2][i + l];
      const float tx = target[0][i + l], ty = target[1][i + l], tz = target[2][i + l];
      const float wx = w * tx, wy = w * ty, wz = w * tz;
      sum[WEIGHT][l] += w;
      sum[SOURCE][l] += w * sx;
      sum[SOURCE + 1][l] += w * sy;
      sum[SOURCE + 2][l] += w * sz;
      sum[TARGET][l] += wx;
      sum[TARGET + 1][l] += wy;
      sum[TARGET + 2][l] += wz;
      sum[PRODUCT][l] += wx * sx;
      sum[PRODUCT + 1][l] += wx * sy;
      sum[PRODUCT + 2][l] += wx * sz;
      sum[PRODUCT + 3][l] += wy * sx;
      sum[PRODUCT + 4][l] += wy * sy;
      sum[PRODUCT + 5][l] += wy * sz;
      sum[PRODUCT + 6][l] += wz * sx;
      sum[PRODUCT + 7][l] += wz * sy;
      sum[PRODUCT + 8][l] += wz * sz;
      sum[SOURCE_SQUARED][l] += w * (sx * sx + sy * sy + sz * sz);
      sum[TARGET_SQUARED][l] += w * (tx * tx + ty * ty + tz * tz);
    }
  for (int s = 0; s < SUMS; ++s)
    for (int l = 0; l < lanes; ++l)
      sums[s] += sum[s][l];
}

/** The similarity between weighted correspondences. */
class Procrustes {
public:
  void
  add(const Pairs& pairs, double reach)
  {
    const Eigen::Index n = pairs.squared.size();
    const float* const source[] = {pairs.source.data(), pairs.source.data() + n,
                                   pairs.source.data() + 2 * n};
    const float* const target[] = {pairs.target.data(), pairs.target.data() + n,
                                   pairs.target.data() + 2 * n};
    addUp(source, target, pairs.squared.data(), n, static_cast<float>(reach * reach),
          sums_);
  }

  /** As much larger as the target points are spread wider: Horn's symmetric scale. */
  double
  symmetricScale() const
  {
    return std::sqrt((sums_[TARGET_SQUARED] - target().squaredNorm() / sums_[WEIGHT]) /
                     (sums_[SOURCE_SQUARED] - source().squaredNorm() / sums_[WEIGHT]));
  }

  /** The similarity of this scale that brings the source points closest to their
   * counterparts: (e7) and (e8). */
  Similarity
  similarity(double scale, RotationAxis axis) const
  {
    using Product = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
    const Eigen::Matrix3d covariance = Eigen::Map<const Product>(sums_ + PRODUCT) -
                                       target() * source().transpose() / sums_[WEIGHT];
    const Eigen::Matrix3d rotation = nearestRotation(covariance, axis);
    return {scale, rotation,
            (target() - scale * (rotation * source())) / sums_[WEIGHT]};
  }

  /** A pose with another scale, at which the middle of the source points stays. */
  Similarity
  scaled(const Similarity& pose, double scale) const
  {
    const Eigen::Vector3d middle = pose.rotation * source() / sums_[WEIGHT];
    return {scale, pose.rotation, pose.translation + (pose.scale - scale) * middle};
  }

private:
  Eigen::Vector3d
  source() const
  {
    return Eigen::Map<const Eigen::Vector3d>(sums_ + SOURCE);
  }

  Eigen::Vector3d
  target() const
  {
    return Eigen::Map<const Eigen::Vector3d>(sums_ + TARGET);
  }

  double sums_[SUMS] = {};
};

/** Finds the counterparts of a cloud's probes in the other cloud, from pose to pose. */
class Counterparts {
public:
  /** \param[out] own the probes' side of the pairs
   * \param[out] other the counterparts' side of them */
  Counterparts(const Points& probes,
               const SurfacePoints& others,
               const Refinement::Effort& effort,
               Pairs& pairs,
               Pairs::Rows& own,
               Pairs::Rows& other)
  : others_(others)
  , exact_(effort.exact)
  , found_(std::min(effort.points, probes.cols()))
  , matches_(found_.size())
  , pairs_(pairs)
  , own_(own)
  , other_(other)
  {
    const auto size = static_cast<Eigen::Index>(found_.size());
    const Eigen::Index filled = roundedUp<Eigen::Index>(size, lanes);
    own.setZero(3, filled);
    own.leftCols(size) = probes.leftCols(size);
    other.setZero(3, filled);
    pairs.squared.setConstant(filled, std::numeric_limits<float>::infinity());
  }

  /** Find them where the probes have been placed; their distances, scaled. */
  void
  find(const Eigen::Affine3f& placement, float scale)
  {
    const Points& points = others_.points->points();
    for (std::size_t i = 0; i < found_.size(); ++i) {
      const Eigen::Vector3f placed = placement * own_.col(i);
      float squared;
      const int other = exact_ ? nearest(found_[i], placed, squared)
                               : others_.points->near(placed, squared);
      matches_[i] = other;
      other_.col(i) = points.col(other);
      pairs_.squared[i] = scale * scale * squared;
    }
  }

  /** The normals of the other cloud at the counterparts, filled up as these are. */
  Pairs::Rows
  normals() const
  {
    Pairs::Rows normals = Pairs::Rows::Zero(3, pairs_.squared.size());
    for (std::size_t i = 0; i < matches_.size(); ++i)
      normals.col(static_cast<Eigen::Index>(i)) = others_.normals.col(matches_[i]);
    return normals;
  }

private:
  /** The point nearest to a place, and how far from it that stays so. */
  struct Found {
    int point = -1;
    Eigen::Vector3f place;
    float squared_slack;
  };

  int
  nearest(Found& found, const Eigen::Vector3f& placed, float& squared) const
  {
    if (found.point >= 0 &&
        (placed - found.place).squaredNorm() < found.squared_slack) {
      squared = (others_.points->points().col(found.point) - placed).squaredNorm();
      return found.point;
    }
    float second;
    found.point = others_.points->nearest(placed, squared, second);
    found.place = placed;
    const float slack = 0.5f * (std::sqrt(second) - std::sqrt(squared));
    found.squared_slack = slack * slack;
    return found.point;
  }

  const SurfacePoints& others_;
  bool exact_;
  std::vector<Found> found_;
  std::vector<int> matches_;
  Pairs& pairs_;
  Pairs::Rows &own_, &other_;
};

/** Pull a pose towards the planes of correspondences. */
Similarity
pulledToPlanes(const Similarity& pose,
               const Pairs& from_source,
               const Counterparts& forth,
               const Pairs& from_target,
               const Counterparts& back,
               double reach,
               RotationAxis axis)
{
  PlanePulls pulls;
  const Eigen::Affine3f placement = pose.affine();
  const Eigen::Matrix3f rotation = pose.rotation.cast<float>();
  const auto squared_reach = static_cast<float>(reach * reach);
  const auto add = [&](const Pairs& pairs, const Pairs::Rows& normals) {
    const Pairs::Rows placed = placement.linear().lazyProduct(pairs.source).colwise() +
                               placement.translation();
    const Eigen::RowVectorXf weights =
        (squared_reach / (squared_reach + pairs.squared.array())).square();
    pulls.add(placed, pairs.target, normals, weights);
  };
  add(from_source, forth.normals());
  add(from_target, rotation.lazyProduct(back.normals()));
  return pulls.moved(pose, turnsOf(axis));
}

/** By how much two poses differ in any number of their matrices. */
double
largestChange(const Similarity& a, const Similarity& b)
{
  return std::max((a.linear() - b.linear()).cwiseAbs().maxCoeff(),
                  (a.translation - b.translation).cwiseAbs().maxCoeff());
}

} // namespace

Refinement::Refinement(const Points& source_probes,
                       const Points& target_probes,
                       const SurfacePoints& source,
                       const SurfacePoints& target,
                       const ScaleRange& scales,
                       RotationAxis axis)
: source_probes_(source_probes)
, target_probes_(target_probes)
, source_(source)
, target_(target)
, scales_(scales)
, axis_(axis)
{
}

Similarity
Refinement::refine(const Similarity& initial, const Effort& effort) const
{
  Similarity pose = initial;
  const int falling = std::max(1, effort.iterations / 2);
  Pairs from_source, from_target;
  Counterparts forth(source_probes_, target_, effort, from_source, from_source.source,
                     from_source.target);
  Counterparts back(target_probes_, source_, effort, from_target, from_target.target,
                    from_target.source);
  for (int iteration = 0; iteration < effort.iterations; ++iteration) {
    const double fallen = std::min(1.0, static_cast<double>(iteration) / falling);
    const double reach =
        effort.widest * std::pow(effort.narrowest / effort.widest, fallen);
    const Eigen::Affine3f placement = pose.affine();
    forth.find(placement, 1.0f);
    back.find(placement.inverse(), static_cast<float>(pose.scale));
    Procrustes pairs;
    pairs.add(from_source, reach);
    pairs.add(from_target, reach);
    const double estimate = scales_.smallest < scales_.largest
                                ? scales_.clamp(pairs.symmetricScale())
                                : pose.scale;
    // planes pull about the middle of the pairs, which the scale leaves where it is
    const Similarity next =
        effort.on_planes ? pulledToPlanes(pairs.scaled(pose, estimate), from_source,
                                          forth, from_target, back, reach, axis_)
                         : pairs.similarity(estimate, axis_);
    if (!next.isUsable())
      break;
    const bool settled = iteration > falling && largestChange(pose, next) < 1e-5;
    pose = next;
    if (settled)
      break;
  }
  return pose;
}

} // namespace kss
} // namespace pcl
