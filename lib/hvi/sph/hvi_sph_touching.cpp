/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing authors: the lammps-hvi developers
------------------------------------------------------------------------- */

#include "hvi_sph_touching.h"

namespace HVI {

const SphTouching::Record SphTouching::NOTHING = {};

void SphTouching::start(int n)
{
  for (const int i : owners) slots[i] = NONE;
  owners.clear();
  records.clear();
  if (n > (int) slots.size()) slots.resize(n, NONE);
}

SphTouching::Record &SphTouching::begin(int i)
{
  slots[i] = records.size();
  owners.push_back(i);
  return records.emplace_back();
}

std::size_t SphTouching::bytes() const
{
  return slots.capacity() * BYTES + owners.capacity() * sizeof(int) +
      records.capacity() * sizeof(Record);
}

}    // namespace HVI
