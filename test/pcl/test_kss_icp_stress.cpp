/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * A thousand registrations in eight threads, a third of which are disturbed: each is
 * right, or refused with a reason, and memory does not grow.
 */

#include "faults/opencl_faults.h"
#include "faults/thread_faults.h"
#include "pairs.h"

#include <array>
#include <atomic>
#include <fstream>
#include <limits>
#include <thread>

#include <malloc.h>
#include <unistd.h>

namespace {

using namespace kss_test;
using pcl::kss::FailureCause;
using KSSICP = pcl::KSSICP<pcl::PointXYZ, pcl::PointXYZ>;
using Cloud = pcl::PointCloud<pcl::PointXYZ>;

constexpr int threads = 8, calls = 125, pairs = 5;

enum Fault {
  DEVICE_FAILS,
  NO_THREADS,
  CANCELLED,
  TIME_IS_UP,
  CALLBACK_THROWS,
  BAD_GUESS
};
constexpr int faults = BAD_GUESS + 1;

/** Megabytes of the process that lie in memory. */
double
residentMegabytes()
{
  malloc_trim(0);
  std::ifstream file("/proc/self/statm");
  long size = 0, resident = 0;
  file >> size >> resident;
  return static_cast<double>(resident) * static_cast<double>(sysconf(_SC_PAGESIZE)) /
         1e6;
}

/** What came of all calls. */
struct Counts {
  std::atomic<int> right{0}, wrong{0}, refused{0}, without_reason{0};
  std::array<std::atomic<int>, faults> disturbed{};
};

/** One registration; \a fault: none if negative. */
void
registerOnce(
    KSSICP& registration, const Pair<>& pair, int fault, int call, Counts& counts)
{
  setClouds(registration, pair);
  registration.setProgressCallback({});
  registration.setTimeLimit(0.0);
  Eigen::Matrix4f guess = Eigen::Matrix4f::Identity();
  std::unique_ptr<ThreadFaults> no_threads;
  std::atomic<int> reports{0};
  switch (fault) {
  case DEVICE_FAILS:
    failAt(1 + call % 60, call % 2 ? -5 : -4);
    break;
  case NO_THREADS:
    no_threads = std::make_unique<ThreadFaults>(call % 2);
    break;
  case CANCELLED:
    registration.setProgressCallback([&](const std::string&, double) {
      if (reports++ == call % 12)
        registration.cancel();
    });
    break;
  case TIME_IS_UP:
    registration.setTimeLimit(1e-4 * (1 + call % 50));
    break;
  case CALLBACK_THROWS:
    registration.setProgressCallback([&](const std::string&, double) {
      if (reports++ == call % 10)
        throw call;
    });
    break;
  case BAD_GUESS:
    guess(call % 3, call % 4) =
        call % 2 ? std::numeric_limits<float>::quiet_NaN() : 1e38f;
    break;
  default:
    break;
  }
  if (fault >= 0)
    ++counts.disturbed[fault];
  Cloud output;
  registration.align(output, guess);
  if (registration.hasConverged()) {
    const bool is_right =
        displacement(poseFrom(registration), pair.truth, pointsOf(*pair.source)) < 0.01;
    ++(is_right ? counts.right : counts.wrong);
  }
  else {
    ++counts.refused;
    counts.without_reason += registration.getFailureReason().empty() ||
                             registration.getFailureCause() == FailureCause::NONE;
    // the host and fewer threads do the same work
    if (fault < 0 || fault == DEVICE_FAILS || fault == NO_THREADS)
      ADD_FAILURE() << fault << ": " << registration.getFailureReason();
  }
}

TEST(Stress, AThousandRegistrationsOfWhichAThirdAreDisturbed)
{
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  std::vector<Pair<>> all;
  for (unsigned int seed = 1; seed <= pairs; ++seed)
    all.push_back(pairOf(randomSimilarity(seed), seed));
  Counts counts;
  KSSICP first; // a driver that comes up while there are no threads ends the process
  registerOnce(first, all.front(), -1, 0, counts);
  const auto round = [&](int number) {
    std::vector<std::thread> workers;
    std::atomic<bool> all_started{false}; // these threads must not be refused
    for (int t = 0; t < threads; ++t)
      workers.emplace_back([&, t] {
        while (!all_started)
          std::this_thread::yield();
        KSSICP registration;
        registration.setMode(pcl::kss::Mode::GLOBAL_GLOBAL);
        set(registration, &pcl::kss::Settings::sample_points, 200);
        for (int i = 0; i < number; ++i)
          registerOnce(registration, all[(t + i) % pairs],
                       i % 3 == 0 ? (t + i / 3) % faults : -1, t + threads * i, counts);
      });
    all_started = true;
    for (std::thread& worker : workers)
      worker.join();
    failAt(0);
  };
  round(calls / 5); // everything that is made once
  const double before = residentMegabytes();
  const long objects = liveObjects();
  round(calls - calls / 5);
  const double after = residentMegabytes();
  std::cout << counts.right << " right, " << counts.refused << " refused, "
            << counts.wrong << " wrong; " << before << " MB, then " << after << " MB\n";
  EXPECT_EQ(1 + threads * calls, counts.right + counts.refused);
  EXPECT_EQ(0, counts.wrong);
  EXPECT_EQ(0, counts.without_reason);
  for (const auto& number : counts.disturbed)
    EXPECT_GT(number, 20);
  EXPECT_LE(liveObjects(), objects + 8); // a program that is built anew
  EXPECT_LT(after, 1.1 * before + 10.0);
}

} // namespace
