/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing authors: the lammps-hvi developers
------------------------------------------------------------------------- */

#include "fix_hvi_ledger.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "force.h"
#include "hvi_anew.h"
#include "hvi_leavers.h"
#include "hvi_restart.h"
#include "math_extra.h"
#include "memory.h"
#include "modify.h"
#include "output.h"
#include "thermo.h"
#include "update.h"

#include <algorithm>
#include <cstring>

using namespace LAMMPS_NS;

using namespace FixConst;
using MathExtra::dot3;

static constexpr int RESTART_FORMAT = 1000;    // and the number of entries

static constexpr char LEDGER_ID[] = "HVI_LEDGER";

/* ---------------------------------------------------------------------- */

static bool made_by_styles = false;

FixHVILedger *FixHVILedger::instance(LAMMPS *lmp)
{
  auto found = lmp->modify->get_fix_by_style("^hvi/ledger$");
  made_by_styles = found.empty();
  Fix *ifix = found.empty() ? lmp->modify->add_fix(fmt::format("{} all hvi/ledger", LEDGER_ID))
                            : found[0];
  made_by_styles = false;
  return dynamic_cast<FixHVILedger *>(ifix);
}

/* ---------------------------------------------------------------------- */

FixHVILedger::FixHVILedger(LAMMPS *lmp, int narg, char **arg) :
    Fix(lmp, narg, arg), entry(), start_set(0), start(), breaking(0), warned(0), nerased(0),
    dt_step(0.0), nmax(0), lost(nullptr), held(lmp, &entry[CLAMP_WORK])
{
  if (!made_by_styles)
    error->all(FLERR, "Fix hvi/ledger is made by the styles that need it: use compute hvi/energy");

  restart_global = 1;
  comm_reverse = 3;
  nevery = 1;
  maxexchange = HVIClamps::SENT;
  create_attribute = 1;
  atom->add_callback(Atom::GROW);
}

/* ---------------------------------------------------------------------- */

FixHVILedger::~FixHVILedger()
{
  HVI::run_anew(update);
  memory->destroy(lost);
  atom->delete_callback(id, Atom::GROW);
}

/* ---------------------------------------------------------------------- */

int FixHVILedger::setmask()
{
  return POST_INTEGRATE | PRE_EXCHANGE | PRE_FORCE | POST_FORCE | END_OF_STEP;
}

/* ---------------------------------------------------------------------- */

void FixHVILedger::init()
{
  if (utils::strmatch(update->integrate_style, "^respa"))
    error->all(FLERR, "Compute hvi/energy and breaking bonds do not support run_style respa");

  if (!held.bits()) return;

  // clamps are what other fixes make of the forces, so see the forces before they do

  for (int i = 0; i < modify->nfix && modify->fix[i] != this; i++)
    if (modify->fmask[i] & POST_FORCE)
      error->all(FLERR,
                 "Compute hvi/energy with clamps must be defined before fix {} ({}): it books the "
                 "forces that clamps take up",
                 modify->fix[i]->id, modify->fix[i]->style);
  bool before = true;
  later = false;
  for (const Fix *const other : modify->get_fix_list()) {
    if (other == this) before = false;
    if (!before && utils::strmatch(other->style, "^wall/reflect")) later = true;
    if (utils::strmatch(other->style, "^recenter$"))
      error->all(FLERR,
                 "Compute hvi/energy with clamps goes by the way of particles, so it does not "
                 "support fix {} (recenter), which shifts them without a velocity",
                 other->id);
  }
}

/* ----------------------------------------------------------------------
   bonds that are too long from the start break in the first force evaluation:
   there is no kick to miss then, only their energy
------------------------------------------------------------------------- */

void FixHVILedger::setup(int /*vflag*/)
{
  dt_step = 0.0;
  held.begin();
  book_forces();
  end_of_step();
}

/* ---------------------------------------------------------------------- */

