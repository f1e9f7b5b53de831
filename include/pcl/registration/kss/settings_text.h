/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/settings_table.h>

#include <sstream>
#include <string>
#include <type_traits>

namespace pcl {
namespace kss {
namespace setting {

/** \brief Who is told: those who write a program, or a command line. */
enum class For { PROGRAM, COMMAND_LINE };

/** \brief The bounds and the unit that they are told. */
template <typename Value>
const Bounds<Value>&
boundsOf(const Number<Value>& row, For whom)
{
  return whom == For::PROGRAM ? row.bounds : row.typed;
}

/** \brief A number with as many digits as people type. */
inline std::string
numberText(double number)
{
  std::ostringstream text;
  text.precision(7);
  text << number;
  return text.str();
}

/** \name The value of a setting in words. */
/** \{ */
template <typename Value>
std::string
valueText(const Number<Value>& row, Value value, For whom)
{
  return numberText(value / boundsOf(row, whom).unit.size);
}

template <typename Value, int size>
std::string
valueText(const Choice<Value, size>& row, Value value, For)
{
  for (const Word<Value>& word : row.words)
    if (word.value == value)
      return word.word;
  return "internal";
}

inline std::string
valueText(const Flag&, bool value, For)
{
  return value ? "true" : "false";
}

inline std::string
valueText(const Text&, const std::string& value, For)
{
  return value.empty() ? "''" : value;
}
/** \} */

/** \brief Bounds with their unit: "20 to 1000000 points". */
template <typename Value>
std::string
rangeText(const Bounds<Value>& bounds)
{
  const bool are_two =
      bounds.highest < (std::is_integral_v<Value> ? unbounded : infinity);
  const std::string lowest = numberText(bounds.lowest / bounds.unit.size);
  const std::string range =
      are_two ? lowest + " to " + numberText(bounds.highest / bounds.unit.size)
              : "at least " + lowest;
  return *bounds.unit.name ? range + ' ' + bounds.unit.name : range;
}

/** \name What to use instead of a value that is wrong. */
/** \{ */
template <typename Value>
std::string
remedy(const Bounds<Value>& bounds)
{
  return std::string("use a ") + (std::is_integral_v<Value> ? "whole " : "") +
         "number, " + rangeText(bounds);
}

template <typename Value, int size>
std::string
remedy(const Choice<Value, size>& row)
{
  std::string text = "use ";
  for (int i = 0; i < size; ++i)
    text += std::string(i == 0 ? "" : i + 1 < size ? ", " : " or ") + row.words[i].word;
  return text;
}

inline std::string
remedy(const Text& row)
{
  return std::string("use ") + row.kinds;
}
/** \} */

/** \name What a setting is, and each word for its value, between \a quotes. */
/** \{ */
template <typename Value>
std::string
meaningText(const Row<Value>& row, const std::string& = "")
{
  return row.meaning;
}

template <typename Value, int size>
std::string
meaningText(const Choice<Value, size>& row, const std::string& quotes = "")
{
  std::string text = row.meaning;
  for (int i = 0; i < size; ++i)
    text += (i == 0 ? ": " : ", ") + quotes + row.words[i].word + quotes + " (" +
            row.words[i].meaning + ')';
  return text;
}
/** \} */

} // namespace setting
} // namespace kss
} // namespace pcl
