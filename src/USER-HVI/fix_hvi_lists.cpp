/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing authors: the lammps-hvi developers
------------------------------------------------------------------------- */

#include "fix_hvi_lists.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "hvi_anew.h"
#include "hvi_mesh.h"
#include "memory.h"
#include "modify.h"
#include "nbin.h"
#include "neigh_list.h"
#include "neighbor.h"
#include "npair.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;
using namespace FixConst;

static constexpr char LISTS_ID[] = "HVI_LISTS";
static constexpr int NEVER = MAXSMALLINT;    // neigh_modify delay, while this fix is in charge
static constexpr double FAR_AWAY = 1.0e100;
static constexpr int LOOK_AHEAD = 5;     // steps
static constexpr double MARGIN = 1.5;    // for velocities that change in these steps

static constexpr double LEAST_BOX = 0.01;      // bins, or LAMMPS makes none
static constexpr double MOST_BINS = 1.0e18;    // of that size: no debris flies so far

static bool making = false;    // else it stands in an input, or goes for good

/* ---------------------------------------------------------------------- */

FixHVILists::FixHVILists(LAMMPS *lmp, int narg, char **arg) :
    Fix(lmp, narg, arg), has_rows(false), moved(nullptr), going(nullptr),
    nmax(0), farthest{}, beyond{}, unseen{}, delay(0), relative(true), ahead(false), made(0),
    next(0), looked(0), known(false), leaving(false),
    put_back(false), put{-1, 0.0, -1.0}, given{0, 0.0, 0.0}
{
  if (!making)
    error->all(FLERR, "Fix hvi/lists is made by pair styles and cannot be given in an input");
  force_reneighbor = 1;
  next_reneighbor = -1;
  comm_forward = SENT;
}

/* ---------------------------------------------------------------------- */

FixHVILists::~FixHVILists()
{
  if (!making) HVI::run_anew(update);    // in an init() another takes its place
  if (neighbor) give_back();             // also if an error has ended the run
  memory->destroy(moved);
  memory->destroy(going);
}

/* ---------------------------------------------------------------------- */

FixHVILists *FixHVILists::make(LAMMPS *lmp, bool relative, bool ahead)
{
  making = true;
  if (lmp->modify->get_fix_by_id(LISTS_ID)) lmp->modify->delete_fix(LISTS_ID);
  auto *const made =
      dynamic_cast<FixHVILists *>(lmp->modify->add_fix(fmt::format("{} all hvi/lists", LISTS_ID)));
  making = false;
  made->relative = relative;
  made->ahead = ahead;
  made->comm_forward = ahead ? 2 * SENT : SENT;
  return made;
}

/* ---------------------------------------------------------------------- */

int FixHVILists::setmask()
{
  return POST_INTEGRATE | PRE_EXCHANGE | PRE_NEIGHBOR;
}

/* ----------------------------------------------------------------------
   who gives neigh_modify another delay, every or check wants LAMMPS to decide; so does a box that
   changes, and another pair style; with comm_modify mode multi ghosts of a type may reach less far
------------------------------------------------------------------------- */

bool FixHVILists::in_charge() const
{
  if (!relative || !force->pair_match(ahead ? "^hvi/contact" : "^hvi/sph$", 0, 1)) return false;
  for (const auto &ifix : modify->get_fix_list())
    if (ifix->box_change & (BOX_CHANGE_SIZE | BOX_CHANGE_SHAPE)) return false;
  return (neighbor->delay == 0 || neighbor->delay == NEVER) && neighbor->every == 1 &&
      neighbor->dist_check && !neighbor->build_once && !neighbor->includegroup &&
      !domain->triclinic && comm->mode == Comm::SINGLE;
}

// else lists lack pairs, or say more of them than that they are neighbors, or cells are much wider than those need

