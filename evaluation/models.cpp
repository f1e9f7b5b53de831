/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "models.h"

#include "surface.h"

#include <boost/algorithm/string/case_conv.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>
#include <stdexcept>

namespace evaluation {
namespace {

namespace fs = std::filesystem;

bool
hasModelExtension(const fs::path& path)
{
  static const std::set<std::string> extensions = {".off", ".ply", ".obj", ".stl",
                                                   ".pcd"};
  return extensions.count(boost::to_lower_copy(path.extension().string())) > 0;
}

std::vector<fs::path>
filesIn(const std::string& folder)
{
  if (!fs::is_directory(folder))
    throw std::runtime_error(folder + ": is no folder; name one that holds models");
  std::vector<fs::path> files;
  const auto follow = fs::directory_options::follow_directory_symlink;
  for (const auto& entry : fs::recursive_directory_iterator(folder, follow))
    if (entry.is_regular_file())
      files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

/** Without the extension, where that tells the models apart. */
void
giveNames(std::vector<Model>& models, const std::string& folder)
{
  const auto nameOf = [&](const Model& model) {
    return fs::path(model.path).lexically_relative(folder);
  };
  std::map<std::string, int> uses;
  for (const auto& model : models)
    ++uses[nameOf(model).replace_extension().generic_string()];
  for (auto& model : models) {
    fs::path name = nameOf(model);
    const std::string stem = fs::path(name).replace_extension().generic_string();
    model.name = uses[stem] == 1 ? stem : name.generic_string();
  }
}

} // namespace

ModelFolder
modelsOf(const std::string& folder)
{
  ModelFolder result;
  for (const auto& file : filesIn(folder)) {
    if (!hasModelExtension(file)) {
      result.skipped.push_back(
          {file.string(), "is no model: neither OFF, PLY, OBJ, STL nor PCD"});
      continue;
    }
    try {
      const Surface surface(file.string());
      result.models.push_back({"", file.string(), surface.isMesh()});
    }
    catch (const std::exception& problem) {
      std::string reason = problem.what();
      if (reason.rfind(file.string() + ": ", 0) == 0)
        reason.erase(0, file.string().size() + 2);
      result.skipped.push_back({file.string(), reason});
    }
  }
  giveNames(result.models, folder);
  std::sort(result.models.begin(), result.models.end(),
            [](const Model& a, const Model& b) { return a.name < b.name; });
  return result;
}

std::vector<Model>
evenlyChosen(const std::vector<Model>& models, std::size_t number)
{
  if (number == 0 || models.size() <= number)
    return models;
  // Multiples of the golden ratio fill an interval evenly, however many there are.
  const double golden = (std::sqrt(5.0) - 1.0) / 2.0;
  std::set<std::size_t> chosen;
  for (double place = 0.5; chosen.size() < number; place += golden) {
    const double share = place - std::floor(place);
    chosen.insert(static_cast<std::size_t>(share * static_cast<double>(models.size())));
  }
  std::vector<Model> result;
  for (const std::size_t index : chosen)
    result.push_back(models[index]);
  return result;
}

} // namespace evaluation
