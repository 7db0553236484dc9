/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifdef FIX_CLASS
// clang-format off
FixStyle(hvi/debris,FixHVIDebris);
// clang-format on
#else

#ifndef LMP_FIX_HVI_DEBRIS_H
#define LMP_FIX_HVI_DEBRIS_H

#include "fix_hvi_records.h"

namespace LAMMPS_NS {

// of a particle

struct HVIDebrisState {
  double flown =
      0.0;    // time for which it has been apart, and nothing pushed it; below 0: it stays as it is
  double pieces = 0.0;    // of as many, to an edge, it is one; 0: it is none
};

/* ----------------------------------------------------------------------
   A particle that has failed into fragments smaller than itself becomes n^3 particles, one for each
   fragment or so, when these have come apart in free flight.  Each has the smoothing length of the whole.
------------------------------------------------------------------------- */

class FixHVIDebris : public FixHVIRecords<FixHVIDebris, HVIDebrisState> {
 public:
  FixHVIDebris(class LAMMPS *, int, char **);
  int setmask() override;
  void init() override;
  void setup(int) override;
  void pre_exchange() override;
  void end_of_step() override;
  double compute_scalar() override;

  static FixHVIDebris *find(class LAMMPS *);    // of this simulation, nullptr: none
  double part(int i) const                      // of a particle that it is
  {
    const double n = extra[i].pieces;
    return n > 0.0 ? 1.0 / (n * n * n) : 1.0;
  }

 private:
  static const Field FIELDS[];

  int most;    // pieces to an edge
  class FixHVIStore *store;
  class FixHVISPH *integrator;
  class FixHVIJohnsonCook *strength;
  class FixHVILedger *ledger;

  std::string settings() const override { return ""; }
  double mass(int) const;
  double size(int) const;
  int pieces(int) const;
  double opened(int) const;
  bool is_due(int) const;
  void look();
  bool stays_in(const double *x) const;
  void split(int);
  void tell();
};

}    // namespace LAMMPS_NS

#endif
#endif
