/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "described_pair.h"
#include "icp.h"
#include "pcl_methods.h"

#include <pcl/registration/ia_fpcs.h>
#include <pcl/registration/ia_kfpcs.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#ifdef _OPENMP
#error "With OpenMP, PCL's FPCS seeds by the clock: compile without it"
#endif

namespace evaluation {
namespace {

using Point = pcl::PointXYZ;

/** \brief Thin to at most so many points.
 * \param[in] leaf where to begin
 * \return where it ended
 */
float
thinTo(const Cloud::ConstPtr& cloud,
       std::size_t points,
       float leaf,
       benchmarks::Described& result)
{
  benchmarks::thin(cloud, leaf, result);
  while (result.points->size() > points) {
    leaf *= 1.1f;
    benchmarks::thin(cloud, leaf, result);
  }
  return leaf;
}

/** \brief How many times four points are tried: the smaller the overlap, the less often
 * all of them lie in what both clouds show.
 */
int
trialsFor(double overlap)
{
  return std::clamp(static_cast<int>(20.0 / std::pow(overlap, 4)), 20, 600);
}

/** \brief Register by four points of the target that are looked for in the source,
 * among all pairs of its points: the work grows with the fourth power of their number.
 * The target may have more, so that aligned points are near a neighbour.
 * \param[in] delta how exactly points lie on each other, in leaves of the source
 * \param[in] score by which it ends early; 0 is perfect, 1 useless
 */
template <typename Registration>
Answer
registerByFourPoints(const Task& task, float delta, float score)
{
  constexpr std::size_t points = 350;
  const CentredPair pair(task);
  const float smallest = leafFor(pair);
  benchmarks::Described source, target;
  const float leaf = thinTo(pair.source, points, smallest, source);
  thinTo(pair.target, 5 * points, 0.5f * smallest, target);
  benchmarks::estimateNormals(2.0f * smallest, source);
  benchmarks::estimateNormals(2.0f * smallest, target);

  Registration registration(task.seed);
  registration.setInputSource(source.points);
  registration.setInputTarget(target.points);
  registration.setSourceNormals(source.normals);
  registration.setTargetNormals(target.normals);
  registration.setMaxNormalDifference(15.0f);
  registration.setApproxOverlap(static_cast<float>(std::min(task.overlap, 0.9)));
  registration.setDelta(delta * leaf, false);
  registration.setScoreThreshold(score);
  registration.setMaximumIterations(trialsFor(task.overlap));
  return alignAndRefine(registration, pair);
}

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

/** \brief The same. The points on which KFPCS judges a pose are drawn before; here, all
 * points judge.
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
registerByFpcs(const Task& task)
{
  return registerByFourPoints<Fpcs>(task, 0.2f, 0.2f);
}

Answer
registerByKfpcs(const Task& task)
{
  return registerByFourPoints<Kfpcs>(task, 0.15f, 0.05f);
}

} // namespace evaluation
