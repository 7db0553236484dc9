/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing authors: the lammps-hvi developers
------------------------------------------------------------------------- */

// elements over a step, and what they get from particles and show to them; the rest of the class is in
// fix_hvi_fem.cpp

#include "fix_hvi_fem.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix_hvi_johnson_cook.h"
#include "fix_hvi_ledger.h"
#include "fix_hvi_sph.h"
#include "fix_hvi_store.h"
#include "force.h"
#include "hvi_compat.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;
using HVI::CORNERS;
using HVI::HexNodes;
using HVI::LANES;
using HVI::Vec;

// of an element, near its first corner

void FixHVIFEM::corners(std::size_t e, int what, double x[CORNERS][3]) const
{
  for (int a = 0; a < CORNERS; a++)
    for (int k = 0; k < 3; k++) x[a][k] = at(e, a)[what + k];
  if (!wraps || what != X) return;
  for (int a = 1; a < CORNERS; a++) {
    const double d[3] = {x[a][0] - x[0][0], x[a][1] - x[0][1], x[a][2] - x[0][2]};
    if (std::fabs(d[0]) < nearby && std::fabs(d[1]) < nearby && std::fabs(d[2]) < nearby) continue;
    double image[3] = {d[0], d[1], d[2]};
    HVI::minimum_image(domain, image[0], image[1], image[2]);
    for (int k = 0; k < 3; k++)
      if (image[k] != d[k]) x[a][k] = x[0][k] + image[k];
  }
}

// of n elements from first on; lanes that are left get the last one

void FixHVIFEM::load(std::size_t first, int n, int what, HexNodes &y) const
{
  for (int lane = 0; lane < LANES; lane++) {
    const std::size_t e = first + std::min(lane, n - 1);
    if (wraps && what == X) {
      double x[CORNERS][3];
      corners(e, what, x);
      for (int a = 0; a < CORNERS; a++)
        for (int k = 0; k < 3; k++) y[k][a][lane] = x[a][k];
    } else
      for (int a = 0; a < CORNERS; a++)
        for (int k = 0; k < 3; k++) y[k][a][lane] = at(e, a)[what + k];
  }
}

/* ---------------------------------------------------------------------- */

const HVI::SolidModel &FixHVIFEM::model(const Element &one) const
{
  const HVI::SolidModel *const found = strength->model(one.type);
  if (!found)
    error->one(FLERR,
               "Fix hvi/fem: element {} has type {}, which is no solid for fix hvi/johnson-cook",
               one.id, one.type);
  return *found;
}

HVI::SolidInput FixHVIFEM::input(const Element &one) const
{
  HVI::SolidInput in = {};
  in.rho = one.rho;
  in.e = one.ahead;
  in.id = one.id;
  in.size = std::cbrt(one.V0);
  return in;
}

/* ----------------------------------------------------------------------
   Between the sweeps of pair hvi/sph.  Elements that pairs do not act on have their forces at once, while
   all of their numbers are at hand.
------------------------------------------------------------------------- */

void FixHVIFEM::settle()
{
  const bool due = integrator->is_due();
  const double dt = integrator->step();
  for (std::size_t e = 0; e < elements.size(); e++) {
    elements[e].kick = 0.0;
    if (!active[e]) continue;
    std::fill_n(now[e].K, 9, 0.0);
    std::fill_n(now[e].sums, +SUMS, 0.0);
  }
  gather_sums();
  shortest = HVI::NO_BOUND;
  for (std::size_t e = 0; e < elements.size(); e += LANES) {
    const int n = std::min<std::size_t>(LANES, elements.size() - e);
    if (going_on)
      for (std::size_t k = e; k < e + n; k++) resume(k);
    else
      advance(e, n, dt, due);
    if (!waits(e, n)) element_forces(e, n, due ? dt : 0.0);
  }
  show_states(false);
}

// as the last run has left it: what advance() told others

void FixHVIFEM::resume(std::size_t e)
{
  const Element &one = elements[e];
  double csq;
  store->materials.of(one.type)->eos->evaluate(one.rho, one.ahead, now[e].p, csq);
  now[e].p = HVI::clip_tension(now[e].p, one.s.failed() ? 0.0 : one.s.least);
  std::copy_n(one.L, 9, now[e].L);
  if (!(one.stable >= shortest)) shortest = one.stable;
}

// for what pairs do to particles of n elements from first on

bool FixHVIFEM::waits(std::size_t first, int n) const
{
  return std::count(&active[first], &active[first] + n, 0) < n;
}

