/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include <pcl/registration/kss/settings.h>

#include "preparation/prepared_cloud.h"

#include <functional>
#include <memory>

namespace pcl {
namespace kss {

/** \brief Two clouds made ready for each other. */
struct PreparedPair {
  std::shared_ptr<const PreparedCloud> source, target;
  /** \brief Whether heavy noise has been averaged away. */
  bool is_noisy = false;
};

/** \brief Two clouds that have been made ready, without the noise of heavily noisy
 * ones.
 */
PreparedPair
pairOf(const std::shared_ptr<const PreparedCloud>& source,
       const std::shared_ptr<const PreparedCloud>& target,
       const Settings& settings);

/** \brief Makes clouds ready, and keeps what it has made of each until another comes in
 * its place.
 */
class Preparation {
public:
  /** \param[in] settings copied */
  explicit Preparation(const Settings& settings);

  /** \brief Two clouds made ready.
   * \param[in] source cloud to be placed
   * \param[in] target cloud to be placed upon
   * \param[in] done told the share of the work that is done
   */
  PreparedPair
  prepared(const LocalCloud& source,
           const LocalCloud& target,
           const std::function<void(double)>& done);

private:
  Settings settings_;
  std::shared_ptr<const PreparedCloud> source_, target_;
};

} // namespace kss
} // namespace pcl
