/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "protocol.h"

#include <boost/algorithm/string/join.hpp>

#include <algorithm>
#include <sstream>
#include <stdexcept>

namespace evaluation {
namespace {

Condition
condition(const std::string& table, const Protocol& protocol)
{
  Condition result;
  result.name = result.table = table;
  result.points = protocol.points;
  return result;
}

Condition
condition(const std::string& table, double parameter, const Protocol& protocol)
{
  Condition result = condition(table, protocol);
  std::ostringstream name;
  name << table << '-' << parameter;
  result.name = name.str();
  result.parameter = parameter;
  return result;
}

void
addTable(const std::string& table,
         const Protocol& protocol,
         std::vector<Condition>& conditions)
{
  if (table == "similarity") {
    conditions.push_back(condition(table, protocol));
  }
  else if (table == "density") {
    conditions.push_back(condition(table, protocol));
    conditions.back().resampled = true;
  }
  else if (table == "gauss") {
    for (const double range : {0.33, 0.66, 2.0, 4.0}) { // 2 and 4 go beyond the paper
      conditions.push_back(condition(table, range, protocol));
      conditions.back().gaussian = range;
    }
  }
  else if (table == "uniform") {
    for (const double range : {0.5, 1.0}) {
      conditions.push_back(condition(table, range, protocol));
      conditions.back().uniform = range;
    }
  }
  else if (table == "deleted") {
    conditions.push_back(condition(table, protocol.deleted, protocol));
    conditions.back().deleted = protocol.deleted;
  }
  else if (table == "size") {
    for (const int points : {5000, 10000, 50000, 100000, 500000, 1000000}) {
      conditions.push_back(condition(table, protocol));
      conditions.back().name += '-' + std::to_string(points);
      conditions.back().parameter = points;
      conditions.back().points = static_cast<std::size_t>(points);
    }
  }
}

} // namespace

const std::vector<std::string>&
tableNames()
{
  static const std::vector<std::string> names = {"similarity", "density", "gauss",
                                                 "uniform",    "deleted", "size"};
  return names;
}

std::vector<Condition>
conditionsOf(const std::vector<std::string>& tables, const Protocol& protocol)
{
  const auto& names = tableNames();
  for (const auto& table : tables)
    if (std::find(names.begin(), names.end(), table) == names.end())
      throw std::runtime_error("there is no table " + table + "; use " +
                               boost::algorithm::join(names, ", "));
  std::vector<Condition> conditions;
  for (const auto& name : names)
    if (std::find(tables.begin(), tables.end(), name) != tables.end())
      addTable(name, protocol, conditions);
  return conditions;
}

} // namespace evaluation
