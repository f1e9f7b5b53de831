/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <cstdio>
#include <cstdlib>

/** \brief What has to hold for every input: else the input is a finding. */
#define KSS_FUZZ_REQUIRE(condition)                                                    \
  do {                                                                                 \
    if (!(condition)) {                                                                \
      std::fprintf(stderr, "%s:%d: does not hold: %s\n", __FILE__, __LINE__,           \
                   #condition);                                                        \
      std::abort();                                                                    \
    }                                                                                  \
  } while (false)
