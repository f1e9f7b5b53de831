/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "folder.h"

#include "command_line/output_file.h"
#include "command_line/transformation_file.h"
#include "merged_cloud.h"
#include "page.h"
#include "picture/subject.h"
#include "scan_points.h"
#include "texts.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <stdexcept>

namespace tool {
namespace {

namespace fs = std::filesystem;

/** So many groups have pictures, the first one large ones. */
constexpr std::size_t PICTURED_GROUPS = 6;

/** Writes files to a folder, each of which is there as a whole or not at all. */
class FolderFiles {
public:
  explicit FolderFiles(const std::string& folder)
  : folder_(folder)
  {
  }

  void
  write(const std::string& name, const std::function<void(std::ostream&)>& writer)
  {
    OutputFile file((folder_ / name).string());
    file.write(writer);
    const SignalsHeld held;
    file.putInPlace();
    names_.insert(name);
  }

  void
  write(const std::string& name, const std::string& text)
  {
    write(name, [&](std::ostream& stream) { stream << text; });
  }

  /** Remove files unless they have been written. */
  void
  removeOthers(const std::set<std::string>& old) const
  {
    std::error_code ignored;
    for (const auto& name : old)
      if (names_.count(name) == 0)
        fs::remove(folder_ / name, ignored);
  }

private:
  fs::path folder_;
  std::set<std::string> names_;
};

/** What the poses.json in a folder says that is there beside it; nothing where there is
 * none, or it is another program's. */
std::set<std::string>
filesOfEarlierRun(const fs::path& folder)
{
  std::set<std::string> names;
  std::ifstream stream(folder / "poses.json");
  const auto json = nlohmann::json::parse(stream, nullptr, false);
  const auto add = [&](const char* list, const char* key, const fs::path& parent) {
    if (!json.is_object() || !json.contains(list) || !json[list].is_array())
      return;
    for (const auto& entry : json[list])
      if (entry.is_object() && entry.contains(key) && entry[key].is_string())
        // nothing that is elsewhere
        if (const fs::path path = entry[key].get<std::string>();
            path.parent_path() == parent && path.has_filename() &&
            path.filename() != ".." && path.filename() != ".")
          names.insert(path.string());
  };
  add("groups", "merged", "");
  add("groups", "graph", "");
  add("scans", "pose_file", "poses");
  return names;
}

/** Look at the scans of all groups. */
std::vector<ScanLook>
lookAtGroups(const Model& model,
             const std::vector<std::vector<std::size_t>>& groups,
             const std::function<void()>& done)
{
  std::vector<ScanLook> looks(model.files.size());
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const bool is_pictured = canDrawGroups() && i < PICTURED_GROUPS;
    const std::size_t drawn =
        is_pictured ? std::max<std::size_t>(DRAWN_POINTS / groups[i].size(), 1) : 0;
    for (const std::size_t scan : groups[i]) {
      looks[scan] = lookAt(pointsOf(model.read(scan), model.samples),
                           model.result.scans[scan].transformation, drawn);
      done();
    }
  }
  return looks;
}

std::vector<SidePicture>
picturesOf(const std::vector<std::size_t>& group,
           const std::vector<ScanLook>& looks,
           bool are_large)
{
  std::vector<std::pair<std::size_t, Points>> scans;
  for (const std::size_t scan : group)
    scans.emplace_back(scan, looks[scan].drawn);
  return are_large ? drawGroup(scans, 680, 510) : drawGroup(scans, 480, 360);
}

/** Whether a file has a name as results have them.
 * \param[in] path from the folder of the results on
 */
bool
isNamedAsResult(const fs::path& path)
{
  static const std::regex names("index[.]html|(poses|graph|times)[.]json|pairs[.]csv|"
                                "journal[.]txt|merged_[0-9]+[.]ply|"
                                "graph_[0-9]+[.]g2o|poses/[^/]+[.]txt");
  return std::regex_match(path.generic_string(), names);
}

} // namespace

void
prepareFolder(const std::string& folder, const std::vector<std::string>& scans)
{
  for (const std::string& scan : scans) {
    std::error_code ignored;
    if (isNamedAsResult(fs::relative(scan, folder, ignored)))
      throw std::runtime_error(scan + ": has the name of a result in " + folder +
                               ", and would be replaced; leave it out if it is one of "
                               "an earlier run, else give --out another folder");
  }
  std::error_code error;
  fs::create_directories(fs::path(folder) / "poses", error);
  if (error)
    throw std::runtime_error(folder + ": cannot be written: " + error.message());
  OutputFile((fs::path(folder) / "poses.json").string()); // leaves no trace
}

void
writeFolder(const Model& model,
            const std::string& folder,
            const std::function<void(double)>& progress)
{
  const auto groups = connectedGroups(model.result);
  const std::vector<std::string> names = scanNames(model.files);
  const std::size_t reads = 2 * countsOf(model.result).grouped;
  std::size_t read = 0;
  const auto done = [&] {
    ++read;
    if (progress)
      progress(static_cast<double>(read) / static_cast<double>(reads));
  };
  const std::vector<ScanLook> looks = lookAtGroups(model, groups, done);

  FolderFiles files(folder);
  std::vector<GroupShow> shows(groups.size());
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const std::string number = std::to_string(i + 1);
    files.write("merged_" + number + ".ply", [&](std::ostream& stream) {
      shows[i].points = writeMergedCloud(model, groups[i], looks, done, stream);
    });
    files.write("graph_" + number + ".g2o", g2oText(model, groups[i]));
    if (i < PICTURED_GROUPS)
      shows[i].pictures = picturesOf(groups[i], looks, i == 0);
  }
  for (std::size_t i = 0; i < names.size(); ++i)
    if (isUsable(model.result.scans[i]))
      files.write("poses/" + names[i] + ".txt",
                  transformationText(model.result.scans[i].transformation));
  files.write("graph.json", graphText(model));
  files.write("pairs.csv", pairsText(model));
  files.write("times.json", timesText(model));
  const std::set<std::string> old = filesOfEarlierRun(folder);
  files.write("poses.json", posesText(model, names));
  files.removeOthers(old);
  files.write("index.html", pageText(model, names, shows));
}

} // namespace tool
