/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "options.h"
#include "plan.h"
#include "resampling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

using namespace evaluation;

namespace {

struct Parsed {
  bool something_to_do = false;
  int exit_code = -1;
  Options options;
  std::string output, errors;
};

Parsed
parsed(std::vector<std::string> arguments)
{
  arguments.insert(arguments.begin(), "pcl_kss_icp_evaluate");
  std::vector<char*> pointers;
  for (auto& argument : arguments)
    pointers.push_back(argument.data());
  Parsed result;
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  result.something_to_do = parse(static_cast<int>(pointers.size()), pointers.data(),
                                 result.options, result.exit_code);
  result.output = ::testing::internal::GetCapturedStdout();
  result.errors = ::testing::internal::GetCapturedStderr();
  return result;
}

/** Beside the folders, which are given. */
Parsed
parsedAlso(std::vector<std::string> arguments)
{
  arguments.insert(arguments.begin(), {"models", "--out", "results"});
  return parsed(arguments);
}

std::vector<std::string>
namesOf(const Plan& plan)
{
  std::vector<std::string> names;
  for (const auto& planned : plan.methods)
    names.push_back(planned.method.name);
  return names;
}

ModelFolder
threeModels()
{
  ModelFolder folder;
  folder.models = {{"a", "a.off", true}, {"b", "b.pcd", false}, {"c", "c.off", true}};
  return folder;
}

} // namespace

TEST(EvaluationOptions, AreAsTheHelpSaysByDefault)
{
  const Parsed result = parsedAlso({});
  ASSERT_TRUE(result.something_to_do) << result.errors;
  EXPECT_EQ("", result.output + result.errors);
  const Options& options = result.options;
  EXPECT_EQ("models", options.models);
  EXPECT_EQ("results", options.out);
  EXPECT_EQ(4u, options.number_of_models);
  EXPECT_EQ(1u, options.size_models);
  EXPECT_EQ(20.0, options.time_limit);
  EXPECT_EQ(tableNames(), options.tables);
  EXPECT_TRUE(options.methods.empty());
  EXPECT_TRUE(options.ablate.empty());
  EXPECT_EQ(0u, options.protocol.seed);
  EXPECT_EQ(1u, options.protocol.repetitions);
  EXPECT_EQ(10000u, options.protocol.points);
  EXPECT_EQ(Rotations::AXES, options.protocol.rotations);
  EXPECT_EQ(0.8, options.protocol.smallest_scale);
  EXPECT_EQ(1.2, options.protocol.largest_scale);
  EXPECT_EQ(0.3, options.protocol.deleted);
  EXPECT_EQ(Resampling::GRADIENT, options.protocol.resampling);
}

TEST(EvaluationOptions, AreTaken)
{
  const Parsed result = parsedAlso(
      {"--models",      "2",           "--size-models", "0",
       "--time-limit",  "7.5",         "--jobs",        "3",
       "--tables",      "gauss, size", "--methods",     "KSS-ICP (paper, host),ICP",
       "--seed",        "9",           "--repetitions", "4",
       "--points",      "2000",        "--rotation",    "so3",
       "--scale-range", "0.5,2",       "--deleted",     "0.4"});
  ASSERT_TRUE(result.something_to_do) << result.errors;
  const Options& options = result.options;
  EXPECT_EQ(2u, options.number_of_models);
  EXPECT_EQ(0u, options.size_models);
  EXPECT_EQ(7.5, options.time_limit);
  EXPECT_EQ(3u, options.jobs);
  EXPECT_EQ((std::vector<std::string>{"gauss", "size"}), options.tables);
  EXPECT_EQ((std::vector<std::string>{"KSS-ICP (paper, host)", "ICP"}),
            options.methods);
  EXPECT_EQ(9u, options.protocol.seed);
  EXPECT_EQ(4u, options.protocol.repetitions);
  EXPECT_EQ(2000u, options.protocol.points);
  EXPECT_EQ(Rotations::SO3, options.protocol.rotations);
  EXPECT_EQ(0.5, options.protocol.smallest_scale);
  EXPECT_EQ(2.0, options.protocol.largest_scale);
  EXPECT_EQ(0.4, options.protocol.deleted);
}

