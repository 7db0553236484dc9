/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_SPH_STEP_H
#define LMP_HVI_SPH_STEP_H

namespace HVI {

/* ----------------------------------------------------------------------
   What pair style hvi/sph does before it sums forces: fix hvi/sph calls it when ghosts and lists are there,
   for it brings density and stress of solids to the end of the step.  See HVIScheme.
------------------------------------------------------------------------- */

class SphStep {
 public:
  virtual void prepare() = 0;

 protected:
  ~SphStep() = default;
};

}    // namespace HVI

#endif
