/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "batch_options.h"

#include "command_line/option_words.h"
#include "command_line/registration_options.h"
#include "command_line/setting_options.h"

#include <boost/program_options.hpp>

#include <stdexcept>

namespace tool {
namespace {

namespace po = boost::program_options;

std::vector<OptionGroup>
groupsOfOptions()
{
  po::options_description settings;
  const po::options_description usual = registrationOptions();
  for (const auto& option : usual.options())
    if (option->long_name() != "threads")
      settings.add(option);
  return {{"Files", folderOptions()},
          {"Settings", settings},
          {"Settings for experts", settingOptions(Users::EXPERTS)},
          {"Others", otherJobOptions()}};
}

} // namespace

BatchOptions
parseBatchOptions(int argc, const char* const* argv)
{
  const po::variables_map values = valuesOf(groupsOfOptions(), argc, argv);
  BatchOptions options;
  if (!readJobOptions(values, options))
    return options;

  const std::vector<std::string> files = filesOf(values);
  if (files.size() != 1 || files.front().empty())
    throw std::runtime_error("needs one MANIFEST, but got " +
                             std::to_string(files.size()) +
                             " files; --help shows an example");
  options.manifest = files.front();
  options.folder = folderOf(values);
  return options;
}

std::string
batchHelpText()
{
  return "Usage: pcl_kss_icp_batch [OPTIONS] MANIFEST --out DIR\n"
         "\n"
         "Registers many pairs of point clouds, each as pcl_kss_icp does, several at "
         "a\n"
         "time. A pair that cannot be read or registered costs one line of the "
         "results.\n"
         "Started again after whatever has ended it, it goes on where it was.\n"
         "\n"
         "MANIFEST is a CSV whose first line names its columns: source and target, "
         "and\n"
         "perhaps name and guess (the file of a transformation to begin with). Or it\n"
         "has a JSON object with these names in each line. Files are looked for from\n"
         "MANIFEST's folder. DIR/results.csv has a line for each pair, "
         "DIR/results.jsonl\n"
         "all that pcl_kss_icp --report says of it, DIR/times.csv what it took.\n"
         "\n"
         "Examples:\n"
         "  pcl_kss_icp_batch pairs.csv --rigid --out results\n"
         "  mpirun -n 4 pcl_kss_icp_batch pairs.csv --rigid --out results\n" +
         helpOn(groupsOfOptions()) +
         "\n"
         "Exit status:\n"
         "  0      all pairs are registered\n"
         "  1      some are not: DIR/results.csv says why\n"
         "  2      the command line, MANIFEST or DIR is wrong, or the disk is full\n"
         "  128+N  ended by signal N (130 by SIGINT, 143 by SIGTERM, 129 by SIGHUP);\n"
         "         what is done is kept, and the same command goes on\n";
}

} // namespace tool
