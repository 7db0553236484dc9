/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_COMPUTE_HVI_MATTER_H
#define LMP_COMPUTE_HVI_MATTER_H

#include "compute.h"
#include "hvi_mirror.h"

#include <functional>
#include <vector>

namespace LAMMPS_NS {

/* ----------------------------------------------------------------------
   What computes that measure bodies have in common: which owned particles count.
   Those of the group do, or those chosen by the compute that owns this one (hvi/wall);
   nodes of elements never do.
------------------------------------------------------------------------- */

class ComputeHVIMatter : public Compute {
 public:
  using Compute::Compute;

  void choose(const std::vector<char> *chosen) { selection = chosen; }    // owned particles

 protected:
  // all that count: number, mass, unwrapped place

  void each(const std::function<void(int, double, const double *)> &work) const;
  HVI::MirrorPlanes find_mirror() const;    // none without pair hvi/sph
  int axis_of(const char *word) const;

 private:
  const std::vector<char> *selection = nullptr;    // none: the group's
};

}    // namespace LAMMPS_NS

#endif
