/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "arrays.h"

#include <pcl/registration/kss/detail/similarity.h>
#include <pcl/registration/kss/settings_text.h>

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <stdexcept>
#include <string>

namespace pcl_kss_icp {
namespace {

namespace py = pybind11;
namespace kss = pcl::kss;

/** A copy: a row of ours is a column of Eigen's. */
template <typename Scalar>
Eigen::Matrix<Scalar, 3, Eigen::Dynamic>
columnsOf(const Rows<Scalar>& rows)
{
  if (rows.ndim() != 2 || rows.shape(1) != 3)
    throw std::invalid_argument("N x 3 numbers are needed");
  return Eigen::Map<const Eigen::Matrix<Scalar, 3, Eigen::Dynamic>>(rows.data(), 3,
                                                                    rows.shape(0));
}

py::object
wordOf(kss::FailureCause cause)
{
  switch (cause) {
  case kss::FailureCause::NONE:
    return py::none();
  case kss::FailureCause::INPUT:
    return py::str("input");
  case kss::FailureCause::DEVICE:
    return py::str("device");
  case kss::FailureCause::STOPPED:
    return py::str("stopped");
  case kss::FailureCause::UNSETTLED:
    return py::str("unsettled");
  case kss::FailureCause::NO_FIT:
    return py::str("no_fit");
  case kss::FailureCause::OTHER:
    break;
  }
  return py::str("other");
}

std::string
wordOf(kss::Mode mode)
{
  namespace setting = kss::setting;
  return valueText(setting::rowOf<&kss::Settings::mode>(), mode, setting::For::PROGRAM);
}

py::dict
dictOf(const kss::Support& support)
{
  py::dict dict;
  dict["near"] = support.near;
  dict["explained"] = support.explained;
  dict["worst"] = support.worst;
  dict["consistent"] = support.consistent;
  dict["points"] = support.points;
  return dict;
}

py::dict
dictOf(const kss::Evidence& evidence)
{
  py::dict dict;
  dict["source"] = dictOf(evidence.source);
  dict["target"] = dictOf(evidence.target);
  dict["residual"] = evidence.residual;
  dict["noise"] = evidence.noise;
  dict["reach"] = evidence.reach;
  dict["size"] = evidence.size;
  return dict;
}

Eigen::Matrix4d
matrixOf(const kss::StoredPose& pose)
{
  return pose;
}

py::dict
dictOf(const kss::Alternative& alternative)
{
  py::dict dict;
  dict["transformation"] = matrixOf(alternative.transformation);
  dict["overlap"] =
      py::make_tuple(alternative.overlap.source, alternative.overlap.target);
  dict["score"] = alternative.overlap.score;
  dict["evidence"] = dictOf(alternative.evidence);
  return dict;
}

} // namespace

kss::StoredPose
poseOf(const Rows<double>& matrix)
{
  if (matrix.ndim() != 2 || matrix.shape(0) != 4 || matrix.shape(1) != 4)
    throw std::invalid_argument("4 x 4 numbers are needed");
  return Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(matrix.data());
}

kss::Cloud
cloudOf(const Rows<double>& points, const Rows<float>& normals)
{
  return {columnsOf(points), columnsOf(normals)};
}

py::dict
dictOf(const kss::Registered& result)
{
  py::list alternatives;
  for (const kss::Alternative& alternative : result.alternatives)
    alternatives.append(dictOf(alternative));
  py::dict seconds;
  for (const kss::StageSeconds& stage : result.seconds)
    seconds[py::str(stage.stage)] = stage.seconds;
  const int unknowns = result.precision.unknowns;

  py::dict dict;
  dict["transformation"] = matrixOf(result.transformation);
  dict["scale"] = kss::scaleOf(result.transformation);
  dict["converged"] = result.failure.cause == kss::FailureCause::NONE;
  dict["reason"] = result.failure.reason;
  dict["cause"] = wordOf(result.failure.cause);
  dict["confidence"] = kss::confidenceOf(result.alternatives);
  dict["ambiguous"] = kss::isAmbiguous(result.alternatives);
  dict["alternatives"] = alternatives;
  dict["covariance"] = py::none();
  if (unknowns > 0)
    dict["covariance"] =
        Eigen::MatrixXd(result.precision.covariance.topLeftCorner(unknowns, unknowns));
  dict["undetermined"] = result.precision.undetermined;
  dict["mode"] = py::none();
  if (!result.alternatives.empty())
    dict["mode"] = wordOf(result.mode);
  dict["iterations"] = result.iterations;
  dict["far_points"] =
      py::make_tuple(result.far_points.source, result.far_points.target);
  dict["seconds"] = seconds;
  // names of devices may hold anything
  dict["device"] = py::reinterpret_steal<py::str>(PyUnicode_DecodeUTF8(
      result.device.data(), static_cast<Py_ssize_t>(result.device.size()), "replace"));
  return dict;
}

} // namespace pcl_kss_icp
