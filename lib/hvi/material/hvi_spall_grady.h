/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_SPALL_GRADY_H
#define LMP_HVI_SPALL_GRADY_H

#include "hvi_parameter.h"

#include <cmath>

namespace HVI {

/* ----------------------------------------------------------------------
   Grady's limit of ductile spall (1988), as Ansys's Explicit Dynamics Analysis Guide has it.  What is
   stretched has the energy P^2/(2 rho c0^2) per volume, and parts when that would do for plastic flow
   up to eps_c:

     P^2/(2 rho c0^2) = Y eps_c                                  (1)

   If P = rho c0^2 epsdot t, epsdot = -rho'/rho, that is after a time in which sound comes as far as

     2 c0 t = sqrt(8 Y eps_c/rho)/epsdot                         (2)

   which is the size of the fragments.
------------------------------------------------------------------------- */

struct SpallGrady {
  static constexpr const char *name = "grady";
  static constexpr Parameter params[] = {{"eps_c", NUMBER, POSITIVE, REQUIRED}};

  double eps_c;

  static SpallGrady make(const double *v) { return {v[0]}; }

  double energy(double Y) const { return Y * eps_c; }    // per volume
  double limit(double rho, double c0, double Y) const
  {
    return c0 * std::sqrt(2.0 * rho * energy(Y));
  }
};

// (2) with an energy per volume; 0, unknown, without that or of what does not expand

inline double fragment_size(double energy, double rho, double expansion)
{
  if (!(energy > 0.0 && expansion > 0.0)) return 0.0;
  return std::sqrt(8.0 * energy / rho) / expansion;
}

}    // namespace HVI

#endif
