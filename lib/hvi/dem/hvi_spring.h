/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_SPRING_H
#define LMP_HVI_SPRING_H

#include <algorithm>
#include <cmath>

namespace HVI {

/* ----------------------------------------------------------------------
   Breakable spring, in tension only.

     phi(r) = kappa/2 (r - r_eq)^2   for r_eq < r <= r_cut
     phi(r) = 0                      for r <= r_eq
     broken for good                 once r > r_cut

   Watson & Steinhauser, Materials 10 (2017) 379, eqs 8-10.
------------------------------------------------------------------------- */

struct Spring {
  double kappa, r_eq, r_cut;
  double eqsq, cutsq;

  static Spring make(double kappa, double r_eq, double r_cut)
  {
    return {kappa, r_eq, r_cut, r_eq * r_eq, r_cut * r_cut};
  }

  bool broken(double rsq) const { return rsq > cutsq; }

  // force divided by distance, <= 0: attracts, or nothing while the spring is slack
  // (Watson & Steinhauser eq 9)

  double force(double rsq) const { return kappa * std::min(r_eq / std::sqrt(rsq) - 1.0, 0.0); }

  double energy(double rsq) const
  {
    const double dr = std::max(std::sqrt(rsq) - r_eq, 0.0);
    return 0.5 * kappa * dr * dr;
  }
};

}    // namespace HVI

#endif
