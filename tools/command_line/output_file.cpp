/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "output_file.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include <unistd.h>

namespace tool {

namespace fs = std::filesystem;

OutputFile::OutputFile(const std::string& path)
: path_(path)
{
  std::error_code ignored;
  const auto status = fs::status(path, ignored);
  if (fs::is_directory(status))
    throw std::runtime_error(path + ": is a directory");
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    temporary_path_ = path;
    return;
  }
  // The file that a link leads to is replaced, not the link.
  if (fs::exists(status))
    path_ = fs::canonical(path).string();
  temporary_path_ = path_ + '.' + std::to_string(getpid()) + ".part";
  removed_on_signal_.emplace(temporary_path_);

  const SignalsHeld held;
  errno = 0;
  const bool could_replace =
      !fs::exists(status) || std::ofstream(path_, std::ios::app).is_open();
  if (!could_replace || !std::ofstream(temporary_path_).is_open())
    throw std::runtime_error(path + ": cannot be written: " + std::strerror(errno));
  fs::remove(temporary_path_);
}

OutputFile::~OutputFile()
{
  std::error_code ignored;
  if (temporary_path_ != path_)
    fs::remove(temporary_path_, ignored);
}

void
OutputFile::write(const std::function<void(std::ostream&)>& writer)
{
  std::ofstream stream;
  const auto check = [&] {
    if (!stream)
      throw std::runtime_error(path_ + ": cannot be written: " + std::strerror(errno));
  };
  errno = 0;
  {
    const SignalsHeld held;
    stream.open(temporary_path_, std::ios::binary);
  }
  check();
  writer(stream);
  stream.close();
  check();
  written_ = true;
}

void
OutputFile::putInPlace()
{
  if (written_ && temporary_path_ != path_)
    fs::rename(temporary_path_, path_);
}

} // namespace tool
