/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * The line that shows how far the work has come.
 */

#include "command_line/progress_bar.h"
#include "command_line/quantities.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace {

using namespace tool;

TEST(ProgressLine, HasRoomForTheTimeThatIsLeft)
{
  const std::string line =
      progressLine("joint refinement", 0.5, 80, timeText(3599) + " left");
  EXPECT_EQ(79u, line.size());
  EXPECT_EQ(0u, line.find("joint refinement  [====")) << line;
  EXPECT_NE(std::string::npos, line.find("]  50 %, 59 min 59 s left")) << line;
  // the bar keeps its length
  EXPECT_EQ(line.find(']'),
            progressLine("joint refinement", 0.5, 80, "1 s left").find(']'));
  for (const std::size_t columns : {1, 2, 20, 30, 45, 200})
    EXPECT_LT(progressLine("joint refinement", 0.5, columns, "1 s left").size(),
              std::max<std::size_t>(columns, 2));
}

TEST(ProgressLine, TimesAreShort)
{
  EXPECT_EQ("0 s", timeText(0.2));
  EXPECT_EQ("1 min 5 s", timeText(65.3));
  EXPECT_EQ("27 h 46 min", timeText(1e5));
}

} // namespace
