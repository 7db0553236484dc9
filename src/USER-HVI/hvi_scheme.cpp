/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing authors: the lammps-hvi developers
------------------------------------------------------------------------- */

#include "hvi_scheme.h"

#include "atom.h"
#include "error.h"
#include "fix_hvi_lists.h"
#include "fix_hvi_sph.h"
#include "force.h"
#include "hvi_excluded.h"
#include "math_special.h"
#include "neigh_list.h"
#include "neighbor.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

using namespace LAMMPS_NS;
using MathSpecial::square;

/* ---------------------------------------------------------------------- */

HVIScheme::HVIScheme(LAMMPS *lmp, const HVIPairTables &pairs_in) :
    Pointers(lmp), pairs(pairs_in), store(FixHVIStore::find(lmp)), integrator(pairs.integrator),
    fields(store->fields), set(fields.settings), work()
{
}

/* ----------------------------------------------------------------------
   what pairs differ in, and which terms they have: bits of SphScene
------------------------------------------------------------------------- */

void HVIScheme::choose(int terms, bool may_be_inactive)
{
  if (atom->ntypes > HVI::SphState::MOST_TYPES)
    error->all(FLERR, "Pair style hvi/sph has at most {} types, not {}", HVI::SphState::MOST_TYPES,
               atom->ntypes);
  if (set.variable) terms |= HVI::SPH_OWN_H;
  int first = 0;
  double lightest = HUGE_VAL, densest = 0.0;    // at rest; gases have no such density
  for (int i = 1; i <= atom->ntypes; i++) {
    if (!pairs.is_ours[i]) continue;
    if (!first) first = i;
    lightest = MIN(lightest, store->materials.of(i)->eos->rho0());
    densest = MAX(densest, store->materials.of(i)->eos->rho0());
    if (set.h[i] != set.h[first]) terms |= HVI::SPH_OWN_H;
    for (int j = 1; j <= atom->ntypes; j++)
      if (pairs.is_ours[j] &&
          (pairs.tension[i][j] == 0.0 || pairs.visc_a[i][j] != pairs.visc_a[first][first] ||
           pairs.visc_b[i][j] != pairs.visc_b[first][first]))
        terms |= HVI::SPH_BODIES;
  }
  if (first) {
    set.laws.h = set.h[first];
    set.laws.a = pairs.visc_a[first][first];
    set.laws.b = pairs.visc_b[first][first];
    set.laws.unlike = densest > 2.0 * lightest;
  }
  asked = terms;
  sweeps = HVI::make_sph_sweeps(set.kernel, terms);
  fields.choose(sweeps->scene());
  work.laws = set.laws;
  work.visc_a = pairs.visc_a;
  work.visc_b = pairs.visc_b;
  work.tension = pairs.tension;
  work.watcher = pairs.watcher;
  work.kept = &kept;
  find_quiet(may_be_inactive);
}

double HVIScheme::widest(int i, int j) const
{
  return 0.5 * (set.h[i] + set.h[j]);
}

/* ---------------------------------------------------------------------- */

void HVIScheme::prepare()
{
  evaluate();
  prepared = true;
}

void HVIScheme::start()
{
  if (neighbor->ago == 0 || (int) has_neighbor.size() != atom->nlocal + atom->nghost)
    find_neighbors();
  if (set.mirror.planes) find_images();
  const int nrecords = set.mirror.planes ? MAX(atom->nmax, images.end()) : atom->nmax;
  const bool lost = fields.grow(nrecords, set.mirror.planes ? nrecords / 16 : 0);
  if (fields.view().touching) fields.view().touching->start(nrecords);
  find_inactive();
  gather_limits();
  choose_rows();
  choose_records(lost);
  gather_records();
  if (set.mirror.planes) images.fill(set.mirror, fields.view());

  work.records = fields.view();
  if (const HVI::NeighborRows *const made = pairs.lists->rows())
    work.list = {(int) rows.size(), rows.data(), made->number.data(), made->first.data()};
  else {
    const NeighList &list = *pairs.style->list;
    work.list = {(int) rows.size(), rows.data(), list.numneigh, list.firstneigh};
  }
  work.type = atom->type;
  work.images = set.mirror.planes ? &images : nullptr;
  work.embedded = fields.embedded.empty() ? nullptr : fields.embedded.data();
  work.fastest = fastest;
}

