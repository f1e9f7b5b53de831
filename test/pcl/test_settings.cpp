/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * The table of settings, and what follows from it: what KSSICP refuses, which settings
 * ask for the same work, and the table in docs/settings.md.
 */

#include <pcl/registration/kss/settings_text.h>
#include <pcl/registration/kss_icp.h>

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <limits>
#include <set>
#include <sstream>

namespace {

using namespace pcl::kss;
using KSSICP = pcl::KSSICP<pcl::PointXYZ, pcl::PointXYZ>;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

/** What PCL prints while a function runs. */
std::string
printed(const std::function<void()>& function)
{
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  function();
  return ::testing::internal::GetCapturedStdout() +
         ::testing::internal::GetCapturedStderr();
}

TEST(Settings, AreAllInTheTable)
{
  // does not compile with another number of members: give a new one a row
  const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v,
               progress] = Settings();
  constexpr std::size_t members = 22;
  EXPECT_EQ(members, std::tuple_size_v<decltype(setting::table)>);
  const std::set<const void*> addresses{&a, &b, &c, &d, &e, &f, &g, &h, &i, &j, &k,
                                        &l, &m, &n, &o, &p, &q, &r, &s, &t, &u, &v};
  EXPECT_EQ(nullptr, progress);
  const Settings settings;
  std::set<std::string> names;
  std::set<const void*> told;
  setting::forEach([&](const auto& row) {
    names.insert(row.name);
    told.insert(&(settings.*row.member));
    EXPECT_NE("internal", valueText(row, settings.*row.member, setting::For::PROGRAM));
  });
  EXPECT_TRUE(checked(settings, settings).refusals.empty());
  EXPECT_EQ(members, addresses.size());
  EXPECT_EQ(members, names.size());
  EXPECT_EQ(members, told.size());
}

TEST(Settings, AskForTheSameWorkUnlessOneOfThemDiffers)
{
  const Settings settings;
  EXPECT_TRUE(sameWork(settings, settings));
  const std::function<void(Settings&)> others[] = {
      [](Settings& s) { s.mode = Mode::PARTIAL_PARTIAL; },
      [](Settings& s) { s.sample_points = 77; },
      [](Settings& s) { s.density = Density::PAPER; },
      [](Settings& s) { s.clean = false; },
      [](Settings& s) { s.rotation_set = RotationSet::EULER; },
      [](Settings& s) { s.angle_step = 0.77; },
      [](Settings& s) { s.even_rotations = 77; },
      [](Settings& s) { s.center_set = CenterSet::PAPER; },
      [](Settings& s) { s.energy = Energy::HAUSDORFF; },
      [](Settings& s) { s.search = Search::EXACT; },
      [](Settings& s) { s.search = static_cast<Search>(-1); },
      [](Settings& s) { s.search_points = 77; },
      [](Settings& s) { s.local_minimum_kernel = 7; },
      [](Settings& s) { s.additional_process_threshold = 0.77; },
      [](Settings& s) { s.estimate_scale = false; },
      [](Settings& s) { s.smallest_scale = 0.77; },
      [](Settings& s) { s.largest_scale = 1.77; },
      [](Settings& s) { s.rotation_axis = RotationAxis::Y; },
      [](Settings& s) { s.device = "host"; },
      [](Settings& s) { s.threads = 7; }};
  for (const auto& change : others) {
    Settings other;
    change(other);
    EXPECT_FALSE(sameWork(settings, other)) << &change - others;
  }
  Settings same;
  same.icp_points = 77;
  same.minimum_confidence = 0.77;
  same.time_limit = 77.0;
  same.progress = [](const std::string&, double) {};
  EXPECT_TRUE(sameWork(settings, same));
}

TEST(Settings, TellWhichSearchRuns)
{
  Settings settings;
  EXPECT_EQ(Search::SCREENED, searchOf(settings));
  settings.energy = Energy::HAUSDORFF;
  EXPECT_EQ(Search::EXACT, searchOf(settings));
  settings.energy = Energy::TRUNCATED_MEAN;
  settings.center_set = CenterSet::PAPER;
  EXPECT_EQ(Search::EXACT, searchOf(settings));
  settings.search = static_cast<Search>(-1);
  EXPECT_EQ(static_cast<Search>(-1), searchOf(settings));
  settings.search = Search::EXACT;
  settings.center_set = CenterSet::SPREAD;
  EXPECT_EQ(Search::EXACT, searchOf(settings));
}

