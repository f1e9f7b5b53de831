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

/** \brief Who is told: somebody who writes a program, or a command line. */
enum class For { PROGRAM, COMMAND_LINE };

template <typename Value>
const Unit&
unitOf(const Number<Value>& row, For whom)
{
  return whom == For::PROGRAM ? row.unit : row.typed;
}

inline std::string
numberText(double number)
{
  std::ostringstream text;
  text.precision(7);
  text << number;
  return text.str();
}

/** \brief The value of a setting. */
template <typename Value>
std::string
valueText(const Number<Value>& row, Value value, For whom)
{
  return numberText(value / unitOf(row, whom).size);
}

/** \copydoc valueText */
template <typename Value, int size>
std::string
valueText(const Choice<Value, size>& row, Value value, For)
{
  for (const Word<Value>& word : row.words)
    if (word.value == value)
      return word.word;
  return "internal";
}

/** \copydoc valueText */
inline std::string
valueText(const Flag&, bool value, For)
{
  return value ? "true" : "false";
}

/** \copydoc valueText */
inline std::string
valueText(const Text&, const std::string& value, For)
{
  return value.empty() ? "''" : value;
}

/** \brief The bounds of a number with its unit: "20 to 1000000 points". */
template <typename Value>
std::string
rangeText(const Number<Value>& row, For whom)
{
  const bool is_bounded =
      row.highest < (std::is_integral_v<Value> ? unbounded : infinity);
  const std::string lowest = valueText(row, row.lowest, whom);
  const std::string range = is_bounded
                                ? lowest + " to " + valueText(row, row.highest, whom)
                                : "at least " + lowest;
  const std::string unit = unitOf(row, whom).name;
  return unit.empty() ? range : range + ' ' + unit;
}

/** \brief Others have no bounds. */
template <typename Value>
std::string
rangeText(const Row<Value>&, For)
{
  return "";
}

/** \brief What to do about a value that is wrong. */
template <typename Value>
std::string
remedy(const Number<Value>& row, For whom)
{
  return std::string("use a ") + (std::is_integral_v<Value> ? "whole " : "") +
         "number, " + rangeText(row, whom);
}

/** \copydoc remedy */
template <typename Value, int size>
std::string
remedy(const Choice<Value, size>& row, For)
{
  std::string text = "use ";
  for (int i = 0; i < size; ++i)
    text += std::string(i == 0 ? "" : i + 1 < size ? ", " : " or ") + row.words[i].word;
  return text;
}

/** \copydoc remedy */
inline std::string
remedy(const Flag&, For)
{
  return "use true or false";
}

/** \copydoc remedy */
inline std::string
remedy(const Text&, For)
{
  return "use a word that is not empty";
}

/** \brief One sentence on what a setting is. */
template <typename Value>
std::string
meaningText(const Row<Value>& row)
{
  return row.meaning;
}

/** \copydoc meaningText */
template <typename Value, int size>
std::string
meaningText(const Choice<Value, size>& row)
{
  std::string text = row.meaning;
  for (int i = 0; i < size; ++i)
    text += std::string(i == 0 ? ": " : "; ") + row.words[i].word + ", " +
            row.words[i].meaning;
  return text;
}

/** \brief Whether a setting may have a value. */
template <typename Value>
bool
isRight(const Number<Value>& row, Value value)
{
  return value >= row.lowest && value <= row.highest; // which NaN is not
}

/** \copydoc isRight */
inline bool
isRight(const Text&, const std::string& value)
{
  return !value.empty();
}

/** \copydoc isRight */
template <typename Value>
bool
isRight(const Row<Value>&, Value)
{
  return true;
}

/** \brief The word for a value of an enumeration. */
template <typename Value>
std::string
wordOf(Value value)
{
  std::string word;
  forEach([&](const auto& row) {
    if constexpr (std::is_same_v<Value, typename std::decay_t<decltype(row)>::Value>)
      word = valueText(row, value, For::PROGRAM);
  });
  return word;
}

} // namespace setting
} // namespace kss
} // namespace pcl
