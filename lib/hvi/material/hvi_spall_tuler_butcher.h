/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_SPALL_TULER_BUTCHER_H
#define LMP_HVI_SPALL_TULER_BUTCHER_H

#include "hvi_parameter.h"

#include <algorithm>
#include <cmath>

namespace HVI {

/* ----------------------------------------------------------------------
   Spall by an impulse above a threshold, Tuler & Butcher, Int. J. Fract. Mech. 4 (1968) 431: once

     integral of max(0, sigma_1 - sigma_0)^lambda dt = K

   sigma_1 being the largest principal stress.  Until then nothing changes.
------------------------------------------------------------------------- */

struct SpallTulerButcher {
  static constexpr const char *name = "tuler-butcher";
  static constexpr Parameter params[] = {{"sigma_0", PRESSURE, NOT_NEGATIVE, REQUIRED},
                                         {"lambda", NUMBER, POSITIVE, REQUIRED},
                                         {"K", {0, 0, 1, 0}, POSITIVE, REQUIRED, 1, PRESSURE}};

  double sigma_0, lambda, K;

  static SpallTulerButcher make(const double *v) { return {v[0], v[1], v[2]}; }

  // the part of K that is used up, 1 at most, after dt more under that stress

  double advance(double used, double sigma_1, double dt) const
  {
    if (!(sigma_1 > sigma_0)) return used;
    return std::min(1.0, used + dt * std::pow(sigma_1 - sigma_0, lambda) / K);
  }
};

}    // namespace HVI

#endif
