/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <string>

#include <unistd.h>

namespace kss_test {

/** \brief Gives every test a folder of its own for files. */
class OwnFolder : public ::testing::Test {
protected:
  OwnFolder()
  : directory_(std::filesystem::temp_directory_path() /
               (std::string("pcl_kss_icp_") +
                ::testing::UnitTest::GetInstance()->current_test_info()->name() +
                std::to_string(getpid())))
  {
    std::filesystem::create_directories(directory_);
  }

  ~OwnFolder() override { std::filesystem::remove_all(directory_); }

  std::string
  path(const std::string& name) const
  {
    return (directory_ / name).string();
  }

  /** \brief Write a file. \return its path */
  std::string
  write(const std::string& name, const std::string& content) const
  {
    std::ofstream(path(name), std::ios::binary) << content;
    return path(name);
  }

  /** \brief The names of all files. */
  std::set<std::string>
  files() const
  {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(directory_))
      names.insert(entry.path().filename().string());
    return names;
  }

  const std::filesystem::path directory_;
};

} // namespace kss_test
