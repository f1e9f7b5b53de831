/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "search/exact/exact_search.h"

#include "candidates/neighbours.h"
#include "evaluators/evaluator_choice.h"
#include "search/exact/known_distances.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace pcl {
namespace kss {
namespace {

/** The search for the minima of one energy. */
class MinimumSearch {
public:
  MinimumSearch(KnownDistances& known,
                const CandidateNeighbours& neighbours,
                std::size_t candidates,
                const Weights& weights,
                Energy energy)
  : known_(known)
  , neighbours_(neighbours)
  , weights_(weights)
  , energy_(energy)
  , lower_(candidates)
  , upper_(candidates)
  , open_(candidates)
  {
    std::iota(open_.begin(), open_.end(), 0);
    update(open_);
  }

  /** Candidates none of whose neighbours has a lower energy, nor the same and a lower
   * index; by rising energy. */
  std::vector<std::size_t>
  minima()
  {
    raise(below(open_, 1), 1);
    // The cheapest step that can help, until none is left. Where a candidate may be a
    // minimum, the bounds of the one that comes nearest to ruling it out come first,
    // then its own, then its energy; last those of the neighbours that may be lower.
    const int closest = known_.closest(), exact = known_.exact();
    for (;;) {
      ruleOut();
      if (raise(below(rulers(), closest), closest) || raiseByOne(open_, closest) ||
          raise(below(lowestOnes(), exact), exact) || raise(below(open_, exact), exact))
        continue;
      const auto challengers = this->challengers();
      if (!raiseByOne(challengers, closest) && !raise(below(challengers, exact), exact))
        break;
    }
    return settled();
  }

  /** The energy of a candidate that has been settled. */
  float
  energyOf(std::size_t candidate) const
  {
    return lower_[candidate];
  }

private:
  void
  update(const std::vector<std::size_t>& changed)
  {
    for (const std::size_t i : changed) {
      lower_[i] = kss::energyOf(known_[i].lower, weights_, energy_);
      upper_[i] = kss::energyOf(known_[i].upper, weights_, energy_);
    }
  }

  /** \return whether there was anything to raise */
  bool
  raise(const std::vector<std::size_t>& candidates, int level)
  {
    if (candidates.empty())
      return false;
    update(known_.raise(candidates, level));
    return true;
  }

  /** Bring each of the candidates to its next level, but not beyond the last. */
  bool
  raiseByOne(const std::vector<std::size_t>& candidates, int last)
  {
    bool any = false;
    for (int level = last; level > 0; --level) {
      std::vector<std::size_t> these;
      for (const std::size_t i : candidates)
        if (known_.level(i) == level - 1)
          these.push_back(i);
      any |= raise(these, level);
    }
    return any;
  }

  std::vector<std::size_t>
  below(const std::vector<std::size_t>& candidates, int level) const
  {
    std::vector<std::size_t> found;
    for (const std::size_t i : candidates)
      if (known_.level(i) < level)
        found.push_back(i);
    return found;
  }

  /** For each rotation, whether a candidate with it may be a minimum. */
  std::vector<char>
  openRows() const
  {
    std::vector<char> rows(lower_.size() / neighbours_.rowSize(), 0);
    for (const std::size_t i : open_)
      rows[i / neighbours_.rowSize()] = 1;
    return rows;
  }

  /** Drop the candidates that have a lower neighbour for certain. */
  void
  ruleOut()
  {
    lowest_around_ = neighbours_.lowestAround(upper_, openRows());
    open_.erase(
        std::remove_if(open_.begin(), open_.end(),
                       [&](std::size_t i) { return lower_[i] > lowest_around_[i]; }),
        open_.end());
  }

  /** Those whose upper bound is the lowest around a candidate that may be a minimum:
   * they decide whether it is ruled out. */
  std::vector<std::size_t>
  rulers() const
  {
    return notAbove(upper_, lowest_around_);
  }

  /** Those whose upper bound is the lowest around themselves. */
  std::vector<std::size_t>
  lowestOnes() const
  {
    std::vector<std::size_t> found;
    for (const std::size_t i : open_)
      if (upper_[i] <= lowest_around_[i])
        found.push_back(i);
    return found;
  }