/* ----------------------------------------------------------------------
   Averages over an element's particles p, of sums over what is free near them:
   L = < - sum_j w_j v_pj (x) grad W >,  M = < - sum_j w_j x_pj (x) grad W >,
   and of other bodies the trace of L and M
------------------------------------------------------------------------- */

void FixHVIFEM::gather_sums()
{
  const HVI::SphView &records = store->fields.view();
  near.gather(
      SUMS,
      [&](int i, double *b) {
        std::copy_n(&records.gradv[i].xx, +TRACE, b);
        std::fill(b + TRACE, b + SUMS, 0.0);
        if (!records.contact || !(records.contact[i].nu > 0.0)) return;
        const HVI::SphGradV &contact = records.contact[i];
        b[TRACE] = contact.xx + contact.yy + contact.zz;
        std::copy_n(&contact.mxx, 6, b + CONTACT);
      },
      [this](int k, const double *b) {
        const Member &m = members[k];
        const double share = 1.0 / elements[m.e].particles();
        for (int n = 0; n < SUMS; n++) now[m.e].sums[n] += share * b[n];
      });
}

/* ----------------------------------------------------------------------
   Elements from first on, n of them, to the end of the step.  What pairs tell of the motion of
   their particles takes the place of a part of the element's own velocity gradient,

     L^ = L (1 - M) + L_pair

   which drives stress, voids and damage; with that of other bodies the density,

     rho(n+1) = rho(n) V(n)/V(n+1) exp[dt (tr L - tr L^)]
------------------------------------------------------------------------- */

double FixHVIFEM::with_pairs(const Now &t, double felt[9]) const
{
  const double *const s = t.sums, *const m = s + M, *const contact = s + CONTACT;
  const double trace = t.L[0] + t.L[4] + t.L[8];
  const double Phi[9] = {m[0], m[3], m[4], m[3], m[1], m[5], m[4], m[5], m[2]};
  const double Phi_c[9] = {contact[0], contact[3], contact[4], contact[3], contact[1],
                           contact[5], contact[4], contact[5], contact[2]};
  double trace_felt = trace + s[TRACE];
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) {
      double l = t.L[3 * i + j] + s[L + 3 * i + j];
      for (int k = 0; k < 3; k++) l -= t.L[3 * i + k] * Phi[3 * k + j];
      felt[3 * i + j] = l;
      trace_felt -= t.L[3 * i + j] * Phi_c[3 * j + i];
    }
  return trace_felt + felt[0] + felt[4] + felt[8] - trace;
}

