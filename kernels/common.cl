/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * What several kernels need: placements, and reductions of vectors.
 */

/* The rows of a 3x4 matrix, which places a point (x, y, z, 1). Functions with a loop
 * take them one by one: given the structure, PoCL keeps it in memory. */
typedef struct {
  float4 x;
  float4 y;
  float4 z;
} Placement;

/* One of many, three rows each. */
inline Placement
placement_at(global const float4* restrict placements, uint index)
{
  const Placement placement = {placements[3 * index], placements[3 * index + 1],
                               placements[3 * index + 2]};
  return placement;
}

inline float4
place(Placement placement, float4 p)
{
  return (float4)(dot(placement.x, p), dot(placement.y, p), dot(placement.z, p), 1.0f);
}

/* One coordinate of eight placed points: that of a placement's row. */
inline float8
place_eight(float4 row, float8 x, float8 y, float8 z)
{
  return row.x * x + row.y * y + row.z * z + row.w;
}

/* The square of s where the placement is a similarity x -> s R x + t. */
inline float
squared_scale(Placement similarity)
{
  return dot(similarity.x.xyz, similarity.x.xyz);
}

/* The inverse of x -> s R x + t is x -> (s R)^T (x - t) / s^2. */
inline Placement
inverse_of(Placement similarity)
{
  const float squared = squared_scale(similarity);
  const float3 shift =
      (float3)(similarity.x.w, similarity.y.w, similarity.z.w) / squared;
  const float3 x = (float3)(similarity.x.x, similarity.y.x, similarity.z.x);
  const float3 y = (float3)(similarity.x.y, similarity.y.y, similarity.z.y);
  const float3 z = (float3)(similarity.x.z, similarity.y.z, similarity.z.z);
  const Placement inverse = {(float4)(x / squared, -dot(x, shift)),
                             (float4)(y / squared, -dot(y, shift)),
                             (float4)(z / squared, -dot(z, shift))};
  return inverse;
}

/* A placement's row, to the cells of a grid: lengths in cells, from its lower end.
 *
 * cells: per length
 */
inline float4
to_cells(float4 row, float lower, float cells)
{
  return (row - (float4)(0.0f, 0.0f, 0.0f, lower)) * cells;
}

inline float
largest_of_four(float4 v)
{
  return max(max(v.x, v.y), max(v.z, v.w));
}

inline float
sum_of_four(float4 v)
{
  return (v.x + v.y) + (v.z + v.w);
}

inline float
smallest_of_eight(float8 v)
{
  const float4 a = min(v.lo, v.hi);
  const float2 b = min(a.lo, a.hi);
  return min(b.x, b.y);
}

inline float
largest_of_eight(float8 v)
{
  const float4 a = max(v.lo, v.hi);
  const float2 b = max(a.lo, a.hi);
  return max(b.x, b.y);
}

inline float
sum_of_eight(float8 v)
{
  const float4 a = v.lo + v.hi;
  const float2 b = a.lo + a.hi;
  return b.x + b.y;
}
