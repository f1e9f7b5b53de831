/*
 * SPDX-License-Identifier: BSD-3-Clause
 */

#include "preparation/cleaning.h"

#include "geometry/cell_grid.h"
#include "geometry/clouds.h"
#include "geometry/median.h"
#include "geometry/neighbourhoods.h"
#include "geometry/take.h"
#include "preparation/simplification.h"
#include "support/parallel.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <vector>

namespace pcl {
namespace kss {
namespace {

/** Neighbours that tell how sparse a place is, and how flat. */
constexpr int sparse_neighbours = 12;
constexpr int flat_neighbours = 16;

/** Space around a point against that around its neighbours: random points of even
 * density stay below 1.4, those in the open beside a surface reach twice this. */
constexpr float isolated = 1.6f;

/** Space around a point against the median of the cloud from which on it is sparse. */
constexpr float sparse = 2.5f;

/** Surface variation, mean of a neighbourhood: random points in space have 0.16,
 * surfaces rarely more than 0.05. */
constexpr float fills_space = 0.09f;

/** Surface variation, median, from which on the noise is heavy: thin and winding
 * surfaces reach 0.1. */
constexpr float heavy = 0.125f;

/** Clouds smaller than this are left alone: they cannot spare a point. */
constexpr Eigen::Index small = 100;

std::vector<int>
notStray(const Points& cloud, const Neighbourhoods& found, unsigned int threads)
{
  const Eigen::VectorXf variation = surfaceVariation(cloud, found, threads);
  const Eigen::VectorXf room = found.distances.row(sparse_neighbours - 1);
  const float usual = median(room);

  std::vector<int> kept;
  for (int i = 0; i < cloud.cols(); ++i) {
    // isolated: more room than so many times the median around it has
    int roomier = 0, some_have_room = 0;
    float flatness = variation[i];
    for (int n = 0; n < flat_neighbours; ++n) {
      const int other = found.indices(n, i);
      roomier += room[i] > isolated * room[other];
      some_have_room += room[other] > 0.0f;
      flatness += variation[other];
    }
    flatness /= 1 + flat_neighbours;
    constexpr int half = flat_neighbours / 2;
    const bool is_isolated = roomier > half && some_have_room >= flat_neighbours - half;
    if (!is_isolated && (room[i] <= sparse * usual || flatness < fills_space))
      kept.push_back(i);
  }
  return kept;
}

/** The mean of the points within a radius of each position. */
Points
meansAround(const Points& positions,
            const Points& cloud,
            float radius,
            unsigned int threads)
{
  const CellGrid grid(cloud, radius);
  Points means(3, positions.cols());
  inParallel(positions.cols(), threads, 64, [&](Eigen::Index i) {
    const Eigen::Vector3f position = positions.col(i);
    const Cell cell = grid.cells().of(position);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    int inside = 0;
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y)
        for (int z = -1; z <= 1; ++z) {
          const int other = grid.find(cell + Cell(x, y, z));
          if (other >= 0)
            for (int p = grid.begin(other); p < grid.begin(other + 1); ++p) {
              const Eigen::Vector3f point = cloud.col(grid.order()[p]);
              if ((point - position).squaredNorm() <= radius * radius) {
                sum += point.cast<double>();
                ++inside;
              }
            }
        }
    means.col(i) = (sum / inside).cast<float>();
  });
  return means;
}

/** The median of the surface variation. */
float
usualVariation(const Points& cloud, unsigned int threads)
{
  return median(surfaceVariation(
      cloud, neighbourhoodsOf(cloud, flat_neighbours, threads), threads));
}

/** Every fourth point: their neighbourhoods are twice as wide. */
Points
quarterOf(const Points& cloud)
{
  return cloud(Eigen::all, Eigen::seqN(0, cloud.cols() / 4, 4));
}

/** A hash of three coordinates; -0 is 0. */
std::size_t
hashOf(const float* point)
{
  std::uint64_t hash = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const float coordinate = point[axis] + 0.0f;
    std::uint32_t bits;
    std::memcpy(&bits, &coordinate, sizeof bits);
    hash = (hash ^ bits) * 0x9e3779b97f4a7c15u;
    hash ^= hash >> 32;
  }
  return hash;
}

} // namespace

Points
withoutCopies(const Points& cloud)
{
  // open addressing; each place is that of the first point that has come to it
  std::size_t size = 64;
  while (size < 2 * static_cast<std::size_t>(cloud.cols()))
    size *= 2;
  std::vector<int> first(size, -1);
  std::vector<int> kept;
  kept.reserve(cloud.cols());
  for (int i = 0; i < cloud.cols(); ++i) {
    std::size_t slot = hashOf(cloud.data() + 3 * i) & (size - 1);
    while (first[slot] >= 0 && cloud.col(first[slot]) != cloud.col(i))
      slot = (slot + 1) & (size - 1);
    if (first[slot] >= 0)
      continue;
    first[slot] = i;
    kept.push_back(i);
  }
  return static_cast<Eigen::Index>(kept.size()) == cloud.cols() ? cloud
                                                                : take(cloud, kept);
}

Surface
withoutStrayPoints(const Points& cloud, unsigned int threads)
{
  // A second look finds those that the first one hid.
  Surface rest{cloud, neighbourhoodsOf(cloud, flat_neighbours, threads)};
  if (cloud.cols() < small)
    return rest;
  for (int look = 0; look < 2; ++look) {
    const auto kept = notStray(rest.points, rest.neighbourhoods, threads);
    if (static_cast<Eigen::Index>(kept.size()) == rest.points.cols())
      break;
    const bool few = kept.size() > 0.998 * rest.points.cols();
    if (kept.size() <= std::max<double>(small, 0.3 * cloud.cols()))
      return {cloud, neighbourhoodsOf(cloud, flat_neighbours, threads)};
    rest.points = take(rest.points, kept);
    rest.neighbourhoods =
        withoutOthers(rest.neighbourhoods, kept, rest.points, threads);
    if (few)
      break;
  }
  return rest;
}

bool
isNoisy(const Surface& surface, unsigned int threads)
{
  // the two skins of a wall fill space from afar, and are surfaces from close by
  const auto& [points, neighbourhoods] = surface;
  return points.cols() >= 4 * small &&
         median(surfaceVariation(points, neighbourhoods, threads)) > heavy &&
         usualVariation(quarterOf(points), threads) > heavy;
}

void
averageNoise(Points& source, Points& target, unsigned int samples, unsigned int threads)
{
  struct Averaging {
    Averaging(const Points& noisy, unsigned int samples, unsigned int threads)
    : cloud(noisy)
    , at(simplify(noisy, samples, Density::UNIFORM, threads))
    , size(rootMeanSquareRadius(noisy, noisy.rowwise().mean()))
    {
    }
    const Points& cloud;
    Points at;
    float size;
  };
  const Averaging a(source, samples, threads), b(target, samples, threads);
  Points means_a, means_b;
  for (float radius = 0.1f; radius < 0.26f; radius *= 1.25f) {
    means_a = meansAround(a.at, a.cloud, radius * a.size, threads);
    means_b = meansAround(b.at, b.cloud, radius * b.size, threads);
    if (std::max(usualVariation(means_a, threads), usualVariation(means_b, threads)) <
        fills_space)
      break;
  }
  source = means_a;
  target = means_b;
}

} // namespace kss
} // namespace pcl