void FixHVILedger::post_force(int /*vflag*/)
{
  dt_step = update->dt;
  book_forces();
}

/* ----------------------------------------------------------------------
   called once per broken bond (newton_bond off: once per owner)
------------------------------------------------------------------------- */

void FixHVILedger::book_break(int n, double energy)
{
  nerased += n;
  entry[BROKEN] += energy;
  entry[BONDS_BROKEN] += force->newton_bond ? n : 0.5 * n;
}

/* ----------------------------------------------------------------------
   a bond that breaks at the end of a step has given only the first half of its
   kick.  The total that velocity Verlet keeps counts on the second, so what
   leaves with the bond is phi(r) + dt/2 F.v, v averaged over before and after
   the second half kick.  F on i is kept until that average is known.
------------------------------------------------------------------------- */

void FixHVILedger::book_lost_kick(int i, double fx, double fy, double fz)
{
  grow_lost();
  const double f[3] = {fx, fy, fz};
  add_lost(i, f);
}

/* ---------------------------------------------------------------------- */

void FixHVILedger::grow_lost()
{
  if (atom->nmax <= nmax) return;
  const int nold = nmax;
  nmax = atom->nmax;
  memory->grow(lost, nmax, 3, "hvi/ledger:lost");
  memset(&lost[nold][0], 0, 3 * sizeof(double) * (nmax - nold));
}

/* ---------------------------------------------------------------------- */

void FixHVILedger::add_lost(int i, const double *f)
{
  double *const l = lost[i];
  if (l[0] == 0.0 && l[1] == 0.0 && l[2] == 0.0) lost_list.push_back(i);
  l[0] += f[0];
  l[1] += f[1];
  l[2] += f[2];
}

/* ----------------------------------------------------------------------
   forces are complete and untouched by other fixes, velocities are those
   between the two half kicks
------------------------------------------------------------------------- */

void FixHVILedger::book_forces()
{
  if (breaking) {
    const bigint nerased_here = nerased;
    bigint nerased_all;
    MPI_Allreduce(&nerased_here, &nerased_all, 1, MPI_LMP_BIGINT, MPI_SUM, world);
    nerased = 0;
    if (nerased_all) {
      count_erased(nerased_all);
      grow_lost();
      if (force->newton_bond) comm->reverse_comm(this);
    }

    // forces that cancelled for a moment have put a particle on the list twice

    std::sort(lost_list.begin(), lost_list.end());
    lost_list.erase(std::unique(lost_list.begin(), lost_list.end()), lost_list.end());
    for (const int i : lost_list)
      if (i < atom->nlocal) entry[BROKEN] += 0.25 * dt_step * dot3(lost[i], atom->v[i]);
  }
  held.see_forces(dt_step);
}

/* ---------------------------------------------------------------------- */

void FixHVILedger::end_of_step()
{
  for (const int i : lost_list) {
    if (i < atom->nlocal) entry[BROKEN] += 0.25 * dt_step * dot3(lost[i], atom->v[i]);
    lost[i][0] = lost[i][1] = lost[i][2] = 0.0;
  }
  lost_list.clear();
  held.end_of_step();
}

/* ---------------------------------------------------------------------- */

void FixHVILedger::count_erased(bigint nrecords)
{
  atom->nbonds -= force->newton_bond ? nrecords : nrecords / 2;
}

/* ----------------------------------------------------------------------
   Particles beyond a fixed face of the box would be lost in the exchange that
   follows.  If the user lets that happen (thermo_modify lost), take them out
   here with all that leaves with them.  Velocities are those between the half
   kicks of a step of length dt (0: at a full step).
------------------------------------------------------------------------- */

void FixHVILedger::setup_pre_exchange()
{
  let_go(0.0);
}

void FixHVILedger::pre_exchange()
{
  see_moves();
  held.look();
  let_go(update->dt);
}

