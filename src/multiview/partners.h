/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace pcl {
namespace kss {

/** \brief Pairs of scans, or of groups, from which each takes its best ones. */
class Partners {
public:
  using Both = std::pair<std::size_t, std::size_t>;

  /** \param[in] rank the smaller the better */
  void
  add(double rank, const Both& both)
  {
    of_[both.first].push_back({rank, both});
    of_[both.second].push_back({rank, both});
  }

  /** \brief The pairs that either of the two takes.
   * \param[in] number gives how many each one takes
   */
  template <typename Number>
  std::set<Both>
  best(const Number& number)
  {
    std::set<Both> pairs;
    for (auto& [one, others] : of_) {
      std::sort(others.begin(), others.end());
      const std::size_t taken = std::min<std::size_t>(number(one), others.size());
      for (std::size_t i = 0; i < taken; ++i)
        pairs.insert(others[i].second);
    }
    return pairs;
  }

private:
  std::map<std::size_t, std::vector<std::pair<double, Both>>> of_;
};

} // namespace kss
} // namespace pcl
