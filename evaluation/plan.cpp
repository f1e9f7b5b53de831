/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "plan.h"

#include <algorithm>
#include <stdexcept>

namespace evaluation {
namespace {

std::vector<PlannedMethod>
allMethods(const Options& options)
{
  std::vector<PlannedMethod> methods;
  for (const auto& method : kssICPMethods())
    methods.push_back({method, "kss", ""});
  if (options.ablate.empty() || !options.methods.empty())
    for (const auto& peers : {pclMethods(), open3dMethods()})
      for (const auto& method : peers)
        methods.push_back({method, "peer", ""});
  else
    methods.resize(1); // as shipped, which the variants are compared with
  for (const auto& ablation : ablations())
    if (std::count(options.ablate.begin(), options.ablate.end(), ablation.flag))
      for (const auto& variant : ablation.variants)
        methods.push_back({variant, "ablation", ablation.title});
  return methods;
}

/** \brief Only those named, in the order in which the tables show them. */
std::vector<PlannedMethod>
chosen(const std::vector<PlannedMethod>& methods, const std::vector<std::string>& names)
{
  if (names.empty())
    return methods;
  const auto nameOf = [](const PlannedMethod& planned) { return planned.method.name; };
  for (const auto& name : names)
    if (std::none_of(methods.begin(), methods.end(),
                     [&](const auto& method) { return nameOf(method) == name; }))
      throw std::runtime_error("there is no method " + name +
                               "; --list-methods shows all");
  std::vector<PlannedMethod> result;
  for (const auto& method : methods)
    if (method.group == "ablation" ||
        std::count(names.begin(), names.end(), nameOf(method)))
      result.push_back(method);
  return result;
}

bool
isOfSizes(const Condition& condition)
{
  return condition.table == "size";
}

} // namespace

Plan
planFor(const Options& options, const ModelFolder& folder)
{
  Plan plan;
  plan.conditions = conditionsOf(options.tables, options.protocol);
  plan.methods = chosen(allMethods(options), options.methods);
  plan.models = evenlyChosen(folder.models, options.number_of_models);
  if (std::any_of(plan.conditions.begin(), plan.conditions.end(), isOfSizes)) {
    std::vector<Model> meshes;
    std::copy_if(folder.models.begin(), folder.models.end(), std::back_inserter(meshes),
                 [](const Model& model) { return model.is_mesh; });
    plan.size_models = options.size_models == 0
                           ? std::vector<Model>()
                           : evenlyChosen(meshes, options.size_models);
  }
  return plan;
}

std::vector<Run>
runsOfTables(const Plan& plan, const Protocol& protocol)
{
  std::vector<Run> runs;
  for (const auto& model : plan.models)
    for (const auto& condition : plan.conditions) {
      if (isOfSizes(condition))
        continue;
      for (unsigned int i = 0; i < protocol.repetitions; ++i)
        for (const auto& planned : plan.methods)
          for (const bool scale_given : {false, true})
            if (!scale_given || planned.group != "ablation")
              runs.push_back({model.name, condition, i, planned.method, scale_given});
    }
  return runs;
}

std::vector<Run>
runsOfSizes(const Plan& plan)
{
  std::vector<Run> runs;
  for (const auto& model : plan.size_models)
    for (const auto& condition : plan.conditions)
      if (isOfSizes(condition))
        for (const auto& planned : plan.methods)
          runs.push_back({model.name, condition, 0, planned.method,
                          !planned.method.estimates_scale});
  return runs;
}

} // namespace evaluation