void FixHVIFEM::advance(std::size_t first, int n, double dt, bool due)
{
  HexNodes x, v, B;
  load(first, n, X, x);
  load(first, n, V, v);
  const Vec V_end = HVI::hex_gradient(x, B), length = HVI::hex_length(V_end, B);
  for (int k = 0; k < 3; k++)
    for (int a = 0; a < CORNERS; a++) x[k][a] -= (due ? 0.5 * dt : 0.0) * v[k][a];
  Vec gradient[9];
  const Vec V_middle = HVI::hex_gradient(x, B);
  HVI::hex_velocity_gradient(v, B, 1.0 / V_middle, gradient);

  Vec rho = Vec{} + 1.0, c = rho;
  HVI::SolidState *states[LANES];
  HVI::SolidInput inputs[LANES];
  int waiting = 0;
  const HVI::SolidModel *law = nullptr;
  std::size_t who[LANES];
  const auto go = [&]() {
    if (!waiting) return;
    const int wrong = law->whole_step(waiting, states, inputs, dt);
    if (wrong >= 0)
      error->one(FLERR, "Fix hvi/fem: stress of element {} is not a number",
                 elements[who[wrong]].id);
    waiting = 0;
  };
  for (int lane = 0; lane < n; lane++) {
    const std::size_t e = first + lane;
    if (!alive(e)) continue;
    Element &one = elements[e];
    Now &t = now[e];
    for (int k = 0; k < 9; k++) t.L[k] = gradient[k][lane];
    const double trace = t.L[0] + t.L[4] + t.L[8];
    double felt[9], trace_felt = trace;
    std::copy_n(t.L, 9, felt);
    if (active[e]) trace_felt = with_pairs(t, felt);
    const HVI::SolidModel &own = model(one);
    if (due) {
      if (!one.s.failed())
        own.try_out(
            one.s,
            {felt[0], felt[1], felt[2], felt[3], felt[4], felt[5], felt[6], felt[7], felt[8]}, dt);
      one.rho *= one.V / V_end[lane];
      if (active[e]) one.rho *= std::exp(dt * (trace - trace_felt));
    }
    one.V = V_end[lane];
    double csq;
    const bool known =
        one.V > 0.0 && store->materials.of(one.type)->eos->evaluate(one.rho, one.ahead, t.p, csq);

    // no body at rest has less energy, and a step in which an element turns over gives it far less

    if (!known || one.ahead < -0.02 * (csq + one.s.shear / one.rho))
      error->one(
          FLERR,
          "Fix hvi/fem: element {} (type {}) has turned inside out or collapsed at step {}: volume "
          "{}, density {}, energy per mass {}; elements that are crushed need particles and "
          "convert yes, or a smaller courant",
          one.id, one.type, update->ntimestep, one.V, one.rho, one.ahead);
    rho[lane] = one.rho;
    c[lane] = csq;
    if (!due || one.s.failed()) continue;
    if (law != &own) go();
    law = &own;
    states[waiting] = &one.s;
    inputs[waiting] = input(one);
    inputs[waiting].p = t.p;
    inputs[waiting].expansion = trace_felt;
    who[waiting++] = e;
  }
  go();

  Vec speed;
  for (int lane = 0; lane < n; lane++) {
    const Element &one = elements[first + lane];
    if (one.type <= 0) continue;
    Now &t = now[first + lane];
    const double least = one.s.failed() ? 0.0
        : due                           ? one.s.least
                                        : model(one).p_min(one.s, input(one));
    t.p = HVI::clip_tension(t.p, least);
    c[lane] = t.c = std::sqrt(c[lane] + 4.0 / 3.0 * one.s.shear / one.rho);
  }
  const Vec q = HVI::hex_bulk_viscosity(rho, c, V_end, gradient[0] + gradient[4] + gradient[8],
                                        options.q1, options.q2, speed);
  const Vec stable = length / (speed + HVI::sqrt(speed * speed + c * c));
  for (int lane = 0; lane < n; lane++) {
    if (!alive(first + lane)) continue;
    elements[first + lane].q = q[lane];
    elements[first + lane].stable = stable[lane];
    if (!(stable[lane] >= shortest)) shortest = stable[lane];
    if (elements[first + lane].at_start > 0.0) continue;
    elements[first + lane].at_start = stable[lane];
    elements[first + lane].shared = shared(first + lane);
  }
}

/* ----------------------------------------------------------------------
   To particles, of elements that are active or of all
------------------------------------------------------------------------- */

void FixHVIFEM::show_states(bool all)
{
  static constexpr int STATE = sizeof(HVI::SolidState) / sizeof(double);
  enum { RHO_NOW = STATE, P, GRADIENT, WIDTH = GRADIENT + 9 };
  static_assert(WIDTH <= HVITagExchange::MAXWIDTH, "a state is too long to be sent");
  const HVI::SphView &records = store->fields.view();
  const std::vector<Member> &of = all ? inside : members;
  const auto pack = [&](int k, double *b) {
    const int e = of[k].e;
    const Element &one = elements[e];
    if (!alive(e)) {
      b[RHO_NOW] = 0.0;
      return;
    }
    std::copy_n((const double *) &one.s, +STATE, b);
    b[RHO_NOW] = one.rho;
    if (all) return;
    b[P] = now[e].p;
    std::copy_n(now[e].L, 9, b + GRADIENT);
  };
  const auto unpack = [&](int i, const double *b) {
    if (b[RHO_NOW] == 0.0) return;
    strength->embed(i, *(const HVI::SolidState *) b);
    if (all) return;
    records.traction[i].rho = b[RHO_NOW];
    records.traction[i].p = b[P];
    std::copy_n(b + GRADIENT, 9, &records.gradv[i].xx);
  };
  (all ? particles : near).scatter(all ? P : WIDTH, pack, unpack);
}

/* ----------------------------------------------------------------------
   When pairs have acted: forces of elements, in place of pre_force() of others, for ghosts have not
   yet sent what happened to them, but sums of what pairs did to particles of elements are at their owners
------------------------------------------------------------------------- */

void FixHVIFEM::pre_reverse(int, int)
{
  make_forces(integrator->step());
}