TEST(EvaluationOptions, FullIsMoreUnlessSaidOtherwise)
{
  const Options full = parsedAlso({"--full"}).options;
  EXPECT_EQ(0u, full.number_of_models);
  EXPECT_EQ(3u, full.size_models);
  EXPECT_EQ(300.0, full.time_limit);
  const Options but =
      parsedAlso({"--full", "--models", "5", "--size-models", "2", "--time-limit", "9"})
          .options;
  EXPECT_EQ(5u, but.number_of_models);
  EXPECT_EQ(2u, but.size_models);
  EXPECT_EQ(9.0, but.time_limit);
}

TEST(EvaluationOptions, SayWhatIsWrongAndWhatToDo)
{
  struct Wrong {
    std::vector<std::string> arguments;
    std::string option, remedy;
  };
  const std::string scales = "two positive numbers, the smaller one first: 0.8,1.2",
                    share = "a share above 0 and up to 0.9";
  std::vector<Wrong> wrong = {
      {{"--scale-range", "1.2,0.8"}, "--scale-range", scales},
      {{"--scale-range", "1.2"}, "--scale-range", scales},
      {{"--scale-range", "0,1"}, "--scale-range", scales},
      {{"--scale-range", "-2,-1"}, "--scale-range", scales},
      {{"--scale-range", "1,2,3"}, "--scale-range", scales},
      {{"--scale-range", "a,b"}, "--scale-range", scales},
      {{"--scale-range", "nan,nan"}, "--scale-range", scales},
      {{"--scale-range", "0.8x,1.2"}, "--scale-range", scales},
      {{"--scale-range", "1,inf"}, "--scale-range", scales},
      {{"--points=-5"}, "--points", "a whole number from 0"},
      {{"--repetitions=-1"}, "--repetitions", "a whole number from 0"},
      {{"--jobs=-1"}, "--jobs", "a whole number from 0"},
      {{"--seed=5000000000"}, "--seed", "a whole number from 0"},
      {{"--deleted", "0.95"}, "--deleted", share},
      {{"--deleted", "0"}, "--deleted", share},
      {{"--deleted", "1"}, "--deleted", share},
      {{"--deleted", "-0.3"}, "--deleted", share},
      {{"--deleted", "30"}, "--deleted", share},
      {{"--deleted", "nan"}, "--deleted", share},
      {{"--deleted", "much"}, "--deleted", "much"},
      {{"--tables", "similarity,noise"}, "no table noise", "use similarity, density"},
      {{"--tables", ""}, "no table", "use similarity, density"},
      {{"--rotation", "euler"}, "--rotation", "axes or so3"},
      {{"--resampling", "random"}, "--resampling", "gradient or wlop"},
      {{"--repetitions", "0"}, "--repetitions", "at least 1"},
      {{"--points", "199"}, "--points", "at least 200"},
      {{"--points", "many"}, "--points", "many"},
      {{"--time-limit", "0"}, "--time-limit", "positive number of seconds"},
      {{"--time-limit", "-3"}, "--time-limit", "positive number of seconds"},
      {{"--jobs", "some"}, "--jobs", "some"},
      {{"--seed"}, "--seed", "missing"},
      {{"--colour"}, "--colour", "unrecognised"}};
  if (!hasWLOP())
    wrong.push_back(
        {{"--resampling", "wlop"}, "--resampling", "_WITH_CGAL=ON; use gradient"});
  for (const auto& [arguments, option, remedy] : wrong) {
    const Parsed result = parsedAlso(arguments);
    EXPECT_FALSE(result.something_to_do) << option;
    EXPECT_EQ(2, result.exit_code) << option;
    EXPECT_EQ(0u, result.errors.find("pcl_kss_icp_evaluate: ")) << result.errors;
    EXPECT_EQ(1, std::count(result.errors.begin(), result.errors.end(), '\n'))
        << result.errors;
    for (const auto& text : {option, remedy})
      EXPECT_NE(std::string::npos, result.errors.find(text))
          << text << " in " << result.errors;
  }
}

