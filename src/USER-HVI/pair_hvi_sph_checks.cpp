/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing authors: the lammps-hvi developers
------------------------------------------------------------------------- */

// what must be right before a run; the rest of the class is in pair_hvi_sph.cpp

#include "pair_hvi_sph.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix_hvi_johnson_cook.h"
#include "fix_hvi_sph.h"
#include "force.h"
#include "modify.h"
#include "neigh_list.h"
#include "update.h"

#include <cmath>

using namespace LAMMPS_NS;

static constexpr double BIG = 1.0e100;

/* ---------------------------------------------------------------------- */

void PairHVISPH::check_fixes() const
{
  // hybrid/scaled, which would scale forces but neither rates of density nor of energy, is refused by LAMMPS

  if (utils::strmatch(force->pair_style, "^hybrid") &&
      force->pair_match("^hvi/sph$", 0, 1) != force->pair_match("^hvi/sph$", 0, 2))
    error->all(FLERR, "More than one pair style hvi/sph");

  // fix hvi/sph takes the density in forces for the one that it has extrapolated

  for (const char *const name : {"sph/rhosum", "mdpd/rhosum", "multi/lucy"})
    if (!set.laws.stock && force->pair_match(std::string("^") + name, 0, 1))
      error->all(FLERR,
                 "Pair style hvi/sph integrates density, which pair style {} writes over: leave it "
                 "out, or use stock yes",
                 name);
  if (set.variable && !integrator)
    error->all(FLERR, "Pair style hvi/sph h variable needs fix hvi/sph, which keeps h");
  if (strength && set.laws.symmetric)
    error->all(FLERR, "Pair style hvi/sph: fix hvi/johnson-cook works with form sum");
  if (strength && set.gradient != HVI::SphSettings::CORRECTED)
    error->all(FLERR,
               "Pair style hvi/sph: gradient plain and gradient law were removed: leave the word "
               "out, for solids have corrected gradients");
  if (set.laws.art_eps > 0.0 && !strength)
    error->all(FLERR,
               "Pair style hvi/sph artstress needs fix hvi/johnson-cook, which keeps the stress");
}

/* ---------------------------------------------------------------------- */

void PairHVISPH::check_materials() const
{
  const bool hybrid = utils::strmatch(force->pair_style, "^hybrid");
  for (int i = 1; i <= atom->ntypes; i++) {
    if (!is_ours[i]) {
      if (hybrid || (mesh && mesh->is_node(i))) continue;
      error->all(FLERR, "Pair style hvi/sph: type {} has no material", i);
    }
    const HVI::Materials::Entry &entry = store->materials.entry(i);
    const std::string eos = entry.material->eos->name();
    if (set.laws.stock && eos != "tait" && eos != "idealgas")
      error->all(FLERR, "Pair style hvi/sph stock yes knows eos tait and idealgas only, not {}",
                 eos);
  }
}

/* ----------------------------------------------------------------------
   what may be meant: said at the start of a run, not whenever LAMMPS initializes
------------------------------------------------------------------------- */

void PairHVISPH::warn() const
{
  if (comm->me != 0) return;
  if (!integrator && modify->get_fix_by_style("^sph").empty() &&
      modify->get_fix_by_style("meso").empty())
    error->warning(FLERR,
                   "Pair style hvi/sph: no fix integrates density and energy and estimates "
                   "velocities, as fix hvi/sph does");
  if (strength) return;
  for (int i = 1; i <= atom->ntypes; i++) {
    if (!is_ours[i]) continue;
    const HVI::Material &material = *store->materials.of(i);
    if (material.is_liquid()) continue;
    for (const HVI::Section &section : material.sections)
      if (section.kind == "strength" && section.law != "none") {
        error->warning(FLERR,
                       "Pair style hvi/sph: type {} is a liquid: material {} has strength, but "
                       "there is no fix hvi/johnson-cook (pair_coeff ... strength none if that is "
                       "meant)",
                       i, material.name);
        break;
      }
  }
}

/* ---------------------------------------------------------------------- */