TEST(Settings, AreToldInTheUnitOfWhoReads)
{
  using setting::For;
  const auto& step = setting::rowOf<&Settings::angle_step>();
  EXPECT_EQ("0.5235988", valueText(step, Settings().angle_step, For::PROGRAM));
  EXPECT_EQ("30", valueText(step, Settings().angle_step, For::COMMAND_LINE));
  EXPECT_EQ("0.05 to 3.141593 radians", rangeText(step.bounds));
  EXPECT_EQ("3 to 180 degrees", rangeText(step.typed));
  EXPECT_EQ("at least 3 steps",
            rangeText(setting::rowOf<&Settings::local_minimum_kernel>().bounds));
  EXPECT_EQ("overlap", valueText(setting::rowOf<&Settings::mode>(),
                                 Mode::PARTIAL_PARTIAL, For::PROGRAM));
}

TEST(KSSICP, TakesWhatIsWithinTheBounds)
{
  KSSICP r;
  Settings settings;
  const std::function<void(Settings&)> changes[] = {
      [](Settings& s) { s.sample_points = 20; },
      [](Settings& s) { s.angle_step = M_PI; },
      [](Settings& s) { s.angle_step = 0.05; },
      [](Settings& s) { s.even_rotations = 1; },
      [](Settings& s) { s.even_rotations = 100000; },
      [](Settings& s) { s.search_points = 1; },
      [](Settings& s) { s.search_points = 128; },
      [](Settings& s) { s.local_minimum_kernel = 3; },
      [](Settings& s) { s.local_minimum_kernel = 4; },
      [](Settings& s) { s.additional_process_threshold = infinity; },
      [](Settings& s) { s.smallest_scale = s.largest_scale = 1.5; },
      [](Settings& s) { s.smallest_scale = 0.0, s.largest_scale = infinity; },
      [](Settings& s) { s.minimum_confidence = 0.0; },
      [](Settings& s) { s.minimum_confidence = 1.0; },
      [](Settings& s) { s.time_limit = 1e-6; },
      [](Settings& s) { s.time_limit = infinity; },
      [](Settings& s) { s.threads = 2000; },
      [](Settings& s) { s.sample_points = std::numeric_limits<unsigned int>::max(); },
      [](Settings& s) { s.icp_points = std::numeric_limits<unsigned int>::max(); },
      [](Settings& s) { s.search = static_cast<Search>(-1); }};
  for (const auto& change : changes) {
    change(settings);
    EXPECT_EQ("", printed([&] { r.setSettings(settings); })) << &change - changes;
    setting::forEach([&](const auto& row) {
      EXPECT_EQ(settings.*row.member, r.getSettings().*row.member) << row.name;
    });
  }
}

/** A setting that is refused, and what is said of it. */
struct Wrong {
  std::function<void(Settings&)> change;
  std::string named, bounds;
};

