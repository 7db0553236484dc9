/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_SPH_REFERENCE_H
#define LMP_HVI_SPH_REFERENCE_H

#include "hvi_sph_work.h"

#include <memory>
#include <string>

namespace HVI {

/* ----------------------------------------------------------------------
   The reference loop: all kernels and all terms of all schemes, chosen at run time, pair by pair, as the
   equations have them.  For what is not worth vectors of its own; and what the vectors are held to.
   Null: an unknown kernel.
------------------------------------------------------------------------- */

std::unique_ptr<SphSweeps> make_sph_reference(const std::string &kernel, int scene);

}    // namespace HVI

#endif
