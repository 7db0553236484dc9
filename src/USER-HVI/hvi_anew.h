/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_ANEW_H
#define LMP_HVI_ANEW_H

#include "update.h"

namespace HVI {

/* ----------------------------------------------------------------------
   Styles of ours point at each other, and make tables, from init() on.  With "run N pre no" there is no
   init(): the destructor of what others point at, and new settings and coefficients, let the next run set
   up anew, as if there had been none before.
   No Update any more: LAMMPS itself ends.
------------------------------------------------------------------------- */

inline void run_anew(LAMMPS_NS::Update *update)
{
  if (update) update->first_update = 0;
}

}    // namespace HVI

#endif
