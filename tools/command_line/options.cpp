/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "options.h"

#include "option_values.h"
#include "setting_options.h"
#include "wrapped.h"

#include <boost/algorithm/string/predicate.hpp>
#include <boost/program_options.hpp>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <sstream>

namespace tool {
namespace {

namespace po = boost::program_options;

constexpr setting::Bounds<unsigned int> samples_bounds{20, 1000000000, {"points"}};
constexpr setting::Bounds<unsigned int> iterations_bounds{1, 1000000, {"iterations"}};

/** Options, and what they are for. */
struct Group {
  std::string caption;
  po::options_description options = {};
};

/** All options, as words; valueOf() converts them, whose messages say more. */
std::vector<Group>
groupsOfOptions()
{
  const auto word = [](const char* name) {
    return po::value<std::string>()->value_name(name);
  };
  po::options_description files, settings, others;
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
  settings.add_options()
    ("samples", word("N"), "points that stand for a mesh (default 10000)")
    ("max-iterations", word("N"), "iterations of the final ICP at most (default 300)");
  others.add_options()
    ("view", "show the clouds and the poses in a window, also if not registered")
    ("list-devices", "list the OpenCL devices, and mark those that would be used")
    ("quiet", "no output but files and errors")
    ("version", "show the version")
    ("help,h", "show this help (-h)");
  // clang-format on
  const po::options_description usual = settingOptions(Users::EVERYBODY);
  for (const auto& option : usual.options())
    settings.add(option);
  return {{"Files", files},
          {"Settings", settings},
          {"Settings for experts", settingOptions(Users::EXPERTS)},
          {"Others", others}};
}

/** How wide --help is at most, and where it says what options are. */
constexpr std::size_t HELP_WIDTH = 79, HELP_COLUMN = 26;

/** An option with what it is, in lines. */
std::string
helpOn(const po::option_description& option)
{
  std::string name = "  --" + option.long_name();
  const std::string parameter = option.format_parameter();
  if (!parameter.empty())
    name += ' ' + parameter;
  name += name.size() + 2 > HELP_COLUMN ? "\n" + std::string(HELP_COLUMN, ' ')
                                        : std::string(HELP_COLUMN - name.size(), ' ');
  return name + wrapped(option.description(), HELP_WIDTH, HELP_COLUMN) + '\n';
}

/** The file that an option names; empty if it was not given. */
std::string
fileName(const po::variables_map& values, const std::string& option)
{
  std::string name;
  ifGiven(values, option, [&](const auto& value) {
    if (value.empty())
      throw UsageError(option, value, "name a file");
    name = value;
  });
  return name;
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

/** Whether a word is an axis for --upright, and no file. */
bool
isAxis(const std::string& word)
{
  const auto& words = setting::rowOf<&pcl::kss::Settings::rotation_axis>().words;
  return std::any_of(std::begin(words), std::end(words),
                     [&](const auto& axis) { return axis.word == word; });
}

/** The command line in words, the two values of --scale-range in one, and --upright
 * with its axis: an option has either one value or all words that follow, and takes the
 * next one for its own, files included. */
std::vector<std::string>
wordsOf(int argc, const char* const* argv)
{
  std::vector<std::string> words;
  for (int i = 1; i < argc; ++i) {
    words.push_back(argv[i]);
    if (words.back().rfind("--iterations", 0) == 0) // as it was called before
      words.back().replace(0, 2, "--max-");
    if (words.back() == "--scale-range" && i + 2 < argc) {
      words.push_back(std::string(argv[i + 1]) + ' ' + argv[i + 2]);
      i += 2;
    }
    else if (words.back() == "--upright") {
      const bool has_axis = i + 1 < argc && isAxis(argv[i + 1]);
      words.push_back(has_axis ? argv[++i] : USUAL_AXIS);
    }
  }
  return words;
}

} // namespace

Options
parseOptions(int argc, const char* const* argv)
{
  po::options_description all;
  for (const auto& group : groupsOfOptions())
    all.add(group.options);
  all.add_options()("file", po::value<std::vector<std::string>>());
  po::positional_options_description positional;
  positional.add("file", -1);
  // Abbreviations would change their meaning with every option that is added.
  const int style =
      po::command_line_style::default_style & ~po::command_line_style::allow_guessing;
  po::variables_map values;
  po::store(po::command_line_parser(wordsOf(argc, argv))
                .options(all)
                .positional(positional)
                .style(style)
                .run(),
            values);

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
  options.settings = settingsOf(values);
  if (options.action == Options::Action::LIST_DEVICES)
    return options;

  std::vector<std::string> files;
  if (values.count("file"))
    files = values["file"].as<std::vector<std::string>>();
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
  ifGiven(values, "samples", [&](const auto& value) {
    options.samples = valueOf(samples_bounds, "samples", value);
  });
  ifGiven(values, "max-iterations", [&](const auto& value) {
    options.iterations = valueOf(iterations_bounds, "max-iterations", value);
  });
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
  for (const auto& group : groupsOfOptions()) {
    text << '\n' << group.caption << ":\n";
    for (const auto& option : group.options.options())
      text << helpOn(*option);
  }
  text
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
