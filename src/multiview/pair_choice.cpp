/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "multiview/pair_choice.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace pcl {
namespace kss {

double
resemblance(const ScanDescription& a, const ScanDescription& b)
{
  // octaves that only one of them has count against both
  const double octaves = (a.features.colwise().squaredNorm().array() +
                              b.features.colwise().squaredNorm().array() >
                          0.0f)
                             .count();
  return octaves > 0.0 ? (a.features.array() * b.features.array()).sum() / octaves
                       : 0.0;
}

std::vector<ScanPair>
pairsToTry(const std::vector<ScanDescription>& scans,
           const std::vector<std::size_t>& usable,
           std::size_t all_pairs,
           std::size_t partners)
{
  std::set<ScanPair> pairs;
  const auto add = [&pairs](std::size_t a, std::size_t b) {
    pairs.insert({std::min(a, b), std::max(a, b)});
  };
  if (usable.size() <= std::max<std::size_t>(all_pairs, partners)) {
    for (const std::size_t a : usable)
      for (const std::size_t b : usable)
        if (a < b)
          add(a, b);
    return {pairs.begin(), pairs.end()};
  }
  for (std::size_t i = 0; i < usable.size(); ++i) {
    const std::size_t scan = usable[i];
    if (i + 1 < usable.size())
      add(scan, usable[i + 1]);
    std::vector<std::pair<double, std::size_t>> others;
    for (const std::size_t other : usable)
      if (other != scan)
        others.emplace_back(-resemblance(scans[scan], scans[other]), other);
    std::partial_sort(others.begin(), others.begin() + partners, others.end());
    for (std::size_t p = 0; p < partners; ++p)
      add(scan, others[p].second);
  }
  return {pairs.begin(), pairs.end()};
}

} // namespace kss
} // namespace pcl
