/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "job_options.h"

#include "registration_options.h"

#include <boost/program_options.hpp>

#include <stdexcept>

namespace tool {

namespace po = boost::program_options;

po::options_description
folderOptions()
{
  po::options_description options;
  // clang-format off
  options.add_options()
    ("out", po::value<std::string>()->value_name("DIR"),
     "the folder of the results, which is made where there is none")
    ("restart", "begin anew instead of going on with what is in DIR");
  // clang-format on
  return options;
}

po::options_description
otherJobOptions()
{
  po::options_description options;
  // clang-format off
  options.add_options()
    ("threads", po::value<std::string>()->value_name("N"),
     "pairs that each process does at a time, one thread for each (default: as many as "
     "there are cores for it)");
  // clang-format on
  addProgramOptions(options);
  return options;
}

bool
readJobOptions(const po::variables_map& values, JobOptions& options)
{
  if (values.count("help"))
    options.action = JobOptions::Action::SHOW_HELP;
  else if (values.count("version"))
    options.action = JobOptions::Action::SHOW_VERSION;
  if (options.action != JobOptions::Action::WORK)
    return false;
  readRegistrationOptions(values, options.how);
  options.threads = options.how.settings.threads;
  options.how.settings.threads = 1;
  options.restart = values.count("restart") > 0;
  options.quiet = values.count("quiet") > 0;
  return true;
}

std::string
folderOf(const po::variables_map& values)
{
  const std::string folder = fileName(values, "out");
  if (folder.empty())
    throw std::runtime_error(
        "needs --out DIR for the results; --help shows an example");
  return folder;
}

} // namespace tool
