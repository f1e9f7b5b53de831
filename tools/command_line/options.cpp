/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "options.h"

#include "option_words.h"
#include "registration_options.h"
#include "setting_options.h"

#include <boost/algorithm/string/predicate.hpp>
#include <boost/program_options.hpp>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <sstream>

namespace tool {
namespace {

namespace po = boost::program_options;

/** All options, as words; valueOf() converts them, whose messages say more. */
std::vector<OptionGroup>
groupsOfOptions()
{
  const auto word = [](const char* name) {
    return po::value<std::string>()->value_name(name);
  };
  po::options_description files, others;
  // clang-format off
  files.add_options()
    ("transform", word("FILE"), "write the transformation: 4x4 numbers, row by row")
    ("report", word("FILE"), "write all results as JSON, also if not registered; "
     "docs/report.md lists them")
    ("picture", word("FILE"), "draw both clouds before and after, the distances, and "
     "what else fits, as PNG, also if not registered")
    ("guess", word("FILE"), "read a transformation that may be right, as --transform "
     "writes it: it competes with those that are found, and of poses that fit equally "
     "well the nearest to it is taken");
  others.add_options()
    ("view", "show the clouds and the poses in a window, also if not registered")
    ("list-devices", "list the OpenCL devices, and mark those that would be used");
  // clang-format on
  addProgramOptions(others);
  return {{"Files", files},
          {"Settings", registrationOptions()},
          {"Settings for experts", settingOptions(Users::EXPERTS)},
          {"Others", others}};
}

/** The file of --picture; what has no ending, as pipes, may take PNG, too. */
std::string
pictureName(const po::variables_map& values)
{
  const std::string name = fileName(values, "picture");
  const std::string ending = std::filesystem::path(name).extension().string();
  if (!ending.empty() && !boost::algorithm::iequals(ending, ".png"))
    throw UsageError("picture", name, "pictures are PNG: name a file ending in .png");
  return name;
}

} // namespace

Options
parseOptions(int argc, const char* const* argv)
{
  const po::variables_map values = valuesOf(groupsOfOptions(), argc, argv);

  Options options;
  if (values.count("help"))
    options.action = Options::Action::SHOW_HELP;
  else if (values.count("version"))
    options.action = Options::Action::SHOW_VERSION;
  else if (values.count("list-devices"))
    options.action = Options::Action::LIST_DEVICES;
  if (options.action == Options::Action::SHOW_HELP ||
      options.action == Options::Action::SHOW_VERSION)
    return options;
  readRegistrationOptions(values, options);
  if (options.action == Options::Action::LIST_DEVICES)
    return options;

  const std::vector<std::string> files = filesOf(values);
  if (files.size() < 2 || files.size() > 3)
    throw std::runtime_error("needs SOURCE, TARGET and perhaps ALIGNED, but got " +
                             std::to_string(files.size()) +
                             " files; --help shows an example");
  if (std::count(files.begin(), files.end(), "") > 0)
    throw std::runtime_error("a file name is empty; --help shows an example");
  options.source = files[0];
  options.target = files[1];
  if (files.size() == 3)
    options.aligned = files[2];
  options.guess = fileName(values, "guess");
  options.transform = fileName(values, "transform");
  options.report = fileName(values, "report");
  options.picture = pictureName(values);
  options.view = values.count("view") > 0;
  options.quiet = values.count("quiet") > 0;
  return options;
}

std::string
helpText()
{
  std::ostringstream text;
  text
      << "Usage: pcl_kss_icp [OPTIONS] SOURCE TARGET [ALIGNED]\n"
         "\n"
         "Finds the rotation, translation and scale that place the point cloud SOURCE\n"
         "upon TARGET, wherever they lie, and writes the placed SOURCE to ALIGNED.\n"
         "\n"
         "Files are PCD, PLY, OBJ, STL, OFF, PTX or columns of text (.xyz, .txt, "
         ".csv,\n"
         ".asc, .pts), known by their content, else by their ending.\n"
         "Meshes are registered by points spread over their faces. ALIGNED keeps the\n"
         "fields and faces of SOURCE; a warning names what its format cannot hold.\n"
         "\n"
         "Examples:\n"
         "  pcl_kss_icp scan.ply model.stl scan_on_model.ply --picture picture.png\n"
         "  pcl_kss_icp left.pcd right.pcd --rigid --transform left_to_right.txt\n";
  text
      << helpOn(groupsOfOptions())
      << "\n"
         "Exit status:\n"
         "  0      registered\n"
         "  1      not registered: the clouds do not fit, or determine no pose, or "
         "the\n"
         "         time limit has passed; only the report and the picture are written\n"
         "  2      the command line or a file is wrong, a device failed, or memory "
         "ran\n"
         "         out\n"
         "  128+N  ended by signal N (130 by SIGINT, 143 by SIGTERM, 129 by SIGHUP);\n"
         "         no file is written\n";
  return text.str();
}

} // namespace tool