void HVIScheme::forces(bool tally)
{
  if (!prepared) prepare();
  prepared = false;
  work.tally = tally;
  sweeps->forces(work);
  fastest = work.fastest /
      (0.5 * set.support);    // half of the reach stands for h, for all kernels alike
  alone /= 0.5 * set.support;
  if (set.mirror.planes) images.fold(work.records, force->newton_pair);
  scatter();
  forces_done();
}

/* ---------------------------------------------------------------------- */

double HVIScheme::mass(int i) const
{
  return atom->rmass ? atom->rmass[i] : atom->mass[atom->type[i]];
}

bool HVIScheme::has_record(int i) const
{
  return pairs.is_ours[atom->type[i]] && !fields.is_idle(i) &&
      !HVI::SphFields::is_frozen(atom->rho[i]);
}

/* ----------------------------------------------------------------------
   owned and ghost particles: pressure and speed of sound of all that have a
   material, whichever fix integrates them
------------------------------------------------------------------------- */

void HVIScheme::gather_records()
{
  const double *const *const x = atom->x, *const *const vest = atom->vest;
  const double *const rho = atom->rho;
  const int nall = atom->nlocal + atom->nghost;
  const HVI::SphView &records = fields.view();
  const bool all = (int) filled.size() == nall;
  if (all) resting = {};
  fastest = resting.fastest;
  narrowest = resting.narrowest;
  alone = 0.0;
  eos_states.assign(atom->ntypes + 1, EosState());

  for (const int i : filled) {
    if (fields.is_idle(i)) continue;
    records.rates[i] = {};
    if (records.gradv) records.gradv[i] = {};
    if (records.slopes) records.slopes[i] = {};
    const int itype = atom->type[i];
    if (!pairs.is_ours[itype]) continue;    // of another style in a hybrid

    // undisturbed matter of a type is in one state: its pressure is known from the particle before

    EosState &known = eos_states[itype];
    const double e = atom->esph[i] / mass(i);
    if (rho[i] != known.rho || e != known.e) {
      const HVI::Eos &eos = *store->materials.of(itype)->eos;
      known.rho = rho[i];
      known.e = e;
      if (HVI::SphFields::is_frozen(rho[i]) || !std::isfinite(e) ||
          !eos.evaluate(rho[i], e, known.p, known.csq)) {
        known.rho = NAN;
        take_out(i);
        continue;
      }
      if (records.traction && eos.rho0() > 0.0) known.width = std::cbrt(rho[i] / eos.rho0());
    }

    HVI::SphPlace &place = records.place[i];
    place.x = x[i][0];
    place.y = x[i][1];
    place.z = x[i][2];
    place.h = set.variable ? set.smoothing_length(itype, rho[i], integrator->hscale(i))
                           : set.h[itype];
    narrowest = MIN(narrowest, place.h);

    HVI::SphState &s = records.state[i];
    s.vx = vest[i][0];
    s.vy = vest[i][1];
    s.vz = vest[i][2];
    s.rho = rho[i];
    s.body = HVI::SphState::code(itype);
    s.c = std::sqrt(gather(i, known, s));
    const bool rests = is_at_rest(i);
    double &most = has_neighbor[i] || rests ? fastest : alone;
    if (!(s.c <= most * place.h)) most = s.c / place.h;
    if (!rests) continue;
    resting.fastest = std::max(resting.fastest, s.c / place.h);
    resting.narrowest = std::min(resting.narrowest, place.h);
  }
}

/* ----------------------------------------------------------------------
   A particle that takes no part, or none from now on: a ghost is one if its owner is.  Its record is out of
   reach of all others, other such particles among them.
------------------------------------------------------------------------- */

void HVIScheme::take_out(int i)
{
  static constexpr double AWAY = 1.0e6;
  if (i < atom->nlocal &&
      !(integrator && (integrator->has_frozen(i) || integrator->freeze(i, atom->rho[i]))))
    no_answer(i, atom->rho[i]);
  const double *const x = atom->x[i], h = set.h[atom->type[i]], away = AWAY * h * (i + 1);
  fields.view().place[i] = {x[0] + away, x[1] + away, x[2] + away, h};
  fields.view().state[i] = {0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0, HVI::SphState::code(atom->type[i])};
  if (fields.view().traction) fields.view().traction[i] = {};
}

