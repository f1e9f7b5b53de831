/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "four_points.h"
#include "icp.h"
#include "pcl_methods.h"

#include <pcl/registration/ia_fpcs.h>

#include <cstdlib>

#ifdef _OPENMP
#error "With OpenMP, PCL's FPCS seeds by the clock: compile without it"
#endif

namespace evaluation {
namespace {

using Point = pcl::PointXYZ;

/** \brief PCL seeds by the clock when it begins; here, what is drawn after that follows
 * from the task. To hold, nothing may be drawn before: the number of samples is not
 * set, nor is delta normalised. And this file must not be compiled with OpenMP, with
 * which PCL seeds by the clock once more.
 */
class Fpcs : public pcl::registration::FPCSInitialAlignment<Point, Point> {
public:
  explicit Fpcs(unsigned int seed)
  : seed_(seed)
  {
  }

protected:
  bool
  initCompute() override
  {
    const bool ready = FPCSInitialAlignment::initCompute();
    std::srand(seed_);
    return ready;
  }

private:
  unsigned int seed_;
};

} // namespace

Answer
registerByFpcs(const Task& task)
{
  const CentredPair pair(task);
  const FourPointsPair thinned(pair, 350);

  Fpcs fpcs(task.seed);
  configure(fpcs, thinned, task.overlap, 0.2f, 0.2f);
  Cloud aligned;
  fpcs.align(aligned);

  Answer answer = refine(pair, fpcs.getFinalTransformation(), {});
  answer.claimed = answer.claimed && fpcs.hasConverged();
  return answer;
}

} // namespace evaluation
