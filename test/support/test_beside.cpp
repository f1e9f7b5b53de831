/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "support/beside.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <thread>

namespace {

using namespace pcl::kss;

struct Maker {
  std::thread::id* by;
  int* times;

  std::unique_ptr<int>
  operator()() const
  {
    *by = std::this_thread::get_id();
    ++*times;
    return std::make_unique<int>(7);
  }
};

TEST(Beside, IsMadeOnceByAnotherThread)
{
  std::thread::id by;
  int times = 0;
  Beside<int> value(2, Maker{&by, &times});
  EXPECT_EQ(7, value.get());
  EXPECT_EQ(7, ++value.get() - 1);
  EXPECT_EQ(8, value.get());
  EXPECT_EQ(1, times);
  EXPECT_NE(std::this_thread::get_id(), by);
}

TEST(Beside, IsMadeWhenNeededWhereThereIsOneThread)
{
  std::thread::id by;
  int times = 0;
  Beside<int> value(1, Maker{&by, &times});
  EXPECT_EQ(0, times);
  EXPECT_EQ(7, value.get());
  EXPECT_EQ(std::this_thread::get_id(), by);
}

TEST(Beside, ThrowsWhatMakingItThrows)
{
  for (const unsigned int threads : {1u, 2u}) {
    Beside<int> value(threads, []() -> std::unique_ptr<int> {
      throw std::invalid_argument("no device");
    });
    EXPECT_THROW(value.get(), std::invalid_argument);
  }
}

} // namespace
