/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * One run of all evaluators, as a registration makes them.
 */

#pragma once

#include "shapes.h"

#include "evaluators/evaluator_choice.h"
#include "evaluators/shift_sums.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace kss_test {

/** \brief The bits of what the evaluators said, in the order in which they were asked.
 */
struct Answers {
  std::vector<std::string> bits;
  std::string device;
};

template <typename Value>
std::string
bitsOf(const std::vector<Value>& values)
{
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Value)};
}

/** \brief Placements that turn the further the later they come. */
inline std::vector<pcl::kss::Placement>
turnedPlacements(std::size_t number)
{
  std::vector<pcl::kss::Placement> placements;
  for (std::size_t i = 0; i < number; ++i) {
    pcl::kss::Placement placement;
    placement << Eigen::AngleAxisf(0.01f * i, Eigen::Vector3f(1, 2, i % 5).normalized())
                     .toRotationMatrix(),
        Eigen::Vector3f(0.001f * i, 0.1f, -0.1f);
    placements.push_back(placement);
  }
  return placements;
}

/** \brief All evaluators of a registration. */
class Evaluators {
public:
  explicit Evaluators(const pcl::kss::Settings& settings)
  : pairs_(pcl::kss::makePairDistances(settings))
  , look_ups_(pcl::kss::makeLookUps(settings))
  , sums_(pcl::kss::makeShiftSums(settings))
  , bounds_(pcl::kss::makeBounds(settings))
  {
  }

  void
  setClouds(Eigen::Index points)
  {
    using namespace pcl::kss;
    source_ = sampled(creature(), points, 1);
    const Points target = sampled(creature(), points + 13, 2);
    pairs_->setClouds(source_, target, 0.4f);
    look_ups_->setClouds(source_, target, 0.4f);
    lattice_.emplace(target, ownCenter(), 0.4f);
    sums_->setField(target, *lattice_);
    BoundsScope scope;
    scope.largest_shift = 2.0;
    scope.nodes = 4096;
    bounds_->setClouds(source_, target, scope);
  }

  Answers
  ask(std::size_t placements)
  {
    const auto some = turnedPlacements(placements);
    std::vector<pcl::kss::Placement> on_lattice;
    for (const auto& placement : some)
      on_lattice.push_back(lattice_->toNodes(placement.leftCols<3>()));
    Answers answers;
    answers.bits.push_back(bitsOf(look_ups_->evaluate(some)));
    answers.bits.push_back(bitsOf(sums_->sums(source_.leftCols(40), on_lattice)));
    answers.bits.push_back(bitsOf(bounds_->evaluate(some, 60)));
    answers.bits.push_back(bitsOf(pairs_->evaluate(some)));
    answers.device = pairs_->deviceName();
    return answers;
  }

private:
  std::unique_ptr<pcl::kss::DistanceEvaluator> pairs_, look_ups_;
  std::unique_ptr<pcl::kss::ShiftSums> sums_;
  std::unique_ptr<pcl::kss::BoundsEvaluator> bounds_;
  Points source_;
  std::optional<pcl::kss::ShiftLattice> lattice_;
};

/** \brief What all of them say. */
inline Answers
answersOf(const pcl::kss::Settings& settings)
{
  Evaluators evaluators(settings);
  evaluators.setClouds(100);
  return evaluators.ask(30);
}

} // namespace kss_test