TEST(EvaluationOptions, NeedBothFolders)
{
  for (const auto& arguments :
       {std::vector<std::string>{}, {"models"}, {"--out", "o"}}) {
    const Parsed result = parsed(arguments);
    EXPECT_FALSE(result.something_to_do);
    EXPECT_EQ(2, result.exit_code);
    EXPECT_NE(std::string::npos, result.errors.find("MODELS_DIR --out DIR"))
        << result.errors;
  }
}

TEST(EvaluationOptions, AreAllInTheHelp)
{
  const Parsed help = parsed({"--help"});
  EXPECT_FALSE(help.something_to_do);
  EXPECT_EQ(0, help.exit_code);
  EXPECT_EQ("", help.errors);
  for (const std::string option :
       {"--out", "--full", "--models", "--size-models", "--methods", "--list-methods",
        "--time-limit", "--jobs", "--version", "--help", "--tables", "--seed",
        "--repetitions", "--points", "--rotation", "--scale-range", "--deleted",
        "--resampling", "--ablate-all"})
    EXPECT_NE(std::string::npos, help.output.find(option)) << option;
  for (const auto& table : tableNames())
    EXPECT_NE(std::string::npos, help.output.find(table)) << table;
  for (const auto& ablation : ablations())
    EXPECT_NE(std::string::npos, help.output.find("--ablate-" + ablation.flag));
}

TEST(EvaluationOptions, ListTheMethods)
{
  const Parsed list = parsed({"--list-methods"});
  EXPECT_FALSE(list.something_to_do);
  EXPECT_EQ(0, list.exit_code);
  EXPECT_EQ(0u, list.output.find("KSS-ICP\n"));
  for (const char* method : {"\nKSS-ICP (paper, host)\n", "\nICP\n"})
    EXPECT_NE(std::string::npos, list.output.find(method)) << method;
}

TEST(EvaluationPlan, TakesTheMethodsThatAreNamed)
{
  Options options = parsedAlso({"--methods", "ICP,KSS-ICP"}).options;
  EXPECT_EQ((std::vector<std::string>{"KSS-ICP", "ICP"}),
            namesOf(planFor(options, threeModels())));
  options.methods.clear();
  const auto all = namesOf(planFor(options, threeModels()));
  EXPECT_LT(5u, all.size());
  for (const auto& name : all)
    EXPECT_EQ(1, std::count(all.begin(), all.end(), name)) << name;
}

TEST(EvaluationPlan, RefusesUnknownMethods)
{
  try {
    planFor(parsedAlso({"--methods", "KSS-ICP,Magic"}).options, threeModels());
    FAIL();
  }
  catch (const std::runtime_error& problem) {
    EXPECT_STREQ("there is no method Magic; --list-methods shows all", problem.what());
  }
}

TEST(EvaluationPlan, RunsEveryMethodOnEveryCase)
{
  const Options options = parsedAlso({"--methods", "KSS-ICP,ICP", "--tables",
                                      "similarity,uniform,size", "--repetitions", "4"})
                              .options;
  const Plan plan = planFor(options, threeModels());
  const auto runs = runsOfTables(plan, options.protocol);
  // models, conditions, repetitions, methods, with and without the true scale
  EXPECT_EQ(3u * 3u * 4u * 2u * 2u, runs.size());
  for (const auto& run : runs)
    EXPECT_NE("size", run.condition.table);

  const auto sizes = runsOfSizes(plan);
  EXPECT_EQ(6u * 2u, sizes.size()); // of one mesh
  for (const auto& run : sizes) {
    EXPECT_NE("b", run.model);
    EXPECT_EQ("size", run.condition.table);
    EXPECT_EQ(run.method.name == "ICP", run.scale_given);
  }
}

TEST(EvaluationPlan, AblationsReplaceTheMethods)
{
  const Options options = parsedAlso({"--ablate-energy"}).options;
  EXPECT_EQ(0, std::count(options.tables.begin(), options.tables.end(), "size"));
  const Plan plan = planFor(options, threeModels());
  EXPECT_EQ((std::vector<std::string>{"KSS-ICP", "Hausdorff"}), namesOf(plan));
  EXPECT_EQ("ablation", plan.methods[1].group);
  EXPECT_EQ("energy", plan.methods[1].ablates);
  for (const auto& run : runsOfTables(plan, options.protocol))
    EXPECT_FALSE(run.scale_given && run.method.name == "Hausdorff");
}
