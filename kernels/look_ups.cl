/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * Distances between the target and the source placed by each candidate, looked up in
 * distance fields: what the truncated means, which take the place of E_d of (e9) and
 * E_cd of (e122), are made of. One work-item per candidate, as in Algorithm 2 of the
 * paper; vectors across eight points, their coordinates apart.
 */

#include "common.cl"

/* The distances of eight positions, in cells from the lower corner of the grid; beyond
 * it, those of its border. */
inline float8
look_up(global const float* restrict field, int4 size, float8 x, float8 y, float8 z)
{
  const float8 cell_x = trunc(clamp(x, 0.0f, size.x - 1.0f));
  const float8 cell_y = trunc(clamp(y, 0.0f, size.y - 1.0f));
  const float8 cell_z = trunc(clamp(z, 0.0f, size.z - 1.0f));
  /* floats count cells exactly: there are fewer than 2^24 */
  const int8 cell =
      convert_int8((cell_z * (float)size.y + cell_y) * (float)size.x + cell_x);
  return (float8)(field[cell.s0], field[cell.s1], field[cell.s2], field[cell.s3],
                  field[cell.s4], field[cell.s5], field[cell.s6], field[cell.s7]);
}

/* The largest and the mean distance of points placed by three rows of a matrix. */
inline float2
distances_from(global const float8* restrict xs,
               global const float8* restrict ys,
               global const float8* restrict zs,
               uint points,
               float4 row_x,
               float4 row_y,
               float4 row_z,
               global const float* restrict field,
               float4 lower, /* w: one over the edge of a cell */
               int4 size,
               float limit)
{
  const uint8 lane = (uint8)(0, 1, 2, 3, 4, 5, 6, 7);
  row_x = to_cells(row_x, lower.x, lower.w);
  row_y = to_cells(row_y, lower.y, lower.w);
  row_z = to_cells(row_z, lower.z, lower.w);
  float8 farthest = (float8)(0.0f);
  float8 sums = (float8)(0.0f);
  for (uint t = 0; t < (points + 7) / 8; ++t) {
    const float8 x = xs[t];
    const float8 y = ys[t];
    const float8 z = zs[t];
    const float8 d = look_up(field, size, place_eight(row_x, x, y, z),
                             place_eight(row_y, x, y, z), place_eight(row_z, x, y, z));
    farthest = max(farthest, d);
    /* the copies that fill up the last tile do not count */
    sums += select((float8)(0.0f), min(d, limit), lane + 8 * t < (uint8)(points));
  }
  return (float2)(largest_of_eight(farthest), sum_of_eight(sums) / points);
}

/* source_*, target_*: points in tiles of eight, the last one filled up with copies
 * *_field, *_lower, *_size: the distance field of each cloud
 * candidates: the three rows of a 3x4 similarity per candidate
 * limit: what a distance counts in the means at most
 * distances: per candidate max and mean source to target, max and mean target to source
 */
kernel void
look_ups(global const float8* restrict source_x,
         global const float8* restrict source_y,
         global const float8* restrict source_z,
         const uint source_points,
         global const float* restrict source_field,
         const float4 source_lower,
         const int4 source_size,
         global const float8* restrict target_x,
         global const float8* restrict target_y,
         global const float8* restrict target_z,
         const uint target_points,
         global const float* restrict target_field,
         const float4 target_lower,
         const int4 target_size,
         global const float4* restrict candidates,
         const uint number_of_candidates,
         const float limit,
         global float4* restrict distances)
{
  const uint candidate = get_global_id(0);
  if (candidate >= number_of_candidates)
    return;
  const Placement forth = placement_at(candidates, candidate);
  const Placement back = inverse_of(forth);
  const float scale = sqrt(squared_scale(forth));
  distances[candidate] =
      (float4)(distances_from(source_x, source_y, source_z, source_points, forth.x,
                              forth.y, forth.z, target_field, target_lower, target_size,
                              limit),
               scale * distances_from(target_x, target_y, target_z, target_points,
                                      back.x, back.y, back.z, source_field,
                                      source_lower, source_size, limit / scale));
}
