/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing authors: the lammps-hvi developers
------------------------------------------------------------------------- */

#include "hvi_scheme_solid.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "fix_hvi_johnson_cook.h"
#include "fix_hvi_lists.h"
#include "fix_hvi_sph.h"
#include "force.h"
#include "hvi_artstress.h"
#include "hvi_inverse.h"
#include "hvi_sph_solid.h"
#include "math_special.h"
#include "neigh_list.h"
#include "update.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using HVI::SphGradV;
using HVI::SphMessage;
using HVI::SphTraction;
using HVI::Symmetric;
using HVI::VelocityGradient;

/* ---------------------------------------------------------------------- */

HVISchemeSolid::HVISchemeSolid(LAMMPS *lmp, const HVIPairTables &tables) :
    HVIScheme(lmp, tables), strength(FixHVIJohnsonCook::find(lmp)), mesh(HVI::find_mesh(lmp)),
    can_fail(strength->can_fail()), components(world)
{
  int terms = HVI::SPH_SOLID;
  if (set.riemann)
    terms |= HVI::SPH_RIEMANN;
  else if (set.density)
    terms |= HVI::SPH_DENSITY;
  if (set.laws.art_eps > 0.0) terms |= HVI::SPH_ARTSTRESS;
  if (can_fail) terms |= HVI::SPH_BODIES;
  all_sums = true;              // M
  choose(terms, set.energy);    // without energy a stress leaves no trace in it
}

double HVISchemeSolid::widest(int i, int j) const
{
  return MAX(set.h[i], set.h[j]);
}

HVIScheme::Traffic HVISchemeSolid::traffic() const
{
  const bool bodies = terms() & HVI::SPH_BODIES;
  int forward = SphTraction::SENT;
  if (set.laws.art_eps > 0.0) forward += HVI::SphStress::SENT;
  if (set.riemann) forward += SphGradV::SENT_STRETCH;
  Traffic t = {forward, SphGradV::SENT, forward, SphGradV::SENT};
  if (bodies) {
    t.forward += SphMessage::PUSHES;
    t.reverse += SphMessage::SUMS;
  }
  t.all_forward += sizeof(Limits) / sizeof(double);
  if (force->newton_pair) t.all_reverse += sent_rates();
  return t;
}

/* ----------------------------------------------------------------------
   The step of solids, t -> t + dt.  Places, velocities of the middle of the step, and weights are there.
------------------------------------------------------------------------- */

void HVISchemeSolid::evaluate()
{
  start();                // records of particles, ghosts and images; active particles
  label_bodies();         // now and then: what has come apart
  sum_gradients();        // sums over neighbors: L, H, M, nu
  correct_gradients();    // L H^-1 of the middle of the step
  advance();              // density, pressure, elements, stress: t -> t + dt
  find_tractions();       // from stress and M^-1
  exchange();             // to ghosts and images
}

/* ----------------------------------------------------------------------
   Other ranks must know which particles are active, for their sums over neighbors: on the way a minus at the
   modulus says so
------------------------------------------------------------------------- */

void HVISchemeSolid::gather_limits()
{
  const int nlocal = atom->nlocal, nall = nlocal + atom->nghost;
  limits.resize(nall);
  for (int i = 0; i < nlocal; i++) {
    const auto before = strength->before(i);
    limits[i] = {before.p_min, before.shear, integrator->middle_weight(i)};
    if (has_inactive() && !fields.asleep(i)) limits[i].shear = -limits[i].shear;
  }
  forward(SphMessage().with(limits.data(), sizeof(Limits) / sizeof(double)));
  if (!has_inactive()) return;

  const HVI::RelativeMotion &motion = pairs.lists->cells();
  for (int i = 0; i < nall; i++) {
    if (i >= nlocal && std::signbit(limits[i].shear) && !fields.sleepers.empty())
      cells.watch(motion.cell_of(i));
    limits[i].shear = std::fabs(limits[i].shear);
  }
}

