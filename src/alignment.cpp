/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include <pcl/registration/kss/alignment.h>

#include <pcl/registration/kss/detail/stopping.h>

#include "candidates/numbers.h"
#include "geometry/pre_shape.h"
#include "preparation/preparation.h"
#include "preparation/shape_pair.h"
#include "refinement/selection.h"
#include "search/candidate_search.h"

namespace pcl {
namespace kss {

struct Alignment::Implementation {
  explicit Implementation(const Settings& asked)
  : settings(asked)
  , preparation(asked)
  , search(asked)
  {
  }

  Settings settings;
  Preparation preparation;
  CandidateSearch search;
  std::shared_ptr<const ShapePair> shapes; ///< of the last call
};

namespace {

/** Whether a pose makes the additional process of (e12) unnecessary. */
bool
isGoodEnough(const JudgedPose& judged,
             const Weights& weights,
             CandidateSearch& search,
             const Settings& settings)
try {
  return search.energyAt(judged.T_target_source, weights) <=
         settings.additional_process_threshold;
}
catch (const Stopped&) {
  return true; // it has to be
}

/** ICP between the shapes, (e7) and (e8), from O_init; the additional process of (e12),
 * from all minima, where that is not good enough. */
std::vector<JudgedPose>
refined(const std::vector<Minimum>& minima,
        const ShapePair& shapes,
        CandidateSearch& search,
        const Settings& settings,
        const std::function<void(double)>& done)
{
  const double reach = search_numbers::reachOf(numberOfRotations(settings));
  const Selection selection(shapes, reach, settings.threads);
  const Minimum& initial = minima.front();
  if (settings.additional_process_threshold > 0.0) {
    auto judged = selection.best({initial.pose}, [](double) {});
    if (isGoodEnough(judged.front(), initial.weights, search, settings))
      return judged;
  }
  std::vector<Similarity> poses;
  for (const Minimum& minimum : minima)
    poses.push_back(minimum.pose);
  return selection.best(poses, done);
}

} // namespace

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
  auto& [settings, preparation, search, shapes] = *implementation_;
  const auto done = [&stages](double share) { stages.progress(share); };

  // clean, without heavy noise, and in the order that simplifies them
  stages.begin("preparation");
  const PreparedPair clouds = preparation.prepared(source, target, done);
  stages.end();

  // k points of each (Sec. III-B), and K_s of (e2)
  stages.begin("simplification");
  shapes = shapePair(clouds, guessed_scale, settings, shapes.get());
  stages.end();

  // E_d of (e9) or E_cd of (e122), and its minima over {O} and {C}: (e10), (e13)
  stages.begin("search");
  const std::vector<Minimum> minima = search.localMinima(
      shapes->source.simplified.points, shapes->target.simplified.points,
      shapes->scales, shapes->metric, done);
  stages.end();

  // (e7), (e8) and (e12); T of (e11) is left to the clouds themselves
  stages.begin("refinement");
  const Similarity T_target_shape = shapes->target.simplified.T_cloud_shape();
  const Similarity T_shape_source = shapes->source.simplified.T_cloud_shape().inverse();
  Alternatives alternatives;
  for (const auto& [pose, overlap] : refined(minima, *shapes, search, settings, done))
    // what surfaces say is asked where the final ICP has laid them on each other
    alternatives.push_back(
        {(T_target_shape * pose * T_shape_source).matrix(), overlap, {}});
  stages.end();
  return {alternatives, PoseScorer(shapes)};
}

const Settings&
Alignment::settings() const
{
  return implementation_->settings;
}

std::string
Alignment::deviceName() const
{
  return implementation_->search.deviceName();
}

} // namespace kss
} // namespace pcl
