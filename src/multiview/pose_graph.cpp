/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * The solver is Ceres; the equations of a link are these. Let c be the source's
 * centroid and x_i = P_i c_i where a pose P_i places the centroid of scan i. A link
 * says that the source has the rotation R and its centroid the place y = T c in the
 * frame of the target. Poses say R_j^T R_i and R_j^T (x_i - x_j) + c_j. The errors are
 *
 *   e = [ log (R_j^T R_i R^T),  R_j^T (x_i - x_j) + c_j - y ]
 *
 * and what is minimized is the sum of rho (e^T W e), W being the information. Places of
 * centroids instead of origins keep rotation and translation apart where scans are far
 * from their origins.
 */

#include "multiview/pose_graph.h"

#include <ceres/ceres.h>
#include <ceres/rotation.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <cmath>
#include <map>
#include <memory>

namespace pcl {
namespace kss {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

/** A link's error counts in full up to so many standard deviations of its six numbers
 * together, and less and less beyond. */
constexpr double full_say = 4.0;

/** A scan as the solver moves it. */
struct Placed {
  Eigen::Quaterniond rotation;
  Eigen::Vector3d centroid;
};

/** A factor of the information: its errors are sums of squares. */
Matrix6
factorOf(const Matrix6& information)
{
  const Eigen::SelfAdjointEigenSolver<Matrix6> solver(
      0.5 * (information + information.transpose()));
  return solver.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal() *
         solver.eigenvectors().transpose();
}

struct LinkError {
  Matrix6 factor;
  Eigen::Quaterniond rotation; ///< of the source in the target
  Eigen::Vector3d place;       ///< of its centroid
  Eigen::Vector3d target_centroid;

  template <typename T>
  bool
  operator()(const T* source_rotation,
             const T* source_centroid,
             const T* target_rotation,
             const T* target_centroid_placed,
             T* errors) const
  {
    using Quaternion = Eigen::Quaternion<T>;
    using Vector = Eigen::Matrix<T, 3, 1>;
    const Quaternion to_target =
        Eigen::Map<const Quaternion>(target_rotation).conjugate();
    const Quaternion turn = to_target * Eigen::Map<const Quaternion>(source_rotation) *
                            rotation.conjugate().template cast<T>();
    const T coefficients[4] = {turn.w(), turn.x(), turn.y(), turn.z()};
    Eigen::Matrix<T, 6, 1> error;
    ceres::QuaternionToAngleAxis(coefficients, error.data());
    const Vector apart = Eigen::Map<const Vector>(source_centroid) -
                         Eigen::Map<const Vector>(target_centroid_placed);
    error.template tail<3>() =
        to_target * apart + (target_centroid - place).template cast<T>();
    Eigen::Map<Eigen::Matrix<T, 6, 1>> weighted(errors);
    weighted = factor.template cast<T>() * error;
    return true;
  }
};

} // namespace

void
solvePoses(const std::vector<ScanDescription>& scans,
           const std::vector<std::size_t>& group,
           const std::vector<PoseLink>& links,
           std::vector<StoredPose>& poses)
{
  if (group.size() < 2 || links.empty())
    return;
  std::map<std::size_t, Placed> placed;
  for (const std::size_t scan : group) {
    const Eigen::Matrix4d pose = poses[scan];
    placed[scan] = {
        Eigen::Quaterniond(Eigen::Matrix3d(pose.topLeftCorner<3, 3>())).normalized(),
        (pose * scans[scan].centroid.homogeneous()).head<3>()};
  }

  ceres::Problem problem;
  for (auto& [scan, at] : placed) {
    problem.AddParameterBlock(at.rotation.coeffs().data(), 4,
                              new ceres::EigenQuaternionManifold);
    problem.AddParameterBlock(at.centroid.data(), 3);
  }
  for (const PoseLink& link : links) {
    const Eigen::Matrix4d pose = link.transformation;
    auto* error = new LinkError{
        factorOf(link.information),
        Eigen::Quaterniond(Eigen::Matrix3d(pose.topLeftCorner<3, 3>())).normalized(),
        (pose * scans[link.source].centroid.homogeneous()).head<3>(),
        scans[link.target].centroid};
    Placed& source = placed.at(link.source);
    Placed& target = placed.at(link.target);
    problem.AddResidualBlock(
        new ceres::AutoDiffCostFunction<LinkError, 6, 4, 3, 4, 3>(error),
        new ceres::CauchyLoss(full_say), source.rotation.coeffs().data(),
        source.centroid.data(), target.rotation.coeffs().data(),
        target.centroid.data());
  }
  Placed& first = placed.at(group.front());
  problem.SetParameterBlockConstant(first.rotation.coeffs().data());
  problem.SetParameterBlockConstant(first.centroid.data());

  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.max_num_iterations = 200;
  options.function_tolerance = 1e-10;
  options.parameter_tolerance = 1e-12;
  options.num_threads = 1; // sums do not depend on threads
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (!summary.IsSolutionUsable())
    return;
  for (const auto& [scan, at] : placed) {
    const Eigen::Matrix3d rotation = at.rotation.normalized().toRotationMatrix();
    poses[scan].setIdentity();
    poses[scan].topLeftCorner<3, 3>() = rotation;
    poses[scan].topRightCorner<3, 1>() = at.centroid - rotation * scans[scan].centroid;
  }
}

} // namespace kss
} // namespace pcl