/* ----------------------------------------------------------------------
   failed particles are not pulled; signals in solids are longitudinal
------------------------------------------------------------------------- */

double HVISchemeSolid::gather(int i, const EosState &eos, HVI::SphState &s)
{
  const Limits &limit = limits[i];
  SphTraction &T = fields.view().traction[i];
  T = {};
  T.volume = mass(i) / s.rho;
  T.rho = s.rho;
  T.p = HVI::clip_tension(eos.p, limit.p_min);
  if (i < atom->nlocal) {    // of ghosts all that is sent
    const double *const v = integrator->work_velocity(i);
    T.vx = v[0];
    T.vy = v[1];
    T.vz = v[2];
  }
  s.w = T.volume * eos.width;
  fields.view().gradv[i].weight = limit.weight;
  s.p = T.p;
  s.body = HVI::SphState::code(atom->type[i], wants(HVI::SPH_BODIES) ? integrator->body_code(i) : 0,
                               limit.p_min == 0.0 && limit.shear == 0.0);
  return eos.csq + 4.0 / 3.0 * limit.shear / s.rho;
}

/* ----------------------------------------------------------------------
   Sound particles within reach of each other are one body if they have been one before: what has come apart has
   another label and does not heal where it meets again.  Crack faces within a body do heal.  The label is the lowest ID;
   0 of what hangs on elements, whose particles hang together in any case: their IDs here are below all others.
   A restart finds labels as they are, and makes new ones in the same steps.  What no law lets fail parts where
   particles clump only, which heals: then labels are those of the start.
------------------------------------------------------------------------- */

bool HVISchemeSolid::looks_at_all() const
{
  static constexpr int EVERY = 100;
  return !integrator->is_due() || (can_fail && update->ntimestep % EVERY == 0);
}

void HVISchemeSolid::label_bodies()
{
  if (!wants(HVI::SPH_BODIES)) return;
  const int nlocal = atom->nlocal, nall = nlocal + atom->nghost;
  if (integrator->is_due()) {
    if (!looks_at_all()) return;
  } else {    // in a setup
    int anew = 0, any;
    for (int i = 0; i < nlocal; i++)
      if (has_record(i) && !is_embedded(i) && !integrator->has_body(i)) anew = 1;
    MPI_Allreduce(&anew, &any, 1, MPI_INT, MPI_MAX, world);
    if (!any) return;
  }

  const HVI::SphView &records = work.records;
  const auto is_sound = [&](int i) {
    return has_record(i) && !records.state[i].is_rubble();
  };
  tagint here = 0, highest;
  for (int i = 0; i < nlocal; i++) here = MAX(here, atom->tag[i]);
  MPI_Allreduce(&here, &highest, 1, MPI_LMP_TAGINT, MPI_MAX, world);
  std::vector<int64_t> ids(nlocal, 0);
  for (int i = 0; i < nlocal; i++)
    if (is_sound(i)) ids[i] = is_embedded(i) ? atom->tag[i] : (int64_t) highest + atom->tag[i];

  components.start(ids, nall);
  const HVI::SphList list = all_pairs();
  for (int ii = 0; ii < list.inum; ii++) {
    const int i = list.ilist[ii];
    if (!is_sound(i)) continue;
    const HVI::SphPlace &pi = records.place[i];
    for (int jj = 0; jj < list.numneigh[i]; jj++) {
      const int j = list.firstneigh[i][jj] & NEIGHMASK;
      if (!is_sound(j) || pairs.tension[atom->type[i]][atom->type[j]] == 0.0 ||
          integrator->body_code(i) != integrator->body_code(j))
        continue;
      const HVI::SphPlace &pj = records.place[j];
      const double reach = set.support * MAX(pi.h, pj.h);
      const double dx = pi.x - pj.x, dy = pi.y - pj.y, dz = pi.z - pj.z;
      if (dx * dx + dy * dy + dz * dz < reach * reach) components.join(i, j);
    }
  }
  components.finish([this](HVI::Components::Node *node) {
    forward(SphMessage().with(node, sizeof(*node) / sizeof(double)));
  });

  for (int i = 0; i < nlocal; i++) {
    const int64_t lowest = ids[i] ? components.component(i).id : 0;
    if (ids[i])
      integrator->set_body(i, lowest > highest ? lowest - highest : 0, integrator->apart_from(i));
    else if (has_record(i) && !integrator->has_body(i))
      integrator->set_body(i, 0, 0);
  }
  integrator->tell_ghosts();
  if (set.mirror.planes) part_from_images();
  for (int i = 0; i < nall; i++)
    if (has_record(i))
      records.state[i].body = HVI::SphState::code(atom->type[i], integrator->body_code(i),
                                                  records.state[i].is_rubble());
  if (set.mirror.planes) images.fill(set.mirror, records);
}