const Wrong wrongs[] = {
    {[](Settings& s) { s.sample_points = 0; }, "sample_points 0", "at least 20"},
    {[](Settings& s) { s.sample_points = 19; }, "sample_points 19", "points"},
    {[](Settings& s) { s.angle_step = 0.0; }, "angle_step 0", "radians"},
    {[](Settings& s) { s.angle_step = -1.0; }, "angle_step -1", "0.05 to"},
    {[](Settings& s) { s.angle_step = 3.2; }, "angle_step 3.2", "3.141593"},
    {[](Settings& s) { s.angle_step = nan; }, "angle_step nan", "radians"},
    {[](Settings& s) { s.angle_step = 1e-9; }, "angle_step 1e-09", "radians"},
    {[](Settings& s) { s.even_rotations = 0; }, "even_rotations 0", "1 to 100000"},
    {[](Settings& s) { s.even_rotations = 100001; }, "even_rotations 100001", "to"},
    {[](Settings& s) { s.search_points = 0; }, "search_points 0", "1 to 128 points"},
    {[](Settings& s) { s.search_points = 129; }, "search_points 129", "1 to 128"},
    {[](Settings& s) { s.local_minimum_kernel = 2; }, "kernel 2", "at least 3 steps"},
    {[](Settings& s) { s.additional_process_threshold = -1e-9; },
     "additional_process_threshold -1e-09", "at least 0"},
    {[](Settings& s) { s.additional_process_threshold = nan; },
     "additional_process_threshold nan", "at least 0"},
    {[](Settings& s) { s.minimum_confidence = -0.1; }, "confidence -0.1", "0 to 1"},
    {[](Settings& s) { s.minimum_confidence = 1.1; }, "confidence 1.1", "0 to 1"},
    {[](Settings& s) { s.minimum_confidence = nan; }, "confidence nan", "0 to 1"},
    {[](Settings& s) { s.time_limit = -1.0; }, "time_limit -1", "seconds"},
    {[](Settings& s) { s.time_limit = nan; }, "time_limit nan", "seconds"},
    {[](Settings& s) { s.smallest_scale = -1.0; }, "smallest_scale -1", "at least 0"},
    {[](Settings& s) { s.smallest_scale = 3.0; }, "smallest_scale 3", "largest"},
    {[](Settings& s) { s.smallest_scale = nan; }, "smallest_scale nan", "at least 0"},
    {[](Settings& s) { s.largest_scale = nan; }, "largest_scale nan", "at least 0"},
    {[](Settings& s) { s.smallest_scale = s.largest_scale = 0.0; }, "largest_scale 0",
     "above 0"}};

TEST(KSSICP, RefusesNonsenseAndSaysWhy)
{
  KSSICP r;
  Settings before;
  before.sample_points = 123;
  before.smallest_scale = 0.5;
  before.largest_scale = 2.0;
  before.mode = Mode::PARTIAL_PARTIAL;
  r.setSettings(before);
  for (const Wrong& wrong : wrongs) {
    SCOPED_TRACE(wrong.named);
    Settings asked = before;
    wrong.change(asked);
    const std::string said = printed([&] { r.setSettings(asked); });
    EXPECT_NE(std::string::npos, said.find("[pcl::KSSICP] ")) << said;
    EXPECT_NE(std::string::npos, said.find(wrong.named)) << said;
    EXPECT_NE(std::string::npos, said.find(wrong.bounds)) << said;
    setting::forEach([&](const auto& row) {
      EXPECT_EQ(before.*row.member, r.getSettings().*row.member) << row.name;
    });
  }
  // all at once: the others are taken
  Settings asked = before;
  for (const Wrong& wrong : wrongs)
    wrong.change(asked);
  asked.clean = false;
  asked.icp_points = 0;
  r.setSettings(asked);
  before.clean = false;
  before.icp_points = 0;
  setting::forEach([&](const auto& row) {
    EXPECT_EQ(before.*row.member, r.getSettings().*row.member) << row.name;
  });
}

TEST(KSSICP, HasSettersThatRefuseTheSame)
{
  KSSICP r;
  r.setMode(Mode::PARTIAL_PARTIAL);
  EXPECT_EQ(Mode::PARTIAL_PARTIAL, r.getMode());
  EXPECT_EQ(Mode::PARTIAL_PARTIAL, r.getFoundMode());
  r.setScaleEstimation(false);
  EXPECT_FALSE(r.getScaleEstimation());
  r.setRotationAxis(RotationAxis::Z);
  EXPECT_EQ(RotationAxis::Z, r.getRotationAxis());
  r.setDevice("host");
  EXPECT_EQ("host", r.getDevice());
  r.setNumberOfThreads(3);
  EXPECT_EQ(3u, r.getNumberOfThreads());
  r.setNumberOfICPPoints(77);
  EXPECT_EQ(77u, r.getNumberOfICPPoints());
  EXPECT_EQ(0.5, r.getMinimumConfidence());
  r.setMinimumConfidence(0.8);
  for (const double confidence : {-0.1, 1.1, nan})
    EXPECT_NE("", printed([&] { r.setMinimumConfidence(confidence); }));
  EXPECT_EQ(0.8, r.getMinimumConfidence());
  r.setTimeLimit(7.0);
  EXPECT_NE("", printed([&] { r.setTimeLimit(-1.0); }));
  EXPECT_EQ(7.0, r.getTimeLimit());
  EXPECT_EQ(0.0, r.getSmallestScale());
  EXPECT_EQ(infinity, r.getLargestScale());
  r.setScaleRange(0.5, 2.0);
  const std::pair<double, double> ranges[] = {
      {-1.0, 2.0}, {3.0, 2.0}, {0.0, 0.0}, {nan, 2.0}, {1.0, nan}};
  for (const auto& range : ranges)
    EXPECT_NE("", printed([&] { r.setScaleRange(range.first, range.second); }));
  EXPECT_EQ(0.5, r.getSmallestScale());
  EXPECT_EQ(2.0, r.getLargestScale());
  r.setScaleRange(1.5, 1.5);
  EXPECT_EQ(1.5, r.getSmallestScale());
  EXPECT_EQ(1.5, r.getLargestScale());
}

