/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "cases.h"

#include <algorithm>

namespace evaluation {

Cases::Cases(const std::vector<Model>& models, const Protocol& protocol)
: models_(models)
, protocol_(protocol)
{
}

std::shared_ptr<const Case>
Cases::of(const Run& run)
{
  if (run.model != model_) {
    const auto model =
        std::find_if(models_.begin(), models_.end(),
                     [&](const Model& each) { return each.name == run.model; });
    surface_ = std::make_unique<Surface>(model->path);
    model_ = run.model;
    name_.clear();
  }
  const std::string name = run.condition.name + '/' + std::to_string(run.repetition);
  if (name != name_) {
    case_.reset(); // a million points need not be there twice
    case_ = std::make_shared<Case>(
        makeCase(*surface_, run.model, run.condition, run.repetition, protocol_));
    name_ = name;
  }
  return case_;
}

} // namespace evaluation
