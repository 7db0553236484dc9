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

#include "comm.h"
#include "error.h"
#include "hvi_interface.h"
#include "hvi_restart.h"
#include "neighbor.h"
#include "output.h"
#include "update.h"

#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;
using namespace FixConst;

static constexpr int RESTART_FORMAT = 1;

enum { MAXIMUM, CONTACT, SPRING, APPROACH, GROWING, SIGNAL, NLIMITER };

/* ---------------------------------------------------------------------- */

FixHVIDt::FixHVIDt(LAMMPS *lmp, int narg, char **arg) :
    Fix(lmp, narg, arg), dtmin(0.0), dtmax(HVI::NO_BOUND), floor(0.01), asked(0), every(1),
    limiter(MAXIMUM), restored(0.0), chosen(0), running(false), laststep(0), first(0.0)
{
  if (narg < 4) utils::missing_cmd_args(FLERR, "fix hvi/dt", error);

  time_depend = 1;    // elapsed time is accumulated by Update
  scalar_flag = vector_flag = 1;
  size_vector = 3;
  global_freq = 1;
  extscalar = extvector = 0;
  dynamic_group_allow = 1;
  restart_global = 1;
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
    } else if (strcmp(arg[iarg], "floor") == 0) {
      floor = utils::numeric(FLERR, arg[iarg + 1], false, lmp);
      if (!(floor >= 0.0) || !(floor < 1.0))
        error->all(FLERR, "Fix hvi/dt floor must be >= 0 and < 1, not {}", arg[iarg + 1]);
    } else if (strcmp(arg[iarg], "every") == 0) {
      asked = utils::inumeric(FLERR, arg[iarg + 1], false, lmp);
      if (asked <= 0) error->all(FLERR, "Fix hvi/dt every must be > 0, not {}", arg[iarg + 1]);
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
  for (const Fix *const other : modify->get_fix_by_style("^dt/reset"))
    error->all(FLERR, "Fix {} ({}) chooses the time step, as fix hvi/dt does: use one of them",
               other->id, other->style);

  sources = HVI::find_interface<HVI::TimeStepSource>(lmp);
  if (sources.empty())
    error->all(FLERR, "Fix hvi/dt needs a pair style, bond style or fix that limits the time step");
  every = asked ? asked : (HVI::at_hand(sources) ? 1 : 10);
}

/* ----------------------------------------------------------------------
   a run from a restart file keeps the step it was interrupted with, one after
   another run, or from a restart file written after it, goes on from its step
------------------------------------------------------------------------- */

void FixHVIDt::setup(int /*vflag*/)
{
  // reset_timestep may have turned back the clock

  if (laststep > update->ntimestep) laststep = update->ntimestep;
  if (update->dt != restored || update->dt > dtmax)    // by the command timestep, a new max
    apply(choose(chosen));
  restored = 0.0;
  chosen = 1;
  running = true;
}

void FixHVIDt::post_run()
{
  running = false;
}

/* ---------------------------------------------------------------------- */

void FixHVIDt::end_of_step()
{
  // a pair that is new in the list has not been looked at yet

  if (update->ntimestep % every && neighbor->lastcall != update->ntimestep) return;
  apply(choose(1));
}

/* ----------------------------------------------------------------------
   going on: the step may shrink at once, but grow only so much since it was
   chosen last
------------------------------------------------------------------------- */

double FixHVIDt::choose(int going_on)
{
  const HVI::StableSteps stable = HVI::stable_steps(lmp, sources, factor);
  const double grown = going_on ? std::pow(stable.growth, update->ntimestep - laststep) * update->dt
                                : HVI::NO_BOUND;
  laststep = update->ntimestep;

  const double bound[NLIMITER] = {dtmax,           stable.contact, stable.spring,
                                  stable.approach, grown,          stable.signal};
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
    error->all(FLERR, "Time step {} of fix hvi/dt fell below min {} at step {}{}", dt, dtmin,
               update->ntimestep, limiter == SIGNAL ? fastest_signal() : "");
  if (limiter == SIGNAL && dt < floor * first)
    error->all(FLERR,
               "Time step {} of fix hvi/dt fell below floor {} times the first one, {}, at step "
               "{}{}: find out why, or give fix hvi/dt another floor",
               dt, floor, first, update->ntimestep, fastest_signal());
  if (dt >= factor * HVI::NO_BOUND)
    error->all(FLERR, "Fix hvi/dt finds nothing that limits the time step: give it a max");
  if (first == 0.0) first = dt;
  return dt;
}

/* ----------------------------------------------------------------------
   what the source says that has the shortest signal bound of all ranks
------------------------------------------------------------------------- */

std::string FixHVIDt::fastest_signal()
{
  struct {
    double time;
    int rank;
  } here = {HVI::NO_BOUND, comm->me}, shortest;
  HVI::TimeStepSource *fastest = nullptr;
  for (auto *source : sources) {
    HVI::TimeStepBounds bounds;
    source->tighten(bounds);
    const double time = MIN(factor * bounds.signal, bounds.stable);
    if (time < here.time) {
      here.time = time;
      fastest = source;
    }
  }
  MPI_Allreduce(&here, &shortest, 1, MPI_DOUBLE_INT, MPI_MINLOC, world);

  char text[400] = "";
  if (comm->me == shortest.rank && fastest)
    snprintf(text, sizeof(text), "%s", fastest->fastest_signal().c_str());
  MPI_Bcast(text, sizeof(text), MPI_CHAR, shortest.rank, world);
  return text[0] ? std::string(", ") + text : "";
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

/* ---------------------------------------------------------------------- */

void FixHVIDt::write_restart(FILE *fp)
{
  if (comm->me) return;
  const double kept = running ? update->dt : 0.0;    // between runs: the next one chooses
  const double list[4] = {kept, (double) limiter, (double) laststep, first};
  HVI::RestartSection section(RESTART_FORMAT);
  section.put(list, 4);
  section.write_state(fp);
}

/* ---------------------------------------------------------------------- */

void FixHVIDt::restart(char *buf)
{
  double list[4];
  HVI::RestartSection(lmp, "Fix hvi/dt", RESTART_FORMAT, buf).get(list, 4);
  update->dt_default = 0;    // the step itself is that of the file, or of a command timestep since
  limiter = static_cast<int>(list[1]);
  laststep = static_cast<bigint>(list[2]);
  first = list[3];
  restored = list[0];
  chosen = 1;
}
