/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * Distances, both ways, between the target and the source placed by each candidate,
 * from all pairs of points: E_d of (e9) and E_cd of (e122). One work-item per
 * candidate, no local memory, no barrier.
 *
 * The target lies in tiles of eight points, x, y and z apart, so that a CPU fills its
 * vectors with target points; on a GPU the eight lanes are independent instructions.
 * Four placed source points are held against each tile while it is in registers. Both
 * directions come from one pass: `column` gathers the minima of the four source points,
 * and nearest[] those of the target points.
 */

#include "common.cl"

inline float8
squared_distance(float8 x, float8 y, float8 z, float4 p)
{
  const float8 dx = x - p.x;
  const float8 dy = y - p.y;
  const float8 dz = z - p.z;
  return dx * dx + dy * dy + dz * dz;
}

/* The squared distances of four placed source points to their nearest target points; on
 * the way, those of the target points are brought down to the distances from them.
 */
inline float4
meet(global const float8* restrict target_x,
     global const float8* restrict target_y,
     global const float8* restrict target_z,
     uint tiles,
     float4 a,
     float4 b,
     float4 c,
     float4 d,
     global float8* restrict nearest)
{
  float8 column_a = (float8)(MAXFLOAT);
  float8 column_b = column_a;
  float8 column_c = column_a;
  float8 column_d = column_a;
  for (uint t = 0; t < tiles; ++t) {
    const float8 x = target_x[t];
    const float8 y = target_y[t];
    const float8 z = target_z[t];
    const float8 to_a = squared_distance(x, y, z, a);
    const float8 to_b = squared_distance(x, y, z, b);
    const float8 to_c = squared_distance(x, y, z, c);
    const float8 to_d = squared_distance(x, y, z, d);
    column_a = min(column_a, to_a);
    column_b = min(column_b, to_b);
    column_c = min(column_c, to_c);
    column_d = min(column_d, to_d);
    nearest[t] = min(nearest[t], min(min(to_a, to_b), min(to_c, to_d)));
  }
  return (float4)(smallest_of_eight(column_a), smallest_of_eight(column_b),
                  smallest_of_eight(column_c), smallest_of_eight(column_d));
}

/* target_*: the target in tiles, the last one filled up with copies of the last point
 * source: x, y, z, 1 per point, filled up to a multiple of four with copies of the last
 * candidates: the three rows of a 3x4 similarity per candidate
 * limit: what a distance counts in the means at most
 * nearest: scratch, tiles x candidates; written before it is read
 * distances: per candidate max and mean source to target, max and mean target to source
 */
kernel void
pair_distances(global const float8* restrict target_x,
               global const float8* restrict target_y,
               global const float8* restrict target_z,
               const uint target_points,
               global const float4* restrict source,
               const uint source_points,
               global const float4* restrict candidates,
               const uint number_of_candidates,
               const float limit,
               global float8* restrict nearest,
               global float4* restrict distances)
{
  const uint candidate = get_global_id(0);
  if (candidate >= number_of_candidates)
    return;
  const Placement placement = placement_at(candidates, candidate);
  const uint tiles = (target_points + 7) / 8;
  global float8* restrict row = nearest + (size_t)candidate * tiles;
  for (uint t = 0; t < tiles; ++t)
    row[t] = (float8)(MAXFLOAT);

  float farthest_source = 0.0f;
  float sum_source = 0.0f;
  for (uint i = 0; i < source_points; i += 4) {
    const float4 a = place(placement, source[i]);
    const float4 b = place(placement, source[i + 1]);
    const float4 c = place(placement, source[i + 2]);
    const float4 d = place(placement, source[i + 3]);
    const float4 column = meet(target_x, target_y, target_z, tiles, a, b, c, d, row);
    farthest_source = max(farthest_source, largest_of_four(column));
    /* the copies that fill up the last four do not count in the mean */
    const float4 length =
        select((float4)(0.0f), min(sqrt(column), limit),
               (uint4)(i, i + 1, i + 2, i + 3) < (uint4)(source_points));
    sum_source += sum_of_four(length);
  }

  const uint8 lane = (uint8)(0, 1, 2, 3, 4, 5, 6, 7);
  float8 farthest = (float8)(0.0f);
  float8 sums = (float8)(0.0f);
  for (uint t = 0; t < tiles; ++t) {
    const float8 squared = row[t];
    farthest = max(farthest, squared);
    sums += select((float8)(0.0f), min(sqrt(squared), limit),
                   lane + 8 * t < (uint8)(target_points));
  }
  distances[candidate] =
      (float4)(sqrt(farthest_source), sum_source / source_points,
               sqrt(largest_of_eight(farthest)), sum_of_eight(sums) / target_points);
}