/* ----------------------------------------------------------------------
   A body that a plane cuts is one with its image; one that comes to the plane later meets another, as in the whole scene.
   So it is told of each body by which planes it is within reach of its own image, and was before.
------------------------------------------------------------------------- */

void HVISchemeSolid::part_from_images()
{
  const HVI::SphView &records = work.records;
  const HVI::MirrorPlanes &mirror = set.mirror;
  const auto is_sound = [&](int i) {
    return has_record(i) && !records.state[i].is_rubble() && integrator->body(i) > 0;
  };
  std::vector<int64_t> cut;    // labels, each with the direction of a plane
  const auto look = [&](int i, int j) {
    const HVI::SphPlace &pi = records.place[i], &pj = records.place[j];
    const double d[3] = {pi.x - pj.x, pi.y - pj.y, pi.z - pj.z};
    const double sum[3] = {pi.x + pj.x, pi.y + pj.y, pi.z + pj.z};
    const double rsq = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    const double reach = set.support * MAX(pi.h, pj.h);
    for (int k = 0; k < 3; k++) {
      if (!mirror.has(k)) continue;
      const double across = sum[k] - 2.0 * mirror.at[k];
      if (rsq - d[k] * d[k] + across * across < reach * reach)
        cut.push_back(3 * integrator->body(i) + k);
    }
  };
  const HVI::SphList list = all_pairs();
  for (int ii = 0; ii < list.inum; ii++) {
    const int i = list.ilist[ii];
    if (!is_sound(i)) continue;
    look(i, i);
    for (int jj = 0; jj < list.numneigh[i]; jj++) {
      const int j = list.firstneigh[i][jj] & NEIGHMASK;
      if (is_sound(j) && integrator->body(i) == integrator->body(j) &&
          pairs.tension[atom->type[i]][atom->type[j]] != 0.0)
        look(i, j);
    }
  }

  // bodies may be on many ranks, few are cut

  const auto sort = [](std::vector<int64_t> &some) {
    std::sort(some.begin(), some.end());
    some.erase(std::unique(some.begin(), some.end()), some.end());
  };
  sort(cut);
  const int n = cut.size();
  std::vector<int> counts(comm->nprocs), begins(comm->nprocs, 0);
  MPI_Allgather(&n, 1, MPI_INT, counts.data(), 1, MPI_INT, world);
  for (int k = 1; k < comm->nprocs; k++) begins[k] = begins[k - 1] + counts[k - 1];
  std::vector<int64_t> all(begins.back() + counts.back() + 1);
  cut.push_back(0);    // no null buffers
  MPI_Allgatherv(cut.data(), n, MPI_INT64_T, all.data(), counts.data(), begins.data(), MPI_INT64_T,
                 world);
  all.pop_back();
  sort(all);

  for (int i = 0; i < atom->nlocal; i++) {
    const int64_t label = integrator->body(i);
    if (!is_sound(i)) continue;
    int apart = integrator->apart_from(i);
    for (int k = 0; k < 3; k++)
      if (mirror.has(k) && !std::binary_search(all.begin(), all.end(), 3 * label + k))
        apart |= 1 << k;
    integrator->set_body(i, label, apart);
  }
  integrator->tell_ghosts();
}

