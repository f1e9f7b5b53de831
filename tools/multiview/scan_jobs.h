/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#pragma once

#include "crew/crew.h"

#include <pcl/registration/kss/scan_work.h>

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace tool {

/** \brief Does what is done with scans, as jobs that can travel between processes. */
JobHandler
handlerOf(pcl::kss::ScanWorker& worker);

/** \brief What has been done before, and is to be remembered. */
class ScanJournal;

/** \brief A crew of the library around one of the program's. */
class ScanJobs : public pcl::kss::ScanCrew {
public:
  /** \param[in] crew does the jobs; kept by reference
   * \param[in] journal knows those that have been done; kept by reference
   */
  ScanJobs(Crew& crew, ScanJournal& journal);

  void
  work(const std::vector<pcl::kss::ScanTask>& tasks,
       const std::function<void(std::size_t, pcl::kss::ScanAnswer)>& done) override;

  /** \brief How many of each kind have been done, known ones aside. */
  const std::map<pcl::kss::ScanTask::Kind, std::size_t>&
  counts() const
  {
    return counts_;
  }

private:
  Crew& crew_;
  ScanJournal& journal_;
  std::map<pcl::kss::ScanTask::Kind, std::size_t> counts_;
};

} // namespace tool
