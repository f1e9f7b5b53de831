/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/settings.h>

#include <cstddef>
#include <limits>
#include <string>
#include <tuple>
#include <type_traits>

namespace pcl {
namespace kss {

/** \brief The table of settings: what setters, setSettings(), the options of the
 * command line tool and docs/settings.md know of them. Their defaults are those of
 * struct Settings.
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

/** \brief What a number may be. */
template <typename Value>
struct Bounds {
  Value lowest, highest;
  Unit unit = {""};

  constexpr bool
  hold(Value value) const
  {
    return value >= lowest && value <= highest; // which NaN is not
  }
};

/** \brief A number. On a command line, where what is typed wrong is likelier than what
 * is out of the ordinary, its bounds may be narrower, and its unit another.
 */
template <typename Value>
struct Number : Row<Value> {
  Bounds<Value> bounds;
  Bounds<Value> typed = bounds;
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

/** \brief Any words. */
struct Text : Row<std::string> {
  const char* kinds; ///< what they may be
};

constexpr double degree = 0.017453292519943295; // pi / 180
constexpr double infinity = std::numeric_limits<double>::infinity();
/** Beyond, single precision has no digits left. */
constexpr Bounds<double> metres_in_micrometres{1e-6, 1e6};
constexpr unsigned int unbounded = std::numeric_limits<unsigned int>::max();

// a row is to read as a row
// clang-format off

/** \brief The settings, in the order in which people are told of them. */
inline constexpr auto table = std::make_tuple(
    Choice<Mode, 5>{
        {&Settings::mode, "mode", "setMode", {"mode", "WORD"}, Part::ALIGNMENT,
         "what the clouds show"},
        {{"auto", Mode::AUTOMATIC, "what fits best of the others"},
         {"global", Mode::GLOBAL_GLOBAL, "both show all of the object"},
         {"partial", Mode::PARTIAL_GLOBAL, "one is a part of the other"},
         {"overlap", Mode::PARTIAL_PARTIAL, "both lack parts"},
         {"scene", Mode::IN_SCENE, "one is an object in the other, a scene"}}},
    Flag{
        {&Settings::estimate_scale, "estimate_scale", "setScaleEstimation",
         {"rigid", ""}, Part::ALIGNMENT,
         "whether the scale of the transformation is estimated; else it is that of the "
         "guess, or 1"},
        "the clouds have the same scale"},
    Number<double>{
        {&Settings::smallest_scale, "smallest_scale", "setScaleRange",
         {"scale-range", "A B"}, Part::ALIGNMENT,
         "smallest scale of the transformation where it is estimated"},
        {0.0, infinity},
        metres_in_micrometres},
    Number<double>{
        {&Settings::largest_scale, "largest_scale", "setScaleRange",
         {"scale-range", "A B"}, Part::ALIGNMENT,
         "largest scale of the transformation where it is estimated"},
        {0.0, infinity},
        metres_in_micrometres},
    Choice<RotationAxis, 4>{
        {&Settings::rotation_axis, "rotation_axis", "setRotationAxis",
         {"upright", "AXIS"}, Part::ALIGNMENT,
         "axis of both clouds that the rotation is about"},
        {{"any", RotationAxis::ANY, "the clouds may be tilted"},
         {"x", RotationAxis::X, "they are upright along x"},
         {"y", RotationAxis::Y, "along y"},
         {"z", RotationAxis::Z, "along z, as levelled scans are"}}},
    Flag{
        {&Settings::clean, "clean", "", {"no-cleaning", ""}, Part::ALIGNMENT,
         "whether stray points are left out and heavy noise is averaged in the search"},
        "keep stray points and noise in the search"},
    Number<unsigned int>{
        {&Settings::sample_points, "sample_points", "", {"points", "K"},
         Part::ALIGNMENT,
         "points that both clouds are simplified to; fewer for clouds too small to be "
         "evened out"},
        {20, unbounded, {"points"}},
        {20, 1000000, {"points"}}},
    Choice<Density, 2>{
        {&Settings::density, "density", "", {"density", "WORD"}, Part::ALIGNMENT,
         "how these points are spread"},
        {{"uniform", Density::UNIFORM, "by area"},
         {"paper", Density::PAPER, "as the cloud's own points, (e5)"}}},
    Choice<RotationSet, 2>{
        {&Settings::rotation_set, "rotation_set", "", {"rotations", "SET"},
         Part::ALIGNMENT, "which rotations are tried"},
        {{"even", RotationSet::EVEN, "evenly spread ones"},
         {"euler", RotationSet::EULER, "a grid of angles, (e10)"}}},
    Number<unsigned int>{
        {&Settings::even_rotations, "even_rotations", "", {"rotations", "even:N"},
         Part::ALIGNMENT, "number of evenly spread rotations"},
        {1, 100000, {"rotations"}}},
    Number<double>{
        {&Settings::angle_step, "angle_step", "", {"angle-step", "DEG"},
         Part::ALIGNMENT,
         "step of the grid of angles, rounded so that steps fill the circle; small "
         "ones cost: (360 degrees / step) cubed rotations"},
        {0.05, 180 * degree, {"radians"}},
        {3 * degree, 180 * degree, {"degrees", degree}}},
    Choice<CenterSet, 2>{
        {&Settings::center_set, "center_set", "", {"centers", "WORD"}, Part::ALIGNMENT,
         "which centres are tried where a cloud may be incomplete"},
        {{"spread", CenterSet::SPREAD, "a box as far as the object reaches"},
         {"paper", CenterSet::PAPER, "5 x 5 x 5 in the incomplete cloud, (e123)"}}},
    Choice<Energy, 2>{
        {&Settings::energy, "energy", "", {"energy", "WORD"}, Part::ALIGNMENT,
         "what is small where a candidate is good"},
        {{"mean", Energy::TRUNCATED_MEAN,
          "the mean of the distances, none counted beyond a limit"},
         {"hausdorff", Energy::HAUSDORFF, "the largest distance, (e9) and (e122)"}}},
    Choice<Search, 2>{
        {&Settings::search, "search", "", {"search", "WORD"}, Part::ALIGNMENT,
         "how the best candidates are found"},
        {{"screened", Search::SCREENED,
          "few points tell which deserve a closer look; with energy mean and centres "
          "spread alone, else as exact"},
         {"exact", Search::EXACT, "all minima that all pairs of points give"}}},
    Number<unsigned int>{
        {&Settings::search_points, "search_points", "", {"search-points", "N"},
         Part::ALIGNMENT, "points of each simplified cloud that screen candidates"},
        {1, 128, {"points"}}},
    Number<unsigned int>{
        {&Settings::local_minimum_kernel, "local_minimum_kernel", "", {"kernel", "N"},
         Part::ALIGNMENT,
         "edge of the kernel of rotations in which a local minimum is the smallest; in "
         "the even set a ball as wide, in the grid of angles the next odd number"},
        {3, unbounded, {"steps"}}},
    Number<double>{
        {&Settings::additional_process_threshold, "additional_process_threshold", "",
         {"additional-process", "ENERGY"}, Part::ALIGNMENT,
         "energy above which more than the lowest minimum is refined, Q_the of (e12); "
         "0: always"},
        {0.0, infinity, {"root mean square radii of the target"}}},
    Number<unsigned int>{
        {&Settings::icp_points, "icp_points", "setNumberOfICPPoints",
         {"icp-points", "N"}, Part::REST,
         "points of the source in the final ICP, on the whole target; 0: all"},
        {0, unbounded, {"points"}}},
    Number<double>{
        {&Settings::minimum_confidence, "minimum_confidence", "setMinimumConfidence",
         {"confidence", "C"}, Part::REST,
         "confidence from which on the clouds count as registered"},
        {0.0, 1.0}},
    Number<double>{
        {&Settings::time_limit, "time_limit", "setTimeLimit", {"time-limit", "SECONDS"},
         Part::REST, "time after which the best pose so far has to do; 0: never"},
        {0.0, infinity, {"seconds"}},
        {1e-3, 1e9, {"seconds"}}},
    Text{
        {&Settings::device, "device", "setDevice", {"device", "NAME"}, Part::ALIGNMENT,
         "where the search runs: auto, on the first OpenCL device, GPUs first, else on "
         "the host; host; part of a platform's name, on all its devices; or part of a "
         "device's name"},
        "auto, host or a device's name"},
    Number<unsigned int>{
        {&Settings::threads, "threads", "setNumberOfThreads", {"threads", "N"},
         Part::ALIGNMENT,
         "threads on the host and on an OpenCL CPU device; 0: as many as there are "
         "cores"},
        {0, unbounded, {"threads"}},
        {0, 1024, {"threads"}}});

// clang-format on

/** \brief Call a function with each row. */
template <typename Function>
void
forEach(Function&& function)
{
  std::apply([&](const auto&... rows) { (function(rows), ...); }, table);
}

/** \brief The row of a setting: rowOf<&Settings::threads>(). */
template <auto member, std::size_t first = 0>
constexpr const auto&
rowOf()
{
  constexpr auto found = std::get<first>(table).member;
  if constexpr (std::is_same_v<std::remove_const_t<decltype(found)>,
                               decltype(member)>) {
    if constexpr (found == member)
      return std::get<first>(table);
    else
      return rowOf<member, first + 1>();
  }
  else
    return rowOf<member, first + 1>();
}

} // namespace setting
} // namespace kss
} // namespace pcl
