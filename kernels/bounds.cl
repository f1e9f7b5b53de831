/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * Lower and upper bounds of the distances between the target and the source placed by
 * each candidate, E_d of (e9) and E_cd of (e122), by look-ups in the grids of
 * bounding_cells.cl.
 *
 * The squared distance of a position p from the point that its cell knows is an upper
 * bound; less the slack of the cell, a lower one. The squared distance from the cloud
 * less |p|^2 is concave in p, being the smallest of linear functions, one per point: it
 * is nowhere smaller than what is interpolated between the corners of the cell, a
 * closer bound, and a dearer one.
 */

#include "common.cl"

inline float8
gather(global const float* restrict from, int8 i)
{
  return (float8)(from[i.s0], from[i.s1], from[i.s2], from[i.s3], from[i.s4],
                  from[i.s5], from[i.s6], from[i.s7]);
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

/* The points and the slacks of eight cells. */
typedef struct {
  float8 x;
  float8 y;
  float8 z;
  float8 slack;
} EightCells;

inline EightCells
gather_cells(global const float4* restrict cells, uint8 cell)
{
  const float8 ae = (float8)(cells[cell.s0], cells[cell.s4]);
  const float8 bf = (float8)(cells[cell.s1], cells[cell.s5]);
  const float8 cg = (float8)(cells[cell.s2], cells[cell.s6]);
  const float8 dh = (float8)(cells[cell.s3], cells[cell.s7]);
  /* of each cell x and y, then z and the slack; then of all cells each */
  const float8 ab_xy = (float8)(ae.s0, bf.s0, ae.s1, bf.s1, ae.s4, bf.s4, ae.s5, bf.s5);
  const float8 ab_zw = (float8)(ae.s2, bf.s2, ae.s3, bf.s3, ae.s6, bf.s6, ae.s7, bf.s7);
  const float8 cd_xy = (float8)(cg.s0, dh.s0, cg.s1, dh.s1, cg.s4, dh.s4, cg.s5, dh.s5);
  const float8 cd_zw = (float8)(cg.s2, dh.s2, cg.s3, dh.s3, cg.s6, dh.s6, cg.s7, dh.s7);
  const EightCells gathered = {(float8)(ab_xy.s01, cd_xy.s01, ab_xy.s45, cd_xy.s45),
                               (float8)(ab_xy.s23, cd_xy.s23, ab_xy.s67, cd_xy.s67),
                               (float8)(ab_zw.s01, cd_zw.s01, ab_zw.s45, cd_zw.s45),
                               (float8)(ab_zw.s23, cd_zw.s23, ab_zw.s67, cd_zw.s67)};
  return gathered;
}

/* Lower bounds of the distances of eight positions, in cells.
 *
 * cells, nodes: look-ups; size: of the nodes
 * rounding: how far a position can be off, in cells, or 0: nothing is interpolated
 * x, y, z: in cells from the first node
 * most: upper bounds
 */
inline float8
look_up_bounds(global const float4* restrict cells,
               global const float* restrict nodes,
               int4 size,
               float rounding,
               float8 x,
               float8 y,
               float8 z,
               float8* most)
{
  const float row = size.x - 1;
  const float layer = row * (size.y - 1);
  const int8 cell_x = convert_int8(min(max(x, 0.0f), (float)(size.x - 2)));
  const int8 cell_y = convert_int8(min(max(y, 0.0f), (float)(size.y - 2)));
  const int8 cell_z = convert_int8(min(max(z, 0.0f), (float)(size.z - 2)));
  /* floats count cells exactly: there are fewer than 2^24 */
  const float8 cell = convert_float8(cell_z) * layer + convert_float8(cell_y) * row +
                      convert_float8(cell_x);
  const EightCells q = gather_cells(cells, convert_uint8(convert_int8(cell)));
  const float8 dx = x - q.x;
  const float8 dy = y - q.y;
  const float8 dz = z - q.z;
  const float8 squared = dx * dx + dy * dy + dz * dz;
  float8 least_squared = squared - q.slack;
  if (rounding > 0.0f) {
    const int8 node = (cell_z * size.y + cell_y) * size.x + cell_x;
    const float8 closer =
        interpolated(nodes, size, node, x - convert_float8(cell_x),
                     y - convert_float8(cell_y), z - convert_float8(cell_z));
    /* not at the border, since beyond it nothing can be interpolated */
    least_squared = select(
        least_squared, max(least_squared, closer - rounding * (1.5f + fabs(closer))),
        fabs(q.slack) < 1e29f);
  }
  *most = sqrt(squared);
  return sqrt(max(least_squared, 0.0f));
}

/* The bounds of one direction: of the largest distance, then of the mean.
 *
 * probes: rows of tiles: x, y and z of points; the share of the cloud that each stands
 *   for; how far that reaches from it; and the mean distance of that, as a share of the
 *   reach
 * row_x, row_y, row_z: place the probes in the frame of the cells
 * lower, size: of the nodes; the edge of a cell in w
 * largest_known: no distance is known to be larger; in cells
 * rounding: as above
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
  row_x = to_cells(row_x, lower.x, inverse);
  row_y = to_cells(row_y, lower.y, inverse);
  row_z = to_cells(row_z, lower.z, inverse);
  limit *= inverse;
  scale *= inverse;
  float8 least_farthest = (float8)(0.0f);
  float8 most_farthest = (float8)(0.0f);
  float8 least_sum = (float8)(0.0f);
  float8 most_sum = (float8)(0.0f);
  for (uint t = 0; t < tiles; ++t) {
    const float8 x = probes[t];
    const float8 y = probes[t + tiles];
    const float8 z = probes[t + 2 * tiles];
    float8 most;
    const float8 known =
        look_up_bounds(cells, nodes, size, rounding, place_eight(row_x, x, y, z),
                       place_eight(row_y, x, y, z), place_eight(row_z, x, y, z), &most);
    const float8 least = min(known, largest_known);
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
  return lower.w * (float4)(largest_of_eight(least_farthest),
                            largest_of_eight(most_farthest),
                            sum_of_four(least_sum.lo + least_sum.hi),
                            sum_of_four(most_sum.lo + most_sum.hi));
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
  const Placement forth = placement_at(candidates, candidate);
  const Placement back = inverse_of(forth);
  const float scale = sqrt(squared_scale(forth));
  bounds[2 * candidate] =
      bounds_from(source_probes, source_tiles, forth.x, forth.y, forth.z, target_cells,
                  target_nodes, target_lower, target_size, target_largest_known,
                  target_rounding, scale, limit);
  bounds[2 * candidate + 1] =
      scale * bounds_from(target_probes, target_tiles, back.x, back.y, back.z,
                          source_cells, source_nodes, source_lower, source_size,
                          source_largest_known, source_rounding, 1.0f / scale,
                          limit / scale);
}
