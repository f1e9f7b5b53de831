/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "fresh_process.h"

#include "clouds.h"
#include "judgement.h"
#include "process.h"
#include "registration.h"

#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <stdexcept>

namespace benchmarks {
namespace {

const std::string flag = "--fresh-process";

/** \brief In the new process: register, and write what it cost to standard output. */
void
registerAndTell(pcl::kss::Mode mode, std::size_t size)
{
  const Pair& pair = pairOf(size);
  const double resident = residentBytes();
  const double wall = wallSeconds(), cpu = cpuSeconds();

  KSSICP kss_icp;
  kss_icp.setMode(mode);
  kss_icp.setInputSource(pair.source);
  kss_icp.setInputTarget(pair.target);
  Cloud aligned;
  kss_icp.align(aligned);

  const double wall_seconds = wallSeconds() - wall, cpu_seconds = cpuSeconds() - cpu;
  const double peak_bytes = peakResidentBytes() - resident;
  std::cout << isSolved(deviationOf(kss_icp.getFinalTransformation(), pair)) << ' '
            << wall_seconds << ' ' << cpu_seconds << ' ' << peak_bytes << std::endl;
}

/** \brief Replace this process by this program with other arguments. */
[[noreturn]] void
startAnew(pcl::kss::Mode mode, std::size_t size, const std::string& cache)
{
  if (!cache.empty()) {
    setenv("POCL_CACHE_DIR", cache.c_str(), 1);
    setenv("XDG_CACHE_HOME", cache.c_str(), 1);
  }
  execl("/proc/self/exe", "pcl_kss_icp_benchmark", flag.c_str(),
        std::to_string(static_cast<int>(mode)).c_str(), std::to_string(size).c_str(),
        ("--threads=" + std::to_string(options().threads)).c_str(),
        static_cast<char*>(nullptr));
  _exit(127);
}

} // namespace

FirstCall
registerInFreshProcess(pcl::kss::Mode mode, std::size_t size, const std::string& cache)
{
  int ends[2];
  if (pipe(ends) != 0)
    throw std::runtime_error("no pipe");
  const pid_t child = fork();
  if (child < 0)
    throw std::runtime_error("no process");
  if (child == 0) {
    dup2(ends[1], STDOUT_FILENO);
    close(ends[0]);
    close(ends[1]);
    startAnew(mode, size, cache);
  }
  close(ends[1]);

  FirstCall call;
  FILE* answer = fdopen(ends[0], "r");
  int solved = 0;
  const int fields = std::fscanf(answer, "%d %lf %lf %lf", &solved, &call.wall_seconds,
                                 &call.cpu_seconds, &call.peak_bytes);
  std::fclose(answer);
  waitpid(child, nullptr, 0);
  call.solved = fields == 4 && solved != 0;
  return call;
}

bool
isFreshProcess(int argc, char** argv)
{
  if (argc != 4 || argv[1] != flag)
    return false;
  registerAndTell(static_cast<pcl::kss::Mode>(std::atoi(argv[2])),
                  static_cast<std::size_t>(std::atoll(argv[3])));
  return true;
}

} // namespace benchmarks
