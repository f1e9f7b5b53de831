/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "case.h"
#include "metrics.h"

#include <nlohmann/json.hpp>

#include <string>

namespace evaluation {

/** \brief A line of the log. */
using Record = nlohmann::ordered_json;

/** \brief One method on one case. */
struct Run {
  std::string model;
  Condition condition;
  unsigned int repetition = 0;
  Method method;
  bool scale_given = false; ///< whether the method is told the true scale
};

/** \brief What the log calls a run: model, condition, repetition, method, scale_given.
 */
Record
keyOf(const Run& run);

/** \brief A record as a line of text; what is no UTF-8 in it is replaced. */
std::string
lineOf(const Record& record);

/** \brief The 16 numbers of a matrix, row by row. */
Record
numbersOf(const Eigen::Matrix4d& matrix);

/** \brief Run the method and judge its answer; in a process of its own, since the
 * memory that this takes is measured, too.
 */
Record
performed(const Run& run, const Case& work);

/** \brief The record of a run that has no answer: the clouds stay as they were.
 * \param[in] status "timeout" or "crashed"
 */
Record
unanswered(const Run& run,
           const Case& work,
           const std::string& status,
           const std::string& message);

} // namespace evaluation
