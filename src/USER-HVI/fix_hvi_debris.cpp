/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing authors: the lammps-hvi developers
------------------------------------------------------------------------- */

#include "fix_hvi_debris.h"

#include "atom_vec.h"
#include "domain.h"
#include "fix_hvi_johnson_cook.h"
#include "fix_hvi_ledger.h"
#include "fix_hvi_sph.h"
#include "fix_hvi_store.h"
#include "hvi_pieces.h"
#include "update.h"

#include <cmath>

using namespace LAMMPS_NS;
using namespace FixConst;

static constexpr double BIG = 1.0e300;

constexpr FixHVIDebris::Field FixHVIDebris::FIELDS[] = {
    {"flown", 0, offsetof(HVIDebrisState, flown)},
    {"pieces", 0, offsetof(HVIDebrisState, pieces)},
};

/* ---------------------------------------------------------------------- */

FixHVIDebris::FixHVIDebris(LAMMPS *lmp, int narg, char **arg) :
    FixHVIRecords(lmp, narg, arg, HVIDebrisState(), FIELDS, {""}), most(3), store(nullptr),
    integrator(nullptr), strength(nullptr), ledger(nullptr)
{
  static_assert(covers<HVIDebrisState>(FIELDS),
                "a number of the record is missing, or there twice");
  int every = 20;
  for (int iarg = 3; iarg < narg; iarg += 2) {
    const std::string key = arg[iarg];
    if (key != "every" && key != "most")
      error->all(FLERR, "Fix hvi/debris knows every and most, not {}", key);
    if (iarg + 1 >= narg) utils::missing_cmd_args(FLERR, "fix hvi/debris " + key, error);
    (key == "every" ? every : most) = utils::inumeric(FLERR, arg[iarg + 1], false, lmp);
  }
  if (every < 1) error->all(FLERR, "Fix hvi/debris every must be 1 or more, not {}", every);
  if (most < 2 ||
      most > 3)    // with more, pieces would be put farther away than particles see each other
    error->all(FLERR, "Fix hvi/debris most must be 2 or 3 pieces to an edge, not {}", most);
  if (atom->molecular != Atom::ATOMIC)
    error->all(FLERR, "Fix hvi/debris works with atom styles without bonds");
  if (domain->dimension != 3) error->all(FLERR, "Fix hvi/debris needs three dimensions");
  if (!atom->tag_enable) error->all(FLERR, "Fix hvi/debris needs IDs of atoms");
  begin();
  nevery = every;
  force_reneighbor = 1;
  next_reneighbor = -1;
  scalar_flag = 1;
  global_freq = 1;
  extscalar = 1;
}

int FixHVIDebris::setmask()
{
  return PRE_EXCHANGE | END_OF_STEP;
}

void FixHVIDebris::init()
{
  if (modify->get_fix_by_style("^hvi/debris$").size() > 1)
    error->all(FLERR, "More than one fix hvi/debris: it keeps how long particles have flown");
  store = FixHVIStore::find(lmp);
  strength = FixHVIJohnsonCook::find(lmp);
  const auto movers = modify->get_fix_by_style("^hvi/sph$");
  if (!store || !strength || movers.empty())
    error->all(FLERR,
               "Fix hvi/debris needs pair style hvi/sph, fix hvi/sph and fix hvi/johnson-cook");
  if (store->fields.settings.laws.dim != 3)
    error->all(FLERR, "Fix hvi/debris needs pair style hvi/sph with dim 3, not {}",
               store->fields.settings.laws.dim);
  integrator = dynamic_cast<FixHVISPH *>(movers[0]);
  if (!atom->rmass)
    error->all(FLERR,
               "Fix hvi/debris needs masses of particles, for pieces have less: fix ID all "
               "property/atom rmass ghost yes, and set type ... mass ...");
  if (domain->triclinic)
    error->all(FLERR,
               "Fix hvi/debris needs a box that is not triclinic: it puts pieces beside "
               "each other in it");
  ledger = FixHVILedger::instance(lmp);
  forget_rows();
  check_restored();
  restored.clear();
  next_reneighbor = -1;
}

