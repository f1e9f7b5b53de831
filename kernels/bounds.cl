/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * Lower and upper bounds of the distances between the target and the source placed by
 * each candidate, E_d of (e9) and E_cd of (e122), by look-ups.
 *
 * Around each cloud lies a grid. A cell knows a point q of the cloud and a slack: from
 * any position p of the cell the cloud is no farther than q, and the square of its
 * distance is smaller than that of q by the slack at most. For the difference of the
 * squares is convex in p, being the largest of linear functions, one per point of the
 * cloud: over the cell it is nowhere larger than at a corner. For the same reason the
 * squared distance less |p|^2 is concave, and nowhere smaller than what is interpolated
 * between the corners: a closer bound, and a dearer one.
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
    const bool inside = x > 0 && x < size.x - 2 && y > 0 && y < size.y - 2 && z > 0 &&
                        z < size.z - 2;
    q.w = inside ? slack + rounding * (sqrt(farthest) + rounding) : border;
    cells[((size_t)z * (size.y - 1) + y) * (size.x - 1) + x] = q;
  }
}

inline float8
gather(global const float* restrict from, int8 i)
{
  return (float8)(from[i.s0], from[i.s1], from[i.s2], from[i.s3], from[i.s4], from[i.s5],
                  from[i.s6], from[i.s7]);
}

/* What is nowhere larger than the squared distances of eight positions.
 *
 * nodes: their squared distances
 * size: of the nodes
 * node: the first of the cell
 * x, y, z: positions within their cells
 */
inline float8
interpolated(global const float* restrict nodes,
             int4 size,
             int8 node,
             float8 x,
             float8 y,
             float8 z)
{
  const int layer = size.x * size.y;
  const float8 a = mix(gather(nodes, node), gather(nodes + 1, node), x);
  const float8 b =
      mix(gather(nodes + size.x, node), gather(nodes + size.x + 1, node), x);
  const float8 c = mix(gather(nodes + layer, node), gather(nodes + layer + 1, node), x);
  const float8 d = mix(gather(nodes + layer + size.x, node),
                       gather(nodes + layer + size.x + 1, node), x);
  /* |p|^2 is interpolated, too */
  return mix(mix(a, b, y), mix(c, d, y), z) -
         (x * (1.0f - x) + y * (1.0f - y) + z * (1.0f - z));
}

/* The bounds of one direction: of the largest distance, then of the mean.
 *
 * probes: rows of tiles: x, y and z of points; the share of the cloud that each stands
 *   for; how far that reaches from it; and the mean distance of that, as a share of the
 *   reach
 * row_x, row_y, row_z: places the probes in the frame of the cells
 * lower, size: of the nodes
 * largest_known: no distance is known to be larger; in cells
 * rounding: as above, or 0: nothing is interpolated
 * scale: from the frame of the probes to that of the cells
 */
