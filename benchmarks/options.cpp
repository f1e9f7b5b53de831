/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "options.h"

#include <charconv>
#include <iostream>
#include <string_view>

namespace benchmarks {
namespace {

constexpr std::string_view threads = "--threads=", folder = "--write-clouds=";

bool
startsWith(std::string_view text, std::string_view begin)
{
  return text.substr(0, begin.size()) == begin;
}

bool
readNumber(std::string_view text, unsigned int& number)
{
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, number);
  return error == std::errc() && rest == end;
}

} // namespace

Options&
options()
{
  static Options options;
  return options;
}

bool
takeOptions(int& argc, char** argv)
{
  int kept = 0;
  for (int i = 0; i < argc; ++i) {
    const std::string_view argument = argv[i];
    if (startsWith(argument, threads)) {
      if (!readNumber(argument.substr(threads.size()), options().threads)) {
        std::cerr << threads << " wants a number\n";
        return false;
      }
    }
    else if (startsWith(argument, folder))
      options().clouds_folder = argument.substr(folder.size());
    else
      argv[kept++] = argv[i];
  }
  argv[argc = kept] = nullptr;
  return true;
}

} // namespace benchmarks