/* ---------------------------------------------------------------------- */

void HVISchemeSolid::sum_gradients()
{
  const HVI::SphView &records = work.records;
  work.half_step = 0.5 * integrator->step();
  sweeps->first(work);
  if (set.mirror.planes) images.fold_sums(records);
  if (!force->newton_pair) return;
  reverse(SphMessage().with(records.gradv).with_sums(records.touching));
}

// a(3x3, rows) b(symmetric)

static VelocityGradient product(const VelocityGradient &a, const Symmetric &b)
{
  return {a.xx * b.xx + a.xy * b.xy + a.xz * b.xz, a.xx * b.xy + a.xy * b.yy + a.xz * b.yz,
          a.xx * b.xz + a.xy * b.yz + a.xz * b.zz, a.yx * b.xx + a.yy * b.xy + a.yz * b.xz,
          a.yx * b.xy + a.yy * b.yy + a.yz * b.yz, a.yx * b.xz + a.yy * b.yz + a.yz * b.zz,
          a.zx * b.xx + a.zy * b.xy + a.zz * b.xz, a.zx * b.xy + a.zy * b.yy + a.zz * b.yz,
          a.zx * b.xz + a.zy * b.yz + a.zz * b.zz};
}

/* ----------------------------------------------------------------------
   Of a particle that is nearly alone M says little: then the weights stay as they are.  full: the part of its
   volume that the neighborhood has, 0.15 of two particles, 0.4 at the corner of a cube, 0.5 in a sheet
------------------------------------------------------------------------- */

static Symmetric inverse(const Symmetric &M, double nu, double full, const bool *along)
{
  static constexpr double ALONE = 0.2, ENOUGH = 0.35;
  const double part = MAX(0.0, MIN(1.0, (full - ALONE) / (ENOUGH - ALONE)));
  if (part == 0.0) return {1.0, 1.0, 1.0, 0.0, 0.0, 0.0};
  const double by = 1.0 / nu;
  const Symmetric N = {along[0] ? M.xx * by : 1.0,
                       along[1] ? M.yy * by : 1.0,
                       along[2] ? M.zz * by : 1.0,
                       M.xy * by,
                       M.xz * by,
                       M.yz * by};
  Symmetric inverse = HVI::limited_inverse(N);
  const double counts = part * part * (3.0 - 2.0 * part);
  double *const c = &inverse.xx;
  for (int k = 0; k < 6; k++) c[k] = counts * by * c[k] + (k < 3 ? 1.0 - counts : 0.0);
  return inverse;
}

// of the middle of the step, to which L belongs: so nothing expands that turns, whether H can be inverted or not

static VelocityGradient corrected(const SphGradV &sum, double full, const bool *along)
{
  return product(sum.gradient(), inverse(sum.middle_moment(), sum.nu, full, along));
}

// what of the stress is normal to the contact, in place of L of what touches

static void put_normal(SphGradV &contact, double nu)
{
  Symmetric normal = {};
  if (contact.mxx + contact.myy + contact.mzz > 0.0) normal = HVI::along_largest(contact.moment());
  double *const n = &normal.xx;
  for (int k = 0; k < 6; k++) n[k] *= MIN(1.0, 4.0 * contact.nu / nu);
  contact.set_normal(normal);
}

bool HVISchemeSolid::touches(int i) const
{
  const HVI::SphTouching *const touching = work.records.touching;
  return touching && touching->of(i).sums.nu > 0.0;
}

