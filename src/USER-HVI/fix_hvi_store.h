/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifdef FIX_CLASS
// clang-format off
FixStyle(hvi/store,FixHVIStore);
// clang-format on
#else

#ifndef LMP_FIX_HVI_STORE_H
#define LMP_FIX_HVI_STORE_H

#include "fix.h"
#include "hvi_anew.h"
#include "hvi_materials.h"
#include "hvi_sph_fields.h"

namespace LAMMPS_NS {

/* ----------------------------------------------------------------------
   What the styles of one simulation share.  It only holds: the materials by type,
   and the records of SPH particles of the last force evaluation.  Made by
   pair_coeff hvi/sph; lives until clear, so pair styles and fixes may come and go.
------------------------------------------------------------------------- */

class FixHVIStore : public Fix {
 public:
  FixHVIStore(class LAMMPS *, int, char **);
  ~FixHVIStore() override { HVI::run_anew(update); }
  int setmask() override { return 0; }
  double memory_usage() override { return fields.bytes(); }

  HVI::Materials materials;
  HVI::SphFields fields;
  int embedded =
      0;    // bit of the group of particles in elements, whose mass and energy are those of nodes and elements
  bool is_reported = false;    // there was a table of HVISphReport
  bool has_moved = false;      // a fix hvi/sph has begun a run

  // LAMMPS has forgotten what a restart file has for fixes: any command before the first run that sets up makes it do so

  bool has_forgotten = false;

  static FixHVIStore *find(class LAMMPS *);        // of this simulation, nullptr: none
  static FixHVIStore *instance(class LAMMPS *);    // makes it if need be; not in init() of fixes
};

}    // namespace LAMMPS_NS

#endif
#endif
