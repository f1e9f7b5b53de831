/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * The command line tool on inputs that are made to break it: it ends soon, with a
 * status and one sentence.
 */

#include "hostile_run.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

namespace {

using namespace kss_test;

std::string
replaced(std::string text, const std::string& what, const std::string& by)
{
  text.replace(text.find(what), what.size(), by);
  return text;
}

/** Names and what the files hold. */
using Files = std::vector<std::pair<std::string, std::string>>;

Files
wrongPCDFiles(const std::string& rows)
{
  const std::string pcd =
      "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n"
      "WIDTH 60\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 60\nDATA "
      "ascii\n" +
      rows;
  return {{"keyword.pcd", "AUTHOR me\n" + pcd},
          {"misspelt.pcd", replaced(pcd, "VERSION", "VERSIO")},
          {"mark.pcd", "\xEF\xBB\xBF" + pcd},
          {"middle.pcd", replaced(pcd, "HEIGHT", "NOTE hello\nHEIGHT")},
          {"many.pcd", replaced(replaced(pcd, "WIDTH 60", "WIDTH 2000000000"),
                                "POINTS 60", "POINTS 2000000000")},
          {"count.pcd", replaced(pcd, "COUNT 1", "COUNT 2000000000")},
          {"large.pcd",
           replaced(replaced(pcd, "COUNT 1", "COUNT 2000000000"), "ascii", "binary")},
          {"packed.pcd", replaced(pcd, "ascii", "binary_compressed")}};
}

Files
wrongPLYFiles(const std::string& rows)
{
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 60\nproperty float x\n"
      "property float y\nproperty float z\nelement face 1\nproperty "
      "list uchar int vertex_indices\nend_header\n" +
      rows + "3 0 1 2\n";
  const std::string binary =
      replaced(ply.substr(0, ply.find(rows)), "ascii", "binary_little_endian");
  return {
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
      {"types.ply", replaced(binary + std::string(724, '\1'), "float z", "char z")}};
}

Files
wrongTextFiles(const std::string& rows)
{
  const std::string middle = rows.substr(0, rows.find('\n') + 1);
  std::string wide;
  for (int i = 0; i < 100000; ++i)
    wide += "1 ";
  return {{"row.xyz", middle + "a b c\n" + rows},
          {"title.xyz", "x y z\n" + middle + "a b c\n" + rows},
          {"huge.xyz", middle + "1e39 0 0\n" + rows},
          {"commas.xyz", middle + "1,5 2,5 3,5\n" + rows},
          {"zeros.xyz", std::string(1000000, '\0')},
          {"columns.xyz", std::string(100000, '1') + " 2"},
          {"wide.xyz", wide}};
}

Files
wrongMeshes(const std::string& rows)
{
  return {
      {"row.off", "OFF\n2000000000 2000000000 0\n" + rows},
      {"row.obj", "v 0 0 0\nv a b c\nv 1 1 1\n"},
      {"device.obj", "mtllib /dev/zero\nv 0 0 0\nv 1 0 0\nv 0 1\nf 1 2 3\n"},
      {"facet.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 1,5 0 0\n"},
      {"many.stl", std::string(80, '\0') + "\xff\xff\xff\x7f" + std::string(50, '\0')}};
}

TEST_F(HostileRun, FilesThatAreWrong)
{
  const std::string rows = blob(60);
  for (const Files& wrong : {wrongPCDFiles(rows), wrongPLYFiles(rows),
                             wrongTextFiles(rows), wrongMeshes(rows)})
    for (const auto& [name, content] : wrong) {
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
                                             {"--max-iterations", "0"},
                                             {"--max-iterations", "1e9"}}) {
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
  write("other.xyz", crate(3000));
  for (const std::vector<std::string>& options : std::vector<std::vector<std::string>>{
           {"more.xyz", "--time-limit", "0.001"}, {"other.xyz"}}) {
    std::vector<std::string> arguments{"cloud.xyz", "a.ply"};
    arguments.insert(arguments.begin(), options.begin(), options.end());
    const Outcome outcome = run(arguments);
    expectOneSentence(outcome, {1});
    for (const std::string word : {"set", "()", "Maximum", "rejectors"})
      EXPECT_EQ(std::string::npos, outcome.errors.find(word)) << outcome.errors;
  }
  EXPECT_EQ((std::set<std::string>{"cloud.xyz", "more.xyz", "other.xyz"}), files());
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

} // namespace
