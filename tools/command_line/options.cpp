/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "options.h"

#include <boost/lexical_cast/try_lexical_convert.hpp>
#include <boost/program_options.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

namespace tool {
namespace {

namespace po = boost::program_options;

/** Keeps Boost's own words about a value that is wrong away from ours. */
class UsageError : public std::runtime_error {
public:
  UsageError(const std::string& option, const std::string& value, const char* remedy)
  : std::runtime_error("--" + option + " " + value + ": " + remedy +
                       "; --help shows all options")
  {
  }
};

/** Options as words; they are converted by number() below, whose messages say more. */
po::options_description
visibleOptions()
{
  po::options_description options("Options");
  const auto word = [](const char* name) {
    return po::value<std::string>()->value_name(name);
  };
  // clang-format off
  options.add_options()
    ("transform", word("FILE"), "write the transformation: 4x4 numbers, row by row")
    ("report", word("FILE"), "write all results as JSON, also if not registered")
    ("mode", word("MODE"),
     "what the clouds show: auto (default), both the whole object: global, one a part of "
     "the other: partial, or both incomplete: overlap")
    ("rigid", "the clouds have the same scale")
    ("scale-range", word("A B"), "smallest and largest scale of the transformation")
    ("paper", "the paper's own settings: all pairs of points, Hausdorff distances, the "
     "Euler grid, no cleaning; --mode global unless given")
    ("no-cleaning", "keep stray points and noise in the search")
    ("points", word("K"), "points that both clouds are simplified to (default 2000)")
    ("angle-step", word("DEG"), "step of the Euler grid (default 30)")
    ("rotations", word("SET"),
     "rotations to try: even:N, N evenly spread ones (default even:1728), or euler, a "
     "grid of angles")
    ("density", word("KIND"),
     "spread the simplified points by area: uniform (default), as the cloud's own "
     "points: paper, or draw them: random")
    ("device", word("NAME"),
     "where to search: auto (default), the first OpenCL device if there is one, host, "
     "or the OpenCL device whose name contains NAME")
    ("list-devices", "list the OpenCL devices")
    ("threads", word("N"), "threads on the CPU (default 0: as many as cores)")
    ("iterations", word("N"), "iterations of the final ICP at most (default 300)")
    ("time-limit", word("SECONDS"), "end after so long, with the best pose so far in the report")
    ("samples", word("N"), "points that stand for a mesh (default 10000)")
    ("quiet", "no output but files and errors")
    ("version", "show the version")
    ("help,h", "show this help");
  // clang-format on
  return options;
}

/** Read the number that an option has. */
double
number(const std::string& option,
       const std::string& value,
       double least,
       double most,
       const char* remedy)
{
  double number;
  if (!boost::conversion::try_lexical_convert(value, number) ||
      !(number >= least && number <= most))
    throw UsageError(option, value, remedy);
  return number;
}

/** Read the whole number that an option has. */
unsigned int
wholeNumber(const std::string& option,
            const std::string& value,
            double least,
            double most,
            const char* remedy)
{
  const double result = number(option, value, least, most, remedy);
  if (result != std::floor(result))
    throw UsageError(option, value, remedy);
  return static_cast<unsigned int>(result);
}

/** Calls a function with the value of an option that was given. */
template <typename Function>
void
ifGiven(const po::variables_map& values, const std::string& option, Function function)
{
  if (values.count(option))
    function(values[option].as<std::string>());
}

/** The file that an option names; empty if it was not given. */
std::string
fileName(const po::variables_map& values, const std::string& option)
{
  std::string name;
  ifGiven(values, option, [&](const auto& value) {
    if (value.empty())
      throw UsageError(option, "''", "name a file");
    name = value;
  });
  return name;
}

pcl::kss::Mode
modeOf(const std::string& name)
{
  using pcl::kss::Mode;
  const std::map<std::string, Mode> modes = {{"auto", Mode::AUTOMATIC},
                                             {"global", Mode::GLOBAL_GLOBAL},
                                             {"partial", Mode::PARTIAL_GLOBAL},
                                             {"overlap", Mode::PARTIAL_PARTIAL}};
  const auto found = modes.find(name);
  if (found == modes.end())
    throw UsageError("mode", name, "use auto, global, partial or overlap");
  return found->second;
}

pcl::kss::Density
densityOf(const std::string& name)
{
  using pcl::kss::Density;
  const std::map<std::string, Density> densities = {{"uniform", Density::UNIFORM},
                                                    {"paper", Density::PAPER},
                                                    {"random", Density::RANDOM}};
  const auto found = densities.find(name);
  if (found == densities.end())
    throw UsageError("density", name, "use uniform, paper or random");
  return found->second;
}

pcl::kss::Settings
settingsOf(const po::variables_map& values)
{
  pcl::kss::Settings settings;
  ifGiven(values, "mode", [&](const auto& value) { settings.mode = modeOf(value); });
  if (values.count("paper"))
    settings = pcl::kss::paperSettings(settings);
  if (values.count("no-cleaning"))
    settings.clean = false;
  settings.estimate_scale = values.count("rigid") == 0;
  ifGiven(values, "scale-range", [&](const auto& value) {
    const char* remedy = "use two numbers from 1e-6 to 1e6, the smaller one first";
    const auto space = value.find(' ');
    if (space == std::string::npos)
      throw UsageError("scale-range", value, remedy);
    // from micrometres to metres and back; beyond, single precision has no digits left
    const double most = 1e6;
    settings.smallest_scale =
        number("scale-range", value.substr(0, space), 1.0 / most, most, remedy);
    settings.largest_scale = number("scale-range", value.substr(space + 1),
                                    settings.smallest_scale, most, remedy);
  });
  ifGiven(values, "points", [&](const auto& value) {
    settings.sample_points =
        wholeNumber("points", value, 20, 1e6, "use a whole number from 20 to 1000000");
  });
  ifGiven(values, "angle-step", [&](const auto& value) {
    settings.rotation_set = pcl::kss::RotationSet::EULER;
    settings.angle_step =
        number("angle-step", value, 3, 180, "use degrees from 3 to 180") * M_PI / 180.0;
  });
  ifGiven(values, "rotations", [&](const std::string& value) {
    const char* remedy = "use euler or even:N, N a whole number from 1 to 100000";
    if (value.compare(0, 5, "even:") == 0) {
      settings.rotation_set = pcl::kss::RotationSet::EVEN;
      settings.even_rotations =
          wholeNumber("rotations", value.substr(5), 1, 1e5, remedy);
    }
    else if (value == "euler")
      settings.rotation_set = pcl::kss::RotationSet::EULER;
    else
      throw UsageError("rotations", value, remedy);
  });
  ifGiven(values, "density",
          [&](const auto& value) { settings.density = densityOf(value); });
  ifGiven(values, "device", [&](const auto& value) {
    if (value.empty())
      throw UsageError("device", "''", "use auto, host or a name of --list-devices");
    settings.device = value;
  });
  ifGiven(values, "threads", [&](const auto& value) {
    settings.threads = wholeNumber("threads", value, 0, 1024,
                                   "use a whole number up to 1024; 0: all cores");
  });
  return settings;
}

/** The command line in words, the two values of --scale-range in one: an option has
 * either one value or all words that follow, files included. */
std::vector<std::string>
wordsOf(int argc, const char* const* argv)
{
  std::vector<std::string> words;
  for (int i = 1; i < argc; ++i) {
    words.push_back(argv[i]);
    if (words.back() == "--scale-range" && i + 2 < argc) {
      words.push_back(std::string(argv[i + 1]) + ' ' + argv[i + 2]);
      i += 2;
    }
  }
  return words;
}

} // namespace

Options
parseOptions(int argc, const char* const* argv)
{
  po::options_description all = visibleOptions();
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
  if (options.action != Options::Action::REGISTER)
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
  options.transform = fileName(values, "transform");
  options.report = fileName(values, "report");
  ifGiven(values, "samples", [&](const auto& value) {
    options.samples = wholeNumber("samples", value, 20, 1e9,
                                  "use a whole number from 20 to 1000000000");
  });
  ifGiven(values, "time-limit", [&](const auto& value) {
    options.limits.seconds = number("time-limit", value, 1e-3, 1e9,
                                    "use a number of seconds from 0.001 to 1e9");
  });
  ifGiven(values, "iterations", [&](const auto& value) {
    options.limits.iterations = static_cast<int>(wholeNumber(
        "iterations", value, 1, 1e6, "use a whole number from 1 to 1000000"));
  });
  options.quiet = values.count("quiet") > 0;
  options.settings = settingsOf(values);
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
         "Files are PCD, PLY, OBJ, STL, OFF or columns of text (.xyz, .txt, .pts).\n"
         "Meshes are registered by points spread over their faces. ALIGNED keeps the\n"
         "fields and faces of SOURCE that its format can hold.\n"
         "\n"
      << visibleOptions()
      << "\n"
         "Exit status:\n"
         "  0    registered\n"
         "  1    not registered: the clouds do not fit, or determine no pose, or the\n"
         "       time limit has passed; only the report is written\n"
         "  2    the command line or a file is wrong, a device failed, or memory ran "
         "out\n"
         "  128+N  ended by signal N (130 by SIGINT, 143 by SIGTERM, 129 by SIGHUP);\n"
         "       no file is written\n"
         "\n"
         "Example:\n"
         "  pcl_kss_icp scan.ply model.stl scan_on_model.ply --report report.json\n";
  return text.str();
}

} // namespace tool
