/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "viewer.h"

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace tool {
namespace {

namespace fs = std::filesystem;

/** The viewer, which is installed beside the tool. */
fs::path
viewerPath()
{
  return fs::read_symlink("/proc/self/exe").parent_path() / "pcl_kss_icp_view";
}

bool
isSet(const char* variable)
{
  const char* const value = std::getenv(variable);
  return value && *value;
}

[[noreturn]] void
fail(const std::string& problem)
{
  throw std::runtime_error("--view: " + problem);
}

/** A pipe whose ends are closed. */
class Pipe {
public:
  Pipe()
  {
    if (pipe(ends_.data()) != 0)
      fail(std::strerror(errno));
  }

  ~Pipe()
  {
    for (int end = 0; end < 2; ++end)
      close(end);
  }

  Pipe(const Pipe&) = delete;
  Pipe&
  operator=(const Pipe&) = delete;

  /** \param[in] end 0: from which is read, 1: to which is written */
  void
  close(int end)
  {
    if (ends_[end] >= 0)
      ::close(ends_[end]);
    ends_[end] = -1;
  }

  int
  operator[](int end) const
  {
    return ends_[end];
  }

private:
  std::array<int, 2> ends_{-1, -1};
};

/** Write as much as the other end reads. */
void
writeAll(int file, const std::string& text)
{
  for (std::size_t written = 0; written < text.size();) {
    const ssize_t more = write(file, text.data() + written, text.size() - written);
    if (more < 0 && errno == EINTR)
      continue;
    if (more <= 0)
      return; // it has ended, which its status tells
    written += static_cast<std::size_t>(more);
  }
}

} // namespace

void
checkViewer()
{
  if (access(viewerPath().c_str(), X_OK) != 0)
    fail("there is no " + viewerPath().string() +
         ", which is built where PCL has its visualization; --picture FILE needs none");
  if (!isSet("DISPLAY") && !isSet("WAYLAND_DISPLAY"))
    fail("there is no display (DISPLAY is not set); --picture FILE needs none");
}

void
showInWindow(const Options& options, const std::string& report)
{
  Pipe pipe;
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, pipe[0], STDIN_FILENO);
  posix_spawn_file_actions_addclose(&actions, pipe[1]);
  const std::string path = viewerPath().string();
  std::string name = path, source = options.source, target = options.target, from = "-";
  char* const arguments[] = {name.data(), source.data(), target.data(), from.data(),
                             nullptr};
  pid_t viewer = 0;
  const int error =
      posix_spawn(&viewer, path.c_str(), &actions, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0)
    fail(path + ": " + std::strerror(error));
  pipe.close(0);
  writeAll(pipe[1], report);
  pipe.close(1);
  int status = 0;
  while (waitpid(viewer, &status, 0) < 0 && errno == EINTR)
    ;
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
    fail("the window could not be shown; --picture FILE needs none");
}

} // namespace tool
