/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing authors: the lammps-hvi developers
------------------------------------------------------------------------- */

#include "compute_hvi_matter.h"

#include "atom.h"
#include "domain.h"
#include "error.h"
#include "fix_hvi_store.h"
#include "force.h"
#include "hvi_mesh.h"
#include "update.h"

#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;

/* ----------------------------------------------------------------------
   what is not a number has no order: a sort of it is undefined
------------------------------------------------------------------------- */

void ComputeHVIMatter::each(const std::function<void(int, double, const double *)> &work) const
{
  const HVI::Mesh *const mesh = HVI::find_mesh(lmp);
  for (int i = 0; i < atom->nlocal; i++) {
    const int itype = atom->type[i];
    if (!(selection ? (*selection)[i] : atom->mask[i] & groupbit) || (mesh && mesh->is_node(itype)))
      continue;
    double x[3];
    domain->unmap(atom->x[i], atom->image[i], x);
    const double *const v = atom->v[i];
    if (!std::isfinite(x[0] + x[1] + x[2] + v[0] + v[1] + v[2]))
      error->one(FLERR,
                 "Compute {}: particle {} is at {} {} {} with velocity {} {} {} at step {}: the "
                 "simulation is unstable, or a command has set this",
                 style, atom->tag[i], x[0], x[1], x[2], v[0], v[1], v[2], update->ntimestep);
    work(i, atom->rmass ? atom->rmass[i] : atom->mass[itype], x);
  }
}

/* ---------------------------------------------------------------------- */

HVI::MirrorPlanes ComputeHVIMatter::find_mirror() const
{
  const auto *const store = force->pair_match("^hvi/sph$", 0) ? FixHVIStore::find(lmp) : nullptr;
  return store ? store->fields.settings.mirror : HVI::MirrorPlanes();
}

/* ---------------------------------------------------------------------- */

int ComputeHVIMatter::axis_of(const char *word) const
{
  if (strlen(word) != 1 || word[0] < 'x' || word[0] > 'z')
    error->all(FLERR, "Compute {} axis must be x, y or z, not {}", style, word);
  return word[0] - 'x';
}
