/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

/** \file
 * Arbitrary clouds, settings, guesses and indices for pcl::KSSICP::align(), several
 * times with one object: there is a finite similarity, or a reason why not.
 */

#include "bytes.h"
#include "preparation/simplification.h"
#include "require.h"
#include "search/candidate_search.h"

#include <pcl/common/transforms.h>
#include <pcl/registration/kss_icp.h>
#include <pcl/registration/transformation_estimation_point_to_plane_lls.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

namespace {

using kss_fuzz::Bytes;
using Point = pcl::PointNormal;
using Cloud = pcl::PointCloud<Point>;
using Matrix = Eigen::Matrix4f;

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

using Registration = pcl::KSSICP<Point, Point>;

float
unusual(Bytes& bytes)
{
  static const float values[] = {
      0.0f,         -0.0f,    1.0f,      1e-3f, 1e3f,  1e6f,    1e9f,
      1e12f,        1e18f,    1e19f,     1e20f, 1e30f, 3.4e38f, -3.4e38f,
      not_a_number, infinity, -1e19f,    1e-6f, 1e-9f, 1e-20f,  1e-38f,
      1e-45f,       -1e6f,    -infinity, 2e9f,  4e9f,  9.3e18f};
  return bytes.flag() ? bytes.take<float>() : bytes.oneOf(values);
}

/** Mostly sizes that are met; all powers of ten that there are. */
float
magnitude(Bytes& bytes)
{
  const int exponent = bytes.flag() ? 0 : static_cast<int>(bytes.below(76)) - 38;
  return std::pow(10.0f, static_cast<float>(exponent));
}

Cloud::Ptr
cloudOf(Bytes& bytes)
{
  const auto cloud = pcl::make_shared<Cloud>();
  const unsigned int size = bytes.below(48);
  const float scale = magnitude(bytes);
  const float shift = bytes.flag() ? magnitude(bytes) : 0.0f;
  const unsigned int axes = 1 + bytes.below(3);
  for (unsigned int i = 0; i < size; ++i) {
    Point point;
    for (unsigned int axis = 0; axis < 3; ++axis)
      point.data[axis] =
          (axis < axes ? scale * bytes.take<std::int8_t>() : 0.0f) + shift;
    point.getNormalVector3fMap() = Eigen::Vector3f::Unit(i % 3);
    cloud->push_back(point);
  }
  for (unsigned int i = bytes.flag() ? bytes.below(4) : 0; i > 0 && size > 0; --i) {
    const unsigned int index = bytes.below(size);
    (*cloud)[index].data[bytes.below(3)] = unusual(bytes);
  }
  cloud->is_dense = bytes.flag();
  return cloud;
}

/** A rotation, scale and shift that are met. */
Matrix
similarity(Bytes& bytes)
{
  const Eigen::Quaternionf rotation(1.0f, bytes.take<std::int8_t>() / 64.0f,
                                    bytes.take<std::int8_t>() / 64.0f,
                                    bytes.take<std::int8_t>() / 64.0f);
  Matrix matrix = Matrix::Identity();
  matrix.topLeftCorner<3, 3>() =
      magnitude(bytes) * rotation.normalized().toRotationMatrix();
  for (int axis = 0; axis < 3; ++axis)
    matrix(axis, 3) = bytes.take<std::int8_t>() * magnitude(bytes);
  return matrix;
}

Matrix
guessOf(Bytes& bytes)
{
  switch (bytes.below(4)) {
  case 0: {
    Matrix guess = similarity(bytes);
    guess(bytes.below(4), bytes.below(4)) = unusual(bytes);
    return guess;
  }
  case 1:
    return similarity(bytes);
  default:
    return Matrix::Identity();
  }
}

pcl::IndicesPtr
indicesOf(Bytes& bytes, const Cloud& cloud)
{
  const auto indices = pcl::make_shared<pcl::Indices>();
  const unsigned int kind = bytes.below(16);
  const auto size = static_cast<unsigned int>(cloud.size());
  for (unsigned int i = size > 0 ? bytes.below(32) : 0; i > 0; --i)
    indices->push_back(kind == 0 ? bytes.take<pcl::index_t>()
                                 : bytes.below(size + (kind == 1)));
  return indices;
}

/** Some of the settings become others; few rotations, so that thousands of searches
 * take a second. */
void
change(pcl::kss::Settings& settings, Bytes& bytes)
{
  using namespace pcl::kss;
  static const Mode modes[] = {Mode::AUTOMATIC, Mode::GLOBAL_GLOBAL,
                               Mode::PARTIAL_GLOBAL, Mode::PARTIAL_PARTIAL};
  static const Search searches[] = {Search::EXACT, brute_force, Search::SCREENED};
  static const Density densities[] = {Density::UNIFORM, Density::PAPER, random_points};
  static const double bounds[] = {0.0, 0.5,  1.0,   2.0,   1e-300, 1e-20,   1e-3,
                                  1e3, 1e20, 1e300, 1e308, -1.0,   infinity};
  settings.mode = bytes.oneOf(modes);
  settings.search = bytes.oneOf(searches);
  settings.density = bytes.oneOf(densities);
  settings.energy = bytes.flag() ? Energy::HAUSDORFF : Energy::TRUNCATED_MEAN;
  settings.center_set = bytes.flag() ? CenterSet::PAPER : CenterSet::SPREAD;
  settings.rotation_set = bytes.flag() ? RotationSet::EULER : RotationSet::EVEN;
  settings.sample_points = 20 + bytes.below(32);
  settings.angle_step = M_PI;
  settings.even_rotations = 1 + bytes.below(3);
  settings.search_points = bytes.below(130);
  settings.local_minimum_kernel = bytes.below(9);
  settings.icp_points = bytes.below(40);
  settings.clean = bytes.flag();
  settings.estimate_scale = bytes.flag();
  settings.additional_process_threshold = bytes.oneOf(bounds);
  settings.smallest_scale = bytes.oneOf(bounds);
  settings.largest_scale = bytes.oneOf(bounds);
}

/** What holds after every align().
 * \param[in] indices none: all points
 */
void
check(Registration& registration,
      const Cloud& source,
      const pcl::Indices* indices,
      const Cloud& output)
{
  const Matrix pose = registration.getFinalTransformation();
  KSS_FUZZ_REQUIRE(pose.allFinite());
  KSS_FUZZ_REQUIRE(registration.getFailureReason().empty() ==
                   registration.hasConverged());
  const double confidence = registration.getConfidence();
  KSS_FUZZ_REQUIRE(confidence >= 0.0 && confidence <= 1.0);
  for (const auto& alternative : registration.getAlternatives()) {
    KSS_FUZZ_REQUIRE(alternative.transformation.allFinite());
    KSS_FUZZ_REQUIRE(std::isfinite(alternative.overlap.score));
  }
  if (registration.hasConverged()) {
    KSS_FUZZ_REQUIRE(pcl::kss::isSimilarity(pose.cast<double>()));
    KSS_FUZZ_REQUIRE(registration.getScale() > 0.0);
  }
  const auto size = static_cast<pcl::index_t>(source.size());
  if (indices && std::any_of(indices->begin(), indices->end(),
                             [&](pcl::index_t i) { return i < 0 || i >= size; })) {
    KSS_FUZZ_REQUIRE(!registration.hasConverged());
    return;
  }
  const bool has_some = !source.empty();
  KSS_FUZZ_REQUIRE(output.size() ==
                   (indices && has_some ? indices->size() : source.size()));
  for (std::size_t i = 0; i < output.size(); ++i)
    if (source[indices ? (*indices)[i] : i].getVector3fMap().allFinite())
      KSS_FUZZ_REQUIRE(!output[i].getVector3fMap().hasNaN());
  KSS_FUZZ_REQUIRE(!std::isnan(registration.getFitnessScore()));
}

} // namespace

