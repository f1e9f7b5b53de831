/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "options.h"

#include "resampling.h"

#include <boost/algorithm/string/classification.hpp>
#include <boost/algorithm/string/join.hpp>
#include <boost/algorithm/string/split.hpp>
#include <boost/algorithm/string/trim.hpp>
#include <boost/lexical_cast/try_lexical_convert.hpp>
#include <boost/program_options.hpp>

#include <cmath>
#include <iostream>
#include <limits>
#include <stdexcept>

namespace evaluation {
namespace {

namespace po = boost::program_options;

[[noreturn]] void
refuse(const std::string& option, const std::string& remedy)
{
  throw std::runtime_error("--" + option + ": " + remedy +
                           "; --help shows all options");
}

std::vector<std::string>
listOf(const std::string& text)
{
  // names of methods hold commas within brackets: "KSS-ICP (paper, host)"
  std::vector<std::string> items(1);
  int depth = 0;
  for (const char c : text) {
    depth += c == '(' ? 1 : c == ')' ? -1 : 0;
    if (c == ',' && depth == 0)
      items.emplace_back();
    else
      items.back() += c;
  }
  for (auto& item : items)
    boost::trim(item);
  return items;
}

po::options_description
visibleOptions()
{
  po::options_description general("Options"), cases("Cases"),
      ablation("Ablations: KSS-ICP with one choice changed, in place of the methods");
  // clang-format off
  general.add_options()
    ("out", po::value<std::string>()->value_name("DIR"),
     "folder for all results; a run that was stopped goes on there")
    ("full", "all models, fifteen times the time limit, three models at all sizes, "
     "rather than what is done within half an hour on two cores")
    ("models", po::value<long long>()->value_name("N"),
     "evaluate so many of the models, evenly chosen (default 4; 0: all); more of them "
     "add to what there is")
    ("size-models", po::value<long long>()->value_name("N"),
     "meshes that the clouds of 5,000 to 1,000,000 points are drawn from (default 1)")
    ("methods", po::value<std::string>()->value_name("A,B"), "only these methods")
    ("list-methods", "list the methods")
    ("time-limit", po::value<double>()->value_name("S"),
     "seconds of CPU time after which a registration is given up (default 20)")
    ("jobs", po::value<long long>()->value_name("N"),
     "registrations at a time (default 0: as many as cores); those of the sizes always "
     "run alone")
    ("version", "show the version")
    ("help,h", "show this help");
  cases.add_options()
    ("tables", po::value<std::string>()->value_name("A,B"),
     "only these: similarity, density, gauss, uniform, deleted, size")
    ("seed", po::value<long long>()->value_name("N"), "for all random numbers "
     "(default 0)")
    ("repetitions", po::value<long long>()->value_name("N"),
     "cases of each model and condition (default 1)")
    ("points", po::value<long long>()->value_name("N"),
     "points of a cloud (default 10000)")
    ("rotation", po::value<std::string>()->value_name("KIND"),
     "axes: by more than 30 degrees about each axis (default); so3: all rotations")
    ("scale-range", po::value<std::string>()->value_name("A,B"),
     "scales of the source (default 0.8,1.2)")
    ("deleted", po::value<double>()->value_name("SHARE"),
     "share of the source that is cut off (default 0.3)")
    ("resampling", po::value<std::string>()->value_name("KIND"),
     "how the source's density is changed; gradient: half the points, 20 times denser "
     "at one end (default); wlop: CGAL's WLOP, where built with it");
  // clang-format on
  for (const auto& each : ablations()) {
    std::vector<std::string> names;
    for (const auto& variant : each.variants)
      names.push_back(variant.name);
    ablation.add_options()(("ablate-" + each.flag).c_str(),
                           boost::algorithm::join(names, "; ").c_str());
  }
  ablation.add_options()("ablate-all", "all of these");
  return general.add(cases).add(ablation);
}

/** A whole number; a negative one would become a very large one. */
template <typename T>
void
take(const po::variables_map& values, const std::string& option, T& value)
{
  if (!values.count(option))
    return;
  const auto number = values[option].as<long long>();
  if (number < 0 || number > std::numeric_limits<unsigned int>::max())
    refuse(option, "use a whole number from 0 to 4294967295");
  value = static_cast<T>(number);
}

void
take(const po::variables_map& values, const std::string& option, double& value)
{
  if (values.count(option))
    value = values[option].as<double>();
}

std::string
word(const po::variables_map& values, const std::string& option)
{
  return values.count(option) ? values[option].as<std::string>() : std::string();
}

void
takeScaleRange(const po::variables_map& values, Protocol& protocol)
{
  if (!values.count("scale-range"))
    return;
  const auto bounds = listOf(word(values, "scale-range"));
  double& smallest = protocol.smallest_scale;
  double& largest = protocol.largest_scale;
  if (bounds.size() != 2 ||
      !boost::conversion::try_lexical_convert(bounds[0], smallest) ||
      !boost::conversion::try_lexical_convert(bounds[1], largest) ||
      !(smallest > 0.0 && largest >= smallest && std::isfinite(largest)))
    refuse("scale-range", "use two positive numbers, the smaller one first: 0.8,1.2");
}

void
takeProtocol(const po::variables_map& values, Protocol& protocol)
{
  take(values, "seed", protocol.seed);
  take(values, "repetitions", protocol.repetitions);
  take(values, "points", protocol.points);
  take(values, "deleted", protocol.deleted);
  takeScaleRange(values, protocol);
  if (protocol.repetitions == 0)
    refuse("repetitions", "use at least 1");
  if (protocol.points < 200)
    refuse("points", "use at least 200");
  if (!(protocol.deleted > 0.0 && protocol.deleted <= 0.9))
    refuse("deleted", "use a share above 0 and up to 0.9");

  const std::string rotation = word(values, "rotation");
  if (!rotation.empty() && rotation != "axes" && rotation != "so3")
    refuse("rotation", "use axes or so3");
  if (rotation == "so3")
    protocol.rotations = Rotations::SO3;

  const std::string resampling = word(values, "resampling");
  if (!resampling.empty() && resampling != "gradient" && resampling != "wlop")
    refuse("resampling", "use gradient or wlop");
  if (resampling == "wlop") {
    if (!hasWLOP())
      refuse("resampling", "wlop needs a build with "
                           "-DPCL_KSS_ICP_BENCHMARKS_WITH_CGAL=ON; use gradient");
    protocol.resampling = Resampling::WLOP;
  }
}

void
takeAblations(const po::variables_map& values, Options& options)
{
  for (const auto& ablation : ablations())
    if (values.count("ablate-all") || values.count("ablate-" + ablation.flag))
      options.ablate.push_back(ablation.flag);
}

Options
optionsOf(const po::variables_map& values)
{
  Options options;
  if (values.count("full")) {
    options.number_of_models = 0;
    options.size_models = 3;
    options.time_limit *= 15.0; // 300 s, as in the paper
  }
  options.models = word(values, "models-folder");
  options.out = word(values, "out");
  if (options.models.empty() || options.out.empty())
    throw std::runtime_error("name a folder of models and a folder for the results: "
                             "pcl_kss_icp_evaluate MODELS_DIR --out DIR");
  take(values, "models", options.number_of_models);
  take(values, "size-models", options.size_models);
  take(values, "time-limit", options.time_limit);
  take(values, "jobs", options.jobs);
  if (!(options.time_limit > 0.0))
    refuse("time-limit", "use a positive number of seconds");
  if (values.count("methods"))
    options.methods = listOf(word(values, "methods"));
  takeProtocol(values, options.protocol);
  takeAblations(values, options);
  options.tables = tableNames();
  if (!options.ablate.empty())
    options.tables.pop_back(); // the sizes tell nothing about choices
  if (values.count("tables"))
    options.tables = listOf(word(values, "tables"));
  conditionsOf(options.tables, options.protocol); // refuses unknown ones
  return options;
}

void
showHelp(const po::options_description& visible)
{
  std::cout << "Usage: pcl_kss_icp_evaluate MODELS_DIR --out DIR [OPTIONS]\n\n"
               "Runs the experiments of the KSS-ICP paper on a folder of models (OFF, "
               "PLY, OBJ, STL,\nPCD), with PCL's registrations beside it, and writes "
               "tables, plots and pictures:\nDIR/report.md.\n\n"
            << visible;
}

} // namespace

bool
parse(int argc, char** argv, Options& options, int& exit_code)
{
  exit_code = 0;
  try {
    const auto visible = visibleOptions();
    po::options_description all;
    all.add(visible).add_options()("models-folder", po::value<std::string>());
    po::positional_options_description position;
    position.add("models-folder", 1);
    po::variables_map values;
    po::store(
        po::command_line_parser(argc, argv).options(all).positional(position).run(),
        values);
    if (values.count("help")) {
      showHelp(visible);
      return false;
    }
    if (values.count("version")) {
      std::cout << "pcl_kss_icp_evaluate " PCL_KSS_ICP_VERSION "\n";
      return false;
    }
    if (values.count("list-methods")) {
      for (const auto& methods : {kssICPMethods(), pclMethods(), open3dMethods()})
        for (const auto& method : methods)
          std::cout << method.name << '\n';
      return false;
    }
    options = optionsOf(values);
    return true;
  }
  catch (const std::exception& problem) {
    std::cerr << "pcl_kss_icp_evaluate: " << problem.what() << '\n';
    exit_code = 2;
    return false;
  }
}

} // namespace evaluation
