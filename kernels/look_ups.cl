/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * Distances between the target and the source placed by each candidate, looked up in
 * distance fields: E_d of (e9) and E_cd of (e122). One work-item per candidate, as in
 * Algorithm 2 of the paper; vectors across eight points, their coordinates apart.
 */

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

inline float
largest_of(float8 v)
{
  const float4 a = max(v.lo, v.hi);
  const float2 b = max(a.lo, a.hi);
  return max(b.x, b.y);
}

inline float
sum_of(float8 v)
{
  const float4 a = v.lo + v.hi;
  const float2 b = a.lo + a.hi;
  return b.x + b.y;
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
  /* from lengths to cells */
  row_x = (row_x - (float4)(0.0f, 0.0f, 0.0f, lower.x)) * lower.w;
  row_y = (row_y - (float4)(0.0f, 0.0f, 0.0f, lower.y)) * lower.w;
  row_z = (row_z - (float4)(0.0f, 0.0f, 0.0f, lower.z)) * lower.w;
  float8 farthest = (float8)(0.0f);
  float8 sums = (float8)(0.0f);
  for (uint t = 0; t < (points + 7) / 8; ++t) {
    const float8 x = xs[t];
    const float8 y = ys[t];
    const float8 z = zs[t];
    const float8 d = look_up(field, size,
                             row_x.x * x + row_x.y * y + row_x.z * z + row_x.w,
                             row_y.x * x + row_y.y * y + row_y.z * z + row_y.w,
                             row_z.x * x + row_z.y * y + row_z.z * z + row_z.w);
    farthest = max(farthest, d);
    /* the copies that fill up the last tile do not count */
    sums += select((float8)(0.0f), min(d, limit), lane + 8 * t < (uint8)(points));
  }
  return (float2)(largest_of(farthest), sum_of(sums) / points);
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
  const float4 row_x = candidates[3 * candidate];
  const float4 row_y = candidates[3 * candidate + 1];
  const float4 row_z = candidates[3 * candidate + 2];
  const float2 forth = distances_from(source_x, source_y, source_z, source_points, row_x,
                                      row_y, row_z, target_field, target_lower,
                                      target_size, limit);
  /* the inverse of x -> s R x + t is x -> (s R)^T (x - t) / s^2 */
  const float squared = dot(row_x.xyz, row_x.xyz);
  const float scale = sqrt(squared);
  const float3 shift = (float3)(row_x.w, row_y.w, row_z.w) / squared;
  const float3 x = (float3)(row_x.x, row_y.x, row_z.x);
  const float3 y = (float3)(row_x.y, row_y.y, row_z.y);
  const float3 z = (float3)(row_x.z, row_y.z, row_z.z);
  const float2 back = scale * distances_from(target_x, target_y, target_z, target_points,
                                             (float4)(x / squared, -dot(x, shift)),
                                             (float4)(y / squared, -dot(y, shift)),
                                             (float4)(z / squared, -dot(z, shift)),
                                             source_field, source_lower, source_size,
                                             limit / scale);
  distances[candidate] = (float4)(forth, back);
}