extern "C" int
LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  Bytes bytes(data, size);
  Registration registration;
  pcl::kss::Settings settings = registration.getSettings();
  settings.device = "host";
  settings.threads = 1;
  settings.even_rotations = 4;
  settings.rotation_set = pcl::kss::RotationSet::EVEN;
  registration.setSettings(settings);
  registration.setMaximumIterations(3);
  Cloud::Ptr source, target;
  pcl::IndicesPtr indices;
  // an input says what changes from one align() to the next
  for (int calls = 0; calls < 3 && (calls == 0 || !bytes.empty()); ++calls) {
    const unsigned int what = bytes.byte();
    if (what & 1 || calls == 0)
      change(settings, bytes);
    registration.setSettings(settings);
    if (what & 2 || calls == 0) {
      source = cloudOf(bytes);
      registration.setInputSource(source);
    }
    if (what & 4 || calls == 0) {
      target = cloudOf(bytes);
      if (what & 8 && source) {
        target = pcl::make_shared<Cloud>();
        pcl::transformPointCloud(*source, *target, similarity(bytes));
      }
      registration.setInputTarget(target);
    }
    if (what & 16) {
      indices = indicesOf(bytes, *source);
      registration.setIndices(indices);
    }
    if (what & 32) {
      registration.setMaximumIterations(bytes.below(12) - 1);
      registration.setMaxCorrespondenceDistance(unusual(bytes));
      settings.minimum_confidence = bytes.byte() / 255.0;
      registration.setMinimumConfidence(settings.minimum_confidence);
      registration.setTransformationEpsilon(unusual(bytes));
    }
    if (what & 64)
      registration.setTransformationEstimation(
          pcl::make_shared<pcl::registration::TransformationEstimationPointToPlaneLLS<
              Point, Point>>());
    Cloud output;
    registration.align(output, what & 128 ? guessOf(bytes) : Matrix::Identity());
    check(registration, *source, indices.get(), output);
  }
  return 0;
}
