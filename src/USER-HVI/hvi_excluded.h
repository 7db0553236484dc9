/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_EXCLUDED_H
#define LMP_HVI_EXCLUDED_H

#include "group.h"
#include "neighbor.h"

namespace HVI {

// what neigh_modify exclude asks of a particle

struct ExcludedBy {
  int type, mask;
  LAMMPS_NS::tagint molecule;    // 0: there are none
};

// whether neighbor lists leave out a pair

inline bool excluded(const LAMMPS_NS::Neighbor &neighbor, const LAMMPS_NS::Group &group,
                     const ExcludedBy &i, const ExcludedBy &j)
{
  for (int m = 0; m < neighbor.nex_type; m++) {
    const int a = neighbor.ex1_type[m], b = neighbor.ex2_type[m];
    if ((i.type == a && j.type == b) || (i.type == b && j.type == a)) return true;
  }
  for (int m = 0; m < neighbor.nex_group; m++) {
    const int a = group.bitmask[neighbor.ex1_group[m]], b = group.bitmask[neighbor.ex2_group[m]];
    if ((i.mask & a && j.mask & b) || (i.mask & b && j.mask & a)) return true;
  }
  for (int m = 0; m < neighbor.nex_mol; m++) {
    const int bit = group.bitmask[neighbor.ex_mol_group[m]];
    const bool one = i.molecule == j.molecule;
    if (i.mask & bit && j.mask & bit && one == (neighbor.ex_mol_intra[m] != 0)) return true;
  }
  return false;
}

}    // namespace HVI

#endif