bool FixHVILists::may_keep_rows(double cut) const
{
  static constexpr double WIDE = 1.5;
  if (comm->cutghostuser - neighbor->skin > WIDE * cut) return false;
  return in_charge() && !utils::strmatch(force->pair_style, "^hybrid") &&
      neighbor->style == Neighbor::BIN &&
      neighbor->nex_type + neighbor->nex_group + neighbor->nex_mol == 0 &&
      atom->molecular == Atom::ATOMIC && !HVI::find_mesh(lmp);
}

/* ----------------------------------------------------------------------
   LAMMPS fills the box with bins of half the reach, twice, for neighbors and for sorting.  A box that grows with
   debris would have more of them than there is memory: beyond so many they are wider.  A box without end says that
   something else is wrong.
------------------------------------------------------------------------- */

void FixHVILists::init()
{
  set_bins(0.0, 0.0);
  if (force->pair && neighbor->style == Neighbor::BIN)
    check_box(domain->prd, force->pair->cutforce + neighbor->skin);
  if (update->whichflag)
    set_bins(0.0, least_bins(false));    // LAMMPS makes those for sorting before it asks fixes
}

void FixHVILists::setup_pre_exchange()
{
  const double least = least_bins(true);
  set_bins(least, least);
}

void FixHVILists::pre_exchange()
{
  if (!domain->box_change) return;
  const double least = least_bins(false);
  set_bins(least, least);
}

// of a box that is about to be another, both count; not where it begins to follow the particles

double FixHVILists::least_bins(bool shrinks) const
{
  static constexpr double MANY = 4.0e6, PER_PARTICLE = 16.0, FLAT = 99.0;
  double ends[6], length[3] = {}, size = 1.0, shortest = FAR_AWAY;    // ends: less the highest
  const double least_box[2][3] = {{domain->minxlo, domain->minylo, domain->minzlo},
                                  {domain->minxhi, domain->minyhi, domain->minzhi}};
  for (int k = 0; k < 3; k++)
    for (int side = 0; side < 2; side++) {
      const int face = domain->boundary[k][side], sign = side ? -1 : 1;
      double &end = ends[3 * side + k];
      end = sign * (side ? domain->boxhi : domain->boxlo)[k];
      if (shrinks && atom->natoms > 0 && face == 2) end = FAR_AWAY;
      if (shrinks && face == 3) end = sign * least_box[side][k];
    }
  for (int i = 0; i < atom->nlocal && domain->nonperiodic == 2; i++)
    for (int k = 0; k < 3; k++) {    // NaN is less than nothing
      const double x = atom->x[i][k];
      if (domain->boundary[k][0] >= 2 && x < ends[k]) ends[k] = x;
      if (domain->boundary[k][1] >= 2 && -x < ends[3 + k]) ends[3 + k] = -x;
    }
  MPI_Allreduce(MPI_IN_PLACE, ends, 6, MPI_DOUBLE, MPI_MIN, world);
  for (int k = 0; k < domain->dimension; k++) {
    length[k] = MAX(-(ends[k] + ends[3 + k]), 0.0);
    if (!(length[k] < FAR_AWAY)) return 0.0;    // no particle has a place: LAMMPS says so
    if (length[k] > 0.0) shortest = MIN(shortest, length[k]);
    size *= length[k];
  }
  if (force->pair && neighbor->style == Neighbor::BIN && domain->nonperiodic == 2)
    check_box(length, force->pair->cutforce + neighbor->skin);
  const double least = pow(size / (MANY + PER_PARTICLE * atom->natoms), 1.0 / domain->dimension);
  return MIN(least, FLAT * shortest);
}

/* ----------------------------------------------------------------------
   0: those of neigh_modify and atom_modify sort again.  What stands there is theirs, unless it was put there here.
------------------------------------------------------------------------- */