  /** Those that may be lower than a neighbour that may be a minimum. */
  std::vector<std::size_t>
  challengers() const
  {
    return notAbove(lower_, upper_);
  }

  /** All candidates with a value that is not above the limit of every neighbour that
   * may be a minimum. */
  std::vector<std::size_t>
  notAbove(const std::vector<float>& values, const std::vector<float>& limits) const
  {
    std::vector<float> limits_of_open(limits.size(),
                                      std::numeric_limits<float>::lowest());
    for (const std::size_t i : open_)
      limits_of_open[i] = limits[i];
    const auto highest = neighbours_.highestAround(limits_of_open, openRows());
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < values.size(); ++i)
      if (values[i] <= highest[i])
        found.push_back(i);
    return found;
  }

  std::vector<std::size_t>
  settled() const
  {
    std::vector<std::size_t> found;
    for (const std::size_t i : open_)
      if (!neighbours_.anyAround(
              i, [&](std::size_t k) { return lower_[k] == lower_[i] && k < i; }))
        found.push_back(i);
    std::sort(found.begin(), found.end(), [&](std::size_t a, std::size_t b) {
      return lower_[a] != lower_[b] ? lower_[a] < lower_[b] : a < b;
    });
    return found;
  }

  KnownDistances& known_;
  const CandidateNeighbours& neighbours_;
  Weights weights_;
  Energy energy_;
  std::vector<float> lower_, upper_;
  std::vector<float> lowest_around_; ///< upper bound among a candidate's neighbours
  std::vector<std::size_t> open_;    ///< may be minima
};

BoundsScope
scopeOf(const Sweep& sweep, Energy energy, float limit, Eigen::Index points)
{
  BoundsScope scope;
  const auto& scales = sweep.candidates.scales();
  scope.smallest_scale = *std::min_element(scales.begin(), scales.end());
  scope.largest_scale = *std::max_element(scales.begin(), scales.end());
  for (const Eigen::Vector3d& center : sweep.candidates.centers().centers)
    scope.largest_shift = std::max(scope.largest_shift,
                                   std::max(1.0, scope.largest_scale) * center.norm());
  scope.limit = limit;
  scope.beyond_limit = isOfLargest(energy);
  scope.source_to_target = scope.target_to_source = false;
  for (const Weights& weights : sweep.energies) {
    scope.source_to_target |= weights.source_to_target != 0.0f;
    scope.target_to_source |= weights.target_to_source != 0.0f;
  }
  // A grid is worth the more the more candidates it serves, though never much of brute
  // force's work. Of means, all points must be bounded closely, of largest distances
  // but a few.
  const double size = sweep.candidates.size();
  const double worth = isOfLargest(energy) ? std::max(100.0 * std::sqrt(size), 8192.0)
                                           : std::max(400.0 * std::sqrt(size), 32768.0);
  scope.nodes = static_cast<std::size_t>(std::min(worth, size * points / 16.0));
  return scope;
}

} // namespace

std::vector<std::vector<FoundMinimum>>
exactMinima(const Settings& settings,
            const Sweep& sweep,
            double distinct_angle,
            const Points& source,
            const Points& target,
            float limit,
            DistanceEvaluator& distances,
            SearchEffort* effort)
{
  const Candidates& candidates = sweep.candidates;
  const auto bounds = makeBounds(settings);
  const Eigen::Index points = std::max(source.cols(), target.cols());
  bounds->setClouds(source, target, scopeOf(sweep, settings.energy, limit, points));
  KnownDistances known(candidates, points, *bounds, distances);
  const CandidateNeighbours neighbours(candidates, settings.local_minimum_kernel);
  std::vector<std::vector<FoundMinimum>> found;
  for (const Weights& weights : sweep.energies) {
    MinimumSearch search(known, neighbours, candidates.size(), weights,
                         settings.energy);
    found.emplace_back();
    for (const std::size_t i : candidates.distinct(search.minima(), distinct_angle))
      found.back().push_back({i, search.energyOf(i)});
  }
  if (effort)
    *effort = known.effort();
  return found;
}

} // namespace kss
} // namespace pcl
