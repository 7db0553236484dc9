/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing authors: the lammps-hvi developers
------------------------------------------------------------------------- */

#include "fix_hvi_balance.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix_hvi_store.h"
#include "force.h"
#include "irregular.h"
#include "kspace.h"
#include "modify.h"
#include "neighbor.h"
#include "pair.h"
#include "rcb.h"
#include "update.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <string>

using namespace LAMMPS_NS;
using namespace FixConst;

static constexpr double BIG = 1.0e300;

/* ---------------------------------------------------------------------- */

FixHVIBalance::FixHVIBalance(LAMMPS *lmp, int narg, char **arg) :
    Fix(lmp, narg, arg), axis(2), store(nullptr), before(1.0), after(1.0), largest(0.0),
    looked_at(-1)
{
  if (narg < 5) utils::missing_cmd_args(FLERR, "fix hvi/balance", error);
  nevery = utils::inumeric(FLERR, arg[3], false, lmp);
  most = utils::numeric(FLERR, arg[4], false, lmp);
  if (nevery < 1) error->all(FLERR, "Fix hvi/balance: every {} steps must be 1 or more", nevery);
  if (!(most >= 1.0))
    error->all(FLERR,
               "Fix hvi/balance: the cost of the fullest rank over the mean that is borne must be "
               "1 or more, not {}",
               most);
  for (int iarg = 5; iarg < narg; iarg += 2) {
    const std::string key = arg[iarg];
    if (key != "axis") error->all(FLERR, "Fix hvi/balance knows axis, not {}", key);
    if (iarg + 1 >= narg) utils::missing_cmd_args(FLERR, "fix hvi/balance axis", error);
    const std::string name = arg[iarg + 1];
    if (name.size() != 1 || name.find_first_of("xyz") != 0)
      error->all(FLERR, "Fix hvi/balance axis must be x, y or z, not {}", name);
    axis = name[0] - 'x';
  }
  if (axis != 2 && domain->dimension == 2)
    error->all(FLERR, "Fix hvi/balance: columns of two dimensions are along z");

  // as in fix balance

  box_change = BOX_CHANGE_DOMAIN;
  pre_exchange_migrate = 1;
  force_reneighbor = 1;
  next_reneighbor = -1;
  scalar_flag = vector_flag = 1;
  size_vector = 2;
  extscalar = extvector = 0;
  global_freq = 1;
  rcb = std::make_unique<RCB>(lmp);
  irregular = std::make_unique<Irregular>(lmp);
}

FixHVIBalance::~FixHVIBalance() = default;

int FixHVIBalance::setmask()
{
  return PRE_EXCHANGE;
}

void FixHVIBalance::init()
{
  if (comm->style != Comm::TILED)
    error->all(FLERR, "Fix hvi/balance needs comm_style tiled, before the box is made");
  if (domain->triclinic) error->all(FLERR, "Fix hvi/balance needs a box that is not triclinic");
  if (modify->get_fix_by_style("^hvi/balance$").size() > 1 ||
      !modify->get_fix_by_style("^balance$").empty())
    error->all(FLERR, "Fix hvi/balance beside another fix that balances: one is enough");
  store = FixHVIStore::find(lmp);
  looked_at = -1;    // each run looks at its start
}

/* ---------------------------------------------------------------------- */

void FixHVIBalance::setup_pre_exchange()
{
  look();
}

void FixHVIBalance::pre_exchange()
{
  if (update->ntimestep >= next_reneighbor || next_reneighbor > update->ntimestep + nevery)
    look();    // the latter after reset_timestep
}

// cost of the fullest rank over the mean

double FixHVIBalance::imbalance(double own)
{
  double total;
  MPI_Allreduce(&own, &largest, 1, MPI_DOUBLE, MPI_MAX, world);
  MPI_Allreduce(&own, &total, 1, MPI_DOUBLE, MPI_SUM, world);
  return total > 0.0 ? largest * comm->nprocs / total : 1.0;
}

/* ----------------------------------------------------------------------
   Particles must be in the box, which may shrink, before they migrate
------------------------------------------------------------------------- */

