/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "search/candidate_search.h"

#include <pcl/registration/kss/detail/stopping.h>

#include "candidates/numbers.h"
#include "evaluators/evaluator_choice.h"
#include "search/exact/exact_search.h"

#include <algorithm>
#include <iomanip>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace pcl {
namespace kss {
namespace {

using namespace search_numbers;

/** What is kept of each candidate while it is searched, in bytes, about. */
double
bytesOfCandidate(Search search)
{
  if (search == Search::EXACT) // KnownDistances and what MinimumSearch makes of them
    return 80.0;
  if (search == brute_force) // energies and indices
    return 16.0;
  return 8.0; // sums of a scale, filled up to whole vectors
}

void
throwWhereTooMany(const Candidates& candidates, Search search)
{
  const auto size = static_cast<double>(candidates.size());
  const double memory = 1e-9 * size * bytesOfCandidate(search);
  if (memory <= most_memory)
    return;
  std::ostringstream message;
  message << std::fixed << std::setprecision(0)
          << "There are too many candidate poses, " << size << ": they would take "
          << memory << " GB, but " << most_memory
          << " GB at most are used; take fewer rotations or a larger angle step.";
  throw std::invalid_argument(message.str());
}

/** What a distance counts at most. */
float
limitOf(const Grain& grain, const Settings& settings)
{
  return isOfLargest(settings.energy) ? std::numeric_limits<float>::max() : grain.limit;
}

} // namespace

CandidateSearch::CandidateSearch(const Settings& settings)
: settings_(settings)
{
  settings_.search = searchOf(settings);
  if (settings_.search == Search::SCREENED) {
    evaluator_ = makeLookUps(settings);
    screening_.emplace(settings);
  }
  else
    evaluator_ = makePairDistances(settings);
}

std::vector<Minimum>
CandidateSearch::localMinima(const Points& source,
                             const Points& target,
                             const ScaleRange& scales,
                             const PoseMetric& metric,
                             const Grain& grain,
                             const std::function<void(double)>& done)
{
  source_ = source;
  target_ = target;
  const float limit = limitOf(grain, settings_);
  evaluator_->setClouds(source, target, limit);
  if (screening_)
    screening_->setClouds(source, target, limit);
  std::vector<Minimum> minima;
  const auto sweeps = sweepsOf(settings_, source_, target_, scales, grain);
  try {
    for (std::size_t i = 0; i < sweeps.size(); ++i) {
      const auto doneOfSweep = [&](double share) {
        done((static_cast<double>(i) + share) / static_cast<double>(sweeps.size()));
      };
      const auto found = minimaOf(sweeps[i], metric, grain, doneOfSweep);
      minima.insert(minima.end(), found.begin(), found.end());
      doneOfSweep(1.0);
    }
  }
  catch (const Stopped&) {
    if (minima.empty())
      throw;
  }
  // The energies share many of their minima.
  DistinctPoses distinct(metric, same_minimum);
  std::vector<Minimum> all;
  for (const Minimum& minimum : minima)
    if (distinct.take(minimum.pose))
      all.push_back(minimum);
  std::iter_swap(all.begin(), std::min_element(all.begin(), all.end(),
                                               [](const Minimum& a, const Minimum& b) {
                                                 return a.energy < b.energy;
                                               }));
  return all;
}

std::vector<Minimum>
CandidateSearch::minimaOf(const Sweep& sweep,
                          const PoseMetric& metric,
                          const Grain& grain,
                          const std::function<void(double)>& done)
{
  throwWhereTooMany(sweep.candidates, settings_.search);
  if (settings_.search == Search::EXACT)
    return exact(sweep, grain);
  // few candidates need no screening
  if (screening_ && sweep.candidates.size() > grain.screened)
    return screened(sweep, metric, grain);
  return evaluated(sweep, grain, done);
}

std::vector<Minimum>
CandidateSearch::screened(const Sweep& sweep,
                          const PoseMetric& metric,
                          const Grain& grain)
{
  const auto found = screening_->lowest(sweep.candidates, grain.screened);
  const auto distances = evaluator_->evaluate(sweep.candidates.placements(found));
  std::vector<Minimum> minima;
  SomeEnergies energies(found, sweep.candidates.size());
  for (const Weights& weights : sweep.energies) {
    for (std::size_t i = 0; i < found.size(); ++i)
      energies.ofPlace(i) = energyOf(distances[i], weights, settings_.energy);
    DistinctPoses distinct(metric, same_pose);
    for (const std::size_t i : sweep.candidates.localMinima(
             energies, settings_.local_minimum_kernel, same_pose)) {
      const Similarity pose = sweep.candidates.pose(i);
      if (distinct.size() < grain.minima && distinct.take(pose))
        minima.push_back({pose, energies[i], weights});
    }
  }
  return minima;
}

std::vector<Minimum>
CandidateSearch::exact(const Sweep& sweep, const Grain& grain)
{
  std::vector<Minimum> minima;
  const auto found = exactMinima(settings_, sweep, same_pose, source_, target_,
                                 limitOf(grain, settings_), *evaluator_);
  for (std::size_t e = 0; e < found.size(); ++e)
    for (std::size_t i = 0; i < std::min(found[e].size(), grain.minima); ++i)
      minima.push_back({sweep.candidates.pose(found[e][i].candidate),
                        found[e][i].energy, sweep.energies[e]});
  return minima;
}

std::vector<Minimum>
CandidateSearch::evaluated(const Sweep& sweep,
                           const Grain& grain,
                           const std::function<void(double)>& done)
{
  // Algorithm 2 for all candidates, so many at once
  const std::size_t size = sweep.candidates.size();
  std::vector<std::vector<float>> energies(sweep.energies.size());
  for (std::size_t begin = 0; begin < size; begin += at_once) {
    const auto distances = evaluator_->evaluate(
        sweep.candidates.placements(begin, std::min(at_once, size - begin)));
    for (std::size_t e = 0; e < energies.size(); ++e)
      for (const DirectedDistances& d : distances)
        energies[e].push_back(energyOf(d, sweep.energies[e], settings_.energy));
    done(static_cast<double>(begin) / size);
  }
  std::vector<Minimum> minima;
  for (std::size_t e = 0; e < energies.size(); ++e) {
    auto found = sweep.candidates.localMinima(
        energies[e], settings_.local_minimum_kernel, same_pose);
    found.resize(std::min(found.size(), grain.minima));
    for (const std::size_t i : found)
      minima.push_back({sweep.candidates.pose(i), energies[e][i], sweep.energies[e]});
  }
  return minima;
}

float
CandidateSearch::energyAt(const Similarity& pose, const Weights& weights)
{
  return energyOf(evaluator_->evaluate({pose.placement()}).front(), weights,
                  settings_.energy);
}

std::string
CandidateSearch::deviceName() const
{
  return evaluator_->deviceName();
}

} // namespace kss
} // namespace pcl