void HVIScheme::no_answer(int i, double rho) const
{
  const int itype = atom->type[i];
  if (rho == 0.0)
    error->one(
        FLERR,
        "Pair hvi/sph: particle {} (type {}) has no density at step {}: give it one before the "
        "run (set ... sph/rho){}",
        atom->tag[i], itype, update->ntimestep,
        integrator
            ? ", or a spacing or volume to its type (pair_coeff ... spacing), which is what "
              "particles need that come during a run, by fix deposit in the group of fix hvi/sph "
              "for instance"
            : "");
  const HVI::Eos &eos = *store->materials.of(itype)->eos;
  error->one(FLERR,
             "Pair hvi/sph: equation of state {} of particle {} (type {}) has no answer at "
             "density {} and energy per mass {} at step {}{}",
             eos.name(), atom->tag[i], itype, rho, atom->esph[i] / mass(i), update->ntimestep,
             rho >= eos.rho_max() ? fmt::format(": it ends at density {:.6g}", eos.rho_max()) : "");
}

/* ----------------------------------------------------------------------
   What counts as undisturbed, in parts eps of the speed of sound c: velocities that differ by eps c, densities by
   eps rho0, energies per mass up to eps^2 c^2.  The energy of a stress goes with its square, so the bound on energy
   is one on stress.
------------------------------------------------------------------------- */

void HVIScheme::find_quiet(bool can)
{
  const double eps = integrator && can ? integrator->sleep() : 0.0;
  quiet = {};
  quiet.rho.assign(atom->ntypes + 1, 0.0);
  quiet.e = quiet.rho;
  for (int itype = 1; itype <= atom->ntypes; itype++) {
    if (!pairs.is_ours[itype] || eps == 0.0) continue;
    const HVI::Eos &eos = *store->materials.of(itype)->eos;
    const double rho0 = eos.rho0();
    double p, csq;
    if (!(rho0 > 0.0) || !eos.evaluate(rho0, 0.0, p, csq) || !(csq > 0.0) ||
        std::fabs(p) > 1.0e-12 * rho0 * csq)
      continue;
    quiet.rho[itype] = rho0;
    quiet.e[itype] = eps * eps * csq;
    quiet.v = MIN(quiet.v, eps * std::sqrt(csq));
  }
  quiet.rho_part = eps;
}

/* ----------------------------------------------------------------------
   cells in which nothing happens, and owned particles in them
------------------------------------------------------------------------- */

void HVIScheme::find_inactive()
{
  const HVI::RelativeMotion &motion = pairs.lists->cells();
  const int nlocal = atom->nlocal, nall = nlocal + atom->nghost;
  std::vector<char> &sleepers = fields.sleepers;
  sleepers.clear();
  placed = motion.points() == nall;
  if (!placed) return;

  cells.start(motion);
  for (int i = 0; i < nall; i++) {
    const int itype = atom->type[i];
    if (!pairs.is_ours[itype] || HVI::SphFields::is_frozen(atom->rho[i])) continue;
    bool undisturbed =
        std::fabs(atom->rho[i] - quiet.rho[itype]) <= quiet.rho_part * quiet.rho[itype] &&
        std::fabs(atom->esph[i]) <= mass(i) * quiet.e[itype] && quiet.rho[itype] > 0.0;
    for (int k = 0; k < 3; k++)
      if (!std::isfinite(atom->vest[i][k]) ||
          (set.mirror.has(k) && std::fabs(atom->vest[i][k]) > quiet.v))
        undisturbed = false;
    cells.add(motion.cell_of(i), atom->vest[i], !undisturbed);
  }
  cells.settle(motion, quiet.v);
  if (!has_inactive()) return;

  sleepers.resize(nlocal);
  for (int i = 0; i < nlocal; i++)
    sleepers[i] = pairs.is_ours[atom->type[i]] && cells.asleep(motion.cell_of(i));
}

bool HVIScheme::is_at_rest(int i) const
{
  const HVI::NeighborRows *const made = pairs.lists->rows();
  if (!made || fields.sleepers.empty()) return false;
  const int cell = pairs.lists->cells().cell_of(i);
  return cells.asleep(cell) && !made->is_lonely(cell);
}

/* ----------------------------------------------------------------------
   the rows of the list that must be gone through: of active particles, and where these have sums over all of
   their neighbors, of those next to them
------------------------------------------------------------------------- */