/* ----------------------------------------------------------------------
   In gradv L H^-1 of what hangs together, and M^-1 in place of M.  Where something else touches, in
   its other record the M^-1 of all, and in place of L what of the stress is normal to the contact.  Its trace with
   all neighbors changes the density.  The law of the solid sees what hangs together; rubble as forces see
   it: it may have failed since.
------------------------------------------------------------------------- */

void HVISchemeSolid::correct_gradients()
{
  const HVI::SphView &records = work.records;
  each_active([&](int i) {
    if (is_embedded(i)) return;
    const HVI::SphState &s = records.state[i];
    SphTraction &T = records.traction[i];
    SphGradV &own = records.gradv[i];
    own.nu += s.w * sweeps->w(0.0) * set.laws.norm /
        MathSpecial::powint(records.place[i].h, set.laws.dim);
    const double scale = T.volume / s.w;
    const Symmetric by_own = inverse(own.moment(), own.nu, scale * own.nu, fields.along);
    const VelocityGradient L = corrected(own, scale * own.nu, fields.along);
    VelocityGradient L_all = L;

    if (touches(i)) {
      SphGradV &contact = records.touching->at(i).sums;
      SphGradV all = own;
      for (int k = 0; k < SphGradV::SENT; k++) (&all.xx)[k] += (&contact.xx)[k];
      const Symmetric by_all = inverse(all.moment(), all.nu, scale * all.nu, fields.along);
      L_all = corrected(all, scale * all.nu, fields.along);
      put_normal(contact, all.nu);
      contact.set_moment(by_all);
    }
    T.div = L_all.xx + L_all.yy + L_all.zz;
    own.set_gradient(s.is_rubble() ? L_all : L);
    own.set_moment(by_own);
  });
}

/* ----------------------------------------------------------------------
   Density and pressure of particles, elements with the particles that they hold, then stress, with what may
   fail.  In a setup nothing is advanced: all of it is that of the end of the last step.
------------------------------------------------------------------------- */

void HVISchemeSolid::advance()
{
  const HVI::SphView &records = work.records;
  each_active([&](int i) {
    if (is_embedded(i)) return;
    SphTraction &T = records.traction[i];
    T.rho = integrator->advance_density(i, T.div);
    records.rates[i].drho -= T.rho * T.div;
    const HVI::Eos &eos = *store->materials.of(atom->type[i])->eos;
    double csq;
    if (eos.evaluate(T.rho, atom->esph[i] / mass(i), T.p, csq))
      return;    // what of p is borne is known with the stress
    if (!integrator->freeze(i, T.rho)) no_answer(i, T.rho);

    // its stress is gone; its volume and velocity are still those that ghosts have

    SphTraction gone = {};
    gone.vx = T.vx;
    gone.vy = T.vy;
    gone.vz = T.vz;
    gone.volume = T.volume;
    T = gone;
    if (records.art) records.art[i] = {};
  });
  if (mesh) mesh->advance();
  if (integrator->is_due()) strength->advance(integrator->step());
  integrator->advanced();
}

/* ----------------------------------------------------------------------
   B = S M^-1 of what hangs together, less the pressure times M^-1 of all that touches.  In an element, whose
   other particles are left out of the sums, neighbors are as even as on a lattice.
------------------------------------------------------------------------- */

