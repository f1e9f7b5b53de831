/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include <pcl/registration/kss/settings.h>

#include <pcl/registration/kss/settings_text.h>

namespace pcl {
namespace kss {
namespace {

/** Why a number is refused; empty: it is not. */
template <typename Value>
std::string
refusalOf(const setting::Number<Value>& row, const Value& value)
{
  if (row.bounds.hold(value))
    return "";
  return std::string(row.name) + ' ' + valueText(row, value, setting::For::PROGRAM) +
         ": " + remedy(row.bounds) + '.';
}

/** What is no number cannot be wrong. */
template <typename Row, typename Value>
std::string
refusalOf(const Row&, const Value&)
{
  return "";
}

} // namespace

Settings
paperSettings(Settings settings)
{
  if (settings.mode == Mode::AUTOMATIC)
    settings.mode = Mode::GLOBAL_GLOBAL;
  settings.sample_points = 2000;
  settings.density = Density::PAPER;
  settings.clean = false;
  settings.rotation_set = RotationSet::EULER;
  settings.angle_step = Settings().angle_step;
  settings.center_set = CenterSet::PAPER;
  settings.icp_points = 0;
  settings.energy = Energy::HAUSDORFF;
  settings.search = Search::EXACT;
  settings.local_minimum_kernel = 5;
  settings.additional_process_threshold = 0.001;
  return settings;
}

bool
sameWork(const Settings& a, const Settings& b)
{
  bool are_same = true;
  setting::forEach([&](const auto& row) {
    if (row.part == setting::Part::ALIGNMENT)
      are_same = are_same && a.*row.member == b.*row.member;
  });
  return are_same;
}

Search
searchOf(const Settings& settings)
{
  const bool can_screen = settings.energy == Energy::TRUNCATED_MEAN &&
                          settings.center_set == CenterSet::SPREAD;
  return settings.search == Search::SCREENED && !can_screen ? Search::EXACT
                                                            : settings.search;
}

CheckedSettings
checked(const Settings& asked, const Settings& before)
{
  CheckedSettings result{asked, {}};
  setting::forEach([&](const auto& row) {
    const std::string refusal = refusalOf(row, asked.*row.member);
    if (refusal.empty())
      return;
    result.settings.*row.member = before.*row.member;
    result.refusals.push_back(refusal);
  });
  if (!(asked.smallest_scale >= 0.0 && asked.smallest_scale <= asked.largest_scale &&
        asked.largest_scale > 0.0)) {
    result.settings.smallest_scale = before.smallest_scale;
    result.settings.largest_scale = before.largest_scale;
    result.refusals.push_back(
        "smallest_scale " + setting::numberText(asked.smallest_scale) +
        " and largest_scale " + setting::numberText(asked.largest_scale) +
        ": use a smallest of at least 0, and a largest above 0 and no less.");
  }
  return result;
}

} // namespace kss
} // namespace pcl
