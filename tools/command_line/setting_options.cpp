/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "setting_options.h"

#include "option_values.h"

#include <boost/program_options.hpp>

namespace tool {
namespace {

namespace po = boost::program_options;

using pcl::kss::Settings;

/** A scale of clouds in units from micrometres to metres: beyond, single precision has
 * no digits left. */
constexpr setting::Range<double> scale_range{1e-6, 1e6};

/** Whether an option sets two settings, and is worded here. */
bool
setsTwo(const setting::Option& option)
{
  int settings = 0;
  setting::forEach([&](const auto& row) {
    settings += std::string(row.option.name) == option.name;
  });
  return settings > 1;
}

template <typename Row>
std::string
rangeAndDefault(const Row& row)
{
  std::string range;
  if constexpr (std::is_arithmetic_v<typename Row::Value>)
    range = rangeText(row, setting::For::COMMAND_LINE) + "; ";
  return range + "default " +
         valueText(row, Settings().*row.member, setting::For::COMMAND_LINE);
}

void
add(po::options_description& options, const setting::Flag& row)
{
  options.add_options()(row.option.name, row.off);
}

template <typename Row>
void
add(po::options_description& options, const Row& row)
{
  const std::string text = meaningText(row) + " (" + rangeAndDefault(row) + ')';
  options.add_options()(
      row.option.name, po::value<std::string>()->value_name(row.option.value),
      text.c_str());
}

void
read(const setting::Flag& row, const po::variables_map& values, Settings& settings)
{
  if (values.count(row.option.name))
    settings.*row.member = false;
}

template <typename Row>
void
read(const Row& row, const po::variables_map& values, Settings& settings)
{
  ifGiven(values, row.option.name, [&](const std::string& text) {
    settings.*row.member = valueOf(row, row.option.name, text);
  });
}

void
readRotations(const po::variables_map& values, Settings& settings)
{
  if (values.count("angle-step"))
    settings.rotation_set = pcl::kss::RotationSet::EULER;
  ifGiven(values, "rotations", [&](const std::string& text) {
    const std::string set = text.substr(0, text.find(':'));
    settings.rotation_set =
        valueOf(setting::rowOf<&Settings::rotation_set>(), "rotations", set);
    if (set == text)
      return;
    const auto& row = setting::rowOf<&Settings::even_rotations>();
    const auto number = parsed(row, text.substr(set.size() + 1));
    if (!number || settings.rotation_set != pcl::kss::RotationSet::EVEN)
      throw UsageError("rotations", text, remedy(row, setting::For::COMMAND_LINE));
    settings.even_rotations = *number;
  });
}

void
readScaleRange(const po::variables_map& values, Settings& settings)
{
  ifGiven(values, "scale-range", [&](const std::string& text) {
    const auto space = text.find(' ');
    const auto smallest = parsed(scale_range, text.substr(0, space));
    const auto largest =
        parsed(scale_range, space == text.npos ? "" : text.substr(space + 1));
    if (!smallest || !largest || *smallest > *largest)
      throw UsageError("scale-range", text,
                       "use two numbers, " +
                           rangeText(scale_range, setting::For::COMMAND_LINE) +
                           ", the smaller one first");
    settings.smallest_scale = *smallest;
    settings.largest_scale = *largest;
  });
}

} // namespace

po::options_description
settingOptions()
{
  po::options_description options("Settings");
  const auto word = [](const char* name) {
    return po::value<std::string>()->value_name(name);
  };
  options.add_options()(
      "paper", "the paper's own settings: all pairs of points, Hausdorff distances, the "
               "grid of angles, no cleaning; --mode global unless given");
  setting::forEach([&](const auto& row) {
    if (!setsTwo(row.option))
      add(options, row);
  });
  options.add_options()("scale-range", word("A B"),
                        "smallest and largest scale of the transformation");
  const auto& set = setting::rowOf<&Settings::rotation_set>();
  const auto& number = setting::rowOf<&Settings::even_rotations>();
  const std::string rotations = meaningText(set) + "; even:N, N of these (" +
                                rangeAndDefault(number) + ')';
  options.add_options()("rotations", word(set.option.value), rotations.c_str());
  return options;
}

Settings
settingsOf(const po::variables_map& values)
{
  Settings settings;
  if (values.count("paper"))
    settings = pcl::kss::paperSettings(settings);
  setting::forEach([&](const auto& row) {
    if (!setsTwo(row.option))
      read(row, values, settings);
  });
  readRotations(values, settings);
  readScaleRange(values, settings);
  // no limit is what there is without the option
  if (values.count("time-limit") && settings.time_limit == 0.0)
    throw UsageError("time-limit", "0", "use more seconds");
  return settings;
}

} // namespace tool
