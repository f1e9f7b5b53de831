/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/settings.h>

#include <limits>
#include <tuple>

namespace pcl {
namespace kss {

/** \brief The table of settings: what setters, setSettings(), the options of the command
 * line tool and README.md know of them. Their defaults are those of struct Settings.
 */
namespace setting {

/** \brief What a setting governs. */
enum class Part {
  ALIGNMENT, ///< kss::Alignment: with another value it keeps nothing (sameWork())
  REST       ///< the final ICP, the judgement and the time
};

/** \brief How a setting is named on the command line. */
struct Option {
  const char* name;  ///< without dashes
  const char* value; ///< what stands for its value
};

/** \brief What is said of any setting. */
template <typename ValueT>
struct Row {
  using Value = ValueT;

  Value Settings::*member;
  const char* name;   ///< of the member
  const char* setter; ///< of KSSICP; empty: setSettings() alone
  Option option;
  Part part;
  const char* meaning;
};

/** \brief A unit, and how many of those of Settings one of them is. */
struct Unit {
  const char* name;
  double size = 1.0;
};

/** \brief A number within bounds. */
template <typename Value>
struct Number : Row<Value> {
  Value lowest, highest;
  Unit unit = {""};
  Unit typed = unit; ///< on the command line
};

/** \brief A value with its word. */
template <typename Value>
struct Word {
  const char* word;
  Value value;
  const char* meaning;
};

/** \brief One of so many values. Others are not refused: what only tests and ablations
 * use has no word. */
template <typename Value, int size>
struct Choice : Row<Value> {
  Word<Value> words[size];
};

/** \brief A switch, which is on; the option switches it off. */
struct Flag : Row<bool> {
  const char* off; ///< what it means that it is off
};

/** \brief Words that are not empty. */
struct Text : Row<std::string> {};

constexpr double degree = 0.017453292519943295; // pi / 180
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr unsigned int unbounded = std::numeric_limits<unsigned int>::max();

/** \brief The settings, in the order in which people are told of them. */
inline constexpr auto table = std::make_tuple(
    Choice<Mode, 4>{
        {&Settings::mode, "mode", "setMode", {"mode", "WORD"}, Part::ALIGNMENT,
         "what the clouds show"},
        {{"auto", Mode::AUTOMATIC, "whatever fits best of the others"},
         {"global", Mode::GLOBAL_GLOBAL, "both show all of the object"},
         {"partial", Mode::PARTIAL_GLOBAL, "one, either, is a part of the other"},
         {"overlap", Mode::PARTIAL_PARTIAL, "both lack parts"}}},
    Flag{{&Settings::estimate_scale, "estimate_scale", "setScaleEstimation",
          {"rigid", ""}, Part::ALIGNMENT,
          "whether the scale of the transformation is estimated"},
         "the clouds have the same scale, or that of the guess"},
    Number<double>{{&Settings::smallest_scale, "smallest_scale", "setScaleRange",
                    {"scale-range", "A B"}, Part::ALIGNMENT,
                    "smallest scale of the transformation where it is estimated"},
                   0.0, infinity},
    Number<double>{{&Settings::largest_scale, "largest_scale", "setScaleRange",
                    {"scale-range", "A B"}, Part::ALIGNMENT,
                    "largest scale of the transformation where it is estimated"},
                   0.0, infinity},
    Flag{{&Settings::clean, "clean", "", {"no-cleaning", ""}, Part::ALIGNMENT,
          "whether stray points are left out and heavy noise is averaged in the search"},
         "keep stray points and noise in the search"},
    Number<unsigned int>{{&Settings::sample_points, "sample_points", "",
                          {"points", "K"}, Part::ALIGNMENT,
                          "points that both clouds are simplified to; fewer for clouds "
                          "too small to be evened out"},
                         20, 1000000, {"points"}},
    Choice<Density, 2>{
        {&Settings::density, "density", "", {"density", "WORD"}, Part::ALIGNMENT,
         "how these points are spread"},
        {{"uniform", Density::UNIFORM, "by area"},
         {"paper", Density::PAPER, "as the cloud's own points, (e5)"}}},
    Choice<RotationSet, 2>{
        {&Settings::rotation_set, "rotation_set", "", {"rotations", "WORD"},
         Part::ALIGNMENT, "which rotations are tried"},
        {{"even", RotationSet::EVEN, "evenly spread ones"},
         {"euler", RotationSet::EULER, "a grid of angles, (e10)"}}},
    Number<unsigned int>{{&Settings::even_rotations, "even_rotations", "",
                          {"rotations", "even:N"}, Part::ALIGNMENT,
                          "number of evenly spread rotations"},
                         1, 100000, {"rotations"}},
    Number<double>{{&Settings::angle_step, "angle_step", "", {"angle-step", "DEG"},
                    Part::ALIGNMENT,
                    "step of the grid of angles, rounded so that steps fill the circle; "
                    "small ones cost: the number of rotations grows with its cube"},
                   3 * degree, 180 * degree, {"radians"}, {"degrees", degree}},
    Choice<CenterSet, 2>{
        {&Settings::center_set, "center_set", "", {"centers", "WORD"}, Part::ALIGNMENT,
         "which centres are tried where a cloud may be incomplete"},
        {{"spread", CenterSet::SPREAD, "a box as far as the object reaches"},
         {"paper", CenterSet::PAPER, "5 x 5 x 5 about the incomplete cloud's, (e123)"}}},
    Choice<Energy, 2>{
        {&Settings::energy, "energy", "", {"energy", "WORD"}, Part::ALIGNMENT,
         "what makes a candidate good"},
        {{"mean", Energy::TRUNCATED_MEAN,
          "a small mean of the distances, none counted beyond a limit"},
         {"hausdorff", Energy::HAUSDORFF, "a small largest distance, (e9), (e122)"}}},
    Choice<Search, 2>{
        {&Settings::search, "search", "", {"search", "WORD"}, Part::ALIGNMENT,
         "how the best candidates are found"},
        {{"screened", Search::SCREENED,
          "few points tell which deserve a closer look; for the mean and spread centres, "
          "else as exact"},
         {"exact", Search::EXACT, "the minima that all pairs of points give"}}},
    Number<unsigned int>{{&Settings::search_points, "search_points", "",
                          {"search-points", "N"}, Part::ALIGNMENT,
                          "points of each simplified cloud that screen candidates"},
                         1, 128, {"points"}},
    Number<unsigned int>{{&Settings::local_minimum_kernel, "local_minimum_kernel", "",
                          {"kernel", "N"}, Part::ALIGNMENT,
                          "edge of the kernel of rotations in which a local minimum is "
                          "the smallest; of the even set a ball as wide, of the grid of "
                          "angles the next odd number"},
                         3, unbounded, {"steps"}},
    Number<double>{{&Settings::additional_process_threshold,
                    "additional_process_threshold", "",
                    {"additional-process", "ENERGY"}, Part::ALIGNMENT,
                    "energy above which more minima than the lowest are refined, Q_the "
                    "of (e12); 0: always"},
                   0.0, infinity, {"root mean square radii of the target"}},
    Number<unsigned int>{{&Settings::icp_points, "icp_points", "setNumberOfICPPoints",
                          {"icp-points", "N"}, Part::REST,
                          "points of the source in the final ICP, on the whole target; "
                          "0: all"},
                         0, unbounded, {"points"}},
    Number<double>{{&Settings::minimum_confidence, "minimum_confidence",
                    "setMinimumConfidence", {"confidence", "C"}, Part::REST,
                    "confidence from which on the clouds count as registered"},
                   0.0, 1.0},
    Number<double>{{&Settings::time_limit, "time_limit", "setTimeLimit",
                    {"time-limit", "SECONDS"}, Part::REST,
                    "time after which the best pose so far has to do; 0: none"},
                   0.0, 1e9, {"seconds"}},
    Text{{&Settings::device, "device", "setDevice", {"device", "NAME"}, Part::ALIGNMENT,
          "where the search runs: auto, on the first OpenCL device, GPUs first, else on "
          "the host; host; part of a platform's name, on all its devices; or part of a "
          "device's name"}},
    Number<unsigned int>{{&Settings::threads, "threads", "setNumberOfThreads",
                          {"threads", "N"}, Part::ALIGNMENT,
                          "threads on the host and on an OpenCL CPU device; 0: as many "
                          "as there are cores"},
                         0, 1024, {"threads"}});

/** \brief Call a function with each row. */
template <typename Function>
void
forEach(Function&& function)
{
  std::apply([&](const auto&... rows) { (function(rows), ...); }, table);
}

} // namespace setting
} // namespace kss
} // namespace pcl
