/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing authors: the lammps-hvi developers
------------------------------------------------------------------------- */

#include "fix_hvi_dt.h"

#include "atom.h"
#include "bond_hvi_spring.h"
#include "comm.h"
#include "error.h"
#include "force.h"
#include "modify.h"
#include "neighbor.h"
#include "output.h"
#include "pair_hvi_contact.h"
#include "pair_hvi_sph.h"
#include "update.h"

#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;
using namespace FixConst;

static constexpr double BIG = 1.0e100;

// The step may shrink at once but grows by no more than this in one step: velocity Verlet keeps
// energy only while its step changes slowly.  Where a whole plate is struck at once and rebounds,
// 0.2 % in place of 0.05 % costs 40 times the drift (examples/dem-scaling, 6 layers at 2 km/s).

static constexpr double GROWTH = 1.0005;

// SPH dissipates where it shocks, and its sound speeds are smooth: there it may grow faster

static constexpr double GROWTH_SPH = 1.01;

// no two particles come closer by more than this part of a contact distance in one step, so
// that a pair is seen on its approach before it is deep in contact

static constexpr double TRAVEL = 0.1;

enum { MAXIMUM, CONTACT, SPRING, APPROACH, GROWING, SIGNAL, NLIMITER };

/* ---------------------------------------------------------------------- */

FixHVIDt::FixHVIDt(LAMMPS *lmp, int narg, char **arg) :
    Fix(lmp, narg, arg), dtmin(0.0), dtmax(BIG), every(10), limiter(MAXIMUM), elastic(0),
    restored(0), chosen(0), laststep(0), reach(0.0)
{
  if (narg < 4) utils::missing_cmd_args(FLERR, "fix hvi/dt", error);

  time_depend = 1;    // elapsed time is accumulated by Update
  scalar_flag = vector_flag = 1;
  size_vector = 3;
  global_freq = 1;
  extscalar = extvector = 0;
  dynamic_group_allow = 1;
  restart_global = 1;
  comm_forward = 3;
  nevery = 1;

  factor = utils::numeric(FLERR, arg[3], false, lmp);
  if (!(factor > 0.0) || !(factor < 1.0))
    error->all(FLERR, "Fix hvi/dt factor C must be > 0 and < 1, not {}", arg[3]);

  int iarg = 4;
  while (iarg < narg) {
    if (iarg + 2 > narg)
      utils::missing_cmd_args(FLERR, fmt::format("fix hvi/dt {}", arg[iarg]), error);
    if (strcmp(arg[iarg], "min") == 0) {
      dtmin = utils::numeric(FLERR, arg[iarg + 1], false, lmp);
      if (!(dtmin >= 0.0) || !std::isfinite(dtmin))
        error->all(FLERR, "Fix hvi/dt min must be >= 0, not {}", arg[iarg + 1]);
    } else if (strcmp(arg[iarg], "max") == 0) {
      dtmax = utils::numeric(FLERR, arg[iarg + 1], false, lmp);
      if (!(dtmax > 0.0) || !std::isfinite(dtmax))
        error->all(FLERR, "Fix hvi/dt max must be > 0, not {}", arg[iarg + 1]);
    } else if (strcmp(arg[iarg], "every") == 0) {
      every = utils::inumeric(FLERR, arg[iarg + 1], false, lmp);
      if (every <= 0) error->all(FLERR, "Fix hvi/dt every must be > 0, not {}", arg[iarg + 1]);
    } else
      error->all(FLERR, "Unknown fix hvi/dt keyword: {}", arg[iarg]);
    iarg += 2;
  }
  if (dtmin >= dtmax) error->all(FLERR, "Fix hvi/dt min {} must be below max {}", dtmin, dtmax);
}

/* ---------------------------------------------------------------------- */

int FixHVIDt::setmask()
{
  return END_OF_STEP;
}

/* ---------------------------------------------------------------------- */

void FixHVIDt::init()
{
  if (utils::strmatch(update->integrate_style, "^respa"))
    error->all(FLERR, "Fix hvi/dt does not support run_style respa");
  if (modify->get_fix_by_style("^hvi/dt$").size() > 1)
    error->all(FLERR, "More than one fix hvi/dt");

  sources.clear();
  // hybrid may hold several

  const bool hybrid = utils::strmatch(force->pair_style, "^hybrid");
  for (int nsub = hybrid ? 1 : 0; Pair *pair = force->pair_match("hvi/contact", 1, nsub); nsub++) {
    sources.push_back(dynamic_cast<HVI::TimeStepSource *>(pair));
    if (!hybrid) break;
  }
  auto *spring = dynamic_cast<HVI::TimeStepSource *>(force->bond_match("hvi/spring"));
  if (spring) sources.push_back(spring);
  elastic = !sources.empty();
  if (auto *sph = dynamic_cast<PairHVISPH *>(force->pair_match("^hvi/sph$", 0)))
    sources.push_back(sph);
  if (sources.empty())
    error->all(
        FLERR,
        "Fix hvi/dt needs pair style hvi/contact, bond style hvi/spring or pair style hvi/sph");

  // shortest distance over which pairs act

  reach = BIG;
  if (force->pair)
    for (int i = 1; i <= atom->ntypes; i++)
      for (int j = i; j <= atom->ntypes; j++)
        if (force->pair->cutsq[i][j] > 0.0) reach = MIN(reach, std::sqrt(force->pair->cutsq[i][j]));
}

/* ----------------------------------------------------------------------
   a run from a restart file keeps the step it was interrupted with, one after
   another run goes on from its step
------------------------------------------------------------------------- */

