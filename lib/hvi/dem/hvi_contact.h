/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_CONTACT_H
#define LMP_HVI_CONTACT_H

#include <cmath>

namespace HVI {

/* ----------------------------------------------------------------------
   Repulsive Lennard-Jones contact, cut at its minimum and shifted to zero.

     phi(r) = F eps [(s/r)^12 - (s/r)^6 + 1/4]   for r < r_eq = 2^(1/6) s
     phi(r) = 0                                  otherwise

   Watson & Steinhauser, Materials 10 (2017) 379, eqs 2 and 3.  Eq 3 prints
   a shift of 1; the minimum of the bracket is -1/4, so only 1/4 makes the
   energy continuous.  F = 1 is the paper's form, F = 4 the textbook one.
------------------------------------------------------------------------- */

struct Contact {
  double cutsq;        // r_eq^2
  double f12, f6;      // 12 F eps s^12, 6 F eps s^6
  double s6, depth;    // s^6, F eps

  static double r_eq(double sigma) { return std::pow(2.0, 1.0 / 6.0) * sigma; }

  static Contact make(double epsilon, double sigma, double prefactor)
  {
    Contact law;
    law.cutsq = r_eq(sigma) * r_eq(sigma);
    law.s6 = std::pow(sigma, 6.0);
    law.depth = prefactor * epsilon;
    law.f12 = 12.0 * law.depth * law.s6 * law.s6;
    law.f6 = 6.0 * law.depth * law.s6;
    return law;
  }

  // force divided by distance, > 0 repels; valid for rsq < cutsq

  double force(double rsq) const
  {
    const double r2inv = 1.0 / rsq;
    const double r6inv = r2inv * r2inv * r2inv;
    return r6inv * (f12 * r6inv - f6) * r2inv;
  }

  // with the shift of 1/4 the bracket is a square, (q - 1/2)^2 with q = (s/r)^6

  double energy(double rsq) const
  {
    const double dq = s6 / (rsq * rsq * rsq) - 0.5;
    return depth * dq * dq;
  }

  // second derivative of phi

  double stiffness(double rsq) const
  {
    const double r2inv = 1.0 / rsq;
    const double r6inv = r2inv * r2inv * r2inv;
    return r6inv * (13.0 * f12 * r6inv - 7.0 * f6) * r2inv;
  }

  // so the distance at which a pair of energy e (kinetic + phi) turns back is explicit

  double turning_rsq(double e) const { return std::cbrt(s6 / (0.5 + std::sqrt(e / depth))); }
};

}    // namespace HVI

#endif
