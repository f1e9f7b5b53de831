/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#ifdef __SSE2__
#include <emmintrin.h>
#endif

// Compiles a function twice, once with wide vectors for machines that have them; no
// fused multiply-add, so that the bits are the same on every machine. Which of the two
// is taken is asked before the thread sanitizer, which would watch it, is there.
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) &&                 \
    !defined(__SANITIZE_THREAD__)
#define PCL_KSS_WIDE __attribute__((target_clones("avx2", "default")))
#else
#define PCL_KSS_WIDE
#endif

namespace pcl {
namespace kss {

/** \brief The floats of a wide vector. */
constexpr int lanes = 8;

/** \brief Which values are less than a bound: a bit for each, from the lowest.
 * \param[in] values a multiple of four
 * \param[in] bound
 */
template <int size>
inline unsigned int
whichBelow(const float (&values)[size], float bound)
{
  static_assert(size % 4 == 0 && size <= 32, "whole vectors, and a bit for each value");
  unsigned int below = 0;
#ifdef __SSE2__
  // compilers make single comparisons of the loop beneath
  const __m128 bounds = _mm_set1_ps(bound);
  for (int i = 0; i < size; i += 4)
    below |= static_cast<unsigned int>(
                 _mm_movemask_ps(_mm_cmplt_ps(_mm_loadu_ps(values + i), bounds)))
             << i;
#else
  for (int i = 0; i < size; ++i)
    below |= values[i] < bound ? 1u << i : 0u;
#endif
  return below;
}

} // namespace kss
} // namespace pcl
