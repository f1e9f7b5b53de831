/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/settings_text.h>

#include <boost/lexical_cast/try_lexical_convert.hpp>
#include <boost/program_options/variables_map.hpp>

#include <cmath>
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

/** \name The value that an option's words stand for.
 * \throws UsageError naming the option
 */
/** \{ */
template <typename Value>
Value
valueOf(const setting::Bounds<Value>& bounds,
        const std::string& option,
        const std::string& text)
{
  double number = 0.0;
  const bool is_number = boost::conversion::try_lexical_convert(text, number);
  number *= bounds.unit.size;
  if (!is_number || !(number >= bounds.lowest && number <= bounds.highest) ||
      (std::is_integral_v<Value> && number != std::floor(number)))
    throw UsageError(option, text, remedy(bounds));
  return static_cast<Value>(number);
}

template <typename Value>
Value
valueOf(const setting::Number<Value>& row,
        const std::string& option,
        const std::string& text)
{
  return valueOf(row.typed, option, text);
}

template <typename Value, int size>
Value
valueOf(const setting::Choice<Value, size>& row,
        const std::string& option,
        const std::string& text)
{
  for (const setting::Word<Value>& word : row.words)
    if (word.word == text)
      return word.value;
  throw UsageError(option, text, remedy(row));
}

inline std::string
valueOf(const setting::Text& row, const std::string& option, const std::string& text)
{
  if (text.empty())
    throw UsageError(option, text, remedy(row));
  return text;
}
/** \} */

} // namespace tool