void HVIScheme::choose_rows()
{
  const std::vector<char> &sleepers = fields.sleepers;
  const HVI::RelativeMotion &motion = pairs.lists->cells();
  if (!sleepers.empty() && all_sums) cells.spread(motion);
  rows.clear();
  if (const HVI::NeighborRows *const made = pairs.lists->rows()) {
    for (int c = 0; c < made->cells(); c++) {
      if (!sleepers.empty() && !(all_sums ? cells.near_awake(c) : !cells.asleep(c))) continue;
      make_rows(c);
      rows.insert(rows.end(), made->begin(c), made->end(c));
    }
    return;
  }

  const NeighList &list = *pairs.style->list;
  for (int ii = 0; ii < list.inum; ii++) {
    const int i = list.ilist[ii];
    if (fields.is_idle(i)) continue;
    if (sleepers.empty() || (all_sums ? cells.near_awake(motion.cell_of(i)) : !sleepers[i]))
      rows.push_back(i);
  }
}

/* ---------------------------------------------------------------------- */

void HVIScheme::choose_records(bool lost)
{
  const int nlocal = atom->nlocal, nall = nlocal + atom->nghost;
  const std::vector<char> &sleepers = fields.sleepers;
  const HVI::RelativeMotion &motion = pairs.lists->cells();
  active.clear();
  for (int i = 0; i < nlocal; i++)
    if (sleepers.empty() || !sleepers[i]) active.push_back(i);

  reached.swap(reached_before);
  reached.clear();
  const bool some = !sleepers.empty() && all_sums && pairs.lists->rows();
  if (some) {
    of_ghosts.clear();
    for (int i = nlocal; i < nall; i++) of_ghosts.push_back(motion.cell_of(i));
    cells.reach_out(motion, of_ghosts);
    for (int i = 0; i < nlocal; i++)
      if (cells.reached(motion.cell_of(i))) reached.push_back(i);
  } else
    reached = active;

  if (!some || lost || neighbor->ago == 0 || looks_at_all()) {
    filled.resize(nall);
    std::iota(filled.begin(), filled.end(), 0);
    return;
  }

  // what has come to rest is filled once more, as that

  filled = reached;
  for (const int i : reached_before)
    if (!cells.reached(motion.cell_of(i))) filled.push_back(i);
  for (int i = nlocal; i < nall; i++) filled.push_back(i);
}

/* ----------------------------------------------------------------------
   Heat is that of particles which fix hvi/sph integrates: what flows to others is
   in no energy of theirs.
------------------------------------------------------------------------- */

void HVIScheme::scatter()
{
  double *const *const f = atom->f;
  const HVI::SphRates *const rates = fields.view().rates;
  const int n = force->newton_pair ? atom->nlocal + atom->nghost : atom->nlocal;
  const int integrated = integrator ? integrator->groupbit : 0;

  double heating = 0.0;
  for (const int i : filled) {
    if (i >= n) break;
    if (fields.is_idle(i)) continue;
    f[i][0] += rates[i].fx;
    f[i][1] += rates[i].fy;
    f[i][2] += rates[i].fz;
    atom->drho[i] += rates[i].drho;
    if (!set.energy) continue;
    atom->desph[i] += rates[i].de();
    if (atom->mask[i] & integrated) heating += rates[i].heat;
  }
  fields.viscous_power = heating;
  for (int k = 0; k < 3; k++) fields.plane_force[k] = images.force[k];
}

/* ----------------------------------------------------------------------
   Sound counts for the time step where it can go to a neighbor: no particle is within reach that is not in
   the list.  Of a pair on two ranks the ghost counts on the rank that has the pair.  Rows that are made where they are
   asked for are those of active particles, and more: inactive ones count as if they had neighbors.
------------------------------------------------------------------------- */

void HVIScheme::find_neighbors()
{
  const int nall = atom->nlocal + atom->nghost;
  has_neighbor.assign(nall, 0);
  if (const HVI::NeighborRows *const made = pairs.lists->rows()) {
    for (int c = 0; c < made->cells(); c++)
      if (made->has(c)) note_neighbors(c);
    return;
  }
  const NeighList &list = *pairs.style->list;
  for (int ii = 0; ii < list.inum; ii++) {
    const int i = list.ilist[ii], n = list.numneigh[i];
    const int *const jlist = list.firstneigh[i];
    if (n) has_neighbor[i] = 1;
    for (int jj = 0; jj < n; jj++) has_neighbor[jlist[jj] & NEIGHMASK] = 1;
  }
}