inline float4
bounds_from(global const float8* restrict probes,
            uint tiles,
            float4 row_x,
            float4 row_y,
            float4 row_z,
            global const float4* restrict cells,
            global const float* restrict nodes,
            float4 lower,
            int4 size,
            float largest_known,
            float rounding,
            float scale,
            float limit)
{
  /* all lengths in cells from the first node */
  const float inverse = 1.0f / lower.w;
  row_x = (row_x - (float4)(0.0f, 0.0f, 0.0f, lower.x)) * inverse;
  row_y = (row_y - (float4)(0.0f, 0.0f, 0.0f, lower.y)) * inverse;
  row_z = (row_z - (float4)(0.0f, 0.0f, 0.0f, lower.z)) * inverse;
  limit *= inverse;
  scale *= inverse;
  const float3 last = (float3)(size.x - 2, size.y - 2, size.z - 2);
  const float row = size.x - 1;
  const float layer = row * (size.y - 1);

  float8 least_farthest = (float8)(0.0f);
  float8 most_farthest = (float8)(0.0f);
  float8 least_sum = (float8)(0.0f);
  float8 most_sum = (float8)(0.0f);
  for (uint t = 0; t < tiles; ++t) {
    const float8 px = probes[t];
    const float8 py = probes[t + tiles];
    const float8 pz = probes[t + 2 * tiles];
    const float8 x = row_x.x * px + row_x.y * py + row_x.z * pz + row_x.w;
    const float8 y = row_y.x * px + row_y.y * py + row_y.z * pz + row_y.w;
    const float8 z = row_z.x * px + row_z.y * py + row_z.z * pz + row_z.w;
    const int8 cell_x = convert_int8(min(max(x, 0.0f), last.x));
    const int8 cell_y = convert_int8(min(max(y, 0.0f), last.y));
    const int8 cell_z = convert_int8(min(max(z, 0.0f), last.z));
    /* floats count cells exactly: there are fewer than 2^24 */
    const uint8 cell =
        convert_uint8(convert_int8(convert_float8(cell_z) * layer +
                                   convert_float8(cell_y) * row + convert_float8(cell_x)));
    const float8 ae = (float8)(cells[cell.s0], cells[cell.s4]);
    const float8 bf = (float8)(cells[cell.s1], cells[cell.s5]);
    const float8 cg = (float8)(cells[cell.s2], cells[cell.s6]);
    const float8 dh = (float8)(cells[cell.s3], cells[cell.s7]);
    /* of each cell x and y, then z and the slack; then of all cells each */
    const float8 ab_xy = (float8)(ae.s0, bf.s0, ae.s1, bf.s1, ae.s4, bf.s4, ae.s5, bf.s5);
    const float8 ab_zw = (float8)(ae.s2, bf.s2, ae.s3, bf.s3, ae.s6, bf.s6, ae.s7, bf.s7);
    const float8 cd_xy = (float8)(cg.s0, dh.s0, cg.s1, dh.s1, cg.s4, dh.s4, cg.s5, dh.s5);
    const float8 cd_zw = (float8)(cg.s2, dh.s2, cg.s3, dh.s3, cg.s6, dh.s6, cg.s7, dh.s7);
    const float8 dx = x - (float8)(ab_xy.s01, cd_xy.s01, ab_xy.s45, cd_xy.s45);
    const float8 dy = y - (float8)(ab_xy.s23, cd_xy.s23, ab_xy.s67, cd_xy.s67);
    const float8 dz = z - (float8)(ab_zw.s01, cd_zw.s01, ab_zw.s45, cd_zw.s45);
    const float8 slack = (float8)(ab_zw.s23, cd_zw.s23, ab_zw.s67, cd_zw.s67);
    const float8 squared = dx * dx + dy * dy + dz * dz;
    float8 least_squared = squared - slack;
    if (rounding > 0.0f) {
      const int8 node = (cell_z * size.y + cell_y) * size.x + cell_x;
      const float8 closer =
          interpolated(nodes, size, node, x - convert_float8(cell_x),
                       y - convert_float8(cell_y), z - convert_float8(cell_z));
      /* not at the border, since beyond it nothing can be interpolated */
      least_squared =
          select(least_squared,
                 max(least_squared, closer - rounding * (1.5f + fabs(closer))),
                 fabs(slack) < 1e29f);
    }
    const float8 least = min(sqrt(max(least_squared, 0.0f)), largest_known);
    const float8 most = sqrt(squared);

    const float8 share = probes[t + 3 * tiles];
    const float8 reach = scale * probes[t + 4 * tiles];
    const float8 mean = probes[t + 5 * tiles];
    least_farthest = max(least_farthest, least);
    most_farthest = max(most_farthest, most + reach);
    /* Points that lie off by r come nearer by r at most. What counts of the distance
     * is concave in r: no mean is lower than that of the largest r and of none. */
    const float8 nearest = min(least - reach, limit);
    const float8 counts = min(least, limit);
    least_sum += share * max(counts - mean * (counts - nearest), 0.0f);
    most_sum += share * min(most + mean * reach, limit);
  }
  const float4 l = max(least_farthest.lo, least_farthest.hi);
  const float4 m = max(most_farthest.lo, most_farthest.hi);
  const float4 s = least_sum.lo + least_sum.hi;
  const float4 u = most_sum.lo + most_sum.hi;
  return lower.w * (float4)(max(max(l.x, l.y), max(l.z, l.w)),
                            max(max(m.x, m.y), max(m.z, m.w)),
                            (s.x + s.y) + (s.z + s.w), (u.x + u.y) + (u.z + u.w));
}

/* *_probes, *_tiles: as above; no tiles, no bounds
 * *_cells, *_nodes, *_lower, *_size, *_largest_known, *_rounding: as above
 * candidates: the three rows of a 3x4 similarity per candidate
 * limit: what a distance counts in the means at most
 * bounds: per candidate and direction, from source to target first: lower and upper
 *   bound of the largest distance, lower and upper bound of the mean
 */
kernel void
distance_bounds(global const float8* restrict source_probes,
                const uint source_tiles,
                global const float4* restrict source_cells,
                global const float* restrict source_nodes,
                const float4 source_lower,
                const int4 source_size,
                const float source_largest_known,
                const float source_rounding,
                global const float8* restrict target_probes,
                const uint target_tiles,
                global const float4* restrict target_cells,
                global const float* restrict target_nodes,
                const float4 target_lower,
                const int4 target_size,
                const float target_largest_known,
                const float target_rounding,
                global const float4* restrict candidates,
                const uint number_of_candidates,
                const float limit,
                global float4* restrict bounds)
{
  const uint candidate = get_global_id(0);
  if (candidate >= number_of_candidates)
    return;
  const float4 row_x = candidates[3 * candidate];
  const float4 row_y = candidates[3 * candidate + 1];
  const float4 row_z = candidates[3 * candidate + 2];
  /* the inverse of x -> s R x + t is x -> (s R)^T (x - t) / s^2 */
  const float squared = dot(row_x.xyz, row_x.xyz);
  const float scale = sqrt(squared);
  const float3 shift = (float3)(row_x.w, row_y.w, row_z.w) / squared;
  const float3 x = (float3)(row_x.x, row_y.x, row_z.x);
  const float3 y = (float3)(row_x.y, row_y.y, row_z.y);
  const float3 z = (float3)(row_x.z, row_y.z, row_z.z);
  bounds[2 * candidate] =
      bounds_from(source_probes, source_tiles, row_x, row_y, row_z, target_cells,
                  target_nodes, target_lower, target_size, target_largest_known,
                  target_rounding, scale, limit);
  bounds[2 * candidate + 1] =
      scale * bounds_from(target_probes, target_tiles,
                          (float4)(x / squared, -dot(x, shift)),
                          (float4)(y / squared, -dot(y, shift)),
                          (float4)(z / squared, -dot(z, shift)), source_cells,
                          source_nodes, source_lower, source_size, source_largest_known,
                          source_rounding, 1.0f / scale, limit / scale);
}
