/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "opencl/dispatches.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>
#include <vector>

namespace {

using namespace pcl::kss;

struct Piece {
  std::size_t begin, end;
};

/** The pieces of some work whose items take so long. */
std::vector<Piece>
piecesOf(Dispatches& dispatches,
         const DispatchLimits& limits,
         std::size_t size,
         std::size_t bytes,
         double operations,
         double seconds)
{
  std::vector<Piece> pieces;
  dispatches.run(
      limits, size, bytes, operations, [&](std::size_t begin, std::size_t end) {
        pieces.push_back({begin, end});
        std::this_thread::sleep_for(
            std::chrono::duration<double>(seconds * static_cast<double>(end - begin)));
      });
  std::size_t reached = 0;
  for (const Piece& piece : pieces) {
    EXPECT_EQ(reached, piece.begin);
    EXPECT_LT(piece.begin, piece.end);
    reached = piece.end;
  }
  EXPECT_EQ(size, reached);
  return pieces;
}

TEST(Dispatches, FitTheMemory)
{
  for (const std::size_t size : {0u, 1u, 99u, 100u, 101u, 1000u}) {
    Dispatches dispatches;
    const auto pieces = piecesOf(dispatches, {1000, 1}, size, 10, 1.0, 0.0);
    EXPECT_EQ((size + 99) / 100, pieces.size());
    for (const Piece& piece : pieces)
      EXPECT_LE(piece.end - piece.begin, 100u);
  }
  // an item that does not fit is tried alone; more items than fit 32 bits are counted
  Dispatches dispatches;
  EXPECT_EQ(3u, piecesOf(dispatches, {1000, 8}, 3, 5000, 1.0, 0.0).size());
  EXPECT_EQ(10u, piecesOf(dispatches, {std::size_t(1) << 40, 1}, std::size_t(10) << 32,
                          256, 1e-9, 0.0)
                     .size());
}

TEST(Dispatches, TakeATenthOfASecondHoweverFastTheDevice)
{
  // sleep_for() takes no less time than it is told: no piece is larger than asked for
  Dispatches dispatches;
  constexpr double slow = 1e-3, fast = 1e-6;
  auto pieces = piecesOf(dispatches, {1 << 30, 1}, 300, 1, 1e6, slow);
  for (const Piece& piece : pieces)
    EXPECT_LE(piece.end - piece.begin, 100u);
  EXPECT_LE(pieces.size(), 15u);
  // it is told of a faster one by the first piece
  pieces = piecesOf(dispatches, {1 << 30, 1}, 300000, 1, 1e6, fast);
  ASSERT_GE(pieces.size(), 4u);
  EXPECT_LE(pieces[0].end, 100u);
  for (const Piece& piece : pieces)
    EXPECT_LE(piece.end - piece.begin, 100000u);
  EXPECT_LE(pieces.size(), 60u);
  // what is done at once anyway is done at once
  Dispatches at_once;
  EXPECT_EQ(1u, piecesOf(at_once, {1 << 30, 4000}, 4000, 1, 1e9, 0.0).size());
}

TEST(Dispatches, AreStoppedInBetween)
{
  StopSignal signal;
  const HeedingSignal heeding(&signal);
  int pieces = 0;
  Dispatches dispatches;
  EXPECT_THROW(dispatches.run({1000, 1}, 1000, 10, 1.0,
                              [&](std::size_t, std::size_t) {
                                if (++pieces == 3)
                                  signal.cancel();
                              }),
               Stopped);
  EXPECT_EQ(3, pieces);
}

} // namespace