TEST(KSSICP, TakesThePapersSettings)
{
  KSSICP r;
  r.setNumberOfThreads(3);
  r.setTimeLimit(7.0);
  EXPECT_EQ("", printed([&] { r.setSettings(paperSettings(r.getSettings())); }));
  EXPECT_EQ(Mode::GLOBAL_GLOBAL, r.getMode());
  EXPECT_EQ(RotationSet::EULER, r.getSettings().rotation_set);
  EXPECT_EQ(2000u, r.getSettings().sample_points);
  EXPECT_EQ(3u, r.getNumberOfThreads());
  EXPECT_EQ(7.0, r.getTimeLimit());
}

TEST(KSSICP, WarnsWhereTheSearchIsNotTheOneAskedFor)
{
  KSSICP r;
  Settings settings;
  EXPECT_EQ("", printed([&] { r.setSettings(settings); }));
  settings.energy = Energy::HAUSDORFF;
  const std::string warning = printed([&] { r.setSettings(settings); });
  EXPECT_NE(std::string::npos, warning.find("search is exact")) << warning;
  // once
  EXPECT_EQ("", printed([&] { r.setNumberOfThreads(1); }));
  settings.search = Search::EXACT;
  EXPECT_EQ("", printed([&] { r.setSettings(settings); }));
}

/** Text as code; none where there is none. */
std::string
code(const std::string& text)
{
  return text.empty() ? "" : '`' + text + '`';
}

/** What stands in one cell for a program, and for a command line where that differs. */
std::string
both(const std::string& program, const std::string& command_line)
{
  return program == command_line ? program
                                 : program + "; as an option: " + command_line;
}

template <typename Value>
std::string
boundsIn(const setting::Number<Value>& row)
{
  return both(rangeText(row.bounds), rangeText(row.typed));
}

template <typename Row>
std::string
boundsIn(const Row&)
{
  return "";
}

/** The table of settings in docs/settings.md. */
std::string
markdown()
{
  using setting::For;
  std::ostringstream text;
  text << "| setting | setter | option | default | bounds | what it is |\n"
          "|---|---|---|---|---|---|\n";
  const Settings defaults;
  setting::forEach([&](const auto& row) {
    std::string option = std::string("--") + row.option.name;
    if (*row.option.value)
      option += std::string(" ") + row.option.value;
    const auto& value = defaults.*row.member;
    std::string meaning = meaningText(row, "`");
    if constexpr (std::is_same_v<std::decay_t<decltype(row)>, setting::Flag>)
      meaning += "; " + code(option) + ": " + row.off;
    text << "| " << code(row.name) << " | " << code(row.setter) << " | " << code(option)
         << " | "
         << both(valueText(row, value, For::PROGRAM),
                 valueText(row, value, For::COMMAND_LINE))
         << " | " << boundsIn(row) << " | " << meaning << " |\n";
  });
  return text.str();
}

TEST(SettingsPage, HasTheTable)
{
  std::ostringstream page;
  page << std::ifstream(PCL_KSS_ICP_SETTINGS_PAGE).rdbuf();
  const std::string begin = "<!-- settings: test_settings prints them -->\n\n",
                    end = "\n<!-- end of settings -->\n";
  const auto from = page.str().find(begin), to = page.str().find(end);
  ASSERT_NE(std::string::npos, from);
  ASSERT_NE(std::string::npos, to);
  const std::string table =
      page.str().substr(from + begin.size(), to - from - begin.size());
  EXPECT_TRUE(markdown() == table) << "docs/settings.md should have this table:\n\n"
                                   << markdown();
}

} // namespace
