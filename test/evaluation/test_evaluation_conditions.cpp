/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "evaluation_cases.h"

#include <gtest/gtest.h>

#include <set>

using namespace evaluation;

TEST(EvaluationConditions, AreThoseOfTheTables)
{
  Protocol protocol;
  protocol.points = 3000;
  protocol.deleted = 0.25;
  std::set<std::string> names, tables;
  for (const auto& condition : conditionsOf(tableNames(), protocol)) {
    names.insert(condition.name);
    tables.insert(condition.table);
    if (condition.table == "size") {
      EXPECT_EQ("size-" + std::to_string(condition.points), condition.name);
      EXPECT_EQ(condition.parameter, static_cast<double>(condition.points));
    }
    else {
      EXPECT_EQ(3000u, condition.points) << condition.name;
    }
    EXPECT_EQ(condition.table == "gauss" ? condition.parameter : 0.0,
              condition.gaussian);
    EXPECT_EQ(condition.table == "uniform" ? condition.parameter : 0.0,
              condition.uniform);
    EXPECT_EQ(condition.table == "deleted" ? 0.25 : 0.0, condition.deleted);
    EXPECT_EQ(condition.table == "density", condition.resampled);
  }
  EXPECT_EQ(conditionsOf(tableNames(), protocol).size(), names.size());
  EXPECT_EQ(tableNames().size(), tables.size());
  for (const char* name : {"similarity", "density", "gauss-0.33", "gauss-0.66",
                           "uniform-0.5", "uniform-1", "deleted-0.25", "size-1000000"})
    EXPECT_EQ(1u, names.count(name)) << name;
}

TEST(EvaluationConditions, KeepThePapersOrder)
{
  const auto conditions = conditionsOf({"deleted", "similarity"}, Protocol());
  ASSERT_EQ(2u, conditions.size());
  EXPECT_EQ("similarity", conditions[0].name);
  EXPECT_EQ("deleted-0.3", conditions[1].name);
}

TEST(EvaluationConditions, RefuseUnknownTables)
{
  try {
    conditionsOf({"similarity", "noise"}, Protocol());
    FAIL();
  }
  catch (const std::runtime_error& problem) {
    const std::string message = problem.what();
    EXPECT_NE(std::string::npos, message.find("no table noise")) << message;
    for (const auto& name : tableNames())
      EXPECT_NE(std::string::npos, message.find(name)) << message;
  }
}
