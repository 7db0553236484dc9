/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_MIRROR_H
#define LMP_HVI_MIRROR_H

namespace HVI {

/* ----------------------------------------------------------------------
   Mirror planes across x, y, z, one per direction, with all particles on one side.

   An image operation is a set of directions in which coordinates are reflected (bits);
   with two planes there are three: x, y and both.  The image of j is never nearer to i
   than j is, so the half list that has the pair (i,j) has all there is to the pairs
   (i, image of j) and (j, image of i), of which each is the image of the other: one is
   worked out, and what happens to the image of j, reflected, is what happens to j.
------------------------------------------------------------------------- */

struct MirrorPlanes {
  static constexpr int NOPS = 8;    // operation 0 is none

  int planes = 0;                // directions that have one, bits
  double at[3] = {0, 0, 0};      // coordinate of the plane
  double side[3] = {1, 1, 1};    // 1: material is above it, -1: below

  bool has(int k) const { return planes >> k & 1; }
  bool is_operation(int op) const { return op && (op & ~planes) == 0; }
  double depth(int k, const double *x) const { return side[k] * (x[k] - at[k]); }
  bool passes(int k, const double *x) const { return has(k) && x[k] == at[k]; }    // through x
  bool passes(const double *x) const { return passes(0, x) || passes(1, x) || passes(2, x); }

  // square of the distance from what an operation leaves in place

  double depth_squared(int op, const double *x) const
  {
    double sum = 0.0;
    for (int k = 0; k < 3; k++)
      if (op >> k & 1) sum += (x[k] - at[k]) * (x[k] - at[k]);
    return sum;
  }
};

// reflected vectors (x,y,z), symmetric tensors and velocity gradients, by their components' signs

struct Reflection {
  double s[3];
  explicit Reflection(int op)
  {
    for (int k = 0; k < 3; k++) s[k] = op >> k & 1 ? -1.0 : 1.0;
  }
  template <class Tensor> void symmetric(Tensor &t) const
  {
    t.xy *= s[0] * s[1];
    t.xz *= s[0] * s[2];
    t.yz *= s[1] * s[2];
  }
  template <class Record> void velocity(Record &a) const
  {
    a.vx *= s[0];
    a.vy *= s[1];
    a.vz *= s[2];
  }
  template <class Rates> void rates(Rates &a) const
  {
    a.fx *= s[0];
    a.fy *= s[1];
    a.fz *= s[2];
  }
  template <class Slopes> void slopes(Slopes &a) const
  {
    symmetric(a);
    a.px *= s[0];
    a.py *= s[1];
    a.pz *= s[2];
  }
  template <class Tensor> void tensor(Tensor &L) const
  {
    L.xy *= s[0] * s[1];
    L.yx *= s[0] * s[1];
    L.xz *= s[0] * s[2];
    L.zx *= s[0] * s[2];
    L.yz *= s[1] * s[2];
    L.zy *= s[1] * s[2];
  }
  template <class Gradient> void gradient(Gradient &L) const
  {
    tensor(L);
    L.mxy *= s[0] * s[1];
    L.mxz *= s[0] * s[2];
    L.myz *= s[1] * s[2];
    L.hxy *= s[0] * s[1];
    L.hxz *= s[0] * s[2];
    L.hyz *= s[1] * s[2];
  }
};

}    // namespace HVI

#endif