void FixHVIFEM::make_forces(double dt)
{
  for (std::size_t e = 0; e < elements.size(); e++) {
    if (!active[e] && !others) continue;
    elements[e].power = 0.0;
    std::fill_n(elements[e].pair_force, 3 * CORNERS, 0.0);
  }
  gather_forces();
  for (std::size_t e = 0; e < elements.size(); e += LANES) {
    const int n = std::min<std::size_t>(LANES, elements.size() - e);
    if (waits(e, n)) element_forces(e, n, dt);
  }

  // in the order of elements, whoever is active: so sums are the same to the last bit when a run goes on with new lists

  push.assign(3 * nodes.size(), 0.0);
  for (std::size_t e = 0; e < elements.size(); e++) {
    if (!alive(e)) continue;
    const Element &one = elements[e];
    for (int a = 0; a < CORNERS; a++)
      for (int k = 0; k < 3; k++) {
        push[3 * corner[CORNERS * e + a] + k] += one.force[3 * a + k] + one.pair_force[3 * a + k];
        now[e].work += one.pair_force[3 * a + k] * at(e, a)[V + k];
      }
  }
  if (others) gather_beside();
  bring_forces();
}

/* ----------------------------------------------------------------------
   What pairs did to particles: force f, to nodes with the weights N_a; energy de, and f.w with the velocity w
   that they saw; and the part of the stress that they carry in place of the element,

     K = < - sum_j w_j (sigma_p grad W) (x) x_pj > = < sigma_p M >

   with sigma_p as pairs had it: under contact only what pushes.  Weights N_a sum up to an eighth of the
   particles for each node, so masses go the same way, and momentum is exact.
------------------------------------------------------------------------- */

void FixHVIFEM::gather_forces()
{
  enum { FORCE, POWER = 3, SHARE, WIDTH = SHARE + 9 };
  const HVI::SphView &records = store->fields.view();
  near.gather(
      WIDTH,
      [&](int i, double *b) {
        const HVI::SphRates &rates = records.rates[i];
        const HVI::SphTraction &T = records.traction[i];
        const HVI::SphGradV &g = records.gradv[i];
        std::copy_n(&rates.fx, 3, b);
        b[POWER] = rates.de + rates.fx * T.vx + rates.fy * T.vy + rates.fz * T.vz;
        const double factor = records.state[i].w / T.volume;
        const double m[9] = {g.mxx, g.mxy, g.mxz, g.mxy, g.myy, g.myz, g.mxz, g.myz, g.mzz};
        for (int k = 0; k < 9; k++) {
          const double *const t = &T.xx + 3 * (k / 3);
          b[SHARE + k] = factor * (t[0] * m[k % 3] + t[1] * m[3 + k % 3] + t[2] * m[6 + k % 3]);
        }
        if (!records.contact || !(records.contact[i].nu > 0.0)) return;
        const HVI::SphGradV &c = records.contact[i];
        const double mc[9] = {c.mxx, c.mxy, c.mxz, c.mxy, c.myy, c.myz, c.mxz, c.myz, c.mzz};
        for (int k = 0; k < 9; k++) b[SHARE + k] -= records.push[i].p * mc[k];
      },
      [this](int k, const double *b) {
        const Member &m = members[k];
        if (!alive(m.e)) return;
        Element &one = elements[m.e];
        const auto &N = subcells[one.n][m.p];
        const double share = 1.0 / one.particles();
        one.power += b[POWER];
        for (int n = 0; n < 9; n++) now[m.e].K[n] += share * b[SHARE + n];
        for (int a = 0; a < CORNERS; a++)
          for (int d = 0; d < 3; d++) one.pair_force[3 * a + d] += N[a] * b[FORCE + d];
      });
}

/* ----------------------------------------------------------------------
   What other styles did to particles: all of their forces but those of pair hvi/sph, to nodes with the weights N_a, so they
   work on particles and nodes alike, and their energy is where these styles have it; and heat, to elements.
   Sums over ghosts are done here, as the forces of nodes must be complete before other fixes see them.
------------------------------------------------------------------------- */

void FixHVIFEM::gather_beside()
{
  const HVI::SphFields &fields = store->fields;
  beside.assign(atom->nlocal + atom->nghost, Beside());
  for (std::size_t i = 0; i < beside.size(); i++)
    if (fields.embedded[i])
      beside[i] = {{atom->f[i][0], atom->f[i][1], atom->f[i][2]}, atom->desph[i]};
  if (force->newton) comm->reverse_comm(this, sizeof(Beside) / sizeof(double));
  for (int i = 0; i < atom->nlocal; i++) {
    if (!fields.embedded[i] || fields.is_idle(i)) continue;
    const HVI::SphRates &rates = fields.view().rates[i];
    beside[i].f[0] -= rates.fx;
    beside[i].f[1] -= rates.fy;
    beside[i].f[2] -= rates.fz;
    if (fields.settings.energy) beside[i].power -= rates.de;
  }
  particles.gather(
      sizeof(Beside) / sizeof(double),
      [this](int i, double *b) {
        memcpy(b, &beside[i], sizeof(Beside));
      },
      [this](int k, const double *b) {
        const Member &m = inside[k];
        const auto &N = subcells[elements[m.e].n][m.p];
        elements[m.e].power += b[3];
        for (int a = 0; a < CORNERS; a++)
          for (int d = 0; d < 3; d++) push[3 * corner[CORNERS * m.e + a] + d] += N[a] * b[d];
      });
  beside.clear();
}

