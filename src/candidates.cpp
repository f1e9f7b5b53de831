/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include <pcl/registration/kss/candidates.h>

#include <algorithm>

namespace pcl {
namespace kss {

Candidates::Candidates(std::shared_ptr<const CandidateRotations> rotations,
                       std::vector<double> scales,
                       CandidateCenters centers,
                       Side side)
: rotations_(std::move(rotations))
, scales_(std::move(scales))
, centers_(std::move(centers))
, side_(side)
{
}

Candidates::Parts
Candidates::partsOf(std::size_t index) const
{
  const std::size_t centers = centers_.centers.size();
  return {index / centers / scales_.size(), index / centers % scales_.size(),
          index % centers};
}

Eigen::Matrix4d
Candidates::pose(std::size_t index) const
{
  const Parts parts = partsOf(index);
  const Eigen::Vector3d& center = centers_.centers[parts.center];
  const Eigen::Matrix3d linear =
      scales_[parts.scale] * rotations_->rotations()[parts.rotation].toRotationMatrix();
  Eigen::Matrix4d pose = Eigen::Matrix4d::Identity();
  pose.topLeftCorner<3, 3>() = linear;
  pose.topRightCorner<3, 1>() =
      side_ == Side::TARGET ? center : Eigen::Vector3d(-linear * center);
  return pose;
}

std::vector<Placement>
Candidates::placements(std::size_t begin, std::size_t count) const
{
  std::vector<Placement> found;
  found.reserve(count);
  for (std::size_t i = begin; i < begin + count; ++i)
    found.push_back(pose(i).topRows<3>().cast<float>());
  return found;
}

std::vector<std::size_t>
Candidates::localMinima(const std::vector<float>& energies,
                        unsigned int kernel,
                        double distinct_angle) const
{
  // Equal energies are told apart by their place, so that a plateau has one minimum.
  const auto lower = [&](std::size_t a, std::size_t b) {
    return energies[a] != energies[b] ? energies[a] < energies[b] : a < b;
  };
  const std::size_t centers = centers_.centers.size();
  const int scales = static_cast<int>(scales_.size());

  // the centres at and around each centre
  std::vector<std::vector<std::size_t>> around(centers);
  const auto [nx, ny, nz] = centers_.steps;
  for (int x = 0; x < nx; ++x)
    for (int y = 0; y < ny; ++y)
      for (int z = 0; z < nz; ++z)
        for (int i = std::max(0, x - 1); i <= std::min(nx - 1, x + 1); ++i)
          for (int j = std::max(0, y - 1); j <= std::min(ny - 1, y + 1); ++j)
            for (int k = std::max(0, z - 1); k <= std::min(nz - 1, z + 1); ++k)
              around[(x * ny + y) * nz + z].push_back((i * ny + j) * nz + k);

  std::vector<std::size_t> minima;
  for (std::size_t rotation = 0; rotation < rotations_->rotations().size();
       ++rotation) {
    std::vector<std::size_t> rotations = rotations_->neighbours(rotation, kernel);
    rotations.insert(rotations.begin(), rotation);
    for (int scale = 0; scale < scales; ++scale)
      for (std::size_t center = 0; center < centers; ++center) {
        const std::size_t index = (rotation * scales + scale) * centers + center;
        const auto is_lower_around = [&](std::size_t r) {
          for (int s = std::max(0, scale - 1); s <= std::min(scales - 1, scale + 1);
               ++s)
            for (const std::size_t c : around[center])
              if (lower((r * scales + s) * centers + c, index))
                return true;
          return false;
        };
        if (std::none_of(rotations.begin(), rotations.end(), is_lower_around))
          minima.push_back(index);
      }
  }
  std::sort(minima.begin(), minima.end(), lower);

  std::vector<std::size_t> distinct;
  for (const std::size_t i : minima) {
    const Parts a = partsOf(i);
    if (std::none_of(distinct.begin(), distinct.end(), [&](std::size_t j) {
          const Parts b = partsOf(j);
          return a.center == b.center && a.scale == b.scale &&
                 rotations_->rotations()[a.rotation].angularDistance(
                     rotations_->rotations()[b.rotation]) < distinct_angle;
        }))
      distinct.push_back(i);
  }
  return distinct;
}

} // namespace kss
} // namespace pcl
