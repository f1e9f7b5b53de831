/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/settings_text.h>

#include <boost/lexical_cast/try_lexical_convert.hpp>
#include <boost/program_options/variables_map.hpp>

#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>

/** \file
 * What an option's words are, and what is said where they are wrong.
 */

namespace tool {

namespace setting = pcl::kss::setting;

/** \brief Keeps Boost's own words about a value that is wrong away from ours. */
class UsageError : public std::runtime_error {
public:
  UsageError(const std::string& option,
             const std::string& value,
             const std::string& remedy)
  : std::runtime_error("--" + option + ' ' + (value.empty() ? "''" : value) + ": " +
                       remedy + "; --help shows all options")
  {
  }
};

/** \brief Call a function with the words of an option that was given. */
template <typename Function>
void
ifGiven(const boost::program_options::variables_map& values,
        const std::string& option,
        Function function)
{
  if (values.count(option))
    function(values[option].as<std::string>());
}

/** \name The value that words stand for; none where they are wrong. */
/** \{ */
template <typename Value>
std::optional<Value>
parsed(const setting::Range<Value>& range, const std::string& text)
{
  double number;
  if (!boost::conversion::try_lexical_convert(text, number))
    return {};
  number *= range.typed.size;
  if (!(number >= range.lowest && number <= range.highest) ||
      (std::is_integral_v<Value> && number != std::floor(number)))
    return {};
  return static_cast<Value>(number);
}

template <typename Value, int size>
std::optional<Value>
parsed(const setting::Choice<Value, size>& row, const std::string& text)
{
  for (const setting::Word<Value>& word : row.words)
    if (word.word == text)
      return word.value;
  return {};
}

inline std::optional<std::string>
parsed(const setting::Text& row, const std::string& text)
{
  return row.holds(text) ? std::optional<std::string>(text) : std::nullopt;
}
/** \} */

/** \brief The value that an option's words stand for.
 * \param[in] row a row of the table of settings, or a Range
 * \throws UsageError naming the option
 */
template <typename Row>
auto
valueOf(const Row& row, const std::string& option, const std::string& text)
{
  const auto value = parsed(row, text);
  if (!value)
    throw UsageError(option, text, remedy(row, setting::For::COMMAND_LINE));
  return *value;
}

} // namespace tool
