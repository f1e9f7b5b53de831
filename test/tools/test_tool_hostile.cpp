/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "own_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <random>
#include <set>
#include <sstream>
#include <thread>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

/** \file
 * Runs the command line tool, whose path is the last argument of this program, on
 * inputs that are made to break it: it ends soon, with a status and one sentence.
 */

namespace {

std::string tool_path;

struct Outcome {
  /** The exit status; -1 where a signal ended it. */
  int status;
  std::string errors;
  double seconds;
  long megabytes;
};

class HostileRun : public kss_test::OwnFolder {
protected:
  void
  SetUp() override
  {
    write("cloud.xyz", blob(1500));
  }

  /** Rows of points of a surface without any symmetry. */
  static std::string
  blob(int points)
  {
    std::mt19937 random(1);
    std::ostringstream rows;
    for (int i = 0; i < points; ++i) {
      const double z = 2.0 * (random() / 4294967296.0) - 1.0;
      const double angle = 2.0 * M_PI * (random() / 4294967296.0);
      const double radius = std::sqrt(1.0 - z * z);
      const double x = radius * std::cos(angle), y = radius * std::sin(angle);
      const double far = 1.0 + 0.5 * x * y + 0.4 * z * z * z + 0.3 * x;
      rows << x * far << ' ' << y * far << ' ' << z * far << '\n';
    }
    return rows.str();
  }