/* ----------------------------------------------------------------------
   f_a = - (sigma - q 1 - K) B_a and hourglass forces.  Those of a run that goes on are there.
------------------------------------------------------------------------- */

void FixHVIFEM::element_forces(std::size_t first, int n, double dt)
{
  if (!going_on) {
    HexNodes x, v, B, f;
    load(first, n, X, x);
    load(first, n, V, v);
    const Vec V_end = HVI::hex_gradient(x, B);
    Vec rho = Vec{} + 1.0, c = rho, stiff = {}, s[9] = {}, gradient[9] = {}, Q[12] = {};
    for (int lane = 0; lane < n; lane++) {
      if (!alive(first + lane)) continue;
      const Element &one = elements[first + lane];
      const Now &t = now[first + lane];
      const HVI::Deviator &S = one.s.S;
      const double p = t.p + one.q;
      const double sigma[9] = {S.xx - p, S.xy, S.xz, S.xy, S.yy - p, S.yz, S.xz, S.yz, S.zz - p};
      for (int k = 0; k < 9; k++) {
        s[k][lane] = sigma[k] - t.K[k];
        gradient[k][lane] = t.L[k];
      }
      for (int k = 0; k < 12; k++) Q[k][lane] = one.Q[k];
      rho[lane] = one.rho;
      c[lane] = t.c;

      // with plastic strain stiffness would be that of an elastic body on top of one that flows

      const bool elastic = one.s.eps == 0.0 && !one.s.failed();
      const double G = one.s.shear, K = one.rho * t.c * t.c - 4.0 / 3.0 * G;
      if (elastic)
        stiff[lane] = options.stiffness >= 0.0 ? options.stiffness : HVI::hex_stiffness(K, G);
    }
    HVI::hex_forces(s, B, f);
    const Vec power =
        HVI::hex_hourglass(x, v, B, V_end, rho, c, gradient, options.viscous, stiff, dt, Q, f);
    Vec work = Vec{};
    for (int k = 0; k < 3; k++)
      for (int a = 0; a < CORNERS; a++) work += f[k][a] * v[k][a];
    for (int lane = 0; lane < n; lane++) {
      if (!alive(first + lane)) continue;
      Element &one = elements[first + lane];
      now[first + lane].work = work[lane];
      for (int k = 0; k < 12; k++) one.Q[k] = Q[k][lane];
      one.hourglass += dt * power[lane];
      for (int a = 0; a < CORNERS; a++)
        for (int k = 0; k < 3; k++) one.force[3 * a + k] = f[k][a][lane];
    }
  }
}

/* ----------------------------------------------------------------------
   To nodes.  One on a mirror plane stays there: its image does the same on the other side, and what they have
   in common is half of each.  Forces on particles of elements have gone to nodes.
------------------------------------------------------------------------- */

void FixHVIFEM::bring_forces()
{
  double *const *const f = atom->f;
  const HVI::MirrorPlanes &mirror = store->fields.settings.mirror;
  double *const held_back = store->fields.plane_force;
  nodes.scatter(
      3,
      [this](int k, double *b) {
        std::copy_n(&push[3 * k], 3, b);
      },
      [&](int i, const double *b) {
        for (int k = 0; k < 3; k++) {
          if (mirror.has(k) && mirror.depth(k, atom->x[i]) < 0.0)
            error->one(
                FLERR,
                "Fix hvi/fem: node {} has gone through the mirror plane {} at step {}: walls "
                "of elements do not bounce off mirror planes",
                atom->tag[i], "xyz"[k], update -> ntimestep);
          if (mirror.has(k) && atom->x[i][k] == mirror.at[k])
            held_back[k] -= b[k];
          else
            f[i][k] += b[k];
        }
      });
  const int nall = atom->nlocal + atom->nghost;
  for (int i = 0; i < nall; i++)
    if (store->fields.embedded[i]) f[i][0] = f[i][1] = f[i][2] = 0.0;
}
