/*
 * SPDX-License-Identifier: BSD-3-Clause
 *
 * The sums of a distance field over points that a placement turns and scales, at all
 * centres of a lattice at once. One work-item per placement.
 *
 * Centres lie on nodes of the field, so that going from centre to centre a point meets
 * a block of the field that only its place under the first centre decides. Nodes one
 * centre apart are stored side by side (those in between in arrays of their own): a
 * vector of 16 distances, one byte each, is 16 centres, along z, or few along z times
 * some along y. Where a node is, is the sum of
 * what each of its coordinates says.
 */

#include "common.cl"

#define MOST_POINTS 128

inline ushort16
sixteen(global const uchar* restrict field, uint index)
{
  return convert_ushort16(vload16(0, field + index));
}

/* points: x, y, z, 1 per point, at most MOST_POINTS
 * placements: three rows of a matrix each: to nodes of the field, under the first
 *   centre
 * field: distances; outermost nodes are as far as a distance counts
 * nodes: where a node is, by x, then by y, then by z
 * first: where those by each of them begin
 * last: the last node that the first centre may fall on
 * rows: where the rows of 16 centres begin, from the first centre; whole groups of
 *   eight
 * sums: 16 per row
 */
kernel void
shift_sums(global const float4* restrict points,
           const uint number_of_points,
           global const float4* restrict placements,
           const uint number_of_placements,
           global const uchar* restrict field,
           global const uint* restrict nodes,
           const int4 first,
           const int4 last,
           global const uint* restrict rows,
           const uint number_of_rows,
           global ushort16* restrict sums)
{
  const uint index = get_global_id(0);
  if (index >= number_of_placements)
    return;
  const Placement placement = placement_at(placements, index);
  uint under_first[MOST_POINTS];
  for (uint i = 0; i < number_of_points; ++i) {
    const float4 node = place(placement, points[i]);
    const int x = (int)clamp(node.x, 0.0f, (float)last.x);
    const int y = (int)clamp(node.y, 0.0f, (float)last.y);
    const int z = (int)clamp(node.z, 0.0f, (float)last.z);
    under_first[i] = nodes[first.x + x] + nodes[first.y + y] + nodes[first.z + z];
  }
  /* eight rows stay in registers while the points go by */
  for (uint row = 0; row < number_of_rows; row += 8) {
    const uint8 at = vload8(0, rows + row);
    ushort16 a = 0, b = 0, c = 0, d = 0, e = 0, f = 0, g = 0, h = 0;
    for (uint i = 0; i < number_of_points; ++i) {
      global const uchar* restrict under = field + under_first[i];
      a += sixteen(under, at.s0);
      b += sixteen(under, at.s1);
      c += sixteen(under, at.s2);
      d += sixteen(under, at.s3);
      e += sixteen(under, at.s4);
      f += sixteen(under, at.s5);
      g += sixteen(under, at.s6);
      h += sixteen(under, at.s7);
    }
    global ushort16* restrict out = sums + (size_t)index * number_of_rows + row;
    out[0] = a;
    out[1] = b;
    out[2] = c;
    out[3] = d;
    out[4] = e;
    out[5] = f;
    out[6] = g;
    out[7] = h;
  }
}
