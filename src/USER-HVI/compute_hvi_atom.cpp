/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing authors: the lammps-hvi developers
------------------------------------------------------------------------- */

#include "compute_hvi_atom.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "fix_hvi_sph.h"
#include "force.h"
#include "memory.h"
#include "modify.h"
#include "pair_hvi_sph.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <string>

using namespace LAMMPS_NS;

/* ---------------------------------------------------------------------- */

ComputeHVIAtom::ComputeHVIAtom(LAMMPS *lmp, int narg, char **arg) :
    Compute(lmp, narg, arg), nmax(0), table(nullptr), pair(nullptr), fix(nullptr)
{
  if (narg < 4) utils::missing_cmd_args(FLERR, "compute hvi/atom", error);

  for (int iarg = 3; iarg < narg; iarg++) {
    const std::string name = arg[iarg];
    if (name == "p")
      values.push_back(PRESSURE);
    else if (name == "T")
      values.push_back(TEMPERATURE);
    else if (name == "c")
      values.push_back(SOUND);
    else if (name == "h")
      values.push_back(LENGTH);
    else if (name == "nbonds")
      values.push_back(BONDS);
    else
      error->all(FLERR, "Unknown compute hvi/atom value {}: use p, T, c, h or nbonds", name);
    if (name == "nbonds" && atom->molecular != Atom::MOLECULAR)
      error->all(FLERR, "Compute hvi/atom nbonds needs an atom style with bonds");
  }

  peratom_flag = 1;
  comm_reverse = 1;
  size_peratom_cols = values.size() == 1 ? 0 : values.size();
}

/* ---------------------------------------------------------------------- */

ComputeHVIAtom::~ComputeHVIAtom()
{
  memory->destroy(table);
}

/* ---------------------------------------------------------------------- */

void ComputeHVIAtom::init()
{
  pair = PairHVISPH::find(lmp);
  const auto fixes = modify->get_fix_by_style("^hvi/sph$");
  fix = fixes.empty() ? nullptr : dynamic_cast<FixHVISPH *>(fixes[0]);
  for (const Value v : values)
    if (v != BONDS && !pair)
      error->all(FLERR, "Compute hvi/atom p, T, c and h need pair style hvi/sph");
}

/* ---------------------------------------------------------------------- */

double ComputeHVIAtom::value_of(Value value, int i) const
{
  if (value == BONDS) return nbonds[i];

  const int itype = atom->type[i];
  const HVI::Material *const material = pair->material(itype);
  if (!material) return 0.0;
  if (value == LENGTH)
    return pair->smoothing_length(itype, atom->rho[i], fix ? fix->hscale(i) : 0.0);

  // from density and energy as they are in output: those of the forces were extrapolated

  const double m = atom->rmass ? atom->rmass[i] : atom->mass[itype];
  const double e = atom->esph[i] / m;
  if (value == TEMPERATURE) {
    const double T = material->eos->temperature(atom->rho[i], e);
    return std::isnan(T) ? 0.0 : T;
  }
  double p, csq;
  if (!material->eos->evaluate(atom->rho[i], e, p, csq)) return 0.0;
  return value == PRESSURE ? p : std::sqrt(csq);
}

/* ---------------------------------------------------------------------- */

void ComputeHVIAtom::compute_peratom()
{
  invoked_peratom = update->ntimestep;

  const int ncols = values.size();
  if (atom->nmax > nmax) {
    nmax = atom->nmax;
    memory->destroy(table);
    memory->create(table, nmax, ncols, "hvi/atom:table");
    array_atom = table;
    vector_atom = ncols == 1 && nmax ? table[0] : nullptr;
  }

  if (std::find(values.begin(), values.end(), BONDS) != values.end()) count_bonds();
  for (int i = 0; i < atom->nlocal; i++)
    for (int n = 0; n < ncols; n++)
      table[i][n] = (atom->mask[i] & groupbit) ? value_of(values[n], i) : 0.0;
}

/* ----------------------------------------------------------------------
   live bonds of a particle: with newton_bond on, one end of a bond keeps it
------------------------------------------------------------------------- */

void ComputeHVIAtom::count_bonds()
{
  nbonds.assign(atom->nlocal + atom->nghost, 0.0);
  for (int i = 0; i < atom->nlocal; i++)
    for (int m = 0; m < atom->num_bond[i]; m++) {
      if (atom->bond_type[i][m] <= 0) continue;
      nbonds[i] += 1.0;
      if (!force->newton_bond) continue;
      const int j = atom->map(atom->bond_atom[i][m]);
      if (j < 0)
        error->one(FLERR, "Compute hvi/atom nbonds: particle {} bonded to {} is out of reach",
                   atom->bond_atom[i][m], atom->tag[i]);
      nbonds[j] += 1.0;
    }
  if (force->newton_bond) comm->reverse_comm(this);
}

int ComputeHVIAtom::pack_reverse_comm(int n, int first, double *buf)
{
  std::copy_n(nbonds.begin() + first, n, buf);
  return n;
}

void ComputeHVIAtom::unpack_reverse_comm(int n, int *list, double *buf)
{
  for (int i = 0; i < n; i++) nbonds[list[i]] += buf[i];
}

/* ---------------------------------------------------------------------- */

double ComputeHVIAtom::memory_usage()
{
  return (double) nmax * values.size() * sizeof(double);
}
