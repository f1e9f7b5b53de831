/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

/** What the running process has used so far. */
namespace benchmarks {

/** \brief CPU time of all threads, in seconds. */
double
cpuSeconds();

/** \brief Wall time, in seconds, from some fixed moment on. */
double
wallSeconds();

/** \brief Memory in use now: the resident set, in bytes. */
double
residentBytes();

/** \brief The largest resident set that there has been, in bytes. */
double
peakResidentBytes();

} // namespace benchmarks