  /** Start the tool in the directory with its files. */
  pid_t
  start(std::vector<std::string> arguments) const
  {
    arguments.insert(arguments.begin(),
                     {tool_path, "--device", "host", "--threads", "1"});
    std::vector<char*> words;
    for (auto& argument : arguments)
      words.push_back(argument.data());
    words.push_back(nullptr);
    const pid_t child = fork();
    if (child != 0)
      return child;
    rlimit no_core = {0, 0};
    setrlimit(RLIMIT_CORE, &no_core);
    if (file_size_limit_ > 0) {
      rlimit limit = {file_size_limit_, file_size_limit_};
      setrlimit(RLIMIT_FSIZE, &limit);
    }
    const int errors = open(path("errors").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    const int nothing = open("/dev/null", O_WRONLY);
    if (chdir(directory_.c_str()) != 0 || dup2(errors, 2) < 0 || dup2(nothing, 1) < 0)
      _exit(99);
    execv(words[0], words.data());
    _exit(99);
  }

  Outcome
  finish(pid_t child) const
  {
    constexpr int deadline = 20;
    std::atomic<bool> done{false};
    std::thread killer([&] {
      for (int i = 0; i < deadline * 100 && !done; ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
      if (!done)
        kill(child, SIGKILL);
    });
    int status = 0;
    rusage usage = {};
    wait4(child, &status, 0, &usage);
    done = true;
    killer.join();
    std::ostringstream errors;
    errors << std::ifstream(path("errors")).rdbuf();
    std::filesystem::remove(path("errors"));
    // the CPU's time, for other work on the machine does not lengthen it
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, errors.str(),
            usage.ru_utime.tv_sec + usage.ru_stime.tv_sec +
                1e-6 * (usage.ru_utime.tv_usec + usage.ru_stime.tv_usec),
            usage.ru_maxrss / 1024};
  }

  Outcome
  run(const std::vector<std::string>& arguments) const
  {
    return finish(start(arguments));
  }

  /** That the tool ends with one of the statuses, soon, with little memory, and with
   * one sentence. */
  static void
  expectOneSentence(const Outcome& outcome, const std::set<int>& statuses)
  {
    EXPECT_EQ(1u, statuses.count(outcome.status)) << outcome.status << outcome.errors;
    EXPECT_EQ(0u, outcome.errors.find("pcl_kss_icp: ")) << outcome.errors;
    EXPECT_EQ(1, std::count(outcome.errors.begin(), outcome.errors.end(), '\n'))
        << outcome.errors;
    EXPECT_LT(outcome.errors.size(), 600u) << outcome.errors;
    EXPECT_LT(outcome.seconds, 1.0);
    EXPECT_LT(outcome.megabytes, 500);
  }

  rlim_t file_size_limit_ = 0;

private:
};

std::string
replaced(std::string text, const std::string& what, const std::string& by)
{
  text.replace(text.find(what), what.size(), by);
  return text;
}

} // namespace

TEST_F(HostileRun, FilesThatAreWrong)
{
  const std::string rows = blob(60);
  const std::string middle = rows.substr(0, rows.find('\n') + 1);
  const std::string pcd =
      "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n"
      "WIDTH 60\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 60\nDATA "
      "ascii\n" +
      rows;
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 60\nproperty float x\n"
      "property float y\nproperty float z\nelement face 1\nproperty "
      "list uchar int vertex_indices\nend_header\n" +
      rows + "3 0 1 2\n";
  const std::string binary =
      replaced(ply.substr(0, ply.find(rows)), "ascii", "binary_little_endian");
  const std::vector<std::pair<std::string, std::string>> cases{
      {"keyword.pcd", "AUTHOR me\n" + pcd},
      {"misspelt.pcd", replaced(pcd, "VERSION", "VERSIO")},
      {"mark.pcd", "\xEF\xBB\xBF" + pcd},
      {"middle.pcd", replaced(pcd, "HEIGHT", "NOTE hello\nHEIGHT")},
      {"many.pcd", replaced(replaced(pcd, "WIDTH 60", "WIDTH 2000000000"), "POINTS 60",
                            "POINTS 2000000000")},
      {"count.pcd", replaced(pcd, "COUNT 1", "COUNT 2000000000")},
      {"large.pcd",
       replaced(replaced(pcd, "COUNT 1", "COUNT 2000000000"), "ascii", "binary")},
      {"packed.pcd", replaced(pcd, "ascii", "binary_compressed")},
      {"columns.ply",
       replaced(ply, "element vertex",
                "obj_info num_cols 2147483648\nobj_info num_rows 1\nelement vertex")},
      {"vertices.ply", replaced(binary, "vertex 60", "vertex 2000000000")},
      {"faces.ply", replaced(ply, "face 1", "face 2000000000")},
      {"grid.ply", replaced(ply, "element face 1", "element range_grid 2000000000")},
      {"half.ply", replaced(ply, "3 0 1 2", "3 0 1.5 2")},
      {"wrapped.ply", replaced(ply, "3 0 1 2", "3 0 4294967296 2")},
      {"list.ply", replaced(binary + std::string(720, '\0') + "\xff\xff\xff\xff",
                            "list uchar", "list int")},
      {"types.ply", replaced(binary + std::string(724, '\1'), "float z", "char z")},
      {"row.xyz", middle + "a b c\n" + rows},
      {"title.xyz", "x y z\n" + middle + "a b c\n" + rows},
      {"huge.xyz", middle + "1e39 0 0\n" + rows},
      {"commas.xyz", middle + "1,5 2,5 3,5\n" + rows},
      {"zeros.xyz", std::string(1000000, '\0')},
      {"columns.xyz", std::string(100000, '1') + " 2"},
      {"wide.xyz",
       [] {
         std::string text;
         for (int i = 0; i < 100000; ++i)
           text += "1 ";
         return text;
       }()},
      {"row.off", "OFF\n2000000000 2000000000 0\n" + rows},
      {"row.obj", "v 0 0 0\nv a b c\nv 1 1 1\n"},
      {"device.obj", "mtllib /dev/zero\nv 0 0 0\nv 1 0 0\nv 0 1\nf 1 2 3\n"},
      {"facet.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 1,5 0 0\n"},
      {"many.stl", std::string(80, '\0') + "\xff\xff\xff\x7f" + std::string(50, '\0')}};
  for (const auto& [name, content] : cases) {
    SCOPED_TRACE(name);
    write(name, content);
    const auto before = files();
    const Outcome outcome = run({name, "cloud.xyz", "aligned.ply"});
    expectOneSentence(outcome, {2});
    EXPECT_NE(std::string::npos, outcome.errors.find(name + ": ")) << outcome.errors;
    expectOneSentence(run({"cloud.xyz", name, "aligned.ply"}), {2});
    EXPECT_EQ(before, files());
  }
}

TEST_F(HostileRun, WhatIsNoFile)
{
  std::filesystem::create_directory(path("folder.ply"));
  ASSERT_EQ(0, mkfifo(path("pipe.pcd").c_str(), 0600));
  std::filesystem::create_symlink("/dev/zero", path("zero.xyz"));
  std::filesystem::create_symlink("/dev/null", path("null.stl"));
  std::filesystem::create_symlink("loop.off", path("loop.off"));
  sockaddr_un address = {};
  address.sun_family = AF_UNIX;
  std::snprintf(address.sun_path, sizeof address.sun_path, "%s",
                path("socket.obj").c_str());
  const int socket = ::socket(AF_UNIX, SOCK_STREAM, 0);
  ASSERT_EQ(0, bind(socket, reinterpret_cast<sockaddr*>(&address), sizeof address));
  for (const std::string name :
       {"folder.ply", "pipe.pcd", "zero.xyz", "null.stl", "socket.obj"}) {
    const Outcome outcome = run({name, "cloud.xyz"});
    expectOneSentence(outcome, {2});
    EXPECT_NE(std::string::npos, outcome.errors.find(name + ": is not a regular file"))
        << outcome.errors;
  }
  expectOneSentence(run({"loop.off", "cloud.xyz"}), {2});
  close(socket);
}

TEST_F(HostileRun, OptionsOutOfAllBounds)
{
  for (const std::vector<std::string>& options :
       std::vector<std::vector<std::string>>{{"--scale-range", "1e300", "1e308"},
                                             {"--scale-range", "1e-300", "1"},
                                             {"--scale-range", "1", "inf"},
                                             {"--scale-range", "nan", "nan"},
                                             {"--time-limit", "0"},
                                             {"--time-limit", "-1"},
                                             {"--time-limit", "nan"},
                                             {"--time-limit", "1e300"},
                                             {"--iterations", "0"},
                                             {"--iterations", "1e9"}}) {
    std::vector<std::string> arguments{"cloud.xyz", "cloud.xyz"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Outcome outcome = run(arguments);
    expectOneSentence(outcome, {2});
    EXPECT_NE(std::string::npos, outcome.errors.find(options[0])) << outcome.errors;
  }
}

TEST_F(HostileRun, SaysInItsOwnWordsWhyItIsNotRegistered)
{
  write("more.xyz", blob(3000));
  for (const std::vector<std::string>& options : std::vector<std::vector<std::string>>{
           {"--time-limit", "0.001"}, {"--iterations", "1"}}) {
    std::vector<std::string> arguments{"more.xyz", "cloud.xyz", "a.ply"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Outcome outcome = run(arguments);
    expectOneSentence(outcome, {1});
    for (const std::string word : {"set", "()", "Maximum", "rejectors"})
      EXPECT_EQ(std::string::npos, outcome.errors.find(word)) << outcome.errors;
  }
  EXPECT_EQ((std::set<std::string>{"cloud.xyz", "more.xyz"}), files());
}

TEST_F(HostileRun, FullDisksLeaveNothing)
{
  file_size_limit_ = 5000;
  for (const std::string name : {"a.pcd", "a.ply", "a.obj", "a.off", "a.xyz"}) {
    const Outcome outcome = run({"cloud.xyz", "cloud.xyz", name, "--points", "300"});
    EXPECT_EQ(2, outcome.status);
    EXPECT_NE(std::string::npos, outcome.errors.find(name + ": cannot be written"))
        << outcome.errors;
    EXPECT_EQ(std::set<std::string>{"cloud.xyz"}, files());
  }
  file_size_limit_ = 0;
  std::filesystem::create_symlink("/dev/full", path("full.pcd"));
  EXPECT_EQ(2, run({"cloud.xyz", "cloud.xyz", "full.pcd", "--points", "300"}).status);
}

/** Whether a process handles a signal. */
bool
handles(pid_t process, int signal)
{
  std::ifstream status("/proc/" + std::to_string(process) + "/status");
  for (std::string word; status >> word;)
    if (word == "SigCgt:" && status >> word)
      return std::stoull(word, nullptr, 16) >> (signal - 1) & 1;
  return false;
}

/** Wait for something, but not forever. */
template <typename Predicate>
bool
waitFor(Predicate predicate)
{
  for (int i = 0; i < 2000; ++i) {
    if (predicate())
      return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return false;
}

TEST_F(HostileRun, SignalsLeaveNothing)
{
  // a full pipe keeps the tool writing when its other file is written, but not in place
  ASSERT_EQ(0, mkfifo(path("pipe").c_str(), 0600));
  const int pipe = open(path("pipe").c_str(), O_RDWR | O_NONBLOCK);
  const std::string zeros(4096, '\0');
  while (::write(pipe, zeros.data(), zeros.size()) > 0) {
  }
  const auto has_part = [&] {
    const auto names = files();
    return std::any_of(names.begin(), names.end(), [](const std::string& name) {
      return name.find(".part") != std::string::npos;
    });
  };
  write("a.pcd", "old");
  const std::set<std::string> before = files();
  for (const int signal : {SIGINT, SIGTERM, SIGHUP})
    for (const bool is_writing : {false, true}) {
      SCOPED_TRACE(signal * 10 + is_writing);
      const pid_t child = start(
          {"cloud.xyz", "cloud.xyz", "a.pcd", "--points", "300", "--report", "pipe"});
      EXPECT_TRUE(waitFor(
          [&] { return handles(child, SIGHUP) && (!is_writing || has_part()); }));
      if (is_writing) // until it waits for the pipe
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
      kill(child, signal);
      const Outcome outcome = finish(child);
      EXPECT_EQ(128 + signal, outcome.status) << outcome.errors;
      EXPECT_EQ(0u, outcome.errors.find("pcl_kss_icp: ended by SIG")) << outcome.errors;
      EXPECT_EQ(before, files());
      EXPECT_EQ(3u, std::filesystem::file_size(path("a.pcd")));
    }
  close(pipe);
}

/** The files of a folder of hostile inputs. */
TEST_F(HostileRun, DataForDevelopment)
{
  const char* data = std::getenv("PCL_KSS_ICP_TEST_DATA");
  const auto folder = std::filesystem::path(data ? data : "") / "hostile";
  if (!data || !std::filesystem::exists(folder))
    GTEST_SKIP() << "Set PCL_KSS_ICP_TEST_DATA to a folder with hostile inputs";
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    SCOPED_TRACE(name);
    if (name.find("target_of_") == 0)
      continue;
    const std::string file = entry.path().string();
    if (name.find("far") != 0) {
      expectOneSentence(run({file, file, "aligned.ply"}), {1, 2});
      continue;
    }
    // sound clouds with a few points far away: the others are what counts
    const Outcome outcome =
        run({file, (folder / "target_of_far.ply").string(), "--report", "report.json"});
    EXPECT_EQ(0, outcome.status) << outcome.errors;
    EXPECT_LT(outcome.megabytes, 500);
  }
}

int
main(int argc, char** argv)
{
  ::testing::InitGoogleTest(&argc, argv);
  if (argc != 2) {
    std::cerr << "usage: " << argv[0] << " TOOL\n";
    return 2;
  }
  tool_path = std::filesystem::absolute(argv[1]).string();
  return RUN_ALL_TESTS();
}
