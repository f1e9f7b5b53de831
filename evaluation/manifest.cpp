/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "manifest.h"

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <thread>

namespace evaluation {
namespace {

std::string
processorName()
{
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.rfind("model name", 0) == 0)
      return line.substr(line.find(':') + 2);
  return "unknown";
}

/** \brief All that the cases depend on. */
Record
settingsOf(const Protocol& protocol, const std::string& models)
{
  return {
      {"models", std::filesystem::weakly_canonical(models).string()},
      {"seed", protocol.seed},
      {"repetitions", protocol.repetitions},
      {"points", protocol.points},
      {"rotation", protocol.rotations == Rotations::AXES ? "axes" : "so3"},
      {"scale", {protocol.smallest_scale, protocol.largest_scale}},
      {"deleted", protocol.deleted},
      {"resampling", protocol.resampling == Resampling::WLOP ? "wlop" : "gradient"}};
}

/** \brief What the folder was last used for; null where it is new.
 * \throws std::runtime_error where it holds runs and nothing says of what
 */
Record
lastManifest(const std::string& path)
{
  const auto folder = std::filesystem::path(path).parent_path();
  std::error_code none;
  if (std::filesystem::is_regular_file(path)) {
    std::ifstream file(path);
    const Record last = Record::parse(file, nullptr, false);
    if (last.is_object() && last.contains("settings") && last["settings"].is_object())
      return last;
  }
  const auto bytes = std::filesystem::file_size(folder / "runs.jsonl", none);
  if (std::filesystem::exists(path) || (!none && bytes > 0))
    throw std::runtime_error(path + ": cannot be read, so nobody knows what the runs "
                                    "beside it are; name another --out, or remove "
                                    "this one");
  return Record();
}

void
refuseOtherCases(const std::string& path, const Record& settings)
{
  const Record last = lastManifest(path);
  if (last.is_null())
    return;
  for (const auto& [name, value] : settings.items()) {
    const Record before = last["settings"].value(name, Record());
    if (name != "repetitions" && before != value)
      throw std::runtime_error(path + ": these are runs with another " + name + ", " +
                               before.dump() + " rather than " + value.dump() +
                               "; name another --out, or remove this one");
  }
}

} // namespace

void
writeManifest(const std::string& path,
              const std::string& command,
              const Options& options,
              const ModelFolder& folder,
              const Plan& plan)
{
  Record manifest;
  manifest["version"] = PCL_KSS_ICP_VERSION;
  manifest["command"] = command;
  manifest["seed"] = options.protocol.seed;
  manifest["machine"] = {{"cpu", processorName()},
                         {"cores", std::thread::hardware_concurrency()}};
  manifest["models"] = Record::array();
  for (const auto& model : plan.models)
    manifest["models"].push_back(
        {{"name", model.name}, {"kind", model.is_mesh ? "mesh" : "points"}});
  manifest["size_models"] = Record::array();
  for (const auto& model : plan.size_models)
    manifest["size_models"].push_back(model.name);
  manifest["readable_models"] = folder.models.size();
  manifest["skipped"] = Record::array();
  for (const auto& file : folder.skipped)
    manifest["skipped"].push_back({{"file", file.path}, {"reason", file.reason}});
  manifest["settings"] = settingsOf(options.protocol, options.models);
  refuseOtherCases(path, manifest["settings"]);
  manifest["settings"]["time_limit_s"] = options.time_limit;
  manifest["methods"] = Record::array();
  for (const auto& planned : plan.methods)
    manifest["methods"].push_back({{"name", planned.method.name},
                                   {"estimates_scale", planned.method.estimates_scale},
                                   {"group", planned.group},
                                   {"ablates", planned.ablates}});
  manifest["conditions"] = Record::array();
  for (const auto& condition : plan.conditions)
    manifest["conditions"].push_back({{"name", condition.name},
                                      {"table", condition.table},
                                      {"parameter", condition.parameter}});
  const std::string unfinished = path + ".unfinished";
  std::ofstream file(unfinished);
  file << manifest.dump(1, ' ', false, Record::error_handler_t::replace) << std::endl;
  if (!file)
    throw std::runtime_error(path + ": cannot be written");
  file.close();
  std::filesystem::rename(unfinished, path);
}

} // namespace evaluation
