/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "multiview_options.h"

#include "command_line/option_values.h"
#include "command_line/option_words.h"
#include "command_line/registration_options.h"
#include "command_line/setting_options.h"

#include <boost/program_options.hpp>

#include <filesystem>
#include <set>
#include <stdexcept>

namespace tool {
namespace {

namespace po = boost::program_options;

constexpr setting::Bounds<unsigned int> scans_bounds{0, 1000000, {"scans"}};
constexpr setting::Bounds<unsigned int> partners_bounds{1, 1000000, {"scans"}};
constexpr setting::Bounds<unsigned int> memory_bounds{10, 100000000, {"MB"}};
constexpr setting::Bounds<double> spacing_bounds{0.0, 1e30, {"units of the scans"}};

/** What may be kept of scans, in megabytes. */
constexpr unsigned int usual_memory = 2000;

/** Settings of single pairs that many scans have no use for: their scale is known. */
const std::set<std::string> not_of_many = {"threads", "rigid", "scale-range"};

std::vector<OptionGroup>
groupsOfOptions()
{
  const auto word = [](const char* name) {
    return po::value<std::string>()->value_name(name);
  };
  po::options_description files = folderOptions(), scans, settings, experts;
  // clang-format off
  files.add_options()
    ("spacing", word("LENGTH"), "thin merged clouds: one point in each cube of that "
     "edge (default 0: all points)");
  scans.add_options()
    ("all-pairs", word("N"), "try all pairs of up to N scans (default 25)")
    ("partners", word("N"), "of more scans, try the N that resemble each most to begin "
     "with (default 8)")
    ("free-scale", "groups that nothing connects may have other units: find which ones "
     "fit each other at another scale")
    ("no-refinement", "do not refine the poses of all scans jointly")
    ("memory", word("MB"), "what may be kept of scans in each process (default 2000)");
  // clang-format on
  const po::options_description usual = registrationOptions();
  for (const auto& option : usual.options())
    if (!not_of_many.count(option->long_name()))
      settings.add(option);
  const po::options_description all = settingOptions(Users::EXPERTS);
  for (const auto& option : all.options())
    if (!not_of_many.count(option->long_name()))
      experts.add(option);
  return {{"Files", files},
          {"Scans", scans},
          {"Settings of pairs", settings},
          {"Settings of pairs for experts", experts},
          {"Others", otherJobOptions()}};
}

/** Check that no file is there twice, by whatever names. */
void
checkUnique(const std::vector<std::string>& scans)
{
  std::set<std::string> files;
  for (const std::string& scan : scans) {
    std::error_code ignored;
    const auto file = std::filesystem::weakly_canonical(scan, ignored);
    if (!files.insert(file.empty() ? scan : file.string()).second)
      throw std::runtime_error(scan + ": is there twice among the SCANS; name it once");
  }
}

} // namespace

MultiviewOptions
parseMultiviewOptions(int argc, const char* const* argv)
{
  const po::variables_map values = valuesOf(groupsOfOptions(), argc, argv);
  MultiviewOptions options;
  if (!readJobOptions(values, options))
    return options;
  options.how.settings.estimate_scale = false;

  ifGiven(values, "all-pairs", [&](const auto& value) {
    options.multiview.all_pairs = valueOf(scans_bounds, "all-pairs", value);
  });
  ifGiven(values, "partners", [&](const auto& value) {
    options.multiview.partners = valueOf(partners_bounds, "partners", value);
  });
  ifGiven(values, "spacing", [&](const auto& value) {
    options.spacing = valueOf(spacing_bounds, "spacing", value);
  });
  unsigned int memory = usual_memory;
  ifGiven(values, "memory",
          [&](const auto& value) { memory = valueOf(memory_bounds, "memory", value); });
  options.room = std::size_t(1000000) * memory;
  options.multiview.scale_between_groups = values.count("free-scale") > 0;
  options.multiview.refine = values.count("no-refinement") == 0;
  options.multiview.threads = options.threads;

  options.scans = filesOf(values);
  if (options.scans.size() < 2)
    throw std::runtime_error("needs two SCANS or more, but got " +
                             std::to_string(options.scans.size()) +
                             "; --help shows an example");
  checkUnique(options.scans);
  options.folder = folderOf(values);
  return options;
}

std::string
multiviewHelpText()
{
  return "Usage: pcl_kss_icp_multiview [OPTIONS] SCANS... --out DIR\n"
         "\n"
         "Finds the poses of many scans, without any to begin with: pairs are\n"
         "registered, loops of pairs tell right ones from wrong ones, and the poses "
         "of\n"
         "all scans are refined jointly. Scans that nothing connects become groups of\n"
         "their own. All have the same unit. Started again after whatever has ended\n"
         "it, it goes on where it was.\n"
         "\n"
         "DIR/poses.json has a pose for each scan, DIR/graph.json the pairs,\n"
         "DIR/merged_1.ply the points of the first group, DIR/index.html shows all.\n"
         "\n"
         "Examples:\n"
         "  pcl_kss_icp_multiview scan_*.ply --out model\n"
         "  mpirun -n 4 pcl_kss_icp_multiview scan_*.ply --out model\n" +
         helpOn(groupsOfOptions()) +
         "\n"
         "Exit status:\n"
         "  0      all scans are connected\n"
         "  1      some are not, or could not be read: DIR/index.html says more\n"
         "  2      the command line or DIR is wrong, or the disk is full\n"
         "  128+N  ended by signal N (130 by SIGINT, 143 by SIGTERM, 129 by SIGHUP);\n"
         "         what is done is kept, and the same command goes on\n";
}

} // namespace tool
