/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing authors: the lammps-hvi developers
------------------------------------------------------------------------- */

// not in the header: hvi_sph_sweep.cpp may be compiled twice, and must have no functions that others have, too

#include "hvi_sph_work.h"

namespace HVI {

SphSweeps::~SphSweeps() = default;

void SphKept::make_room(std::size_t pairs, std::size_t particles)
{
  if (pairs > j.size()) j.resize(1.1 * pairs);
  if (particles > number.size()) number.resize(1.1 * particles);
}

int *SphKept::room_for(std::size_t some_neighbors)
{
  if (some_neighbors > some.size()) some.resize(2 * some_neighbors);
  return some.data();
}

}    // namespace HVI
