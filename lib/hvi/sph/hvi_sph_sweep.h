/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_SPH_SWEEP_H
#define LMP_HVI_SPH_SWEEP_H

#include "hvi_sph_work.h"

#include <memory>
#include <string>

namespace HVI {

// in vectors, if there are any for kernel and scene.  Null: an unknown kernel.

std::unique_ptr<SphSweeps> make_sph_sweeps(const std::string &kernel, int scene);

}    // namespace HVI

#endif
