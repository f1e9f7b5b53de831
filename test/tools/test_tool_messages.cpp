/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * What the command line tool says of what is wrong, and of itself.
 */

#include "tool_run.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <pty.h>
#include <sys/ioctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace {

using namespace kss_test;

/** Arguments, and what the message about them has to name. */
using Cases = std::vector<std::pair<std::string, std::string>>;

const Cases wrong_command_lines{{"", "needs SOURCE"},
                                {"source.xyz", "needs SOURCE"},
                                {"source.xyz target.xyz a.ply b.ply", "needs SOURCE"},
                                {"source.xyz target.xyz --unknown", "--unknown"},
                                {"source.xyz target.xyz --rep r.json", "--rep"},
                                {"source.xyz target.xyz --report", "--report"},
                                {"source.xyz target.xyz --report ''", "--report"},
                                {"source.xyz target.xyz ''", "empty"},
                                {"source.xyz target.xyz --mode", "--mode"}};

const Cases wrong_values{
    {"source.xyz target.xyz --points 19", "--points 19"},
    {"source.xyz target.xyz --points many", "--points many"},
    {"source.xyz target.xyz --points=-300", "--points -300"},
    {"source.xyz target.xyz --points 300.5", "--points 300.5"},
    {"source.xyz target.xyz --angle-step 0", "--angle-step 0"},
    {"source.xyz target.xyz --angle-step nan", "--angle-step nan"},
    {"source.xyz target.xyz --angle-step 30x", "--angle-step 30x"},
    {"source.xyz target.xyz --rotations odd", "--rotations odd"},
    {"source.xyz target.xyz --rotations even:", "--rotations"},
    {"source.xyz target.xyz --rotations even:0", "--rotations"},
    {"source.xyz target.xyz --mode whole", "--mode whole"},
    {"source.xyz target.xyz --scale-range 1", "--scale-range"},
    {"source.xyz target.xyz --scale-range 2 1", "--scale-range 1"},
    {"source.xyz target.xyz --scale-range 0 1", "--scale-range 0"},
    {"source.xyz target.xyz --scale-range a b", "--scale-range a"},
    {"source.xyz target.xyz --density high", "--density high"},
    {"source.xyz target.xyz --density random", "use uniform or paper"},
    {"source.xyz target.xyz --points 1000001", "20 to 1000000 points"},
    {"source.xyz target.xyz --angle-step 2.9", "3 to 180 degrees"},
    {"source.xyz target.xyz --angle-step 181", "3 to 180 degrees"},
    {"source.xyz target.xyz --rotations euler:9", "--rotations euler:9"},
    {"source.xyz target.xyz --rotations even:100001", "1 to 100000 rotations"},
    {"source.xyz target.xyz --mode whole",
     "use auto, global, partial, overlap or scene"},
    {"source.xyz target.xyz --scale-range 1e-7 1", "--scale-range 1e-7"},
    {"source.xyz target.xyz --scale-range 1 1e7", "--scale-range 1e7"},
    {"source.xyz target.xyz --centers none", "--centers none"},
    {"source.xyz target.xyz --energy ''", "--energy ''"},
    {"source.xyz target.xyz --search brute", "use screened or exact"},
    {"source.xyz target.xyz --search-points 129", "--search-points 129"},
    {"source.xyz target.xyz --kernel 2", "--kernel 2"},
    {"source.xyz target.xyz --additional-process=-1", "--additional-process -1"},
    {"source.xyz target.xyz --icp-points all", "--icp-points all"},
    {"source.xyz target.xyz --icp-points 4294967296", "--icp-points 4294967296"},
    {"source.xyz target.xyz --confidence 1.1", "--confidence 1.1"},
    {"source.xyz target.xyz --time-limit 0.0009", "0.001 to 1e+09 seconds"},
    {"source.xyz target.xyz --device nonesuch", "--device nonesuch"},
    {"source.xyz target.xyz --device ''", "--device"},
    {"source.xyz target.xyz --threads 2000", "--threads 2000"},
    {"source.xyz target.xyz --max-iterations 0", "use a whole number, 1 to 1000000"},
    {"source.xyz target.xyz --max-iterations=-5", "--max-iterations -5"},
    {"source.xyz target.xyz --iterations many", "--max-iterations many"},
    {"source.xyz target.xyz --picture ''", "--picture"},
    {"source.xyz target.xyz --picture p.jpg", "a file ending in .png"},
    {"source.xyz target.xyz --upright=w", "use any, x, y or z"},
    {"--list-devices --device nonesuch", "nonesuch"},
    {"source.xyz target.xyz --samples 1", "--samples 1"}};

