/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "shapes.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include <unistd.h>

/** Models of the evaluation's tests, as files. */
namespace kss_test {

inline std::string
textOf(const std::filesystem::path& path)
{
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream content;
  content << stream.rdbuf();
  return content.str();
}

/** \brief A folder of its own, removed at the end. */
class Folder {
public:
  explicit Folder(const std::string& name)
  : path_(std::filesystem::temp_directory_path() /
          ("pcl_kss_icp_" + name + std::to_string(getpid())))
  {
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }

  ~Folder() { std::filesystem::remove_all(path_); }

  Folder(const Folder&) = delete;
  Folder&
  operator=(const Folder&) = delete;

  std::string
  path(const std::string& name = "") const
  {
    return (path_ / name).string();
  }

  /** \brief Write a file. \return its path */
  std::string
  write(const std::string& name, const std::string& content) const
  {
    std::filesystem::create_directories((path_ / name).parent_path());
    std::ofstream(path_ / name, std::ios::binary) << content;
    return path(name);
  }

private:
  std::filesystem::path path_;
};

/** \brief A folder of its own for every test. */
class FolderTest : public ::testing::Test {
protected:
  static std::string
  nameOfTest()
  {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    return std::string(test->test_suite_name()) + test->name();
  }

  Folder folder{nameOfTest()};
};

inline std::string
offOf(const Mesh& mesh)
{
  std::ostringstream text;
  text.precision(17);
  text << "OFF\n" << 3 * mesh.size() << ' ' << mesh.size() << " 0\n";
  for (const Triangle& t : mesh)
    text << t.a.transpose() << '\n'
         << t.b.transpose() << '\n'
         << t.c.transpose() << '\n';
  for (std::size_t i = 0; i < mesh.size(); ++i)
    text << "3 " << 3 * i << ' ' << 3 * i + 1 << ' ' << 3 * i + 2 << '\n';
  return text.str();
}

inline std::string
objOf(const Mesh& mesh)
{
  std::ostringstream text;
  text.precision(9);
  for (const Triangle& t : mesh)
    for (const Eigen::Vector3d& p : {t.a, t.b, t.c})
      text << "v " << p.transpose() << '\n';
  for (std::size_t i = 0; i < mesh.size(); ++i)
    text << "f " << 3 * i + 1 << ' ' << 3 * i + 2 << ' ' << 3 * i + 3 << '\n';
  return text.str();
}

inline std::string
pcdOf(const Points& points)
{
  std::ostringstream text;
  text.precision(9);
  text << "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH "
       << points.cols() << "\nHEIGHT 1\nPOINTS " << points.cols() << "\nDATA ascii\n";
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    text << points.col(i).transpose() << '\n';
  return text.str();
}

} // namespace kss_test
