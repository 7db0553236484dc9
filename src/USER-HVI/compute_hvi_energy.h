/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifdef COMPUTE_CLASS
// clang-format off
ComputeStyle(hvi/energy,ComputeHVIEnergy);
// clang-format on
#else

#ifndef LMP_COMPUTE_HVI_ENERGY_H
#define LMP_COMPUTE_HVI_ENERGY_H

#include "compute.h"

namespace LAMMPS_NS {

class ComputeHVIEnergy : public Compute {
 public:
  ComputeHVIEnergy(class LAMMPS *, int, char **);
  ~ComputeHVIEnergy() override;
  void init() override;
  void setup() override;
  double compute_scalar() override;
  void compute_vector() override;

 private:
  class FixHVILedger *ledger;
  int clampbit;        // groups named by clamps
  double run_start, last;    // total when this run began, and at the last look
  double before;             // what has come in earlier runs; not what commands between them have done
  bool warned, warned_of_missed;

  void warn(double drift);
};

}    // namespace LAMMPS_NS

#endif
#endif