void FixHVILists::set_bins(double least, double least_sort)
{
  const double bin = neighbor->binsizeflag ? neighbor->binsize_user : 0.0;    // else it is not set
  if (neighbor->binsizeflag != put.wide || bin != put.bin)
    given = {neighbor->binsizeflag, bin, given.sort_bin};
  if (atom->userbinsize != put.sort_bin) given.sort_bin = atom->userbinsize;

  const bool any = least > 0.0 || least_sort > 0.0;    // else it may be before cutforce is set
  const double half = any && force->pair ? 0.5 * (force->pair->cutforce + neighbor->skin) : 0.0;
  if (half == 0.0) least = least_sort = 0.0;    // LAMMPS has no bins then
  const bool wider = least > (given.wide ? given.bin : half);
  const bool sorts = least_sort > (given.sort_bin > 0.0 ? given.sort_bin : half);
  put = {wider ? 1 : given.wide, wider ? least : given.bin, sorts ? least_sort : given.sort_bin};
  neighbor->binsizeflag = put.wide;
  neighbor->binsize_user = put.bin;
  atom->userbinsize = put.sort_bin;
  for (int k = 0; k < neighbor->nlist; k++)
    if (NPair *const builds = neighbor->lists[k]->np)
      if (builds->nb) builds->nb->copy_neighbor_info();
}

// restart files have it, and particles are sorted by now

void FixHVILists::give_back_sorting()
{
  if (atom->userbinsize != put.sort_bin) return;
  atom->userbinsize = put.sort_bin = given.sort_bin;
}

void FixHVILists::check_box(const double *length, double cut) const
{
  const double width = given.wide ? given.bin : 0.5 * cut;
  double bins = 1.0;
  for (int k = 0; k < domain->dimension && cut > 0.0; k++) {
    if (length[k] < LEAST_BOX * width)
      error->all(
          FLERR,
          "Particles are looked for within {:.6g}, the reach of the pair style and the skin, in "
          "a box that is only {:.6g} long along {}: is the reach of a type in other units?",
          cut, length[k], "xyz"[k]);
    bins *= 1.0 + length[k] / width;
  }
  if (bins > MOST_BINS)
    error->all(
        FLERR,
        "The box is {:.4g} by {:.4g} by {:.4g} long, {:.3g} bins of neighbors for a reach of "
        "{:.4g}: have particles flown far away, for the simulation is unstable or its time "
        "step too long, or is the reach of a type in other units? Fixed faces (boundary f) "
        "keep a box as it is",
        length[0], length[1], length[2], bins, cut);
}

/* ---------------------------------------------------------------------- */

void FixHVILists::setup_pre_neighbor()
{
  pre_neighbor();
}

void FixHVILists::pre_neighbor()
{
  put_back = false;
  give_back_sorting();
  if (ahead && !in_charge()) return;    // nobody else asks for the cells
  made = update->ntimestep;
  next = made + 1;
  looked = made;
  const int nlocal = atom->nlocal;
  if (nlocal) hold.assign(atom->x[0], atom->x[0] + 3 * (size_t) nlocal);
  const double cut = neighbor->cutneighmax - neighbor->skin;

  // lists of computes may reach as far as ghosts do

  const double reach = MAX(cut, comm->cutghostuser - neighbor->skin);
  motion.start(nlocal + atom->nghost, atom->x, reach, neighbor->skin);
  if (has_rows)
    made_rows.start(motion,
                    {nlocal, nlocal + atom->nghost, atom->x, atom->type, neighbor->cutneighsq,
                     neighbor->cutneighmax * neighbor->cutneighmax, force->newton_pair != 0,
                     neighbor->oneatom});

  // Exchange reaches the ranks next door.  Who owns the place half-way between two has both, as owned or
  // ghosts, unless they are more than two cutoffs of ghosts apart in some direction.  Both does
  // not matter where no rank ends.

  double width[3];
  for (int k = 0; k < 3; k++) {
    const double sub = domain->subhi[k] - domain->sublo[k];
    width[k] = domain->periodicity[k] || sub < 0.999 * domain->prd[k] ? sub : FAR_AWAY;
    for (int side = 0; side < 2; side++)
      beyond[3 * side + k] = domain->boundary[k][side] != 1 ? FAR_AWAY
          : side                                            ? domain->boxhi[k] + cut
                                                            : cut - domain->boxlo[k];
  }
  MPI_Allreduce(MPI_IN_PLACE, width, 3, MPI_DOUBLE, MPI_MIN, world);
  const double ghosts = MAX(neighbor->cutneighmax, comm->cutghostuser);
  for (int k = 0; k < 3; k++) {
    farthest[k] = 0.5 * width[k];
    unseen[k] = width[k] < FAR_AWAY ? 2.0 * ghosts - (reach + neighbor->skin) : FAR_AWAY;
  }
}

