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
#include "fix_hvi_johnson_cook.h"
#include "fix_hvi_sph.h"
#include "fix_hvi_store.h"
#include "force.h"
#include "memory.h"
#include "modify.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <string>

using namespace LAMMPS_NS;

// in the order of Value

static const char *const NAMES[] = {
    "p",          "e",       "T",     "c",           "h",        "eps",  "epsdot", "damage",
    "initiation", "spalled", "voids", "void_damage", "fragsize", "vm",   "sxx",    "syy",
    "szz",        "sxy",     "sxz",   "syz",         "asleep",   "cost", "body",   "nbonds"};

/* ---------------------------------------------------------------------- */

ComputeHVIAtom::ComputeHVIAtom(LAMMPS *lmp, int narg, char **arg) :
    Compute(lmp, narg, arg), nmax(0), table(nullptr), store(nullptr), integrator(nullptr),
    strength(nullptr)
{
  if (narg < 4) utils::missing_cmd_args(FLERR, "compute hvi/atom", error);

  for (int iarg = 3; iarg < narg; iarg++) {
    const std::string name = arg[iarg];
    const auto found = std::find(std::begin(NAMES), std::end(NAMES), name);
    if (found == std::end(NAMES)) {
      std::string known;
      for (const char *const one : NAMES) known += std::string(known.empty() ? "" : ", ") + one;
      error->all(FLERR, "Unknown compute hvi/atom value {}: use {}", name, known);
    }
    values.push_back(static_cast<Value>(found - std::begin(NAMES)));
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
  find_sources();
}

void ComputeHVIAtom::find_sources()
{
  store = force->pair_match("^hvi/sph$", 0) ? FixHVIStore::find(lmp) : nullptr;
  const auto integrators = modify->get_fix_by_style("^hvi/sph$");
  integrator = integrators.empty() ? nullptr : dynamic_cast<FixHVISPH *>(integrators[0]);
  strength = FixHVIJohnsonCook::find(lmp);
  mesh = HVI::find_mesh(lmp);
  for (const Value v : values) {
    if (v != BONDS && !store)
      error->all(FLERR, "Compute hvi/atom {} needs pair style hvi/sph", NAMES[v]);
    if (v == BODY && !integrator)
      error->all(FLERR, "Compute hvi/atom {} needs fix hvi/sph, which keeps it", NAMES[v]);
    if (v >= EPS && v < MISES && !strength)
      error->all(FLERR, "Compute hvi/atom {} needs fix hvi/johnson-cook", NAMES[v]);
    if (v == LENGTH && store->fields.settings.variable && !integrator)
      error->all(FLERR, "Compute hvi/atom {} needs fix hvi/sph, which keeps it", NAMES[v]);
  }
}

/* ---------------------------------------------------------------------- */

double ComputeHVIAtom::value_of(Value value, int i) const
{
  if (value == BONDS) return nbonds[i];
  if (value == ASLEEP) return store->fields.asleep(i) ? 1.0 : 0.0;
  if (value == BODY) return integrator->body(i);
  if (value == COST) return are_others ? 1.0 : store->fields.cost(i);

  const int itype = atom->type[i];
  const HVI::Material *const material = store->materials.of(itype);
  if (!material) return 0.0;
  if (value == LENGTH) {    // before the first run of a particle: that of its type
    const HVI::SphSettings &set = store->fields.settings;
    const bool known = integrator && !integrator->is_new(i);
    return known ? set.smoothing_length(itype, atom->rho[i], integrator->hscale(i)) : set.h[itype];
  }

  // from density and energy as they are in output: those of the forces were extrapolated

  const double m = atom->rmass ? atom->rmass[i] : atom->mass[itype];
  double rho = atom->rho[i], esph = atom->esph[i];
  const bool held = mesh && mesh->is_shown(i, rho, esph);
  const double e = esph / m;
  if (value == ENERGY) return e;
  if (value == TEMPERATURE) {
    const double T = material->eos->temperature(strength && !held ? strength->density(i) : rho, e);
    return std::isnan(T) ? 0.0 : T;
  }
  double p, csq;
  if (!material->eos->evaluate(rho, e, p, csq)) p = csq = 0.0;
  if (value == SOUND) return std::sqrt(csq);
  if (strength) p = strength->pressure(i, p);
  return value == PRESSURE ? p : solid_value(value, i, p);
}

/* ----------------------------------------------------------------------
   stress is that of the material, tension positive; without strength it is -p
------------------------------------------------------------------------- */

double ComputeHVIAtom::solid_value(Value value, int i, double p) const
{
  const FixHVIJohnsonCook::Solid s = strength ? strength->state(i) : FixHVIJohnsonCook::Solid();
  switch (value) {
    case EPS:
      return s.eps;
    case EPSDOT:
      return s.rate;
    case DAMAGE:
      return std::min(s.damage, 1.0);
    case INITIATION:
      return std::min(s.initiation, 1.0);
    case SPALLED:
      return s.spalled;
    case VOIDS:
      return s.voids.phi;
    case VOID_DAMAGE:
      return std::min(s.voids.D, 1.0);
    case FRAGSIZE:
      return strength->fragments(i);
    case MISES:
      return HVI::von_mises(s.S);
    case SXX:
      return s.S.xx - p;
    case SYY:
      return s.S.yy - p;
    case SZZ:
      return s.S.zz - p;
    case SXY:
      return s.S.xy;
    case SXZ:
      return s.S.xz;
    case SYZ:
      return s.S.yz;
    default:
      return 0.0;
  }
}

/* ---------------------------------------------------------------------- */

void ComputeHVIAtom::compute_peratom()
{
  invoked_peratom = update->ntimestep;
  find_sources();

  const int ncols = values.size();
  if (atom->nmax > nmax) {
    nmax = atom->nmax;
    memory->destroy(table);
    memory->create(table, nmax, ncols, "hvi/atom:table");
    array_atom = table;
    vector_atom = ncols == 1 && nmax ? table[0] : nullptr;
  }

  const auto asks_for = [this](Value value) {
    return std::find(values.begin(), values.end(), value) != values.end();
  };
  if (asks_for(ASLEEP) || asks_for(COST)) check_inactive(asks_for(ASLEEP));
  if (asks_for(BONDS)) count_bonds();
  for (int i = 0; i < atom->nlocal; i++)
    for (int n = 0; n < ncols; n++)
      table[i][n] = (atom->mask[i] & groupbit) ? value_of(values[n], i) : 0.0;
}

/* ----------------------------------------------------------------------
   between runs particles may not be those of the last forces.  All cost the same then: the command balance moves
   particles before it asks for weights.
------------------------------------------------------------------------- */

void ComputeHVIAtom::check_inactive(bool asks_for_asleep)
{
  are_others = false;
  if (update->whichflag || !store) return;
  const std::size_t seen = store->fields.sleepers.size();
  int here = seen && seen != (std::size_t) atom->nlocal, any;
  MPI_Allreduce(&here, &any, 1, MPI_INT, MPI_MAX, world);
  are_others = any;
  if (any && asks_for_asleep)
    error->all(
        FLERR,
        "Compute hvi/atom asleep: a command since the last run has moved, made or taken away "
        "particles: use run 0 first");
}

// as in compute hvi/fragment/atom

void ComputeHVIAtom::check_ghosts(const std::string &value)
{
  checking = true;
  sent = 0;
  comm->reverse_comm(this);
  checking = false;
  int here = sent != atom->nghost, any;
  MPI_Allreduce(&here, &any, 1, MPI_INT, MPI_MAX, world);
  if (any)
    error->all(FLERR,
               "Compute hvi/atom {}: a command since the last run has moved, made or taken away "
               "particles, and ghosts are not there: use run 0 first",
               value);
}

/* ----------------------------------------------------------------------
   live bonds of a particle: with newton_bond on, one end of a bond keeps it
------------------------------------------------------------------------- */

void ComputeHVIAtom::count_bonds()
{
  if (force->newton_bond) check_ghosts("nbonds");
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
  if (checking) {
    sent += n;
    std::fill_n(buf, n, 0.0);
    return n;
  }
  std::copy_n(nbonds.begin() + first, n, buf);
  return n;
}

void ComputeHVIAtom::unpack_reverse_comm(int n, int *list, double *buf)
{
  if (checking) return;
  for (int i = 0; i < n; i++) nbonds[list[i]] += buf[i];
}

/* ---------------------------------------------------------------------- */

double ComputeHVIAtom::memory_usage()
{
  return (double) nmax * values.size() * sizeof(double);
}
