/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_SPH_H
#define LMP_HVI_SPH_H

// what SPH particles do to each other; no LAMMPS in here

namespace HVI {

// what a scene adds to plain hydrodynamics with one h; bits of a template parameter

enum SphScene {
  SPH_OWN_H = 1,      // particles differ in h
  SPH_BODIES = 2,     // pairs of types differ: bodies without tension, own viscosities
  SPH_DENSITY = 4,    // interface density dissipation
  SPH_NSCENES = 8
};

// records of a particle: where it is, what its neighbors must know (one cache line), what they do to it

struct alignas(32) SphPlace {
  double x, y, z, h;
};

struct alignas(64) SphState {
  double vx, vy, vz;
  double w;    // weight in sums over particles: m/rho in form sum, m in form symmetric
  double p;    // pressure, in form symmetric p/rho^2
  double c;    // speed of sound
  double rho;
  double type;
};

struct alignas(64) SphRates {
  double fx, fy, fz;    // force
  double de;            // of the internal energy of the particle
  double drho;
  double heat;    // viscous part of de
  double unused[2];
};

// laws of pairs: uniform, or from tables of type pairs (row of one type) in a scene with SPH_BODIES

struct SphLaws {
  double norm;    // of the kernel in this dimension
  int dim;
  double h;                                     // if all have the same
  double a, b;                                  // Monaghan's viscosity
  double alpha;                                 // interface density dissipation: the constant,
  int automatic;                                // or from the states on both sides
  int symmetric;                                // form of the equations
  int stock;                                    // energy split as in the package SPH
  const double *row_a, *row_b, *row_tension;    // by type of the neighbor; tension: 0 or 1
};

// eight doubles, for whole records at a time; compilers split it where registers are shorter

typedef double Vec8 __attribute__((vector_size(64), may_alias));
static_assert(sizeof(SphState) == sizeof(Vec8) && sizeof(SphRates) == sizeof(Vec8), "records");

static inline Vec8 load8(const double *x)
{
  return *(const Vec8 *) x;
}

static inline Vec8 sqrt8(const Vec8 &x)
{
  Vec8 r;
  for (int k = 0; k < 8; k++) r[k] = __builtin_sqrt(x[k]);
  return r;
}

static inline Vec8 abs8(const Vec8 &x)
{
  return x < 0.0 ? -x : x;
}

static inline double sum8(const Vec8 &x)
{
  return ((x[0] + x[4]) + (x[2] + x[6])) + ((x[1] + x[5]) + (x[3] + x[7]));
}

// GCC has the other name since version 12

#if defined(__GNUC__) && !defined(__clang__) && __GNUC__ < 12
typedef long long Index8 __attribute__((vector_size(64)));
#define HVI_SHUFFLE(a, b, ...) __builtin_shuffle(a, b, Index8{__VA_ARGS__})
#else
#define HVI_SHUFFLE(a, b, ...) __builtin_shufflevector(a, b, __VA_ARGS__)
#endif

// rows to columns, and back

static inline void transpose8(Vec8 *r)
{
  Vec8 t[8];
  for (int k = 0; k < 8; k += 2) {
    t[k] = HVI_SHUFFLE(r[k], r[k + 1], 0, 8, 2, 10, 4, 12, 6, 14);
    t[k + 1] = HVI_SHUFFLE(r[k], r[k + 1], 1, 9, 3, 11, 5, 13, 7, 15);
  }
  Vec8 u[8];
  for (int k = 0; k < 8; k += 4)
    for (int n = 0; n < 2; n++) {
      u[k + n] = HVI_SHUFFLE(t[k + n], t[k + n + 2], 0, 1, 8, 9, 4, 5, 12, 13);
      u[k + n + 2] = HVI_SHUFFLE(t[k + n], t[k + n + 2], 2, 3, 10, 11, 6, 7, 14, 15);
    }
  for (int k = 0; k < 4; k++) {
    r[k] = HVI_SHUFFLE(u[k], u[k + 4], 0, 1, 2, 3, 8, 9, 10, 11);
    r[k + 4] = HVI_SHUFFLE(u[k], u[k + 4], 4, 5, 6, 7, 12, 13, 14, 15);
  }
}

// neighbors of one particle within reach, as many as fit

struct alignas(64) SphNear {
  static constexpr int MAX = 128, LANES = 8, SIZE = MAX + LANES;
  double dx[SIZE], dy[SIZE], dz[SIZE], rsq[SIZE], h[SIZE];
  double force[SIZE];    // on i along (dx,dy,dz), opposite on j
  int j[SIZE];
};

/* ----------------------------------------------------------------------
   All pairs of particle i with its n near neighbors, eight at a time.  Adds what
   happens to i to sum and what happens to its neighbors to rates.  near is filled
   up to whole vectors with particles out of reach, for which all comes out as 0.
   Returns whether a neighbor is at the same place.

   With V = m/rho, g = v_ij.grad W_ij, form sum (Zisis et al. eqs 9, 13, with
   q = rho_i rho_j Pi for the viscosity) and form symmetric (as in the package
   SPH) differ in weights only:

     sum:       f_i = - V_i V_j (p_i + p_j) grad W - m_i m_j Pi grad W
                dE_i = V_i V_j p_i g + m_i m_j Pi g / 2      drho_i = rho_i V_j g
     symmetric: f_i = - m_i m_j (p_i/rho_i^2 + p_j/rho_j^2) grad W - m_i m_j Pi grad W
                dE_i = m_i m_j p_i/rho_i^2 g + m_i m_j Pi g / 2     drho_i = m_j g

   so that the internal energies of a pair gain what its kinetic energy loses.
   The package SPH gives either particle half of it (stock).
------------------------------------------------------------------------- */

template <class Kernel, int SCENE>
inline bool sph_interact(int i, const SphPlace &pi, const SphState *state, int n,
                         const SphLaws &laws, SphNear &near, SphRates *rates, SphRates &sum)
{
  const int nlanes = (n + SphNear::LANES - 1) & ~(SphNear::LANES - 1);
  for (int m = n; m < nlanes; m++) {
    near.j[m] = i;
    near.dx[m] = near.dy[m] = near.dz[m] = 0.0;
    near.h[m] = pi.h;
    near.rsq[m] = 4.0 * Kernel::support * Kernel::support * pi.h * pi.h;
  }

  // weights of the two forms: rho V/w, p/P and V/w are 1 or a power of rho

  const double sym = laws.symmetric, add = 1.0 - sym;
  const double own = laws.stock ? 0.5 : 1.0, others = 1.0 - own;

  const SphState si = state[i];
  const double w_i = si.w, P_i = si.p, c_i = si.c, rho_i = si.rho, z_i = rho_i * c_i;
  const double rhow_i = add * rho_i + sym;
  const double p_i = P_i * (add + sym * rho_i * rho_i);
  const double V_i = w_i * (add + sym / rho_i);

  // norm/h^(dim+2), without a choice in the loop

  const double two = laws.dim > 1, not_two = 1.0 - two;
  const double three = laws.dim > 2, not_three = 1.0 - three;
  const double same_hinv = 1.0 / laws.h;
  const double same_scale = laws.norm * same_hinv * same_hinv * same_hinv *
      (two * same_hinv + not_two) * (three * same_hinv + not_three);

  const Vec8 zero = {}, one = zero + 1.0;
  Vec8 fx = zero, fy = zero, fz = zero, de = zero, drho = zero, heat = zero, same = zero;

  for (int m = 0; m < nlanes; m += 8) {
    Vec8 block[8];
    for (int k = 0; k < 8; k++) block[k] = load8(&state[near.j[m + k]].vx);
    transpose8(block);
    const Vec8 w_j = block[3], P_j = block[4], c_j = block[5], rho_j = block[6];
    const Vec8 dx = load8(near.dx + m), dy = load8(near.dy + m), dz = load8(near.dz + m);
    const Vec8 rsq = load8(near.rsq + m);
    const Vec8 r = sqrt8(rsq);
    same += rsq > 0.0 ? zero : one;

    // grad W = F (dx,dy,dz)

    Vec8 h = zero + laws.h, hinv = zero + same_hinv, scale = zero + same_scale;
    if (SCENE & SPH_OWN_H) {
      h = load8(near.h + m);
      hinv = 1.0 / h;
      scale = laws.norm * hinv * hinv * hinv * (two * hinv + not_two) * (three * hinv + not_three);
    }
    const Vec8 F = scale * Kernel::template dw_q<Vec8>(r * hinv);

    const Vec8 dvx = si.vx - block[0], dvy = si.vy - block[1], dvz = si.vz - block[2];
    const Vec8 rdotv = dx * dvx + dy * dvy + dz * dvz;
    const Vec8 g = rdotv * F;
    const Vec8 rhow_j = add * rho_j + sym;
    const Vec8 p_j = P_j * (add + sym * rho_j * rho_j);

    // bodies without tension between them push, but do not pull, nor do they stretch each other

    Vec8 a = zero + laws.a, b = zero + laws.b, bonded = one, open = one, stretch = one;
    if (SCENE & SPH_BODIES) {
      for (int k = 0; k < 8; k++) {
        const int jtype = static_cast<int>(block[7][k]);
        a[k] = laws.row_a[jtype];
        b[k] = laws.row_b[jtype];
        bonded[k] = laws.row_tension[jtype];
      }
      open = p_i + p_j > 0.0 ? one : bonded;
      stretch = rdotv < 0.0 ? one : open;
    }

    // Monaghan 1992, for pairs that approach: mu = h v.x/(r^2 + 0.01 h^2),
    // Pi = (b mu^2 - a c_ij mu)/rho_ij; the means over i and j and all quotients in one

    const Vec8 hv = h * (rdotv < 0.0 ? rdotv : zero);
    const Vec8 soft = rsq + 0.01 * h * h;
    const Vec8 Pi = hv * (2.0 * b * hv - a * (c_i + c_j) * soft) / (soft * soft * (rho_i + rho_j));
    const Vec8 visc = w_i * rhow_i * w_j * rhow_j * Pi;

    const Vec8 ww = open * w_i * w_j;
    const Vec8 press_i = ww * P_i, press_j = ww * P_j;
    const Vec8 force = -(press_i + press_j + visc) * F;
    const Vec8 qheat = 0.5 * visc * g;
    *(Vec8 *) (near.force + m) = force;

    Vec8 drho_i = stretch * rhow_i * w_j * g, drho_j = stretch * rhow_j * w_i * g;
    if (SCENE & SPH_DENSITY) {
      // Zisis et al. eqs 22-25 with a constant; or what the contact of the acoustic Riemann
      // problem between i and j moves, less what is a wave within a body, |dp| = z |dv|
      const Vec8 V_j = w_j * (add + sym / rho_j);
      const Vec8 z_j = rho_j * c_j, dp = p_i - p_j, size = abs8(dp);
      const Vec8 dv = sqrt8(dvx * dvx + dvy * dvy + dvz * dvz);
      const Vec8 wave = bonded * (z_i < z_j ? zero + z_i : z_j) * dv;
      const Vec8 excess = (size > wave ? size - wave : zero) / (size + 1.0e-300);
      const Vec8 both = laws.automatic * excess / (z_i + z_j);
      const Vec8 same_alpha = laws.alpha / (c_i + c_j);
      const Vec8 phi = 2.0 * open * dp * F * r;
      drho_i += phi * V_j * (same_alpha + both * rho_i);
      drho_j -= phi * V_i * (same_alpha + both * rho_j);
    }

    const Vec8 f[3] = {force * dx, force * dy, force * dz};
    fx += f[0];
    fy += f[1];
    fz += f[2];
    de += (own * press_i + others * press_j) * g + qheat;
    drho += drho_i;
    heat += qheat;

    for (int k = 0; k < 3; k++) block[k] = -f[k];
    block[3] = (others * press_i + own * press_j) * g + qheat;
    block[4] = drho_j;
    block[5] = qheat;
    block[6] = block[7] = zero;
    transpose8(block);
    for (int k = 0; k < 8; k++) *(Vec8 *) &rates[near.j[m + k]] += block[k];
  }

  sum.fx += sum8(fx);
  sum.fy += sum8(fy);
  sum.fz += sum8(fz);
  sum.de += sum8(de);
  sum.drho += sum8(drho);
  sum.heat += sum8(heat);
  return sum8(same) > 0.0;
}

}    // namespace HVI

#endif