/* ---------------------------------------------------------------------- */

void FixHVILists::setup(int /*vflag*/)
{
  if (!in_charge()) {
    give_back();
    return;
  }
  if (neighbor->delay != NEVER) delay = neighbor->delay;
  neighbor->delay = NEVER;
}

void FixHVILists::give_back()
{
  set_bins(0.0, 0.0);
  if (neighbor->delay == NEVER) neighbor->delay = delay;
}

/* ----------------------------------------------------------------------
   commands between runs look for particles in the box, where the last step of a run has put them unless fix halt or
   a timer has ended it: lists and ghosts are then those of other places
------------------------------------------------------------------------- */

void FixHVILists::post_run()
{
  const bool was_in_charge = neighbor->delay == NEVER;
  give_back();
  if (!was_in_charge || !strays()) return;
  domain->pbc();
  put_back = true;
  atom->nghost = 0;
  if (atom->map_style != Atom::MAP_NONE) {
    atom->map_init();
    atom->map_set();
  }
}

/* ---------------------------------------------------------------------- */

void FixHVILists::post_integrate()
{
  // with run ... pre no nothing is set up, and post_run() of the run before has given the delay back

  if (update->ntimestep == update->firststep + 1) {
    setup(0);
    if (made > update->firststep || next > update->ntimestep + LOOK_AHEAD) {    // reset_timestep
      made = looked = update->firststep;
      next = update->ntimestep;
    }
  }
  if (put_back) next_reneighbor = update->ntimestep;
  if (neighbor->delay != NEVER) return;

  // commands between runs look for particles in the box

  if (update->ntimestep == update->laststep && strays()) next_reneighbor = update->ntimestep;
  if (update->ntimestep < next) return;
  measure();
  const bigint last = looked;
  looked = update->ntimestep;

  bool renew = exceeded(ahead ? LOOK_AHEAD * MARGIN * update->dt : 0.0);
  if (ahead && renew) {
    const bool late = exceeded(0.0);
    if (late && update->ntimestep > last + 1) neighbor->ndanger++;

    // a list that is old need not get older by some steps, at the cost of a look in each of them

    renew = late || update->ntimestep - made >= 4 * LOOK_AHEAD;
    next = update->ntimestep + 1;
  } else
    next = update->ntimestep + (ahead ? LOOK_AHEAD : 1);

  if (renew || leaving) next_reneighbor = update->ntimestep;
}

// whether any particle of all ranks is outside of periodic faces, in a box that is not triclinic: see in_charge()

bool FixHVILists::strays() const
{
  int here = 0, any;
  for (int i = 0; i < atom->nlocal && !here; i++) {
    const double *const x = atom->x[i];
    for (int k = 0; k < 3; k++)
      if (domain->periodicity[k] && !(x[k] >= domain->boxlo[k] && x[k] < domain->boxhi[k]))
        here = 1;
  }
  MPI_Allreduce(&here, &any, 1, MPI_INT, MPI_MAX, world);
  return any;
}

/* ----------------------------------------------------------------------
   how far owned particles and ghosts have come, and how fast they are; what has moved by no number
   would never ask for lists, in which LAMMPS finds it
------------------------------------------------------------------------- */