void HVIScheme::make_rows(int cell)
{
  HVI::NeighborRows &made = *pairs.lists->rows();
  if (made.has(cell)) return;
  const int crowded = made.make(cell);
  if (crowded >= 0) {
    const int itype = atom->type[crowded];
    error->one(
        FLERR,
        "Pair hvi/sph: particle {} (type {}) has {} neighbors within reach and skin at step {}, "
        "more than the {} that neigh_modify one allows: is a smoothing length of {:.6g} that "
        "of its spacing?  Else raise it",
        atom->tag[crowded], itype, made.number[crowded], update->ntimestep, neighbor->oneatom,
        set.h[itype]);
  }
  note_neighbors(cell);
}

void HVIScheme::note_neighbors(int cell)
{
  const HVI::NeighborRows &made = *pairs.lists->rows();
  for (const int *i = made.begin(cell); i < made.end(cell); i++) {
    const int *const row = made.first[*i], n = made.number[*i];
    if (n) has_neighbor[*i] = 1;
    for (int k = 0; k < n; k++) has_neighbor[row[k]] = 1;
  }
}

HVI::SphList HVIScheme::all_pairs()
{
  HVI::NeighborRows *const made = pairs.lists->rows();
  if (!made) {
    const NeighList &list = *pairs.style->list;
    return {list.inum, list.ilist, list.numneigh, list.firstneigh};
  }
  if ((int) has_neighbor.size() != atom->nlocal + atom->nghost) find_neighbors();
  for (int c = 0; c < made->cells(); c++) make_rows(c);
  all_rows.resize(atom->nlocal);
  std::iota(all_rows.begin(), all_rows.end(), 0);
  return {atom->nlocal, all_rows.data(), made->number.data(), made->first.data()};
}

/* ---------------------------------------------------------------------- */

void HVIScheme::find_images()
{
  double reachsq = 0.0;
  for (int i = 1; i <= atom->ntypes; i++)
    for (int j = 1; j <= atom->ntypes; j++)
      if (pairs.is_ours[i] && pairs.is_ours[j] && pairs.style->cutsq[i][j] > 0.0)
        reachsq = MAX(reachsq, square(std::sqrt(pairs.style->cutsq[i][j]) + neighbor->skin));

  for (int i = 0; i < atom->nlocal; i++)
    for (int k = 0; k < 3; k++)
      if (set.mirror.has(k) && pairs.is_ours[atom->type[i]] &&
          set.mirror.depth(k, atom->x[i]) < 0.0)
        error->one(FLERR,
                   "Pair style hvi/sph: particle {} is beyond the mirror plane {} at step {}: fix "
                   "hvi/sph does not integrate it, so does not put it back",
                   atom->tag[i], "xyz"[k], update -> ntimestep);

  const int nall = atom->nlocal + atom->nghost;

  // neigh_modify exclude: images are of the types and groups of their owners

  std::vector<char> alone;
  if (neighbor->exclude) {
    alone.resize(atom->nlocal);
    for (int i = 0; i < atom->nlocal; i++) {
      const HVI::ExcludedBy one = {atom->type[i], atom->mask[i],
                                   atom->molecule ? atom->molecule[i] : 0};
      alone[i] = HVI::excluded(*neighbor, *group, one, one);
    }
  }
  images.find(set.mirror, atom->x, atom->type, pairs.is_ours, atom->nlocal, nall, reachsq, alone);
  for (int a = nall; a < images.end(); a++)
    if (images.is_own(a)) has_neighbor[images.owner(a)] = 1;
}

/* ---------------------------------------------------------------------- */

void HVIScheme::forward(const HVI::SphMessage &message)
{
  sent = message;
  comm->forward_comm(pairs.style, sent.size());
}

void HVIScheme::reverse(const HVI::SphMessage &message)
{
  sent = message;
  comm->reverse_comm(pairs.style, sent.size());
}

int HVIScheme::pack_forward(int n, const int *list, double *buf) const
{
  return sent.pack(
      n,
      [=](int k) {
        return list[k];
      },
      buf);
}

void HVIScheme::unpack_forward(int n, int first, const double *buf)
{
  sent.unpack(
      n,
      [=](int k) {
        return first + k;
      },
      buf,
      [](double &here, double number) {
        here = number;
      });
}

int HVIScheme::pack_reverse(int n, int first, double *buf) const
{
  return sent.pack(
      n,
      [=](int k) {
        return first + k;
      },
      buf);
}

