/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing authors: the lammps-hvi developers
------------------------------------------------------------------------- */

#include "fix_hvi_store.h"

#include "error.h"
#include "modify.h"

#include <cstring>

using namespace LAMMPS_NS;

static constexpr char STORE_ID[] = "HVI_STORE";

/* ---------------------------------------------------------------------- */

static bool made_by_styles = false;

FixHVIStore::FixHVIStore(LAMMPS *lmp, int narg, char **arg) : Fix(lmp, narg, arg)
{
  if (!made_by_styles)
    error->all(FLERR,
               "Fix hvi/store is made by pair style hvi/sph and cannot be given in an input");
}

/* ---------------------------------------------------------------------- */

FixHVIStore *FixHVIStore::find(LAMMPS *lmp)
{
  return dynamic_cast<FixHVIStore *>(lmp->modify->get_fix_by_id(STORE_ID));
}

FixHVIStore *FixHVIStore::instance(LAMMPS *lmp)
{
  FixHVIStore *found = find(lmp);
  if (found) return found;
  made_by_styles = true;
  found =
      dynamic_cast<FixHVIStore *>(lmp->modify->add_fix(fmt::format("{} all hvi/store", STORE_ID)));
  made_by_styles = false;
  return found;
}
