/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_EOS_HUGONIOT_H
#define LMP_HVI_EOS_HUGONIOT_H

#include "hvi_parameter.h"

namespace HVI {

/* ----------------------------------------------------------------------
   Where a law about a Hugoniot ends:

     p = p_H(eta) (1 - g eta/2) + rho0 g e,   eta = 1 - rho0/rho

   The law gives rho0, ratio(eta) = C/Us, and g(eta) = dp/de/rho0.  It ends
   at the lowest density where one of these is true:
   - C/Us has fallen to 1/100; it is 0 on the pole of the Hugoniot,
   - C/Us no longer falls: beyond, Us falls as a cubic Hugoniot is compressed,
   - g eta = 2: beyond, matter without energy pulls the harder the more it
     is compressed, and collapses.
------------------------------------------------------------------------- */

template <class Law> double end_of_hugoniot(const Law &law)
{
  static constexpr int n = 1000;
  static constexpr double d = 1e-6;    // of eta
  auto beyond = [&law](double eta) {
    return law.ratio(eta) <= 0.01 || law.ratio(eta) > law.ratio(eta - d) || law.g(eta) * eta >= 2.0;
  };
  for (int i = 1; i < n; i++) {
    double lo = double(i - 1) / n, hi = double(i) / n;
    if (!beyond(hi)) continue;
    for (int k = 0; k < 60; k++) {
      const double mid = 0.5 * (lo + hi);
      (beyond(mid) ? hi : lo) = mid;
    }
    return law.rho0 / (1.0 - lo);
  }
  return NO_LIMIT;
}

}    // namespace HVI

#endif
