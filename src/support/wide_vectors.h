/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

// Compiles a function twice, once with wide vectors for machines that have them; no
// fused multiply-add, so that the bits are the same on every machine.
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__)
#define PCL_KSS_WIDE __attribute__((target_clones("avx2", "default")))
#else
#define PCL_KSS_WIDE
#endif
