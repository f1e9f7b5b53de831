/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "scans/scan_store.h"

#include "preparation/prepared_cloud.h"
#include "prepared_scan.h"

#include <utility>

namespace pcl {
namespace kss {

ScanStore::ScanStore(std::function<Scan(std::size_t)> make, std::size_t room)
: make_(std::move(make))
, room_(room)
{
}

ScanStore::Scan
ScanStore::get(std::size_t number)
{
  std::promise<Scan> promise;
  std::shared_future<Scan> scan;
  bool is_new = false;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    auto found = kept_.find(number);
    if (found == kept_.end()) {
      is_new = true;
      turns_.push_front(number);
      Kept kept;
      kept.scan = promise.get_future().share();
      kept.turn = turns_.begin();
      found = kept_.emplace(number, std::move(kept)).first;
    }
    turns_.splice(turns_.begin(), turns_, found->second.turn);
    scan = found->second.scan;
  }
  if (is_new)
    try {
      const Scan made = make_(number);
      promise.set_value(made);
      account(number, bytesOf(*made));
    }
    catch (...) {
      promise.set_exception(std::current_exception());
    }
  return scan.get();
}

void
ScanStore::account(std::size_t number, std::size_t bytes)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  kept_[number].bytes = bytes;
  taken_ += bytes;
  for (auto turn = turns_.end(); taken_ > room_ && turn != turns_.begin();) {
    const auto kept = kept_.find(*--turn);
    if (kept->first == number || kept->second.bytes == 0)
      continue;
    taken_ -= kept->second.bytes;
    kept_.erase(kept);
    turn = turns_.erase(turn);
  }
}

std::size_t
bytesOf(const PreparedScan& scan)
{
  const auto surface = [](const Surface& points) {
    return sizeof(float) *
           (points.points.size() + points.neighbourhoods.indices.size() +
            points.neighbourhoods.distances.size());
  };
  // the tree holds the points once more, with their numbers
  const std::size_t tree = 2 * sizeof(float) * scan.local.points.size();
  return sizeof(float) * (scan.local.points.size() + scan.local.normals.size()) + tree +
         sizeof(double) * scan.used.size() + surface(scan.prepared->surface) +
         surface(scan.prepared->dense) +
         sizeof(float) * 5 * scan.prepared->dense.points.cols();
}

} // namespace kss
} // namespace pcl
