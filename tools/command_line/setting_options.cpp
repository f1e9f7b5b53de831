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

/** Whether an option sets two settings, and is worded here. */
bool
setsTwo(const std::string& option)
{
  return option == "scale-range" || option == "rotations";
}

template <typename Row>
std::string
defaultOf(const Row& row)
{
  return "default " +
         valueText(row, Settings().*row.member, setting::For::COMMAND_LINE);
}

template <typename Value>
std::string
defaultOf(const setting::Number<Value>& row)
{
  return rangeText(row.typed) + "; default " +
         valueText(row, Settings().*row.member, setting::For::COMMAND_LINE);
}

void
add(po::options_description& options, const setting::Flag& row)
{
  options.add_options()(row.option.name, row.off);
}

void
add(po::options_description& options,
    const setting::Option& option,
    const std::string& text)
{
  const bool has_usual = option.name == std::string("upright");
  const std::string value = option.value, more = "; --upright alone: ";
  options.add_options()(
      option.name,
      po::value<std::string>()->value_name(has_usual ? '[' + value + ']' : value),
      (has_usual ? text + more + USUAL_AXIS : text).c_str());
}

template <typename Row>
void
add(po::options_description& options, const Row& row)
{
  add(options, row.option, meaningText(row) + " (" + defaultOf(row) + ')');
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

/** --rotations WORD, or even:N. */
void
addRotations(po::options_description& options)
{
  const auto& set = setting::rowOf<&Settings::rotation_set>();
  const auto& number = setting::rowOf<&Settings::even_rotations>();
  add(options, set.option,
      meaningText(set) + ", " + number.option.value +
          " (so many of them: " + defaultOf(number) + ") (" + defaultOf(set) + ')');
}

/** \copydoc addRotations */
void
readRotations(const po::variables_map& values, Settings& settings)
{
  ifGiven(values, "rotations", [&](const std::string& text) {
    const auto& set = setting::rowOf<&Settings::rotation_set>();
    const auto& number = setting::rowOf<&Settings::even_rotations>();
    const std::string even = "even:";
    if (text.compare(0, even.size(), even) != 0) {
      settings.rotation_set = valueOf(set, "rotations", text);
      return;
    }
    settings.rotation_set = pcl::kss::RotationSet::EVEN;
    settings.even_rotations = valueOf(number, "rotations even:", text.substr(5));
  });
}

/** --scale-range A B. */
void
addScaleRange(po::options_description& options)
{
  const auto& smallest = setting::rowOf<&Settings::smallest_scale>();
  add(options, smallest.option,
      "smallest and largest scale of the transformation (" + rangeText(smallest.typed) +
          ')');
}

/** \copydoc addScaleRange */
void
readScaleRange(const po::variables_map& values, Settings& settings)
{
  ifGiven(values, "scale-range", [&](const std::string& text) {
    const auto space = text.find(' ');
    if (space == std::string::npos)
      throw UsageError("scale-range", text, "use two numbers");
    settings.smallest_scale = valueOf(setting::rowOf<&Settings::smallest_scale>(),
                                      "scale-range", text.substr(0, space));
    auto largest = setting::rowOf<&Settings::largest_scale>().typed;
    largest.lowest = settings.smallest_scale;
    settings.largest_scale = valueOf(largest, "scale-range", text.substr(space + 1));
  });
}

} // namespace

po::options_description
settingOptions(Users users)
{
  po::options_description options;
  if (users == Users::EXPERTS)
    options.add_options()(
        "paper",
        "the paper's own settings: all pairs of points, Hausdorff distances, the "
        "grid of angles, no cleaning; --mode global unless given");
  setting::forEach([&](const auto& row) {
    const std::string name = row.option.name;
    if ((*row.setter != 0) != (users == Users::EVERYBODY))
      return;
    if (!setsTwo(name))
      add(options, row);
    else if (!options.find_nothrow(name, false))
      name == "rotations" ? addRotations(options) : addScaleRange(options);
  });
  return options;
}

Settings
settingsOf(const po::variables_map& values)
{
  Settings settings;
  if (values.count("paper"))
    settings = pcl::kss::paperSettings(settings);
  setting::forEach([&](const auto& row) {
    if (!setsTwo(row.option.name))
      read(row, values, settings);
  });
  if (values.count("angle-step"))
    settings.rotation_set = pcl::kss::RotationSet::EULER;
  readRotations(values, settings);
  readScaleRange(values, settings);
  return settings;
}

} // namespace tool