void FixHVIDt::setup(int /*vflag*/)
{
  // reset_timestep may have turned back the clock

  if (laststep > update->ntimestep) laststep = update->ntimestep;
  if (restored)
    restored = 0;
  else
    apply(choose(chosen ? grown() : BIG));
  chosen = 1;
}

/* ---------------------------------------------------------------------- */

void FixHVIDt::end_of_step()
{
  // a pair that is new in the list has not been looked at yet

  if (update->ntimestep % every && neighbor->lastcall != update->ntimestep) return;
  apply(choose(grown()));
}

/* ---------------------------------------------------------------------- */

double FixHVIDt::grown() const
{
  return std::pow(elastic ? GROWTH : GROWTH_SPH, update->ntimestep - laststep) * update->dt;
}

/* ---------------------------------------------------------------------- */

double FixHVIDt::choose(double limit)
{
  laststep = update->ntimestep;
  comm->forward_comm(this);

  HVI::TimeStepBounds bounds = {BIG, BIG, BIG, BIG};
  for (auto &source : sources) source->tighten(bounds);

  // the same, with the extremes of velocity: min v and min -v in each direction

  double mine[10] = {bounds.contact, bounds.spring, bounds.approach, BIG, BIG, BIG, BIG, BIG, BIG,
                     bounds.signal};
  double sum = 0.0;
  for (int i = 0; i < atom->nlocal; i++)
    for (int k = 0; k < 3; k++) {
      const double v = atom->v[i][k];
      mine[3 + k] = MIN(mine[3 + k], v);
      mine[6 + k] = MIN(mine[6 + k], -v);
      sum += v;
    }

  // MPI_MIN may drop a NaN, so carry it as the smallest number of all

  double all[10];
  for (int k = 0; k < 10; k++)
    if (std::isnan(mine[k]) || !std::isfinite(sum)) mine[k] = -1.0;
  MPI_Allreduce(mine, all, 10, MPI_DOUBLE, MPI_MIN, world);

  double spread = 0.0, travel = BIG;
  if (atom->natoms > 0)
    for (int k = 3; k < 6; k++) spread += (all[k] + all[k + 3]) * (all[k] + all[k + 3]);
  if (elastic && spread > 0.0) travel = TRAVEL * reach / std::sqrt(spread);

  const double bound[NLIMITER] = {dtmax,           factor * all[0],
                                  factor * all[1], MIN(factor * all[2], travel),
                                  limit,           factor * all[9]};
  limiter = MAXIMUM;
  for (int n = 0; n < NLIMITER; n++)
    if (bound[n] < bound[limiter]) limiter = n;

  const double dt = bound[limiter];
  if (!(dt > 0.0))
    error->all(FLERR,
               "Time step of fix hvi/dt is not a number at step {}: particles overlap or "
               "positions or velocities are NaN",
               update->ntimestep);
  if (dt < dtmin)
    error->all(FLERR, "Time step {} of fix hvi/dt fell below min {} at step {}", dt, dtmin,
               update->ntimestep);
  if (dt >= factor * BIG)
    error->all(FLERR, "Fix hvi/dt finds nothing that limits the time step: give it a max");
  return dt;
}

/* ----------------------------------------------------------------------
   as fix dt/reset does
------------------------------------------------------------------------- */

void FixHVIDt::apply(double dt)
{
  if (dt == update->dt) return;

  update->update_time();
  update->dt = dt;
  update->dt_default = 0;
  if (force->pair) force->pair->reset_dt();
  for (auto &ifix : modify->get_fix_list()) ifix->reset_dt();
  output->reset_dt();
}

/* ---------------------------------------------------------------------- */

double FixHVIDt::compute_scalar()
{
  return update->dt;
}

/* ---------------------------------------------------------------------- */

double FixHVIDt::compute_vector(int n)
{
  if (n == 0) return update->dt;
  if (n == 1) return update->atime + (update->ntimestep - update->atimestep) * update->dt;
  return limiter;
}

/* ----------------------------------------------------------------------
   velocities of ghost particles, needed on the steps that choose dt only
------------------------------------------------------------------------- */

int FixHVIDt::pack_forward_comm(int n, int *list, double *buf, int /*pbc_flag*/, int * /*pbc*/)
{
  int m = 0;
  for (int i = 0; i < n; i++) {
    const double *const v = atom->v[list[i]];
    buf[m++] = v[0];
    buf[m++] = v[1];
    buf[m++] = v[2];
  }
  return m;
}

/* ---------------------------------------------------------------------- */

void FixHVIDt::unpack_forward_comm(int n, int first, double *buf)
{
  int m = 0;
  for (int i = first; i < first + n; i++) {
    atom->v[i][0] = buf[m++];
    atom->v[i][1] = buf[m++];
    atom->v[i][2] = buf[m++];
  }
}

/* ---------------------------------------------------------------------- */

void FixHVIDt::write_restart(FILE *fp)
{
  if (comm->me) return;
  const double list[3] = {update->dt, (double) limiter, (double) laststep};
  const int size = sizeof(list);
  fwrite(&size, sizeof(int), 1, fp);
  fwrite(list, sizeof(double), 3, fp);
}

/* ---------------------------------------------------------------------- */

void FixHVIDt::restart(char *buf)
{
  const double *const list = (double *) buf;
  update->dt = list[0];
  update->dt_default = 0;
  limiter = static_cast<int>(list[1]);
  laststep = static_cast<bigint>(list[2]);
  restored = 1;
}
