/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing authors: the lammps-hvi developers
------------------------------------------------------------------------- */

#include "hvi_materials.h"

namespace HVI {

const Materials::Entry &Materials::entry(int itype) const
{
  static const Entry none;
  return itype < (int) entries.size() ? entries[itype] : none;
}

void Materials::set(int itype, const Entry &entry)
{
  if (itype >= (int) entries.size()) entries.resize(itype + 1);
  entries[itype] = entry;
}

void Materials::forget(const std::string &owner)
{
  for (Entry &e : entries)
    if (e.owner == owner) e = Entry();
}

}    // namespace HVI