const Cases wrong_files{
    {"missing.ply target.xyz", "missing.ply"},
    {"source.xyz missing.xyz", "missing.xyz"},
    {"a_directory.ply target.xyz", "a_directory.ply"},
    {"short.off target.xyz", "short.off"},
    {"binary.xyz target.xyz", "binary.xyz"},
    {"source.las target.xyz", "source.las"},
    {"source.xyz target.xyz aligned.las", "aligned.las"},
    {"source.xyz target.xyz aligned", "aligned"},
    {"source.xyz target.xyz aligned.stl", "aligned.stl"},
    {"source.xyz target.xyz no_directory/aligned.ply", "no_directory/aligned.ply"},
    {"source.xyz target.xyz --guess missing.txt", "missing.txt"},
    {"source.xyz target.xyz --guess a_directory.ply", "a_directory.ply: holds no"},
    {"source.xyz target.xyz --guess rigid.xyz", "rigid.xyz: holds no transformation"},
    {"source.xyz target.xyz --guess shear.txt", "shear.txt: its transformation"},
    {"source.xyz target.xyz --transform no_directory/t", "no_directory/t"},
    {"source.xyz target.xyz --report a_directory.ply", "a_directory.ply"},
    {"source.xyz target.xyz source.xyz", "source.xyz"},
    {"source.xyz target.xyz --report r --transform ./r", "r: is named twice"},
    {"source.xyz target.xyz --guess shear --picture ./shear", "shear: is named twice"},
    {"--upright source.xyz missing.xyz", "missing.xyz: No such file"},
    {"--upright y source.xyz missing.xyz", "missing.xyz: No such file"}};

TEST_F(ToolRun, NamesWhatIsWrong)
{
  const auto before = files();
  for (const Cases* cases : {&wrong_command_lines, &wrong_values, &wrong_files})
    for (const auto& [arguments, name] : *cases) {
      SCOPED_TRACE(arguments);
      const Outcome result = run(arguments);
      EXPECT_EQ(2, result.status);
      EXPECT_EQ("", result.output);
      EXPECT_EQ(0u, result.errors.find("pcl_kss_icp: ")) << result.errors;
      EXPECT_NE(std::string::npos, result.errors.find(name)) << result.errors;
      EXPECT_EQ(1, std::count_if(result.errors.begin(), result.errors.end(),
                                 [](unsigned char c) { return std::iscntrl(c); }))
          << result.errors; // the end of the only line
    }
  EXPECT_EQ(before, files());
}

TEST_F(ToolRun, LeavesNoPartsOfOutputs)
{
  if (!std::filesystem::exists("/dev/full"))
    GTEST_SKIP() << "needs /dev/full";
  const auto before = files();
  const Outcome result = search("source.xyz target.xyz aligned.ply --report /dev/full");
  EXPECT_EQ(2, result.status);
  EXPECT_NE(std::string::npos, result.errors.find("/dev/full"));
  EXPECT_EQ(before, files());
  // the summary is an output, too
  EXPECT_EQ(
      2, search("source.xyz target.xyz > /dev/full 2> /dev/null ; exit $? #").status);
}

