/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_SPH_H
#define LMP_HVI_SPH_H

namespace HVI {

// what a scene adds to plain hydrodynamics with one h, form sum; bits

enum SphScene {
  SPH_OWN_H = 1,          // particles differ in h
  SPH_BODIES = 2,         // pairs of types differ: bodies without tension, own viscosities
  SPH_DENSITY = 4,        // interface density dissipation
  SPH_RIEMANN = 8,        // Riemann problems instead of viscosity and that
  SPH_SOLID = 16,         // stress: forces of tractions, with M^-1
  SPH_SPACINGS = 32,      // types differ in spacing; with SPH_RIEMANN without SPH_SOLID only
  SPH_ARTSTRESS = 64,     // artificial stress; with SPH_SOLID only
  SPH_SYMMETRIC = 128,    // form symmetric of the equations; neither Riemann problems nor solids
  SPH_STOCK = 256         // energy split as in the package SPH; with SPH_SYMMETRIC only
};

// laws of pairs: numbers of pair_style.  In a scene with SPH_BODIES h, a and b are those of one of several types.

struct SphLaws {
  double norm;    // of the kernel in this dimension
  int dim;
  double h;                 // smoothing length
  double a, b;              // Monaghan's viscosity
  double alpha;             // interface density dissipation: the constant,
  int automatic;            // or from the states on both sides
  int symmetric, stock;     // words: what the loops go by are SPH_SYMMETRIC and SPH_STOCK
  double art_eps, art_n;    // artificial stress
  bool unlike = true;       // types may differ so much in density that sph_swing() matters
};

}    // namespace HVI

#endif
