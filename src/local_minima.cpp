/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include <pcl/registration/kss/local_minima.h>

#include <algorithm>
#include <numeric>

namespace pcl {
namespace kss {

std::vector<std::size_t>
localMinima(const std::vector<float>& energies,
            const CandidateRotations& candidates,
            unsigned int kernel,
            double distinct_angle)
{
  // Equal energies are told apart by their place, so that a plateau has one minimum.
  const auto lower = [&](std::size_t a, std::size_t b) {
    return energies[a] != energies[b] ? energies[a] < energies[b] : a < b;
  };
  std::vector<std::size_t> minima;
  for (std::size_t i = 0; i < energies.size(); ++i) {
    const auto around = candidates.neighbours(i, kernel);
    if (std::none_of(around.begin(), around.end(),
                     [&](std::size_t j) { return lower(j, i); }))
      minima.push_back(i);
  }
  std::sort(minima.begin(), minima.end(), lower);

  const auto& rotations = candidates.rotations();
  std::vector<std::size_t> distinct;
  for (const std::size_t i : minima)
    if (std::none_of(distinct.begin(), distinct.end(), [&](std::size_t j) {
          return rotations[i].angularDistance(rotations[j]) < distinct_angle;
        }))
      distinct.push_back(i);
  return distinct;
}

} // namespace kss
} // namespace pcl
