/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_CONTACT_STEP_H
#define LMP_HVI_CONTACT_STEP_H

#include "hvi_contact.h"

#include <algorithm>
#include <cmath>

namespace HVI {

/* ----------------------------------------------------------------------
   What pairs in reach of a contact leave to a time step: the least m/k, m the
   reduced mass and k the stiffness, of pairs as they stand, and of pairs that
   approach where they will turn back if left alone.  rdotv is the product of the
   distance and the velocity with which it grows.
------------------------------------------------------------------------- */

struct ContactTimes {
  double contact, approach;    // m/k
};

/* ----------------------------------------------------------------------
   pairs of one law: the stiffness grows with depth and with energy, so only a pair
   that is deeper, more energetic or lighter than the worst one so far needs to be
   worked out
------------------------------------------------------------------------- */

class ContactStep {
 public:
  void add(const Contact &c, double m, double rsq, double rdotv, ContactTimes &least)
  {
    const bool touching = rsq < c.cutsq;
    if (touching && !(rsq >= worst_rsq && m >= lightest_touching)) {
      const double time = m / c.stiffness(rsq);
      if (time < least.contact || std::isnan(time)) {
        least.contact = time;
        worst_rsq = rsq;
        lightest_touching = m;
      }
    }
    if (!(rdotv >= 0.0)) {
      const double e = 0.5 * m * rdotv * rdotv / rsq + (touching ? c.energy(rsq) : 0.0);
      if (!(e <= worst_energy && m >= lightest_approaching)) {
        const double time = m / c.stiffness(c.turning_rsq(e));
        if (time < least.approach || std::isnan(time)) {
          least.approach = time;
          worst_energy = e;
          lightest_approaching = m;
        }
      }
    }
  }

 private:
  static constexpr double BIG = 1.0e100;
  double worst_rsq = BIG, lightest_touching = BIG, worst_energy = 0.0, lightest_approaching = BIG;
};

/* ----------------------------------------------------------------------
   pairs of one law and one mass: only the shortest distance and the most energy of an approach
   count, which are found in batches without a branch per pair: which pairs approach is a coin toss
------------------------------------------------------------------------- */

class UniformContactStep {
 public:
  static constexpr int ROW = 64;

  UniformContactStep(const Contact &law, double m) : c(law), m(m)
  {
    for (int k = 0; k < NLANE; k++) {
      shortest[k] = BIG;
      most[k] = sum[k] = 0.0;
    }
  }

  struct Row {
    double *rsq, *rdotv;
  };
  Row row()    // room for ROW pairs
  {
    if (n > NBATCH - ROW) work_off();
    return {rsq + n, rdotv + n};
  }
  void filled(int npairs) { n += npairs; }

  void finish(ContactTimes &least)
  {
    work_off();
    for (int k = 1; k < NLANE; k++) {
      shortest[0] = std::min(shortest[0], shortest[k]);
      most[0] = std::max(most[0], most[k]);
      sum[0] += sum[k];
    }
    if (!(shortest[0] >= c.cutsq))
      least.contact = std::min(least.contact, m / c.stiffness(shortest[0]));
    if (!(most[0] <= 0.0))
      least.approach = std::min(least.approach, m / c.stiffness(c.turning_rsq(most[0])));
    if (std::isnan(sum[0])) least.approach = sum[0];
  }

 private:
  static constexpr double BIG = 1.0e100;
  static constexpr int NBATCH = 256, NLANE = 8;

  const Contact c;
  const double m;
  double rsq[NBATCH], rdotv[NBATCH];
  double shortest[NLANE], most[NLANE], sum[NLANE];    // a maximum may drop a NaN, a sum does not
  int n = 0;

  void work_off()
  {
    for (; n % NLANE; n++) {
      rsq[n] = BIG;
      rdotv[n] = 0.0;
    }
    const double s6 = c.s6, depth = c.depth, half_m = 0.5 * m;
    for (int first = 0; first < n; first += NLANE)
#pragma GCC unroll 1    // else it is unrolled into scalars before it can go in vectors
      for (int k = 0; k < NLANE; k++) {
        const double one = rsq[first + k], rate = rdotv[first + k];
        const double r2inv = 1.0 / one;

        // q > 1/2 of Contact::energy() is where they touch

        double dq = s6 * (r2inv * r2inv * r2inv) - 0.5;
        dq = dq < 0.0 ? 0.0 : dq;
        const double energy = half_m * rate * rate * r2inv + depth * dq * dq;
        const double e = rate >= 0.0 ? 0.0 : energy;
        shortest[k] = one < shortest[k] ? one : shortest[k];
        most[k] = e > most[k] ? e : most[k];
        sum[k] += e;
      }
    n = 0;
  }
};

}    // namespace HVI

#endif