void FixHVIBalance::look()
{
  if (update->ntimestep == looked_at) return;
  looked_at = update->ntimestep;
  next_reneighbor = (update->ntimestep / nevery + 1) * nevery;
  domain->pbc();
  domain->reset_box();

  costs.assign(atom->nlocal + 1, 0.0);    // never null, which tells RCB that there are no weights
  for (int i = 0; i < atom->nlocal; i++) costs[i] = store ? store->fields.cost(i) : 1.0;
  before = after = imbalance(std::accumulate(costs.begin(), costs.end(), 0.0));
  if (before > most) balance();
}

/* ----------------------------------------------------------------------
   As Balance::bisection() and FixBalance::rebalance(), but for the axis: RCB gets the axes in another order, and is told
   that there are two.  Messages are sorted, so that particles come in the same order in each run.
------------------------------------------------------------------------- */

void FixHVIBalance::balance()
{
  static constexpr int SORTED = 1, ASSIGNED = 1;
  const int order[3] = {axis == 0 ? 1 : 0, axis == 2 ? 1 : 2, axis};
  const int n = atom->nlocal;
  std::vector<std::array<double, 3>> places(n);
  std::vector<double *> x(n);
  double mine[6] = {BIG, BIG, BIG, BIG, BIG, BIG}, all[6];    // least, and minus the most
  for (int i = 0; i < n; i++) {
    for (int k = 0; k < 3; k++) {
      const double at = places[i][k] = atom->x[i][order[k]];
      mine[k] = std::min(mine[k], at);
      mine[3 + k] = std::min(mine[3 + k], -at);
    }
    x[i] = places[i].data();
  }
  MPI_Allreduce(mine, all, 6, MPI_DOUBLE, MPI_MIN, world);
  double low[3], high[3];
  for (int k = 0; k < 3; k++) {
    low[k] = all[k];
    high[k] = -all[3 + k];
    if (low[k] < high[k]) continue;
    low[k] = domain->boxlo[order[k]];
    high[k] = domain->boxhi[order[k]];
  }
  rcb->compute(2, n, x.data(), costs.data(), low, high);

  // particles that lie in one plane are cut in it, into domains without width: there ranks do not agree about
  // their neighbors, and hang

  static constexpr double NARROW = 0.01;
  double width = BIG, narrowest;
  for (int k = 0; k < 2; k++) width = std::min(width, rcb->hi[k] - rcb->lo[k]);
  MPI_Allreduce(&width, &narrowest, 1, MPI_DOUBLE, MPI_MIN, world);
  if (!(narrowest > NARROW * neighbor->skin)) return;
  rcb->invert(SORTED);

  comm->layout = Comm::LAYOUT_TILED;
  comm->rcbnew = 1;
  comm->rcbcutdim = rcb->cutdim < 0 ? -1 : order[rcb->cutdim];
  comm->rcbcutfrac = rcb->cutdim < 0
      ? 0.0
      : (rcb->cut - domain->boxlo[comm->rcbcutdim]) / domain->prd[comm->rcbcutdim];
  for (int k = 0; k < 3; k++) {
    const int d = order[k];
    double *const split = comm->mysplit[d];
    split[0] = rcb->lo[k] == low[k] ? 0.0 : (rcb->lo[k] - domain->boxlo[d]) / domain->prd[d];
    split[1] = rcb->hi[k] == high[k] ? 1.0 : (rcb->hi[k] - domain->boxlo[d]) / domain->prd[d];
  }
  domain->set_local_box();
  domain->subbox_too_small_check(neighbor->skin);

  std::vector<double> given(comm->nprocs, 0.0), received(comm->nprocs);
  for (int i = 0; i < n; i++) given[rcb->sendproc[i]] += costs[i];
  MPI_Allreduce(given.data(), received.data(), comm->nprocs, MPI_DOUBLE, MPI_SUM, world);
  after = imbalance(received[comm->me]);

  irregular->migrate_atoms(SORTED, ASSIGNED, rcb->sendproc);
  modify->reset_grid();
  if (force->pair) force->pair->reset_grid();
  if (force->kspace) force->kspace->reset_grid();
}

double FixHVIBalance::memory_usage()
{
  return irregular->memory_usage() + rcb->memory_usage() + costs.capacity() * sizeof(double);
}
