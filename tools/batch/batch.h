/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "batch_options.h"
#include "batch_progress.h"
#include "crew/crew.h"
#include "journal.h"
#include "manifest.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace tool {

/** \brief All pairs of a manifest, some of which an earlier start may have done. */
class Batch {
public:
  /** \brief Read the manifest, and what there is in the folder of the results.
   * \throws std::runtime_error where either is wrong, or they do not belong together
   */
  explicit Batch(const BatchOptions& options);

  /** \brief Have the crew do all that is not done yet. */
  void
  run(Crew& crew);

  /** \brief Write the results, and say how many pairs came to what.
   * \return whether all are registered
   */
  bool
  conclude();

private:
  /** \brief Look at the pairs that are done: those that failed are tried again, unless
   * the program died of them; and where others have other files now, it does not go on.
   */
  void
  checkDone();

  /** \brief Pass over the pairs that the program has died of too often, and do those
   * that it seems to die of one by one, so that others do not die with them. */
  void
  runSuspects(Crew& crew);

  void
  run(Crew& crew, const std::vector<std::size_t>& pairs);

  void
  keep(std::size_t pair, const JobAnswer& answer);

  const BatchOptions options_;
  const Manifest manifest_;
  /** \brief Where relative paths of the manifest begin. */
  const std::string manifest_folder_;
  std::optional<Journal> journal_;
  std::optional<BatchProgress> progress_;
};

} // namespace tool
