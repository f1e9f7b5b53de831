/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include <pcl/registration/kss/alignment.h>

#include <pcl/registration/kss/detail/stopping.h>

#include "geometry/pre_shape.h"
#include "levels.h"
#include "preparation/preparation.h"
#include "preparation/shape_pair.h"
#include "refinement/selection.h"
#include "search/candidate_search.h"
#include "support/beside.h"

#include <algorithm>
#include <string>

namespace pcl {
namespace kss {

struct Alignment::Implementation {
  explicit Implementation(const Settings& asked)
  : settings(asked)
  , preparation(asked)
  , made_search(asked.threads,
                [asked] { return std::make_unique<CandidateSearch>(asked); })
  {
  }

  /** \brief From two clouds that have been made ready to poses. */
  Aligned
  align(const PreparedPair& clouds,
        const std::optional<double>& guessed_scale,
        Thoroughness thoroughness,
        Stages& stages);

  Settings settings;
  Preparation preparation;
  Beside<CandidateSearch> made_search;
  std::shared_ptr<const ShapePair> shapes; ///< of the last call
};

namespace {

/** Whether a pose makes the additional process of (e12) unnecessary. */
bool
isGoodEnough(const Similarity& pose,
             const Weights& weights,
             CandidateSearch& search,
             const Settings& settings)
try {
  return search.energyAt(pose, weights) <= settings.additional_process_threshold;
}
catch (const Stopped&) {
  return true; // it has to be
}

/** ICP between the shapes, (e7) and (e8), from O_init; the additional process of (e12),
 * from all minima, where that is not good enough. */
std::vector<Similarity>
refined(const std::vector<Minimum>& minima,
        const ShapePair& shapes,
        const SelectionEffort& effort,
        CandidateSearch& search,
        const Settings& settings,
        const std::function<void(double)>& done)
{
  const Selection selection(shapes, effort, settings.threads);
  const Minimum& initial = minima.front();
  if (settings.additional_process_threshold > 0.0) {
    auto refined = selection.best({initial.pose}, [](double) {});
    if (isGoodEnough(refined.front(), initial.weights, search, settings))
      return refined;
  }
  std::vector<Similarity> poses;
  for (const Minimum& minimum : minima)
    poses.push_back(minimum.pose);
  return selection.best(poses, done);
}

/** Leave the distinct ones, the likeliest first, and not too many of them. */
void
keepTheLikeliest(const PoseScorer& scorer, Alternatives& alternatives)
{
  std::stable_sort(alternatives.begin(), alternatives.end(),
                   [](const Alternative& a, const Alternative& b) {
                     return logOddsOf(a) > logOddsOf(b);
                   });
  Alternatives kept;
  for (const Alternative& alternative : alternatives)
    if (kept.size() < most_alternatives &&
        std::none_of(kept.begin(), kept.end(), [&](const Alternative& other) {
          return scorer.areSame(alternative.transformation, other.transformation);
        }))
      kept.push_back(alternative);
  alternatives = kept;
}

} // namespace

Aligned
Alignment::Implementation::align(const PreparedPair& clouds,
                                 const std::optional<double>& guessed_scale,
                                 Thoroughness thoroughness,
                                 Stages& stages)
{
  const auto done = [&stages](double share) { stages.progress(share); };

  // a device that cannot be had ends it here
  CandidateSearch& search = made_search.get();

  // k points of each (Sec. III-B), and K_s of (e2)
  stages.begin("simplification");
  shapes = shapePair(clouds, guessed_scale, settings, shapes.get());
  stages.end();

  // from coarse to fine, until a pose convinces
  const PoseScorer scorer(shapes);
  const Similarity T_target_shape = shapes->target.simplified.T_cloud_shape();
  const Similarity T_shape_source = shapes->source.simplified.T_cloud_shape().inverse();
  Alternatives alternatives;
  for (const SearchLevel& level : levelsFor(settings, *shapes))
    try {
      const std::string prefix = level.prefix;

      // E_d of (e9) or E_cd of (e122), and its minima over {O} and {C}: (e10), (e13)
      stages.begin(prefix + "search");
      const std::vector<Minimum> minima = search.localMinima(
          shapes->source.simplified.points, shapes->target.simplified.points,
          shapes->scales, shapes->metric, level.grain, done);
      stages.end();

      // (e7), (e8) and (e12); T of (e11) is left to the clouds themselves
      stages.begin(prefix + "refinement");
      for (const Similarity& pose :
           refined(minima, *shapes, level.selection, search, settings, done))
        alternatives.push_back(
            scorer.scored((T_target_shape * pose * T_shape_source).matrix()));
      stages.end();

      keepTheLikeliest(scorer, alternatives);
      if (logOddsOf(alternatives.front()) >= level.convincing ||
          thoroughness == Thoroughness::QUICK)
        break;
    }
    catch (const Stopped&) {
      if (alternatives.empty())
        throw;
      break;
    }
  return {alternatives, scorer};
}

Alignment::Alignment(const Settings& settings)
: implementation_(std::make_unique<Implementation>(settings))
{
}

// in the library, which has allocated what is in here: a program compiled for other
// vectors would free it otherwise
Alignment::~Alignment() = default;

Aligned
Alignment::align(const LocalCloud& source,
                 const LocalCloud& target,
                 const std::optional<double>& guessed_scale,
                 Stages& stages)
{
  // clean, without heavy noise, and in the order that simplifies them
  stages.begin("preparation");
  const PreparedPair clouds = implementation_->preparation.prepared(
      source, target, [&stages](double share) { stages.progress(share); });
  stages.end();
  return implementation_->align(clouds, guessed_scale, Thoroughness::USUAL, stages);
}

Aligned
Alignment::align(const std::shared_ptr<const PreparedCloud>& source,
                 const std::shared_ptr<const PreparedCloud>& target,
                 const std::optional<double>& guessed_scale,
                 Thoroughness thoroughness,
                 Stages& stages)
{
  return implementation_->align(pairOf(source, target, settings()), guessed_scale,
                                thoroughness, stages);
}

std::shared_ptr<const PreparedCloud>
Alignment::prepared(const LocalCloud& cloud) const
{
  return std::make_shared<PreparedCloud>(
      kss::prepared(cloud, fingerprintOf(cloud), settings()));
}

PoseScorer
Alignment::scorerOf(const std::shared_ptr<const PreparedCloud>& source,
                    const std::shared_ptr<const PreparedCloud>& target,
                    const std::optional<double>& guessed_scale)
{
  auto& shapes = implementation_->shapes;
  shapes = shapePair(pairOf(source, target, settings()), guessed_scale, settings(),
                     shapes.get());
  return PoseScorer(shapes);
}

const Settings&
Alignment::settings() const
{
  return implementation_->settings;
}

std::string
Alignment::deviceName() const
{
  return implementation_->made_search.get().deviceName();
}

} // namespace kss
} // namespace pcl
