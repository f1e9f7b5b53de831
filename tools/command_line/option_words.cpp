/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "option_words.h"

#include "setting_options.h"
#include "wrapped.h"

#include <boost/program_options.hpp>

#include <algorithm>
#include <iterator>

namespace tool {
namespace {

namespace po = boost::program_options;

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

void
addProgramOptions(po::options_description& options)
{
  // clang-format off
  options.add_options()
    ("quiet", "no output but files and errors")
    ("version", "show the version")
    ("help,h", "show this help (-h)");
  // clang-format on
}

po::variables_map
valuesOf(const std::vector<OptionGroup>& groups, int argc, const char* const* argv)
{
  po::options_description all;
  for (const auto& group : groups)
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
  return values;
}

std::vector<std::string>
filesOf(const po::variables_map& values)
{
  return values.count("file") ? values["file"].as<std::vector<std::string>>()
                              : std::vector<std::string>();
}

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

std::string
helpOn(const std::vector<OptionGroup>& groups)
{
  std::string text;
  for (const auto& group : groups) {
    text += '\n' + group.caption + ":\n";
    for (const auto& option : group.options.options())
      text += helpOn(*option);
  }
  return text;
}

} // namespace tool
