/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_SPH_RECORDS_H
#define LMP_HVI_SPH_RECORDS_H

#include "hvi_inverse.h"
#include "hvi_stress.h"
#include "hvi_vector.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

// the records of SPH particles: what the loops over pairs read and add to; no LAMMPS in here

namespace HVI {

/* ----------------------------------------------------------------------
   Stages of a force evaluation: records are filled; in some scenes a first sweep over pairs adds up
   sums, from which the pair style, between the sweeps, makes what the forces need; the sweep of the
   forces adds to SphRates.  Numbers that are replaced between the sweeps have a function with the
   name of what is there afterwards.
------------------------------------------------------------------------- */

// filled: where a particle is

struct alignas(32) SphPlace {
  double x, y, z, h;
};

// filled: what its neighbors must know, one cache line

struct alignas(64) SphState {
  double vx, vy, vz;
  double w;    // weight in sums over neighbors: the volume m/rho, in solids times (rho/rho0)^(1/3)
  double p;    // pressure
  double c;    // speed of sound
  double rho;
  double body;    // see code()

  // the bits of a whole number, for vectors: label of the body that it is part of, its type, and whether it is a solid
  // that failed.  The last bits of a label are mirror planes, by direction: images across these are another body.

  static constexpr int MOST_TYPES = 1023, PLANES = 7;
  static constexpr int64_t RUBBLE = 1, TYPE = 2 * MOST_TYPES, LABEL = ~(TYPE | RUBBLE);

  static double code(int type, int64_t label = 0, bool rubble = false)
  {
    const int64_t whole = label * (TYPE + 2) + 2 * type + rubble;
    double code;
    memcpy(&code, &whole, sizeof(code));
    return code;
  }
  static int64_t bits_of(double code)
  {
    int64_t whole;
    memcpy(&whole, &code, sizeof(whole));
    return whole;
  }
  static int64_t label_of(double code) { return bits_of(code) >> 11; }
  static int type_of(double code) { return (bits_of(code) & TYPE) >> 1; }
  static bool is_rubble(double code) { return bits_of(code) & RUBBLE; }

  int64_t label() const { return label_of(body); }
  int type() const { return type_of(body); }
  bool is_rubble() const { return is_rubble(body); }

  // of the image by an operation, a set of planes: a label below 0 that no particle has

  void reflect_body(int op)
  {
    if (label() & op) body = code(type(), -1 - label(), is_rubble());
  }
};

/* ----------------------------------------------------------------------
   A particle of light matter beside one of dense matter is held by the stiffness of that, K = rho c^2, and
   swings as if its speed of sound were sqrt(K/rho_light), of which half is counted: it matters where
   densities, and masses rho w, differ by more than 4.  0: they do not
------------------------------------------------------------------------- */

static inline double sph_swing(double c_i, double rho_i, double w_i, double c_j, double rho_j,
                               double w_j)
{
  const double m_i = rho_i * w_i, m_j = rho_j * w_j;
  if (!(rho_i > 4.0 * rho_j && m_i > 4.0 * m_j) && !(rho_j > 4.0 * rho_i && m_j > 4.0 * m_i))
    return 0.0;
  return 0.5 * std::sqrt(std::max(rho_i * c_i * c_i, rho_j * c_j * c_j) / std::min(rho_i, rho_j));
}

// the forces: what its neighbors do to it; drho of solids is written between the sweeps, too

struct alignas(64) SphRates {
  static constexpr int FORCE = 3, WITH_POWER = 7;    // its first numbers
  double fx, fy, fz;                                 // force
  double drho;
  double de_x, de_y, de_z;    // of the internal energy of the particle, in parts
  double heat;                // viscous part of it

  double de() const { return de_x + de_y + de_z; }
};

// between the sweeps: artificial stress of solids

struct alignas(64) SphStress {
  static constexpr int SENT = 6;
  double xx, yy, zz, xy;
  double xz, yz;
  double unused[2];
};

/* ----------------------------------------------------------------------
   First sweep, in solids: sums over what a particle hangs together with and, in another of these records,
   over what else touches it,

     L = - sum_j w_j v_ij (x) grad W_i,   M = - sum_j w_j x_ij (x) grad W_i,   nu = sum_j w_j W_i

   M is 1 where particles are even all around.  L belongs to the middle of the step, as does the H that goes with
   it, sums like M; M and nu, for forces, to its end.  Between the sweeps M^-1 takes the place of M, the velocity
   gradient L H^-1 that of L; of what touches what of the stress is normal to the contact, n (x) n times a
   share, that of L.
------------------------------------------------------------------------- */

struct alignas(64) SphGradV {
  static constexpr int SENT = 22;
  double xx, xy, xz, hxy;    // L_ab: of v_a along b
  double yx, yy, yz, hxz;
  double zx, zy, zz, hyz;
  double hxx, hyy, hzz, nu;
  double mxx, myy, mzz, mxy;
  double mxz, myz, unused;
  double weight;    // filled: w in the middle of the step over that at its end

