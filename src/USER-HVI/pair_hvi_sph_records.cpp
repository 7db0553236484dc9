/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing authors: the lammps-hvi developers
------------------------------------------------------------------------- */

// the records of particles, before and after the loop over pairs, which is in hvi_sph_sweep.cpp

#include "pair_hvi_sph.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix_hvi_johnson_cook.h"
#include "fix_hvi_lists.h"
#include "fix_hvi_sph.h"
#include "force.h"
#include "hvi_artstress.h"
#include "hvi_sph_solid.h"
#include "math_special.h"
#include "neigh_list.h"
#include "neighbor.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;
using MathSpecial::square;

/* ----------------------------------------------------------------------
   owned and ghost particles: pressure and speed of sound of all that have a
   material, whoever integrates them
------------------------------------------------------------------------- */

void PairHVISPH::gather()
{
  const double *const *const x = atom->x;
  const double *const *const vest = atom->vest;
  const double *const rho = atom->rho;
  const double *const esph = atom->esph;
  const double *const rmass = atom->rmass;
  const int *const type = atom->type;
  const int nall = atom->nlocal + atom->nghost;
  const HVI::SphView &records = store->fields.view();
  const HVI::SphLaws &laws = set.laws;
  fastest = alone = 0.0;
  narrowest = HVI::NO_BOUND;
  eos_states.assign(atom->ntypes + 1, EosState());

  for (int i = 0; i < nall; i++) {
    const int itype = type[i];
    if (store->fields.is_idle(i)) continue;
    records.rates[i] = {};
    if (records.gradv) records.gradv[i] = {};
    if (records.contact) records.contact[i] = {};
    if (records.slopes) records.slopes[i] = {};
    if (!is_ours[itype]) continue;    // of another style in a hybrid
    const HVI::Eos &eos = *store->materials.of(itype)->eos;
    const double m = rmass ? rmass[i] : atom->mass[itype];

    // undisturbed matter of a type is in one state: its pressure is known from the particle before

    EosState &known = eos_states[itype];
    const double e = esph[i] / m;
    if (rho[i] != known.rho || e != known.e) {
      known.rho = rho[i];
      known.e = e;
      if (!std::isfinite(e) || !eos.evaluate(rho[i], e, known.p, known.csq)) no_answer(i, rho[i]);
      if (records.traction && eos.rho0() > 0.0) known.width = std::cbrt(rho[i] / eos.rho0());
    }
    double p = known.p, csq = known.csq;

    // failed particles are not pulled; signals in solids are longitudinal

    if (records.stress) {
      p = HVI::clip_tension(p, records.stress[i].p_min);
      csq += 4.0 / 3.0 * records.stress[i].shear / rho[i];
    }

    // the package SPH takes the speed of sound of liquids as constant, of gases as sqrt(p/rho)

    if (laws.stock) {
      const double c0 = eos.c0();
      csq = c0 > 0.0 ? c0 * c0 : p / rho[i];
      if (!(csq >= 0.0))
        error->one(FLERR, "Pair hvi/sph: energy {} of particle {} is negative at step {}", esph[i],
                   atom->tag[i], update->ntimestep);
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
    s.w = laws.symmetric ? m : m / rho[i];
    if (records.traction) {
      HVI::SphTraction &T = records.traction[i];
      T = {};
      T.volume = s.w;
      T.rho = rho[i];
      T.p = p;
      if (i < atom->nlocal) {    // of ghosts all that is sent
        const double *const felt = integrator->working_velocity(i);
        T.vx = felt[0];
        T.vy = felt[1];
        T.vz = felt[2];
      }
      s.w *= known.width;
    }
    s.p = laws.symmetric ? p / (rho[i] * rho[i]) : p;
    s.c = std::sqrt(csq);
    double &most = has_neighbor[i] ? fastest : alone;
    if (!(s.c <= most * place.h)) most = s.c / place.h;
    s.type = itype;
    if (records.traction && records.stress[i].p_min == 0.0 && records.stress[i].shear == 0.0)
      s.type += HVI::RUBBLE;
  }
}

void PairHVISPH::no_answer(int i, double rho) const
{
  const int itype = atom->type[i];
  const double m = atom->rmass ? atom->rmass[i] : atom->mass[itype];
  error->one(FLERR,
             "Pair hvi/sph: equation of state {} of particle {} (type {}) has no answer at "
             "density {} and energy per mass {} at step {}",
             store->materials.of(itype)->eos->name(), atom->tag[i], itype, rho, atom->esph[i] / m,
             update->ntimestep);
}

/* ----------------------------------------------------------------------
   stress at this step, of owned particles from the fix that integrates it.  Where sums over all
   neighbors count, other ranks must know who is awake: on the way a minus at the modulus says so.
------------------------------------------------------------------------- */

void PairHVISPH::gather_stress()
{
  const HVI::SphView &records = store->fields.view();
  HVI::SphStress *const stress = records.stress;
  const int nlocal = atom->nlocal, nall = nlocal + atom->nghost;
  const bool says = whole_sums() && v_quiet < HVI::NO_BOUND;
  for (int i = 0; i < nlocal; i++) {
    stress[i] = strength->stress(i);
    if (says && !store->fields.asleep(i)) stress[i].shear = -stress[i].shear;
  }
  if (!records.traction)
    forward(stress);
  else {

    // the stress itself goes to neighbors as traction

    for (int i = nlocal; i < nall; i++) stress[i] = {};
    forward(stress, HVI::SphStress::LIMITS, HVI::SphStress::FIRST_LIMIT);
  }
  if (!says) return;

  const HVI::RelativeMotion &cells = lists->cells();
  for (int i = 0; i < nall; i++) {
    if (i >= nlocal && std::signbit(stress[i].shear) && !store->fields.sleepers.empty())
      sleep.watch(cells.cell_of(i));
    stress[i].shear = std::fabs(stress[i].shear);
  }
}

/* ----------------------------------------------------------------------
   What counts as undisturbed, in parts of the speed of sound c: differences of velocity; of density;
   of energy the root, for that of a stress goes with its square, so that it need not be asked for.
------------------------------------------------------------------------- */

void PairHVISPH::find_quiet()
{
  // forces of dissipation riemann without solids use the number of neighbors at undisturbed particles;
  // with energy no a stress leaves nothing in the energy

  const bool can = integrator && !(set.riemann && !set.whole) && (set.energy || !strength);
  const double eps = can ? integrator->sleep() : 0.0;
  rho_quiet.assign(atom->ntypes + 1, 0.0);
  e_quiet = rho_quiet;
  v_quiet = HVI::NO_BOUND;
  for (int itype = 1; itype <= atom->ntypes; itype++) {
    if (!is_ours[itype] || eps == 0.0) continue;
    const HVI::Eos &eos = *store->materials.of(itype)->eos;
    const double rho0 = eos.rho0();
    double p, csq;
    if (!(rho0 > 0.0) || !eos.evaluate(rho0, 0.0, p, csq) || !(csq > 0.0) ||
        std::fabs(p) > 1.0e-12 * rho0 * csq)
      continue;
    rho_quiet[itype] = rho0;
    e_quiet[itype] = eps * eps * csq;
    v_quiet = MIN(v_quiet, eps * std::sqrt(csq));
  }
  rho_far = eps;
}

/* ----------------------------------------------------------------------
   whether particles have sums over all of their neighbors: M
------------------------------------------------------------------------- */

bool PairHVISPH::whole_sums() const
{
  return strength && set.gradient != HVI::SphSettings::PLAIN;
}

/* ----------------------------------------------------------------------
   to whom nothing happens, of owned particles
------------------------------------------------------------------------- */

void PairHVISPH::find_sleepers()
{
  const HVI::RelativeMotion &cells = lists->cells();
  const int nlocal = atom->nlocal, nall = nlocal + atom->nghost;
  std::vector<char> &sleepers = store->fields.sleepers;
  sleepers.clear();
  placed = cells.points() == nall;
  if (!placed) return;

  sleep.start(cells);
  for (int i = 0; i < nall; i++) {
    const int itype = atom->type[i];
    if (!is_ours[itype]) continue;
    const double m = atom->rmass ? atom->rmass[i] : atom->mass[itype];
    bool quiet = std::fabs(atom->rho[i] - rho_quiet[itype]) <= rho_far * rho_quiet[itype] &&
        std::fabs(atom->esph[i]) <= m * e_quiet[itype] && rho_quiet[itype] > 0.0;
    for (int k = 0; k < 3; k++)
      if (!std::isfinite(atom->vest[i][k]) ||
          (set.mirror.has(k) && std::fabs(atom->vest[i][k]) > v_quiet))
        quiet = false;
    sleep.add(cells.cell_of(i), atom->vest[i], !quiet);
  }
  sleep.settle(cells, v_quiet);
  if (v_quiet == HVI::NO_BOUND) return;

  sleepers.resize(nlocal);
  for (int i = 0; i < nlocal; i++)
    sleepers[i] = is_ours[atom->type[i]] && sleep.asleep(cells.cell_of(i));
}

/* ----------------------------------------------------------------------
   the rows of the list that must be gone through
------------------------------------------------------------------------- */

void PairHVISPH::choose_rows()
{
  const int nlocal = atom->nlocal;
  const std::vector<char> &sleepers = store->fields.sleepers;
  const HVI::SphFields &fields = store->fields;
  if (sleepers.empty()) {
    rows.assign(list->ilist, list->ilist + list->inum);
    if (mesh)
      rows.erase(std::remove_if(rows.begin(), rows.end(),
                                [&](int i) {
                                  return fields.is_idle(i);
                                }),
                 rows.end());
    return;
  }

  const HVI::RelativeMotion &cells = lists->cells();
  const bool sums = whole_sums();
  if (sums) sleep.spread(cells);
  rows.clear();
  for (int ii = 0; ii < list->inum; ii++) {
    const int i = list->ilist[ii];
    if (fields.is_idle(i)) continue;
    if (sums ? sleep.near_awake(cells.cell_of(i)) : !sleepers[i]) rows.push_back(i);
  }
  const HVI::SphView &records = store->fields.view();
  if (records.push)
    for (int i = 0; i < nlocal; i++)
      if (sleepers[i]) records.push[i] = {};
}

/* ----------------------------------------------------------------------
   Of owned particles and ghosts, whose pressure and stress are known here; with gradient corrected of
   owned ones, when they have those of the end of the step.  The spacing dp is
   that of the material's own density, (m/rho0)^(1/dim), over the H of pair_coeff: as Gray's,
   it stays what it was at the start, and in units of h with variable h too.
------------------------------------------------------------------------- */

void PairHVISPH::artificial_stress()
{
  const HVI::SphView &records = store->fields.view();
  const HVI::SphLaws &laws = set.laws;
  const double *const rmass = atom->rmass;
  const bool whole = records.traction;
  for (int i = 0; i < atom->nlocal + (whole ? 0 : atom->nghost); i++) {
    const int itype = atom->type[i];
    if (!is_ours[itype] || store->fields.is_idle(i)) continue;
    const HVI::SphStress s = whole ? strength->settled(i) : records.stress[i];
    const double p = whole ? records.traction[i].p : records.state[i].p;
    const HVI::Deviator T = HVI::tensile_part(p, {s.xx, s.yy, s.zz, s.xy, s.xz, s.yz});
    double f = 0.0;
    if (T.xx + T.yy + T.zz > 0.0) {
      const double rho0 = store->materials.of(itype)->eos->rho0();
      const double V = (rmass ? rmass[i] : atom->mass[itype]) / rho0;
      const double dp = laws.dim == 3 ? std::cbrt(V) : (laws.dim == 2 ? std::sqrt(V) : V);
      const double w = sweeps->w(dp / set.h[itype]);
      if (!(w > 0.0))
        error->one(FLERR,
                   "Pair hvi/sph artstress: the spacing {} of type {} is beyond the reach of its "
                   "h {}",
                   dp, itype, set.h[itype]);
      f = -laws.art_eps / std::pow(w, laws.art_n);
    }
    records.art[i] = {f * T.xx, f * T.yy, f * T.zz, f * T.xy, f * T.xz, f * T.yz, 0.0, 0.0};
  }
}

/* ----------------------------------------------------------------------
   Of dissipation riemann, when the first sweep has the sums of all neighbors.  Omega is 1
   where h stays as it is, and far from 1 only for particles nearly alone: bounded.
------------------------------------------------------------------------- */

void PairHVISPH::finish_slopes()
{
  const HVI::SphView &records = store->fields.view();
  if (force->newton_pair) reverse(records.slopes);
  for (int i = 0; i < atom->nlocal; i++) {
    if (!is_ours[atom->type[i]]) continue;
    HVI::SphSlopes &slopes = records.slopes[i];
    const double start = set.h[atom->type[i]], h = records.place[i].h;
    const double W0 = sweeps->w(0.0) * set.laws.norm / MathSpecial::powint(h, set.laws.dim);
    const double n = slopes.volume + W0;
    const bool follows = set.variable && h > set.hmin * start && h < set.hmax * start;
    const double omega = follows ? 1.0 + (slopes.omega / set.laws.dim - W0) / n : 1.0;
    slopes.omega = 1.0 / MAX(omega, 0.25);
    slopes.volume = slopes.omega / n;
  }
  forward(records.slopes);
}

/* ----------------------------------------------------------------------
   records of owned particles to their ghosts; of ghosts added up at their owners
------------------------------------------------------------------------- */

template <class Record> void PairHVISPH::forward(Record *records, int number, int first)
{
  halo = {&records->xx + first, (int) (sizeof(Record) / sizeof(double)), number};
  comm->forward_comm(this, number);
}

template <class Record> void PairHVISPH::reverse(Record *records, int number)
{
  halo = {(double *) records, (int) (sizeof(Record) / sizeof(double)), number};
  comm->reverse_comm(this, number);
}

template void PairHVISPH::reverse(HVI::SphGradV *, int);
template void PairHVISPH::reverse(HVI::SphRates *, int);
template void PairHVISPH::forward(HVI::SphStress *, int, int);
template void PairHVISPH::forward(HVI::SphGradV *, int, int);
template void PairHVISPH::forward(HVI::SphTraction *, int, int);
template void PairHVISPH::forward(HVI::SphPush *, int, int);

int PairHVISPH::pack_forward_comm(int n, int *sent, double *buf, int /*pbc_flag*/, int * /*pbc*/)
{
  for (int k = 0; k < n; k++)
    memcpy(buf + k * halo.number, halo.first + sent[k] * (std::size_t) halo.stride,
           halo.number * sizeof(double));
  return n * halo.number;
}

void PairHVISPH::unpack_forward_comm(int n, int first, double *buf)
{
  for (int k = 0; k < n; k++)
    memcpy(halo.first + (first + k) * (std::size_t) halo.stride, buf + k * halo.number,
           halo.number * sizeof(double));
}

int PairHVISPH::pack_reverse_comm(int n, int first, double *buf)
{
  for (int k = 0; k < n; k++)
    memcpy(buf + k * halo.number, halo.first + (first + k) * (std::size_t) halo.stride,
           halo.number * sizeof(double));
  return n * halo.number;
}

void PairHVISPH::unpack_reverse_comm(int n, int *owned, double *buf)
{
  for (int k = 0; k < n; k++) {
    double *const to = halo.first + owned[k] * (std::size_t) halo.stride;
    for (int l = 0; l < halo.number; l++) to[l] += buf[k * halo.number + l];
  }
}

/* ----------------------------------------------------------------------
   Heat is that of particles which fix hvi/sph integrates: what flows to others is
   in no energy of theirs.
------------------------------------------------------------------------- */

void PairHVISPH::scatter()
{
  double *const *const f = atom->f;
  double *const drho = atom->drho;
  double *const desph = atom->desph;
  const HVI::SphRates *const rates = store->fields.view().rates;
  const int n = atom->nlocal + (force->newton_pair ? atom->nghost : 0);
  const int integrated = integrator ? integrator->groupbit : 0;

  double heating = 0.0;
  for (int i = 0; i < n; i++) {
    if (store->fields.is_idle(i)) continue;
    f[i][0] += rates[i].fx;
    f[i][1] += rates[i].fy;
    f[i][2] += rates[i].fz;
    drho[i] += rates[i].drho;
    if (!set.energy) continue;
    desph[i] += rates[i].de;
    if (atom->mask[i] & integrated) heating += rates[i].heat;
  }
  store->fields.viscous_power = heating;
  for (int k = 0; k < 3; k++) store->fields.plane_force[k] = images.force[k];
}

/* ---------------------------------------------------------------------- */

// Sound counts for the time step where it can go to a neighbor: no particle is within reach that is not in
// the list.  Of a pair on two ranks the ghost counts on the rank that has the pair.

void PairHVISPH::find_neighbors()
{
  has_neighbor.assign(atom->nlocal + atom->nghost, 0);
  for (int ii = 0; ii < list->inum; ii++) {
    const int i = list->ilist[ii], n = list->numneigh[i];
    const int *const jlist = list->firstneigh[i];
    if (n) has_neighbor[i] = 1;
    for (int jj = 0; jj < n; jj++) has_neighbor[jlist[jj] & NEIGHMASK] = 1;
  }
}

/* ---------------------------------------------------------------------- */

void PairHVISPH::find_images()
{
  double reachsq = 0.0;
  for (int i = 1; i <= atom->ntypes; i++)
    for (int j = 1; j <= atom->ntypes; j++)
      if (is_ours[i] && is_ours[j] && cutsq[i][j] > 0.0)
        reachsq = MAX(reachsq, square(std::sqrt(cutsq[i][j]) + neighbor->skin));

  for (int i = 0; i < atom->nlocal; i++)
    for (int k = 0; k < 3; k++)
      if (set.mirror.has(k) && is_ours[atom->type[i]] && set.mirror.depth(k, atom->x[i]) < 0.0)
        error->one(FLERR,
                   "Pair style hvi/sph: particle {} is beyond the mirror plane {} at step {}: fix "
                   "hvi/sph does not integrate it, so does not put it back",
                   atom->tag[i], "xyz"[k], update -> ntimestep);

  const int nall = atom->nlocal + atom->nghost;
  images.find(set.mirror, atom->x, atom->type, is_ours, atom->nlocal, nall, reachsq);
  for (int a = nall; a < images.end(); a++)
    if (images.is_own(a)) has_neighbor[images.owner(a)] = 1;
}

/* ----------------------------------------------------------------------
   Shortest h/(c + approach + viscosity), from the last forces.  A pair that is not yet within reach is
   not seen: it comes no deeper in a step than forces rise slowly.  What they reach with variable h is
   that of now: how fast h shrinks is limited by signals.  Those that are not in adjacent
   cells are farther apart by a skin at least.
------------------------------------------------------------------------- */

void PairHVISPH::tighten(HVI::TimeStepBounds &bounds)
{
  if (fastest * bounds.signal > 1.0 || std::isnan(fastest)) bounds.signal = 1.0 / fastest;
  if (alone * bounds.alone > 1.0) bounds.alone = 1.0 / alone;

  double h = narrowest;
  for (int i = 1; i <= atom->ntypes; i++)
    if (is_ours[i] && !set.variable) h = MIN(h, set.h[i]);    // whoever is on this rank
  if (h >= HVI::NO_BOUND) return;                             // nobody
  const double deep = 0.25 * set.support * h;
  const double apart = deep + neighbor->skin;
  double speed = placed ? sleep.fastest() : 0.0;
  if (set.mirror.planes) speed = MAX(speed, fastest_to_images(deep / apart));
  if (speed * bounds.meet > deep) bounds.meet = deep / speed;
  bounds.come_closer(placed ? apart : deep);
}

// of all particles with neighbors the largest c/h of the last forces

std::string PairHVISPH::fastest_signal() const
{
  const HVI::SphView &records = store->fields.view();
  int most = -1;
  double rate = 0.0;
  for (int i = 0; i < (int) has_neighbor.size(); i++) {
    if (store->fields.is_idle(i) || !is_ours[atom->type[i]] || !has_neighbor[i]) continue;
    const double here = records.state[i].c / records.place[i].h;
    if (here <= rate) continue;
    most = i;
    rate = here;
  }
  if (most < 0) return "";
  const int type = atom->type[most];
  return fmt::format(
      "the fastest sound is {} of particle {} (type {}) at density {}, energy per mass {}, h {}",
      records.state[most].c, atom->tag[most], type, atom->rho[most],
      atom->esph[most] / (atom->rmass ? atom->rmass[most] : atom->mass[type]),
      records.place[most].h);
}

// of particles and their images, less by a factor where these are far

double PairHVISPH::fastest_to_images(double far) const
{
  const HVI::MirrorPlanes &mirror = set.mirror;
  double most = 0.0;
  for (int i = 0; i < atom->nlocal; i++) {
    if (!is_ours[atom->type[i]]) continue;
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
