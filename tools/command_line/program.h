/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <exception>
#include <functional>
#include <iostream>
#include <optional>
#include <string>

/** \file
 * What the main() of all programs has in common.
 */

namespace tool {

/** \brief The exit status of a program that has done what it was asked for, of one that
 * has done so for a part, and of one that could not.
 */
constexpr int SUCCESS = 0, NOT_ALL = 1, FAILED = 2;

/** \brief Write a message of a program on one line, whatever it quotes. */
void
complain(const std::string& program, std::string message);

/** \brief Run a program, whose exceptions are messages.
 * \return its exit status
 */
int
guarded(const std::string& program, const std::function<int()>& run);

/** \brief Show help or version, or do the work, as the command line asks for.
 * \param[in] program its name
 * \param[in] speaks whether it is this process that speaks for all of the program's
 * \param[in] parse reads the command line
 * \param[in] help the text of --help
 * \param[in] work is given the options
 */
template <typename Options>
int
runAsAsked(const std::string& program,
           bool speaks,
           const std::function<Options()>& parse,
           const std::function<std::string()>& help,
           const std::function<int(const Options&)>& work)
{
  std::optional<Options> options;
  try {
    options = parse();
  }
  catch (const std::exception& problem) {
    if (speaks)
      complain(program, problem.what());
    return FAILED;
  }
  if (options->action == Options::Action::SHOW_HELP) {
    if (speaks)
      std::cout << help();
  }
  else if (options->action == Options::Action::SHOW_VERSION) {
    if (speaks)
      std::cout << program << " " PCL_KSS_ICP_VERSION "\n";
  }
  else
    return work(*options);
  return SUCCESS;
}

} // namespace tool