void PairHVISPH::check_mirror() const
{
  for (int k = 0; k < 3; k++) {
    if (!set.mirror.has(k)) continue;
    if (k >= domain->dimension)
      error->all(FLERR, "Pair style hvi/sph: mirror {} in a two-dimensional box", "xyz"[k]);
    if (domain->periodicity[k])
      error->all(FLERR, "Pair style hvi/sph: mirror {} needs a box that is not periodic along {}",
                 "xyz"[k], "xyz"[k]);
  }
  if (!set.mirror.planes) return;
  if (domain->triclinic)
    error->all(FLERR, "Pair style hvi/sph: mirror needs a box that is not triclinic");
  if (!integrator)
    error->all(FLERR,
               "Pair style hvi/sph: mirror needs fix hvi/sph, which keeps particles on "
               "their side");
}

/* ----------------------------------------------------------------------
   forces do not look at pairs of particles that sleep
------------------------------------------------------------------------- */

void PairHVISPH::check_places()
{
  const double *const *const x = atom->x;
  for (int ii = 0; ii < list->inum; ii++) {
    const int i = list->ilist[ii];
    for (int jj = 0; jj < list->numneigh[i]; jj++) {
      const int j = list->firstneigh[i][jj] & NEIGHMASK;
      if (x[i][0] == x[j][0] && x[i][1] == x[j][1] && x[i][2] == x[j][2]) overlap(i, j);
    }
  }
}

/* ----------------------------------------------------------------------
   at the start of a run no particle may be beyond a plane, or on it
------------------------------------------------------------------------- */

void PairHVISPH::check_sides() const
{
  if (!set.mirror.planes) return;
  for (int i = 0; i < atom->nlocal; i++) {
    if (!is_ours[atom->type[i]]) continue;
    for (int k = 0; k < 3; k++)
      if (set.mirror.has(k) && !(set.mirror.depth(k, atom->x[i]) > 1.0e-12 * set.h[atom->type[i]]))
        error->one(FLERR,
                   "Pair style hvi/sph: particle {} at {} = {} is on the mirror plane {} or beyond "
                   "it (mirror {} {} {} wants all {} it); a lattice is best half a spacing away",
                   atom->tag[i], "xyz"[k], atom -> x[i][k], set.mirror.at[k], "xyz"[k],
                   set.mirror.at[k], set.mirror.side[k] > 0 ? "lo" : "hi",
                   set.mirror.side[k] > 0 ? "above" : "below");
  }
}

/* ----------------------------------------------------------------------
   in which directions the particles extend: dim of them.  A row of particles must not see
   its own images across it.
------------------------------------------------------------------------- */

void PairHVISPH::check_extent()
{
  const int dim = set.laws.dim;
  bool *const along = store->fields.along;
  for (int k = 0; k < 3; k++) along[k] = k < domain->dimension;
  if (dim == domain->dimension) return;

  double here[6], extreme[6];    // largest coordinates, and largest of those turned around
  for (double &value : here) value = -BIG;
  for (int i = 0; i < atom->nlocal; i++)
    for (int k = 0; k < 3 && is_ours[atom->type[i]]; k++) {
      here[k] = MAX(here[k], atom->x[i][k]);
      here[3 + k] = MAX(here[3 + k], -atom->x[i][k]);
    }
  MPI_Allreduce(here, extreme, 6, MPI_DOUBLE, MPI_MAX, world);

  int extended = 0;
  double cutmax = 0.0;
  for (int i = 1; i <= atom->ntypes; i++)
    if (is_ours[i]) cutmax = MAX(cutmax, sqrt(cutsq[i][i]));
  for (int k = 0; k < domain->dimension; k++) {
    along[k] = extreme[k] + extreme[3 + k] > 1.0e-9 * cutmax;
    if (along[k])
      extended++;
    else if (domain->periodicity[k] && domain->prd[k] < cutmax)
      error->all(FLERR,
                 "Pair hvi/sph dim {}: the box is only {} long along {}, particles would interact "
                 "with their images beyond the reach of {}",
                 dim, domain->prd[k], "xyz"[k], cutmax);
  }
  if (extended > dim)
    error->all(FLERR, "Pair hvi/sph dim {}: particles extend along {} directions", dim, extended);
  for (int k = 0; k < domain->dimension && extended < dim; k++)
    if (!along[k]) {
      along[k] = true;
      extended++;
    }
}