FixHVIDebris *FixHVIDebris::find(LAMMPS *lmp)
{
  const auto found = lmp->modify->get_fix_by_style("^hvi/debris$");
  return found.empty() ? nullptr : dynamic_cast<FixHVIDebris *>(found[0]);
}

/* ----------------------------------------------------------------------
   the particle before it failed: its cell, and how many fragments of the size that it is in lie along its
   edge
------------------------------------------------------------------------- */

double FixHVIDebris::mass(int i) const
{
  return atom->rmass[i];
}

double FixHVIDebris::size(int i) const
{
  return std::cbrt(mass(i) / store->materials.of(atom->type[i])->eos->rho0());
}

int FixHVIDebris::pieces(int i) const
{
  const double fragments = strength->fragments(i);
  if (!(fragments > 0.0)) return 1;
  const double across = size(i) / (fragments * HVI::Pieces::width(atom->tag[i]));
  return (int) std::lround(std::min(std::max(1.0, across), (double) most));
}

// by how much its cell has widened, by the rate at which it failed: as if all flew from one place

double FixHVIDebris::opened(int i) const
{
  return 1.0 + extra[i].flown * strength->state(i).expansion / 3.0;
}

bool FixHVIDebris::is_due(int i) const
{
  if (!(atom->mask[i] & groupbit) || !(extra[i].flown > 0.0)) return false;
  const int n = pieces(i);
  return n > 1 && opened(i) >= n;
}

/* ----------------------------------------------------------------------
   What is pushed again while its fragments are still together begins anew; what flew and then struck
   something has its place in it.
------------------------------------------------------------------------- */

void FixHVIDebris::end_of_step()
{
  static constexpr double PUSHED = 1.0e-3;    // of rho c^2: what is hot expands against less
  const double time = nevery * integrator->step();
  const HVI::SphView &records = store->fields.view();
  for (int i = 0; i < atom->nlocal; i++) {
    const int mask = atom->mask[i];
    if (!(mask & groupbit) || !(mask & integrator->groupbit) || (mask & store->embedded)) continue;
    if (extra[i].flown < 0.0 || !store->materials.of(atom->type[i]) || !strength->failed(i) ||
        integrator->has_frozen(i) || (ledger && ledger->clamps(mask)))
      continue;
    const HVI::SphState &s = records.state[i];
    if (records.traction[i].p > PUSHED * s.rho * s.c * s.c)
      extra[i].flown = opened(i) < 2.0 ? 0.0 : -1.0;
    else
      extra[i].flown += time;
  }
  look();
}

// what is due at the end of a run is divided in the first step of the next

void FixHVIDebris::setup(int /*vflag*/)
{
  look();
}

void FixHVIDebris::look()
{
  int here = 0, any;
  for (int i = 0; i < atom->nlocal; i++)
    if (is_due(i)) here = 1;
  MPI_Allreduce(&here, &any, 1, MPI_INT, MPI_MAX, world);
  if (any) next_reneighbor = update->ntimestep + 1;
}

void FixHVIDebris::pre_exchange()
{
  if (update->ntimestep != next_reneighbor) return;
  const int n = atom->nlocal;
  double far[2] = {0.0, 0.0};    // that a piece is put, and less the width of what ranks have
  far[1] = -BIG;
  for (int i = 0; i < n; i++) {
    if (!is_due(i)) continue;
    far[0] = MAX(far[0], opened(i) * size(i) * HVI::Pieces::corner(pieces(i)));
    split(i);
  }
  for (int k = 0; k < 3; k++)
    if (domain->subhi[k] - domain->sublo[k] < domain->prd[k])
      far[1] = MAX(far[1], domain->sublo[k] - domain->subhi[k]);
  MPI_Allreduce(MPI_IN_PLACE, far, 2, MPI_DOUBLE, MPI_MAX, world);
  if (far[0] > -far[1])
    error->all(FLERR,
               "Fix hvi/debris puts pieces up to {} away, and the box of a rank is {} wide at step "
               "{}: use fewer ranks, or other processors",
               far[0], -far[1], update->ntimestep);
  integrator->reflect();
  tell();
}