  VelocityGradient gradient() const { return {xx, xy, xz, yx, yy, yz, zx, zy, zz}; }
  void set_gradient(const VelocityGradient &L)
  {
    xx = L.xx;
    xy = L.xy;
    xz = L.xz;
    yx = L.yx;
    yy = L.yy;
    yz = L.yz;
    zx = L.zx;
    zy = L.zy;
    zz = L.zz;
  }
  Symmetric moment() const { return {mxx, myy, mzz, mxy, mxz, myz}; }    // M, and afterwards M^-1
  Symmetric middle_moment() const { return {hxx, hyy, hzz, hxy, hxz, hyz}; }

  // its first numbers are, when forces are evaluated, what Riemann problems need of L H^-1: the symmetric part

  static constexpr int SENT_STRETCH = 6;
  Symmetric &stretch() { return reinterpret_cast<Symmetric &>(xx); }
  void keep_stretch()
  {
    stretch() = {xx, yy, zz, 0.5 * (xy + yx), 0.5 * (xz + zx), 0.5 * (yz + zy)};
  }
  Symmetric normal() const { return {xx, yy, zz, xy, xz, yz}; }
  void set_moment(const Symmetric &s)
  {
    mxx = s.xx;
    myy = s.yy;
    mzz = s.zz;
    mxy = s.xy;
    mxz = s.xz;
    myz = s.yz;
  }
  void set_normal(const Symmetric &s)
  {
    xx = s.xx;
    yy = s.yy;
    zz = s.zz;
    xy = s.xy;
    xz = s.xz;
    yz = s.yz;
  }
};

// between the sweeps, in solids: the force on i is w_i w_j (T_i + T_j) grad W, with M^-1 in T; and what
// else is known at the end of the step only: see fix hvi/sph

struct alignas(64) SphTraction {
  static constexpr int SENT = 15;
  double xx, yx, zx;    // T, by columns
  double p;             // pressure
  double xy, yy, zy;
  double volume;    // filled: m/rho
  double xz, yz, zz;
  double rho;           // density
  double vx, vy, vz;    // velocity at that time, with which forces do work
  double div;           // owned: trace of the velocity gradient by which that density is advanced

  VelocityGradient by_rows() const { return {xx, xy, xz, yx, yy, yz, zx, zy, zz}; }
};

// between the sweeps, in solids: the part of T that is a pressure, which also acts between bodies

struct alignas(64) SphPush {
  static constexpr int SENT = 7;
  double xx, yy, zz, xy;
  double xz, yz;
  double p;    // what bodies push each other with: - n.sigma.n, n the normal of the contact
  double unused;
};

static_assert(offsetof(SphGradV, weight) >= SphGradV::SENT * sizeof(double),
              "weights are not among sums");
static_assert(sizeof(SphStress) == 2 * sizeof(Vec4) && sizeof(SphGradV) == 6 * sizeof(Vec4) &&
                  sizeof(SphTraction) == 4 * sizeof(Vec4) && sizeof(SphPush) == 2 * sizeof(Vec4),
              "records are read as vectors");
static_assert(sizeof(SphPlace) == sizeof(Vec4) && sizeof(SphState) == 2 * sizeof(Vec4) &&
                  sizeof(SphRates) == 2 * sizeof(Vec4),
              "records are read as vectors");

/* ----------------------------------------------------------------------
   First sweep, with Riemann problems without solids: gradients at a particle, of velocity the symmetric
   part, and of pressure; and how its density follows from the places of its neighbors, by

     n = sum_j w_j/w_i W(r, h_i),   spread = sum_j w_j/w_i h_i dW/dh(r, h_i)

   Between the sweeps what forces need of these takes their place: 1/(n Omega) and 1/Omega.
------------------------------------------------------------------------- */

struct alignas(32) SphSlopes {
  static constexpr int SENT = 11;    // of the numbers below, to other ranks
  double xx, yy, zz, xy;
  double xz, yz, px, py;
  double pz;
  double n, spread;
  double unused;

  void replace_sums(double by_n_omega, double by_omega)
  {
    n = by_n_omega;
    spread = by_omega;
  }
  double by_n_omega() const { return n; }
  double by_omega() const { return spread; }
  static constexpr double SphSlopes::*BY_N_OMEGA = &SphSlopes::n;    // for vectors
  static constexpr double SphSlopes::*BY_OMEGA = &SphSlopes::spread;
};
static_assert(sizeof(SphSlopes) == 3 * sizeof(Vec4), "records are read as vectors");

// what of an entry in a list of neighbors is the index, as LAMMPS's NEIGHMASK: other bits are for bonds

static constexpr int NEIGHBOR_INDEX = 0x1FFFFFFF;

class SphTouching;

// all of them, by index of particles: owned, ghosts, then images; null where the scene has none

struct SphView {
  SphPlace *place = nullptr;
  SphState *state = nullptr;
  SphRates *rates = nullptr;
  SphSlopes *slopes = nullptr;    // Riemann problems without solids
  SphGradV *gradv = nullptr;      // solids, as are the next
  SphTraction *traction = nullptr;
  SphStress *art = nullptr;           // artificial stress
  SphTouching *touching = nullptr;    // where there are bodies
};

}    // namespace HVI

#endif
