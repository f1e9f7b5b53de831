/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "texts.h"

#include <Eigen/Geometry>

#include <iomanip>
#include <limits>
#include <sstream>

namespace tool {
namespace {

namespace kss = pcl::kss;

/** Translation and rotation as g2o has them: x y z, then the quaternion, its real part
 * last. */
void
writePose(std::ostream& stream, const Eigen::Matrix4d& pose)
{
  const Eigen::Vector3d place = pose.topRightCorner<3, 1>();
  Eigen::Quaterniond turn(Eigen::Affine3d(pose).rotation());
  turn.normalize();
  if (turn.w() < 0.0)
    turn.coeffs() *= -1.0;
  for (const double number :
       {place.x(), place.y(), place.z(), turn.x(), turn.y(), turn.z(), turn.w()})
    stream << ' ' << number;
}

Eigen::Matrix3d
crossWith(const Eigen::Vector3d& vector)
{
  Eigen::Matrix3d matrix;
  matrix << 0.0, -vector.z(), vector.y(), vector.z(), 0.0, -vector.x(), -vector.y(),
      vector.x(), 0.0;
  return matrix;
}

} // namespace

/*
 * A pair says where its source is on its target: T maps p of the source to R p + t. Its
 * information is over (w, u): a pose nearby turns the source by w about the axes of the
 * target, round the source's centroid c, and moves it by u,
 *
 *     T' p = exp(w) R (p - c) + R c + t + u.
 *
 * In g2o, an edge from vertex i to vertex j measures Z, which is to be X_i^-1 X_j. As
 * X_i maps scan i to the world, X_target^-1 X_source = T: the edge leads from the
 * target to the source, and Z is T. Its error is (e, q): e is the translation, and q
 * the vector part of the quaternion, of Z^-1 X_i^-1 X_j. With T' for X_i^-1 X_j that is
 *
 *     T^-1 T' p = R^T (exp(w) R (p - c) + R c + u) = exp(R^T w) (p - c) + c + R^T u,
 *
 * a rotation by v = R^T w, of which q = v / 2 to first order, and the translation
 *
 *     e = c - exp(v) c + R^T u = c x v + R^T u = 2 [c]x q + R^T u  to first order.
 *
 * Hence w = 2 R q and u = R e - 2 R [c]x q: (w, u) = J (e, q), and the information over
 * (e, q) is J^T information J.
 */
Eigen::Matrix<double, 6, 6>
g2oInformation(const kss::PairPose& pose, const Eigen::Vector3d& centroid)
{
  const Eigen::Matrix4d transformation = pose.transformation;
  const Eigen::Matrix3d rotation = Eigen::Affine3d(transformation).rotation();
  Eigen::Matrix<double, 6, 6> jacobian = Eigen::Matrix<double, 6, 6>::Zero();
  jacobian.topRightCorner<3, 3>() = 2.0 * rotation;
  jacobian.bottomLeftCorner<3, 3>() = rotation;
  jacobian.bottomRightCorner<3, 3>() = -2.0 * rotation * crossWith(centroid);
  const Eigen::Matrix<double, 6, 6> information = pose.information;
  const Eigen::Matrix<double, 6, 6> converted =
      jacobian.transpose() * information * jacobian;
  return 0.5 * (converted + converted.transpose());
}

std::string
g2oText(const Model& model, const std::vector<std::size_t>& group)
{
  std::ostringstream text;
  text << std::setprecision(std::numeric_limits<double>::max_digits10);
  for (const std::size_t scan : group) {
    text << "VERTEX_SE3:QUAT " << scan + 1;
    writePose(text, model.result.scans[scan].transformation);
    text << '\n';
  }
  text << "FIX " << group.front() + 1 << '\n';
  const std::size_t number = model.result.scans[group.front()].group;
  for (const auto& pair : model.result.pairs) {
    const auto& result = pair.result;
    const auto* pose = poseOf(pair);
    if (pair.verdict != kss::PairVerdict::KEPT || !pose ||
        model.result.scans[result.source].group != number)
      continue;
    text << "EDGE_SE3:QUAT " << result.target + 1 << ' ' << result.source + 1;
    writePose(text, pose->transformation);
    const auto information =
        g2oInformation(*pose, model.result.scans[result.source].centroid);
    for (int row = 0; row < 6; ++row)
      for (int column = row; column < 6; ++column)
        text << ' ' << information(row, column);
    text << '\n';
  }
  return text.str();
}

} // namespace tool