/* ----------------------------------------------------------------------
   Mass and momentum are shared out evenly.  What the pieces move apart with is taken from internal energy,
   half of it at most.
------------------------------------------------------------------------- */

void FixHVIDebris::split(int i)
{
  const int n = pieces(i), N = n * n * n;
  const double wide = size(i), far = opened(i), m = mass(i);
  double rate = strength->state(i).expansion / 3.0;
  const double square = wide * wide * HVI::Pieces::mean_square(n), e = atom->esph[i] / m;
  double spread = 0.5 * rate * rate * square;
  if (spread > 0.5 * e) {
    rate *= e > 0.0 ? std::sqrt(0.5 * e / spread) : 0.0;
    spread = 0.5 * rate * rate * square;
  }
  const auto places = HVI::Pieces::places(n, atom->tag[i]);
  const double x[3] = {atom->x[i][0], atom->x[i][1], atom->x[i][2]};
  extra[i].flown = -1.0;
  for (const auto &place : places) {
    const double at[3] = {x[0] + far * wide * place[0], x[1] + far * wide * place[1],
                          x[2] + far * wide * place[2]};
    if (!stays_in(at)) return;    // it leaves the box as a whole
  }

  atom->rmass[i] = m / N;
  atom->esph[i] = (atom->esph[i] - m * spread) / N;
  atom->desph[i] /= N;
  for (int k = 0; k < 3; k++) atom->f[i][k] /= N;
  integrator->share(i, N, m * spread);
  extra[i].pieces = n;

  const int first = atom->nlocal;
  for (int q = 1; q < N; q++) {
    double at[3] = {x[0], x[1], x[2]};
    atom->avec->create_atom(atom->type[i], at);
    atom->avec->copy(i, atom->nlocal - 1, 0);    // fixes look at what is new
    modify->create_attribute(atom->nlocal - 1);
  }
  for (int q = N - 1; q >= 0; q--) {
    const int j = q ? first + q - 1 : i;
    if (q) {
      atom->avec->copy(i, j, 0);
      atom->tag[j] = 0;
      for (int k = 0; k < 3; k++) atom->f[j][k] = atom->f[i][k];
    }
    double along[3];
    for (int k = 0; k < 3; k++) {
      atom->x[j][k] = x[k] + far * wide * places[q][k];
      along[k] = rate * wide * places[q][k];
    }
    integrator->hasten(j, along);
  }
}

// at fixed faces, what is beyond a mirror plane where it will be put

bool FixHVIDebris::stays_in(const double *x) const
{
  const HVI::MirrorPlanes &mirror = store->fields.settings.mirror;
  for (int k = 0; k < 3; k++) {
    double at = x[k];
    if (mirror.has(k) && mirror.depth(k, x) < 0.0) at = 2.0 * mirror.at[k] - at;
    if (domain->boundary[k][0] == 1 && at < domain->boxlo[k]) return false;
    if (domain->boundary[k][1] == 1 && at >= domain->boxhi[k]) return false;
  }
  return true;
}

// LAMMPS, of the new particles

void FixHVIDebris::tell()
{
  bigint here = atom->nlocal;
  MPI_Allreduce(&here, &atom->natoms, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  if (atom->natoms < 0 || atom->natoms >= MAXBIGINT)
    error->all(FLERR, "Fix hvi/debris: too many particles, {}", atom->natoms);
  atom->tag_extend();
  atom->nghost = 0;
  if (atom->map_style != Atom::MAP_NONE) {
    atom->map_init();
    atom->map_set();
  }
}

// how many particles are pieces

double FixHVIDebris::compute_scalar()
{
  bigint here = 0, all;
  for (int i = 0; i < atom->nlocal; i++) here += extra[i].pieces > 0.0;
  MPI_Allreduce(&here, &all, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  return all;
}
