/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_STRENGTH_PERFECT_H
#define LMP_HVI_STRENGTH_PERFECT_H

#include "hvi_strength.h"

#include <array>

namespace HVI {

// perfect plasticity: G and Y constant; for exact solutions

struct StrengthPerfect {
  static constexpr const char *name = "perfect";
  static constexpr Parameter params[] = {
      {"G", PRESSURE, POSITIVE, REQUIRED},
      {"Y", PRESSURE, POSITIVE, REQUIRED},
  };
  static constexpr double Tref = 300.0;

  double G, Y;

  static StrengthPerfect make(const double *v) { return {v[0], v[1]}; }

  double modulus(const Conditions &) const { return G; }
  double melt(const Conditions &) const { return NO_LIMIT; }
  double scale(const Conditions &) const { return 1.0; }
  double flow(double, double, const Conditions &) const { return Y; }
};

// No strength.  In a material file: declared a liquid.

struct StrengthNone {
  static constexpr const char *name = "none";
  static constexpr std::array<Parameter, 0> params = {};
  static constexpr double Tref = 300.0;

  static StrengthNone make(const double *) { return {}; }

  double modulus(const Conditions &) const { return 0.0; }
  double melt(const Conditions &) const { return NO_LIMIT; }
  double scale(const Conditions &) const { return 0.0; }
  double flow(double, double, const Conditions &) const { return 0.0; }
};

}    // namespace HVI

#endif
