/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "method.h"

/** PCL's registrations, each from the clouds as they are to the final pose. */
namespace evaluation {

/** \brief From where the centroids coincide; without coarse alignment. */
Answer
registerByIcp(const Task& task);

/** \brief The same, with the scale; from where the clouds have the same extent. */
Answer
registerByScalingIcp(const Task& task);

Answer
registerBySacIa(const Task& task);

Answer
registerByPrerejective(const Task& task);

Answer
registerByFpcs(const Task& task);

Answer
registerByKfpcs(const Task& task);

} // namespace evaluation
