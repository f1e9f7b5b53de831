/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "program_run.h"

#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace kss_test {

using JSON = nlohmann::json;

constexpr int PAIRS = 10;

/** \brief Runs the program in a folder with some clouds and a list of pairs. */
class BatchRun : public ProgramRun {
protected:
  void
  SetUp() override
  {
    std::string manifest = "name,source,target\n";
    for (int i = 0; i < PAIRS; ++i) {
      const std::string number = std::to_string(i);
      write("s" + number, lump(i, Eigen::Affine3d::Identity()));
      write("t" + number,
            lump(i, Eigen::Translation3d(i, 2, 3) *
                        Eigen::AngleAxisd(1.0 + i,
                                          Eigen::Vector3d(1, -2, 3).normalized())));
      manifest += "pair " + number + ",s" + number + ",t" + number + '\n';
    }
    write("pairs.csv", manifest);
    write("line", "0 0 0\n1 0 0\n2 0 0\n3 0 0\n");
    write("short.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n");
    write("empty", "");
  }

  /** \brief Random points of a surface without symmetry, another one each. */
  static std::string
  lump(int number, const Eigen::Affine3d& pose)
  {
    std::mt19937 random(1);
    const auto uniform = [&] { return random() / 4294967296.0; };
    std::ostringstream rows;
    rows.precision(17);
    for (int i = 0; i < 600; ++i) {
      const double z = 2.0 * uniform() - 1.0, angle = 2.0 * M_PI * uniform();
      const double x = std::sqrt(1.0 - z * z) * std::cos(angle);
      const double y = std::sqrt(1.0 - z * z) * std::sin(angle);
      const double far =
          1.0 + (0.5 + 0.02 * number) * x * y + 0.4 * z * z * z + 0.3 * x;
      rows << (pose * Eigen::Vector3d(x * far, y * far, z * far)).transpose() << '\n';
    }
    return rows.str();
  }

  /** \brief The final files, whose bytes do not depend on anything but the run. */
  std::string
  results(const std::string& folder) const
  {
    const std::string table = content(folder + "/results.csv");
    EXPECT_NE("", table);
    return table + content(folder + "/results.jsonl");
  }

  /** \brief The program with a small search, which is the same everywhere. */
  static std::vector<std::string>
  batch(std::vector<std::string> more)
  {
    more.insert(more.begin(),
                {PCL_KSS_ICP_BATCH, "--device", "host", "--points", "300", "--rigid"});
    return more;
  }

  /** \brief The results of an undisturbed run in one thread. */
  std::string
  expected() const
  {
    const Outcome outcome =
        run(batch({"pairs.csv", "--out", "expected", "--threads", "1"}));
    EXPECT_EQ(0, outcome.status) << outcome.errors;
    return results("expected");
  }

  /** \brief How often a journal says that each pair is done. */
  std::vector<int>
  timesDone(const std::string& folder) const
  {
    std::vector<int> times(PAIRS, 0);
    for (const std::string& text : lines(folder + "/journal.jsonl")) {
      const JSON line = JSON::parse(text);
      if (line.contains("done"))
        ++times.at(line["done"].get<std::size_t>() - 1);
    }
    return times;
  }

  /** \brief How often a journal has a text. */
  std::size_t
  timesInJournal(const std::string& folder, const std::string& text) const
  {
    const std::string journal = content(folder + "/journal.jsonl");
    std::size_t number = 0;
    for (std::size_t at = 0; (at = journal.find(text, at)) != journal.npos; ++at)
      ++number;
    return number;
  }
};

} // namespace kss_test
