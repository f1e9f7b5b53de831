/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "four_points.h"
#include "icp.h"
#include "pcl_methods.h"

#include <pcl/registration/ia_kfpcs.h>

#include <cstdlib>

#ifdef _OPENMP
#error "With OpenMP, PCL's FPCS seeds by the clock: compile without it"
#endif

namespace evaluation {
namespace {

using Point = pcl::PointXYZ;

/** \brief As for FPCS, what is drawn follows from the task instead of the clock. The
 * points on which KFPCS judges a pose are drawn before; here, all points judge.
 */
class Kfpcs : public pcl::registration::KFPCSInitialAlignment<Point, Point> {
public:
  explicit Kfpcs(unsigned int seed)
  : seed_(seed)
  {
  }

protected:
  bool
  initCompute() override
  {
    const bool ready = KFPCSInitialAlignment::initCompute();
    indices_validation_ = indices_;
    std::srand(seed_);
    return ready;
  }

private:
  unsigned int seed_;
};

} // namespace

Answer
registerByKfpcs(const Task& task)
{
  const CentredPair pair(task);
  const FourPointsPair thinned(pair, 350);

  Kfpcs kfpcs(task.seed);
  configure(kfpcs, thinned, task.overlap, 0.15f, 0.05f);
  Cloud aligned;
  kfpcs.align(aligned);

  Answer answer = refine(pair, kfpcs.getFinalTransformation(), {});
  answer.claimed = answer.claimed && kfpcs.hasConverged();
  return answer;
}

} // namespace evaluation
