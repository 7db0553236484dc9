/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_SPH_RECORDS_H
#define LMP_HVI_SPH_RECORDS_H

#include "hvi_vector.h"

// the records of SPH particles: what the loop over pairs reads and adds to; no LAMMPS in here

namespace HVI {

// records of a particle: where it is, what its neighbors must know (one cache line), what they do to it

struct alignas(32) SphPlace {
  double x, y, z, h;
};

struct alignas(64) SphState {
  double vx, vy, vz;
  double
      w;    // weight in sums over particles: m/rho in form sum, m in form symmetric; see Howto_sph for
            // gradient corrected
  double p;    // pressure, in form symmetric p/rho^2
  double c;    // speed of sound
  double rho;
  double type;    // with gradient corrected more for rubble, see SphBonds
};

struct alignas(64) SphRates {
  static constexpr int FORCE = 3, WITH_POWER = 4;    // its first numbers
  double fx, fy, fz;                                 // force
  double de;                                         // of the internal energy of the particle
  double drho;
  double heat;    // viscous part of de
  double unused[2];
};

// artificial stress of solids

struct alignas(64) SphStress {
  static constexpr int SENT = 6;
  double xx, yy, zz, xy;
  double xz, yz;
  double unused[2];
};

// of solids: velocity gradient L_ab = d v_a/d x_b, and what it comes out as if L is 1

struct alignas(64) SphGradV {
  static constexpr int SENT = 16, SENT_L = 9;    // all; L only
  double xx, xy, xz, yx;
  double yy, yz, zx, zy;
  double zz, mxx, myy,
      mzz;    // M = - sum_j V_j x_ij (x) grad W_ij: 1 where particles are even all around
  double mxy, mxz, myz;
  double nu;    // sum_j w_j W_ij, with gradient corrected only
};

// with gradient corrected: the force on i is w_i w_j (T_i + T_j) grad W, with M^-1 in T; and what else
// is known at the end of the step only: see fix hvi/sph

struct alignas(64) SphTraction {
  static constexpr int SENT = 13;
  double xx, xy, xz, yx;
  double yy, yz, zx, zy;
  double zz;
  double p;             // pressure
  double vx, vy, vz;    // velocity at that time, with which forces do work
  double volume;
  double rho,
      div;    // of owned particles only; div: trace of L with all neighbors, which changes the density
};

// the part of T that is a pressure, which also acts between bodies

struct alignas(64) SphPush {
  static constexpr int SENT = 7;
  double xx, yy, zz, xy;
  double xz, yz;
  double p;    // what bodies push each other with: - n.sigma.n, n the normal of the contact
  double unused;
};

static_assert(sizeof(SphStress) == 2 * sizeof(Vec4) && sizeof(SphGradV) == 4 * sizeof(Vec4) &&
                  sizeof(SphTraction) == 4 * sizeof(Vec4) && sizeof(SphPush) == 2 * sizeof(Vec4),
              "records are read as vectors");
static_assert(sizeof(SphPlace) == sizeof(Vec4) && sizeof(SphState) == 2 * sizeof(Vec4) &&
                  sizeof(SphRates) == 2 * sizeof(Vec4),
              "records are read as vectors");

// gradients at a particle: of velocity the symmetric part, and of pressure; and how its density
// follows from the number of particles n = sum_j W(x_ij, h_i), itself included

struct alignas(32) SphSlopes {
  static constexpr int SENT = 11;    // of the numbers below, to other ranks
  double xx, yy, zz, xy;
  double xz, yz, px, py;
  double pz;
  double volume;    // first n, then 1/(n Omega)
  double omega;     // first h dW/dh summed over neighbors, then 1/Omega
  double unused;
};
static_assert(sizeof(SphSlopes) == 3 * sizeof(Vec4), "records are read as vectors");

// what of an entry in a list of neighbors is the index, as LAMMPS's NEIGHMASK: other bits are for bonds

static constexpr int NEIGHBOR_INDEX = 0x1FFFFFFF;

// all of them, by index of particles: owned, ghosts, then images; null where the scene has none

struct SphView {
  SphPlace *place = nullptr;
  SphState *state = nullptr;
  SphRates *rates = nullptr;
  SphSlopes *slopes = nullptr;    // dissipation riemann
  SphGradV *gradv = nullptr;      // solids, as are the next
  SphTraction *traction = nullptr;
  SphStress *art = nullptr;       // artificial stress
  SphGradV *contact = nullptr;    // between bodies, as is the next
  SphPush *push = nullptr;
};

}    // namespace HVI

#endif
