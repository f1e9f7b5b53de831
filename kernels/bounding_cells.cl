/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * The grid around a cloud that bounds its distances from anywhere: see bounds.cl.
 *
 * A cell knows a point q of the cloud and a slack: from any position p of the cell the
 * cloud is no farther than q, and the square of its distance is smaller than that of q
 * by the slack at most. For the difference of the squares is convex in p, being the
 * largest of linear functions, one per point of the cloud: over the cell it is nowhere
 * larger than at a corner.
 */

/* The point nearest to every node. One work-item per row of nodes along x, sixteen at a
 * time.
 *
 * first_row: of a dispatch
 * points: x, y, z, 1 per point
 * lower: the first node, and the edge of a cell in w
 * size: nodes along x, y and z; along x a multiple of eight
 * nearest: index of a point per node, x varies fastest
 * squared_distances: of these, in cells
 */
kernel void
nearest_to_nodes(const uint first_row,
                 global const float4* restrict points,
                 const uint number_of_points,
                 const float4 lower,
                 const int4 size,
                 global int8* restrict nearest,
                 global float8* restrict squared_distances)
{
  const int row = first_row + get_global_id(0);
  if (row >= size.y * size.z)
    return;
  const float y = lower.y + lower.w * (row % size.y);
  const float z = lower.z + lower.w * (row / size.y);
  const float8 lane = (float8)(0.0f, 1.0f, 2.0f, 3.0f, 4.0f, 5.0f, 6.0f, 7.0f);
  for (int i = 0; i < size.x; i += 16) {
    const float8 a = lower.x + lower.w * (lane + i);
    const float8 b = a + 8 * lower.w;
    float8 near_a = (float8)(MAXFLOAT);
    float8 near_b = near_a;
    int8 index_a = (int8)(0);
    int8 index_b = index_a;
    for (uint n = 0; n < number_of_points; ++n) {
      const float4 p = points[n];
      const float off_line = (y - p.y) * (y - p.y) + (z - p.z) * (z - p.z);
      const float8 to_a = (a - p.x) * (a - p.x) + off_line;
      const float8 to_b = (b - p.x) * (b - p.x) + off_line;
      index_a = select(index_a, (int8)(n), to_a < near_a);
      index_b = select(index_b, (int8)(n), to_b < near_b);
      near_a = min(near_a, to_a);
      near_b = min(near_b, to_b);
    }
    const int out = (row * size.x + i) / 8;
    const float inverse = 1.0f / (lower.w * lower.w);
    nearest[out] = index_a;
    squared_distances[out] = near_a * inverse;
    if (i + 8 < size.x) { /* what lies beyond the row is not written */
      nearest[out + 1] = index_b;
      squared_distances[out + 1] = near_b * inverse;
    }
  }
}

inline float
squared_length(float4 v)
{
  return v.x * v.x + v.y * v.y + v.z * v.z;
}

/* A point and its slack for every cell, lengths in cells from the first node: of the
 * points nearest to the cell's corners the one nearest to its middle. One work-item per
 * row of cells along x.
 *
 * first_row: of a dispatch
 * nearest, lower, size: of the nodes
 * rounding: how far a position can be off, in cells
 * border: the slack of cells at the border of the grid, which stand for all beyond
 */
kernel void
cell_bounds(const uint first_row,
            global const float4* restrict points,
            global const int* restrict nearest,
            const float4 lower,
            const int4 size,
            const float rounding,
            const float border,
            global float4* restrict cells)
{
  const int row = first_row + get_global_id(0);
  if (row >= (size.y - 1) * (size.z - 1))
    return;
  const int y = row % (size.y - 1);
  const int z = row / (size.y - 1);
  const float inverse = 1.0f / lower.w;
  for (int x = 0; x < size.x - 1; ++x) {
    const float4 first = (float4)(x, y, z, 0.0f);
    const float4 middle = first + (float4)(0.5f, 0.5f, 0.5f, 0.0f);
    float4 at_corner[8];
    float4 q = (float4)(0.0f);
    float least = MAXFLOAT;
    for (int c = 0; c < 8; ++c) {
      const int line = (z + (c >> 2)) * size.y + y + ((c >> 1) & 1);
      const int node = line * size.x + x + (c & 1);
      at_corner[c] = (points[nearest[node]] - lower) * inverse;
      const float squared = squared_length(middle - at_corner[c]);
      q = squared < least ? at_corner[c] : q;
      least = min(squared, least);
    }
    float slack = 0.0f;
    float farthest = 0.0f;
    for (int c = 0; c < 8; ++c) {
      const float4 corner = first + (float4)(c & 1, (c >> 1) & 1, c >> 2, 0.0f);
      const float squared = squared_length(corner - q);
      slack = max(slack, squared - squared_length(corner - at_corner[c]));
      farthest = max(farthest, squared);
    }
    const bool inside =
        x > 0 && x < size.x - 2 && y > 0 && y < size.y - 2 && z > 0 && z < size.z - 2;
    q.w = inside ? slack + rounding * (sqrt(farthest) + rounding) : border;
    cells[((size_t)z * (size.y - 1) + y) * (size.x - 1) + x] = q;
  }
}