TEST_F(ToolRun, ShowsHelpVersionAndDevices)
{
  for (const std::string arguments : {"--help", "-h", "--version", "--list-devices"}) {
    const Outcome result = run(arguments);
    EXPECT_EQ(0, result.status) << arguments;
    EXPECT_EQ("", result.errors) << arguments;
  }
  // in one line
  std::istringstream words(run("--help").output);
  std::string help;
  for (std::string word; words >> word;)
    help += word + ' ';
  for (const char* option : {"--picture",
                             "--view",
                             "--guess",
                             "--max-iterations",
                             "--transform",
                             "--report",
                             "--mode",
                             "--scale-range",
                             "--paper",
                             "--no-cleaning",
                             "--rigid",
                             "--upright [AXIS]",
                             "--upright alone: z",
                             "--points",
                             "--angle-step",
                             "--rotations",
                             "--density",
                             "--device",
                             "--list-devices",
                             "--threads",
                             "--samples",
                             "--quiet",
                             "--version",
                             "--help",
                             "Example",
                             "--centers",
                             "--energy",
                             "--search",
                             "--search-points",
                             "--kernel",
                             "--additional-process",
                             "--icp-points",
                             "--confidence",
                             "--time-limit",
                             "default 2000",
                             "3 to 180 degrees",
                             "default 30)",
                             "(default even)",
                             "1 to 100000 rotations; default 1728"})
    EXPECT_NE(std::string::npos, help.find(option)) << option;
  EXPECT_EQ(0u, run("--version").output.find("pcl_kss_icp "));
  std::istringstream lines(run("--help").output);
  for (std::string line; std::getline(lines, line);) {
    EXPECT_LT(line.size(), 80u) << line;
    EXPECT_TRUE(line.empty() || line.back() != ' ') << line;
  }
}

TEST_F(ToolRun, MarksTheDeviceThatRuns)
{
  const std::string on_host = run("--list-devices --device host").output;
  EXPECT_NE(std::string::npos, on_host.find("\n* host\n")) << on_host;
  ASSERT_EQ(0, run("source.xyz target.xyz --points 300 --report r.json").status);
  const std::string report = content("r.json");
  std::istringstream lines(run("--list-devices").output);
  int marked = 0;
  for (std::string line; std::getline(lines, line);)
    if (line.compare(0, 2, "* ") == 0 && line.find("--device") == std::string::npos) {
      ++marked;
      EXPECT_NE(std::string::npos, report.find(line.substr(2))) << line;
    }
  EXPECT_GE(marked, 1);
}

TEST_F(ToolRun, SaysWhyItShowsNoWindow)
{
  const std::string displays[] = {"DISPLAY", "WAYLAND_DISPLAY"};
  for (const std::string& display : displays)
    unsetenv(display.c_str());
  const auto before = files();
  const Outcome result = run("source.xyz target.xyz --view --report r.json");
  EXPECT_EQ(2, result.status);
  EXPECT_EQ(0u, result.errors.find("pcl_kss_icp: --view: there is no "))
      << result.errors;
  EXPECT_EQ(before, files());
}

/** What the tool writes to a terminal of so many columns. */
std::string
onTerminal(const std::string& tool,
           std::vector<std::string> words,
           unsigned short columns)
{
  int terminal = -1;
  winsize size{};
  size.ws_row = 24;
  size.ws_col = columns;
  const pid_t child = forkpty(&terminal, nullptr, nullptr, &size);
  if (child == 0) {
    words.insert(words.begin(), tool);
    std::vector<char*> arguments;
    for (std::string& word : words)
      arguments.push_back(word.data());
    arguments.push_back(nullptr);
    execv(tool.c_str(), arguments.data());
    _exit(127);
  }
  std::string output;
  char bytes[4096];
  for (ssize_t size; (size = read(terminal, bytes, sizeof bytes)) > 0;)
    output.append(bytes, static_cast<std::size_t>(size));
  close(terminal);
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << output;
  return output;
}

TEST_F(ToolRun, ShowsProgressAsWideAsTheTerminalAndWipesItOut)
{
  for (const unsigned short columns : {40, 80}) {
    const std::string shown =
        onTerminal(toolPath(),
                   {"--device", "host", "--points", "300", path("source.xyz"),
                    path("target.xyz"), "--transform", path("t.txt")},
                   columns);
    // up to the summary
    std::istringstream lines(shown.substr(0, shown.find("Transformation")));
    std::set<std::string> of_final_icp;
    std::string last;
    for (std::string line; std::getline(lines, line, '\r'); last = line) {
      EXPECT_LT(line.size(), columns) << line;
      if (line.find("final ICP") == 0)
        of_final_icp.insert(line);
    }
    EXPECT_GE(of_final_icp.size(), 3u) << shown; // it moves
    EXPECT_EQ(std::string::npos, last.find_first_not_of(' ')) << last;
  }
}

} // namespace
