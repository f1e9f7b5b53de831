/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "models.h"
#include "run.h"

#include <memory>
#include <string>
#include <vector>

namespace evaluation {

/** \brief Makes the cases of runs; keeps the last one, which mostly is the next, too.
 */
class Cases {
public:
  Cases(const std::vector<Model>& models, const Protocol& protocol);

  /** \brief The case of a run on one of the models. */
  std::shared_ptr<const Case>
  of(const Run& run);

private:
  std::vector<Model> models_;
  Protocol protocol_;
  std::string model_, name_;
  std::unique_ptr<Surface> surface_;
  std::shared_ptr<const Case> case_;
};

} // namespace evaluation