void HVISchemeSolid::find_tractions()
{
  static constexpr Symmetric ONE = {1.0, 1.0, 1.0, 0.0, 0.0, 0.0};
  const HVI::SphView &records = work.records;
  each_active([&](int i) {
    const FixHVIJohnsonCook::Stress borne = strength->stress(i);
    const HVI::Deviator &S = borne.S;
    SphTraction &T = records.traction[i];
    T.p = HVI::clip_tension(T.p, borne.p_min);

    const bool held = is_embedded(i);
    if (held && touches(i))
      put_normal(records.touching->at(i).sums, records.state[i].w / T.volume);    // nu of a lattice
    const Symmetric by_own = held ? ONE : records.gradv[i].moment();
    Symmetric by_all = by_own;
    double rest = 0.0;
    if (touches(i)) {
      const SphGradV &contact = records.touching->of(i).sums;
      if (!held) by_all = contact.moment();
      const Symmetric n = contact.normal();
      if (borne.shear > 0.0)
        rest = -(n.xx * S.xx + n.yy * S.yy + n.zz * S.zz +
                 2.0 * (n.xy * S.xy + n.xz * S.xz + n.yz * S.yz));
    }
    const double scale = T.volume / records.state[i].w, push = T.p + rest, p = scale * push;
    const VelocityGradient B = product(
        {S.xx + rest, S.xy, S.xz, S.xy, S.yy + rest, S.yz, S.xz, S.yz, S.zz + rest}, by_own);
    T.xx = scale * B.xx - p * by_all.xx;
    T.xy = scale * B.xy - p * by_all.xy;
    T.xz = scale * B.xz - p * by_all.xz;
    T.yx = scale * B.yx - p * by_all.xy;
    T.yy = scale * B.yy - p * by_all.yy;
    T.yz = scale * B.yz - p * by_all.yz;
    T.zx = scale * B.zx - p * by_all.xz;
    T.zy = scale * B.zy - p * by_all.yz;
    T.zz = scale * B.zz - p * by_all.zz;
    if (records.touching && records.touching->has(i))
      records.touching->at(i).push = {
          -p * by_all.xx, -p * by_all.yy, -p * by_all.zz, -p * by_all.xy,
          -p * by_all.xz, -p * by_all.yz, push,           0.0};
  });
}

void HVISchemeSolid::exchange()
{
  const HVI::SphView &records = work.records;
  if (records.art) artificial_stress();
  if (set.riemann)
    each_active([&](int i) {
      records.gradv[i].keep_stretch();
    });
  forward(SphMessage()
              .with(records.traction)
              .with(records.art)
              .with(set.riemann ? records.gradv : nullptr, SphGradV::SENT_STRETCH)
              .with_pushes(records.touching));
  if (set.mirror.planes) images.fill_sums(records);
}

/* ----------------------------------------------------------------------
   Of owned particles.  The spacing dp is that of the material's own density, (m/rho0)^(1/dim), over the H of
   pair_coeff: as Gray's, it stays what it was at the start, and in units of h with variable h too.
------------------------------------------------------------------------- */

void HVISchemeSolid::artificial_stress()
{
  const HVI::SphView &records = work.records;
  const HVI::SphLaws &laws = set.laws;
  for (int i = 0; i < atom->nlocal; i++) {
    if (!has_record(i)) continue;
    const int itype = atom->type[i];
    const HVI::Deviator T = HVI::tensile_part(records.traction[i].p, strength->stress(i).S);
    double f = 0.0;
    if (T.xx + T.yy + T.zz > 0.0) {
      const double V = mass(i) / store->materials.of(itype)->eos->rho0();
      const double dp = laws.dim == 3 ? std::cbrt(V) : (laws.dim == 2 ? std::sqrt(V) : V);
      const double w = sweeps->w(dp / set.h[itype]);
      if (!(w > 0.0))
        error->one(FLERR,
                   "Pair hvi/sph artstress: the spacing {} of type {} is beyond the reach of its "
                   "h {}",
                   dp, itype, set.h[itype]);
      f = -laws.art_eps / std::pow(w, laws.art_n);
    }
    records.art[i] = {f * T.xx, f * T.yy, f * T.zz, f * T.xy, f * T.xz, f * T.yz, {}};
  }
}

/* ----------------------------------------------------------------------
   SPH forces alone, and power, are needed at owners: for the work on the velocity of the end of the step, and by
   elements
------------------------------------------------------------------------- */

void HVISchemeSolid::forces_done()
{
  if (!force->newton_pair) return;
  reverse(SphMessage().with(work.records.rates, sent_rates()));
}
