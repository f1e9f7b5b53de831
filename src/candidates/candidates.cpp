/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "candidates/candidates.h"

#include <pcl/registration/kss/detail/stopping.h>

#include "candidates/rotation_cells.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pcl {
namespace kss {

Candidates::Candidates(std::shared_ptr<const CandidateRotations> rotations,
                       std::vector<double> scales,
                       CandidateCenters centers,
                       Role centered)
: rotations_(std::move(rotations))
, scales_(std::move(scales))
, centers_(std::move(centers))
, centered_(centered)
, around_(centers_.centers.size())
{
  const auto [nx, ny, nz] = centers_.steps;
  for (int x = 0; x < nx; ++x)
    for (int y = 0; y < ny; ++y)
      for (int z = 0; z < nz; ++z)
        for (int i = std::max(0, x - 1); i <= std::min(nx - 1, x + 1); ++i)
          for (int j = std::max(0, y - 1); j <= std::min(ny - 1, y + 1); ++j)
            for (int k = std::max(0, z - 1); k <= std::min(nz - 1, z + 1); ++k)
              around_[(x * ny + y) * nz + z].push_back((i * ny + j) * nz + k);
}

Candidates::Parts
Candidates::partsOf(std::size_t index) const
{
  const std::size_t centers = centers_.centers.size();
  return {index / centers / scales_.size(), index / centers % scales_.size(),
          index % centers};
}

Similarity
Candidates::pose(std::size_t index) const
{
  const Parts parts = partsOf(index);
  const Eigen::Vector3d& center = centers_.centers[parts.center];
  Similarity pose{scales_[parts.scale],
                  rotations_->rotations()[parts.rotation].toRotationMatrix(), center};
  if (centered_ == Role::SOURCE)
    pose.translation = -pose.linear() * center;
  return pose;
}

std::vector<Placement>
Candidates::placements(std::size_t begin, std::size_t count) const
{
  std::vector<Placement> found;
  found.reserve(count);
  for (std::size_t i = begin; i < begin + count; ++i)
    found.push_back(pose(i).placement());
  return found;
}

std::vector<Placement>
Candidates::placements(const std::vector<std::size_t>& indices) const
{
  std::vector<Placement> found;
  found.reserve(indices.size());
  for (const std::size_t i : indices)
    found.push_back(pose(i).placement());
  return found;
}

template <typename Energies>
std::vector<std::size_t>
Candidates::localMinima(const Energies& energies,
                        const std::vector<std::size_t>& among,
                        unsigned int kernel,
                        double distinct_angle) const
{
  // Equal energies are told apart by their place, so that a plateau has one minimum.
  const auto lower = [&](std::size_t a, std::size_t b) {
    return energies[a] != energies[b] ? energies[a] < energies[b] : a < b;
  };
  const std::size_t centers = centers_.centers.size(), scales = scales_.size();
  std::vector<std::size_t> minima;
  for (const std::size_t index : among) {
    const Parts at = partsOf(index);
    const std::size_t first = at.scale > 0 ? at.scale - 1 : 0;
    const std::size_t last = std::min(at.scale + 1, scales - 1);
    const auto is_lower_around = [&](std::size_t rotation) {
      for (std::size_t scale = first; scale <= last; ++scale)
        for (const std::size_t center : around_[at.center])
          if (lower((rotation * scales + scale) * centers + center, index))
            return true;
      return false;
    };
    if (is_lower_around(at.rotation))
      continue;
    throwIfStopped();
    const auto others = rotations_->neighbours(at.rotation, kernel);
    if (std::none_of(others.begin(), others.end(), is_lower_around))
      minima.push_back(index);
  }
  std::sort(minima.begin(), minima.end(), lower);
  return distinct(minima, distinct_angle);
}

std::vector<std::size_t>
Candidates::localMinima(const std::vector<float>& energies,
                        unsigned int kernel,
                        double distinct_angle) const
{
  std::vector<std::size_t> all(energies.size());
  std::iota(all.begin(), all.end(), 0);
  return localMinima(energies, all, kernel, distinct_angle);
}

std::vector<std::size_t>
Candidates::localMinima(const SomeEnergies& energies,
                        unsigned int kernel,
                        double distinct_angle) const
{
  return localMinima(energies, energies.candidates(), kernel, distinct_angle);
}

std::vector<std::size_t>
Candidates::distinct(const std::vector<std::size_t>& candidates, double angle) const
{
  if (angle <= 0.0)
    return candidates;
  // the cosine of half the angle between rotations is their quaternions' product
  const double smallest_cosine = std::cos(0.5 * angle);
  const double chord = RotationCells::chord(std::min(angle, M_PI));
  const auto rotationOf = [&](std::size_t candidate) -> const Eigen::Quaterniond& {
    return rotations_->rotations()[partsOf(candidate).rotation];
  };
  const std::size_t places = centers_.centers.size() * scales_.size();
  RotationCells cells(chord);
  std::vector<std::size_t> distinct;
  for (const std::size_t i : candidates) {
    throwIfStopped();
    const Eigen::Quaterniond& rotation = rotationOf(i);
    const std::size_t place = i % places;
    if (!cells.anyNear(rotation, chord, place, [&](std::size_t taken) {
          const std::size_t other = distinct[taken];
          return other % places == place &&
                 std::abs(rotation.dot(rotationOf(other))) > smallest_cosine;
        })) {
      distinct.push_back(i);
      cells.add(rotation, place);
    }
  }
  return distinct;
}

} // namespace kss
} // namespace pcl