void HVIScheme::unpack_reverse(int n, const int *list, const double *buf)
{
  sent.unpack(
      n,
      [=](int k) {
        return list[k];
      },
      buf,
      [](double &here, double number) {
        here += number;
      });
}

/* ----------------------------------------------------------------------
   Shortest h/(c + approach + viscosity), from the last forces.  A pair that is not yet within reach is
   not seen: the step lets it come so deep in the kernel only that forces are still small.  With variable h the reach is
   that of now: how fast h shrinks is limited by signals.  Those that are not in adjacent
   cells are farther apart by a skin at least.
------------------------------------------------------------------------- */

void HVIScheme::tighten(HVI::TimeStepBounds &bounds) const
{
  if (fastest * bounds.signal > 1.0 || std::isnan(fastest)) bounds.signal = 1.0 / fastest;
  if (alone * bounds.alone > 1.0) bounds.alone = 1.0 / alone;

  double h = narrowest;
  for (int i = 1; i <= atom->ntypes; i++)
    if (pairs.is_ours[i] && !set.variable) h = MIN(h, set.h[i]);    // those of other ranks, too
  if (h >= HVI::NO_BOUND) return;                                   // there are no particles
  const double deep = 0.25 * set.support * h;
  const double apart = deep + neighbor->skin;
  double speed = placed ? cells.fastest() : 0.0;
  if (set.mirror.planes) speed = MAX(speed, fastest_to_images(deep / apart));
  if (speed * bounds.meet > deep) bounds.meet = deep / speed;
  bounds.come_closer(placed ? apart : deep);
}

// of all particles with neighbors the largest c/h of the last forces

std::string HVIScheme::fastest_signal() const
{
  const HVI::SphView &records = fields.view();
  int most = -1;
  double rate = 0.0;
  for (int i = 0; i < (int) has_neighbor.size(); i++) {
    if (!has_record(i) || !has_neighbor[i]) continue;
    const double here = records.state[i].c / records.place[i].h;
    if (here <= rate) continue;
    most = i;
    rate = here;
  }
  if (most < 0) return "";
  return fmt::format(
      "the fastest sound is {} of particle {} (type {}) at density {}, energy per mass {}, h {}",
      records.state[most].c, atom->tag[most], atom->type[most], atom->rho[most],
      atom->esph[most] / mass(most), records.place[most].h);
}

// of particles and their images, less by a factor where these are far

double HVIScheme::fastest_to_images(double far) const
{
  const HVI::MirrorPlanes &mirror = set.mirror;
  double most = 0.0;
  for (int i = 0; i < atom->nlocal; i++) {
    if (!pairs.is_ours[atom->type[i]]) continue;
    double square = 0.0, factor = far;
    for (int k = 0; k < 3; k++) {
      if (!mirror.has(k)) continue;
      const double toward = -2.0 * mirror.side[k] * atom->v[i][k];
      if (toward > 0.0) square += toward * toward;
      if (2.0 * mirror.depth(k, atom->x[i]) < neighbor->cutneighmax) factor = 1.0;
    }
    most = MAX(most, square * factor * factor);
  }
  return std::sqrt(most);
}

/* ---------------------------------------------------------------------- */

HVISchemeFluid::HVISchemeFluid(LAMMPS *lmp, const HVIPairTables &tables) : HVIScheme(lmp, tables)
{
  choose((set.density ? HVI::SPH_DENSITY : 0) | (set.laws.symmetric ? HVI::SPH_SYMMETRIC : 0) |
         (set.laws.stock ? HVI::SPH_STOCK : 0));
}

/* ----------------------------------------------------------------------
   the package SPH takes the speed of sound of liquids as constant, of gases as sqrt(p/rho)
------------------------------------------------------------------------- */

double HVISchemeFluid::gather(int i, const EosState &eos, HVI::SphState &s)
{
  s.w = mass(i) / s.rho;
  s.p = eos.p;
  if (!set.laws.stock) return eos.csq;
  const double c0 = store->materials.of(atom->type[i])->eos->c0();
  const double csq = c0 > 0.0 ? c0 * c0 : eos.p / s.rho;
  if (!(csq >= 0.0))
    error->one(FLERR, "Pair hvi/sph: energy {} of particle {} is negative at step {}",
               atom->esph[i], atom->tag[i], update->ntimestep);
  return csq;
}
