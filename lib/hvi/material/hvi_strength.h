/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_STRENGTH_H
#define LMP_HVI_STRENGTH_H

#include "hvi_parameter.h"
#include "hvi_stress.h"

#include <string>

namespace HVI {

/* ----------------------------------------------------------------------
   Strength of a solid: shear modulus G and flow stress Y of von Mises's
   yield surface, sqrt(3/2 S:S) <= Y(eps, epsdot, p, T).

   A law is a plain struct in a header of its own, an entry in the list of hvi_laws.cpp, and has
     name
     params[]                     its table of parameters
     problem(const double *)      if it has any: what is wrong with values that are right one by one
     make(const double *)         from values in the order of params
     Tref                         where T* is 0
     modulus(conditions)          G below melt
     melt(conditions)             melting temperature, infinite if there is none
     scale(conditions)            the factor of Y that is constant in a step
     flow(eps, rate, conditions)  the rest of Y; must not fall with eps or rate.
                                  A rate that is NaN: without rate terms.
     solve(trial, G, factor, eps, dt)     if it can: what solve_return() does, for LANES particles;
                                  NaN where it gives up
   Thermal terms are off where T is NaN.  Guards are in hvi_strength_model.h, once for all laws.
   All in any consistent units, but T in K.
------------------------------------------------------------------------- */

struct Conditions {
  double rho, rho0, p, T;
};

// What became of a trial stress: the stress on the yield surface, the plastic strain of the step, and
// the plastic work per volume, Y d_eps, with the Y at the end of the step; where the yield surface then is

struct Plastic {
  Deviator S;
  double d_eps, work, yield;
};

class Strength {
 public:
  virtual ~Strength() = default;
  virtual const char *name() const = 0;

  // G and Y are zero at and above melt

  virtual double shear_modulus(const Conditions &) const = 0;
  virtual double yield(double eps, double rate, const Conditions &) const = 0;

  // T* = (T - Tref)/(Tm - Tref) in [0, 1]; 0 if T is NaN or nothing melts

  virtual double homologous_temperature(const Conditions &) const = 0;

  // Radial return of the trial stress after a step dt, eps being the plastic strain before it.
  // G = 0 (melt) takes away stress without plastic strain; dt = 0 means without rate terms.  From
  // what is not a number comes NaN.

  virtual Plastic radial_return(const Deviator &trial, double dt, double G, double eps,
                                const Conditions &) const = 0;

  // the same for n particles, not more than LANES

  virtual void radial_return(int n, const Deviator *trial, double dt, const double *G,
                             const double *eps, const Conditions *, Plastic *result) const = 0;
};

}    // namespace HVI

#endif