void FixHVILists::measure()
{
  if (atom->nmax > nmax) {
    nmax = atom->nmax;
    memory->destroy(moved);
    memory->create(moved, nmax, SENT, "hvi/lists:moved");
    if (ahead) {
      memory->destroy(going);
      memory->create(going, nmax, SENT, "hvi/lists:going");
    }
  }
  const int nlocal = atom->nlocal;
  const double *const *const x = atom->x;
  known = motion.points() == nlocal + atom->nghost;    // none came in between
  for (int i = 0; i < nlocal; i++) {
    for (int k = 0; k < 3; k++) moved[i][k] = known ? x[i][k] - hold[3 * i + k] : 0.0;
    if (!std::isfinite(moved[i][0] + moved[i][1] + moved[i][2]))
      error->one(FLERR, "Particle {} is at {} {} {} at step {}: the simulation is unstable",
                 atom->tag[i], x[i][0], x[i][1], x[i][2], update->ntimestep);
  }
  if (ahead && nlocal) memcpy(going[0], atom->v[0], 3 * (size_t) nlocal * sizeof(double));
  comm->forward_comm(this);
}

/* ----------------------------------------------------------------------
   may pairs be missing on any rank, now or up to this time from now?
------------------------------------------------------------------------- */

bool FixHVILists::exceeded(double time)
{
  const double *const *const x = atom->x;
  double lo[3] = {0.0, 0.0, 0.0}, hi[3] = {0.0, 0.0, 0.0};
  leaving = false;
  for (int i = 0; i < atom->nlocal; i++)
    for (int k = 0; k < 3; k++) {
      leaving |= -x[i][k] > beyond[k] || x[i][k] > beyond[3 + k];
      const double now = moved[i][k], then = ahead ? now + time * going[i][k] : now;
      lo[k] = i ? std::min({lo[k], now, then}) : std::min(now, then);
      hi[k] = i ? std::max({hi[k], now, then}) : std::max(now, then);
    }

  enum { LOWEST, HIGHEST = LOWEST + 3, RENEW = HIGHEST + 3, LEAVING, N };    // less the highest
  double ends[N] = {FAR_AWAY, FAR_AWAY, FAR_AWAY, FAR_AWAY,
                    FAR_AWAY, FAR_AWAY, 0.0,      leaving ? -1.0 : 0.0};
  if (atom->nlocal)
    for (int k = 0; k < 3; k++) {
      ends[LOWEST + k] = lo[k];
      ends[HIGHEST + k] = -hi[k];
    }
  if (!known || motion.exceeded(moved, ahead ? going : nullptr, time)) ends[RENEW] = -1.0;
  for (int k = 0; k < 3; k++)
    if (motion.farthest(k) > farthest[k]) ends[RENEW] = -1.0;
  MPI_Allreduce(MPI_IN_PLACE, ends, N, MPI_DOUBLE, MPI_MIN, world);
  leaving = ends[LEAVING] < 0.0;
  if (ends[RENEW] < 0.0) return true;
  for (int k = 0; k < 3; k++)
    if (-(ends[LOWEST + k] + ends[HIGHEST + k]) > unseen[k]) return true;
  return false;
}

/* ---------------------------------------------------------------------- */

int FixHVILists::pack_forward_comm(int n, int *sent, double *buf, int /*pbc_flag*/, int * /*pbc*/)
{
  int m = 0;
  for (int one = 0; one < n; one++) {
    memcpy(buf + m, moved[sent[one]], SENT * sizeof(double));
    m += SENT;
    if (!ahead) continue;
    memcpy(buf + m, going[sent[one]], SENT * sizeof(double));
    m += SENT;
  }
  return m;
}

void FixHVILists::unpack_forward_comm(int n, int first, double *buf)
{
  int m = 0;
  for (int i = first; i < first + n; i++) {
    memcpy(moved[i], buf + m, SENT * sizeof(double));
    m += SENT;
    if (!ahead) continue;
    memcpy(going[i], buf + m, SENT * sizeof(double));
    m += SENT;
  }
}

/* ---------------------------------------------------------------------- */

double FixHVILists::memory_usage()
{
  return motion.bytes() + made_rows.bytes() +
      (hold.capacity() + (ahead ? 6.0 : 3.0) * nmax) * sizeof(double);
}
