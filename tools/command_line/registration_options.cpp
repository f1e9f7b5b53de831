/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "registration_options.h"

#include "option_values.h"
#include "setting_options.h"

#include <boost/program_options.hpp>

namespace tool {
namespace {

namespace po = boost::program_options;

constexpr setting::Bounds<unsigned int> samples_bounds{20, 1000000000, {"points"}};
constexpr setting::Bounds<unsigned int> iterations_bounds{1, 1000000, {"iterations"}};

} // namespace

po::options_description
registrationOptions()
{
  po::options_description options;
  const auto* const number = "N";
  // clang-format off
  options.add_options()
    ("samples", po::value<std::string>()->value_name(number),
     "points that stand for a mesh (default 10000)")
    ("max-iterations", po::value<std::string>()->value_name(number),
     "iterations of the final ICP at most (default 300)");
  // clang-format on
  const po::options_description usual = settingOptions(Users::EVERYBODY);
  for (const auto& option : usual.options())
    options.add(option);
  return options;
}

void
readRegistrationOptions(const po::variables_map& values, Options& options)
{
  options.settings = settingsOf(values);
  ifGiven(values, "samples", [&](const auto& value) {
    options.samples = valueOf(samples_bounds, "samples", value);
  });
  ifGiven(values, "max-iterations", [&](const auto& value) {
    options.iterations = valueOf(iterations_bounds, "max-iterations", value);
  });
}

} // namespace tool
