/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * Distance fields: the distance of every node of a lattice to the nearest point of a
 * cloud, from all pairs. One work-item per row of nodes along x, eight at a time.
 */

/* first_row: of a dispatch
 * points: x, y, z, 1 per point
 * origin: the first node; step: from node to node along x, y and z
 * size: nodes along x, y and z; along x a multiple of eight
 * distances: of the nodes, x varies fastest
 */
kernel void
node_distances(const uint first_row,
               global const float4* restrict points,
               const uint number_of_points,
               const float4 origin,
               const float4 step,
               const int4 size,
               global float8* restrict distances)
{
  const int row = first_row + get_global_id(0);
  if (row >= size.y * size.z)
    return;
  const float y = origin.y + step.y * (row % size.y);
  const float z = origin.z + step.z * (row / size.y);
  const float8 lane = (float8)(0.0f, 1.0f, 2.0f, 3.0f, 4.0f, 5.0f, 6.0f, 7.0f);
  for (int i = 0; i < size.x; i += 32) {
    /* four at once, so that a point is fetched for 32 nodes; what lies beyond the row
     * is not written */
    const float8 a = origin.x + step.x * (lane + i);
    const float8 b = a + 8 * step.x;
    const float8 c = b + 8 * step.x;
    const float8 d = c + 8 * step.x;
    float8 near_a = (float8)(MAXFLOAT);
    float8 near_b = near_a;
    float8 near_c = near_a;
    float8 near_d = near_a;
    for (uint n = 0; n < number_of_points; ++n) {
      const float4 p = points[n];
      const float off_line = (y - p.y) * (y - p.y) + (z - p.z) * (z - p.z);
      near_a = min(near_a, (a - p.x) * (a - p.x) + off_line);
      near_b = min(near_b, (b - p.x) * (b - p.x) + off_line);
      near_c = min(near_c, (c - p.x) * (c - p.x) + off_line);
      near_d = min(near_d, (d - p.x) * (d - p.x) + off_line);
    }
    global float8* restrict out = distances + ((size_t)row * size.x + i) / 8;
    out[0] = sqrt(near_a);
    if (i + 8 < size.x)
      out[1] = sqrt(near_b);
    if (i + 16 < size.x)
      out[2] = sqrt(near_c);
    if (i + 24 < size.x)
      out[3] = sqrt(near_d);
  }
}