void FixHVILedger::let_go(double dt)
{
  HVILeavers leavers(lmp);
  const bigint nleft = leavers.pick(output->thermo->lostflag != Thermo::ERROR);
  if (nleft == 0) return;

  const HVILeavers::Account left = leavers.take_out(dt);
  entry[LEFT] += left.energy;
  for (int k = 0; k < 3; k++) entry[LEFT_PX + k] += left.momentum[k];
  entry[LEFT_MASS] += left.mass;
  entry[LEFT_PLASTIC] += left.plastic;
  entry[LEFT_VOIDS] += left.voids;
  entry[LEFT_COUNT] += left.count;

  // half the records with newton_bond off, where a bond has one at either end

  if (comm->me == 0) entry[BONDS_LEFT] += left.nrecords * (force->newton_bond ? 1.0 : 0.5);
  count_erased(left.nrecords);

  if (comm->me == 0 && output->thermo->lostflag == Thermo::WARN)
    error->warning(FLERR, "{} particles left the box at step {}", nleft, update->ntimestep);

  if (!left.unknown.empty() && !warned) {
    warned = 1;
    if (comm->me == 0)
      error->warning(FLERR,
                     "Energy of style {} between particles that leave and their neighbors is not "
                     "booked: it depends on more than types and distances",
                     utils::join_words(left.unknown, ", "));
  }
}

/* ---------------------------------------------------------------------- */

int FixHVILedger::pack_reverse_comm(int n, int first, double *buf)
{
  if (n > 0) memcpy(buf, &lost[first][0], 3 * sizeof(double) * n);
  return 3 * n;
}

/* ---------------------------------------------------------------------- */

void FixHVILedger::unpack_reverse_comm(int n, int *list, double *buf)
{
  for (int i = 0; i < n; i++, buf += 3)
    if (buf[0] != 0.0 || buf[1] != 0.0 || buf[2] != 0.0) add_lost(list[i], buf);
}

/* ---------------------------------------------------------------------- */

void FixHVILedger::totals(double *sum)
{
  MPI_Allreduce(entry, sum, NENTRY, MPI_DOUBLE, MPI_SUM, world);
}

/* ---------------------------------------------------------------------- */

// bodies at rest, or none yet, are no start: the energy that is compared with comes later

const double *FixHVILedger::first(const double *now)
{
  if (!start_set || start[START_ENERGY] == 0.0) {
    start_set = 1;
    memcpy(start, now, sizeof(start));
  }
  return start;
}

/* ----------------------------------------------------------------------
   shares are kept by rank: on the same number of ranks a continued run adds
   up the same numbers in the same order
------------------------------------------------------------------------- */

void FixHVILedger::write_restart(FILE *fp)
{
  std::vector<double> list(NENTRY * comm->nprocs);
  MPI_Gather(entry, NENTRY, MPI_DOUBLE, list.data(), NENTRY, MPI_DOUBLE, 0, world);
  if (comm->me) return;
  HVI::RestartSection section(RESTART_FORMAT + NENTRY);
  section.put(&comm->nprocs, 1);
  section.put(&start_set, 1);
  section.put(start, NSTART);
  section.put(list.data(), list.size());
  section.write_state(fp);
}

/* ---------------------------------------------------------------------- */

void FixHVILedger::restart(char *buf)
{
  HVI::RestartSection section(lmp, "Fix hvi/ledger", RESTART_FORMAT + NENTRY, buf);
  const int nprocs = section.get<int>();
  section.get(&start_set, 1);
  section.get(start, NSTART);
  std::fill_n(entry, +NENTRY, 0.0);
  for (int p = 0; p < nprocs; p++) {
    double list[NENTRY];
    section.get(list, NENTRY);
    for (int n = 0; n < NENTRY; n++)
      if (nprocs == comm->nprocs ? p == comm->me : comm->me == 0) entry[n] += list[n];
  }
}

/* ---------------------------------------------------------------------- */

double FixHVILedger::memory_usage()
{
  return 3.0 * nmax * sizeof(double) + held.memory_usage();
}
