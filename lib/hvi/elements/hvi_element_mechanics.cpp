/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing authors: the lammps-hvi developers
------------------------------------------------------------------------- */

#include "hvi_element_mechanics.h"

#include <algorithm>
#include <cmath>

namespace HVI {

SolidInput ElementMechanics::input(const Element &one)
{
  SolidInput in = {};
  in.rho = one.rho;
  in.e = one.ahead;
  in.id = one.id;
  in.size = std::cbrt(one.V0);
  return in;
}

bool ElementMechanics::start(Element &one, const Corners &x) const
{
  one.V = one.V0 = hex_volume(x);
  if (!(one.V > 0.0) || !(hex_shape(x).jacobian > 0.0)) return false;
  one.rho = law(one).eos->rho0();
  one.mass = one.rho * one.V;
  one.solid = SolidModel::blank();
  law(one).solid->start(one.solid, input(one), true);
  return true;
}

/* ----------------------------------------------------------------------
   The step begins, as fix hvi/johnson-cook begins that of particles: forces tell rubble and signals by it.

   Half of a step's energy.  Forces on nodes work on the velocity v of the middle of the step, in both
   halves: that is what kinetic energy changes by, but for dt^2/8 f^2/m, which cancels between a
   step and the next if they are as long; what is left, the kick, is given back.  Of pairs particles have gained
   de, and forces worked f.w on them at the velocity w that pairs have seen; on v it is another work.  power_on_changes,
   that of pair forces on what other fixes have added to v since, is not work of pairs.
------------------------------------------------------------------------- */

void ElementMechanics::first_half(Element &one, const ElementNodes &nodes, double dt,
                                  double power_on_changes) const
{
  const SolidModel &solid = *law(one).solid;
  solid.begin_step(one.solid, solid.own_limit() ? input(one) : SolidInput());
  double work = -power_on_changes, kick = 0.0;
  for (int a = 0; a < CORNERS; a++) {
    for (int k = 0; k < 3; k++) work += (one.force[a][k] + one.pair_force[a][k]) * nodes[a]->v[k];
    kick += nodes[a]->kick;
  }
  one.change = 0.5 * dt * (one.pair_power - work) / one.mass;
  one.e += one.change + kick / CORNERS;
  one.ahead = one.e + one.change;
}

// forces have worked on velocities that have not changed since they were made

void ElementMechanics::second_half(Element &one, const ElementStep &step, double dt) const
{
  one.change = 0.5 * dt * (one.pair_power - step.work) / one.mass;
  one.e += one.change;
}

/* ----------------------------------------------------------------------
   The material has failed, or the element's shape
------------------------------------------------------------------------- */

int ElementMechanics::shared_corners(const ElementNodes &nodes) const
{
  return std::count_if(nodes.begin(), nodes.end(), [this](const Node *node) {
    return node->valence > 1.0 || mirror.passes(node->x);
  });
}

ElementMechanics::Failure ElementMechanics::failure(const Element &one, const ElementNodes &nodes,
                                                    const Corners &x) const
{
  const SolidState &s = one.solid;
  if (options.damage && s.damage >= 1.0) return DAMAGE;
  if (options.spall && s.spalled != 0.0) return SPALL;
  if (options.strain > 0.0 && s.eps > options.strain) return STRAIN;
  if (one.stable < options.shrink * one.stable_at_start) return STEP;
  const int shared = shared_corners(nodes);
  if (shared < 4 && shared < one.shared) return ORPHAN;    // a face has four
  if ((s.eps > 0.0 || s.failed()) && is_distorted(x)) return SHAPE;
  return NONE;
}

bool ElementMechanics::is_distorted(const Corners &x) const
{
  const HexShape shape = hex_shape(x);
  return shape.jacobian < options.jacobian || shape.edges > options.edges;
}

double ElementMechanics::let_go(Element &one, const ElementNodes &nodes, const Cells &cells) const
{
  double of_nodes = 0.0, of_particles = 0.0;
  for (int a = 0; a < CORNERS; a++)
    for (int k = 0; k < 3; k++) of_nodes += nodes[a]->v[k] * nodes[a]->v[k] / CORNERS;
  for (const auto &weights : cells)
    for (int k = 0; k < 3; k++) {
      double mean = 0.0;
      for (int a = 0; a < CORNERS; a++) mean += weights[a] * nodes[a]->v[k];
      of_particles += mean * mean / cells.size();
    }
  const double heat = 0.5 * (of_nodes - of_particles);
  one.e += heat;
  one.ahead += heat;
  return heat;
}

/* ----------------------------------------------------------------------
   What pairs tell of the motion of embedded particles takes the place of a part of the element's own velocity
   gradient,

     L^ = L (1 - M) + L_pair

   which drives stress, voids and damage.  Returns its trace, with that of other bodies.
------------------------------------------------------------------------- */

static double with_pairs(const ElementStep &step, double felt[9])
{
  const double *const L = step.L, *const m = step.sums.M, *const other = step.sums.M_of_others;
  const double Phi[9] = {m[0], m[3], m[4], m[3], m[1], m[5], m[4], m[5], m[2]};
  const double Phi_c[9] = {other[0], other[3], other[4], other[3], other[1],
                           other[5], other[4], other[5], other[2]};
  double of_others = step.sums.trace_L_of_others;
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) {
      double l = L[3 * i + j] + step.sums.L[3 * i + j];
      for (int k = 0; k < 3; k++) l -= L[3 * i + k] * Phi[3 * k + j];
      felt[3 * i + j] = l;
      of_others -= L[3 * i + j] * Phi_c[3 * j + i];
    }
  return felt[0] + felt[4] + felt[8] + of_others;
}

/* ----------------------------------------------------------------------
   Density goes by volume and by what pairs tell of it,

     rho(n+1) = rho(n) V(n)/V(n+1) exp[dt (tr L - tr L^)]
------------------------------------------------------------------------- */

ElementMechanics::Trouble ElementMechanics::advance(ElementBatch &batch, double dt, bool due,
                                                    int &lane) const
{
  const int n = batch.n;
  HexNodes x, B;
  for (int k = 0; k < 3; k++)
    for (int a = 0; a < CORNERS; a++)
      x[k][a] = batch.x[k][a] - (due ? 0.5 * dt : 0.0) * batch.v[k][a];
  Vec gradient[9];
  const Vec V_middle = hex_gradient(x, B);
  hex_velocity_gradient(batch.v, B, 1.0 / V_middle, gradient);

  Vec rho = Vec{} + 1.0, c = rho;
  SolidState *states[LANES];
  SolidInput inputs[LANES];
  int waiting = 0, lanes[LANES], wrong = -1;
  const SolidModel *solid = nullptr;
  const auto go = [&]() {
    if (waiting) wrong = solid->advance(waiting, states, inputs, dt);
    waiting = 0;
    if (wrong >= 0) lane = lanes[wrong];
    return wrong < 0;
  };
  for (lane = 0; lane < n; lane++) {
    Element &one = batch.element[lane];
    ElementStep &step = batch.step[lane];
    const Law &own = law(one);
    for (int k = 0; k < 9; k++) step.L[k] = gradient[k][lane];
    const double trace = step.L[0] + step.L[4] + step.L[8];
    double felt[9], trace_felt = trace;
    std::copy_n(step.L, 9, felt);
    if (step.paired) trace_felt = with_pairs(step, felt);
    if (due) {
      one.rho *= one.V / batch.V[lane];
      if (step.paired) one.rho *= std::exp(dt * (trace - trace_felt));
    }
    one.V = batch.V[lane];
    double csq;
    const bool known = one.V > 0.0 && own.eos->evaluate(one.rho, one.ahead, step.p, csq);

    // no body at rest has less energy, and a step in which an element turns over gives it far less

    if (!known || one.ahead < -0.02 * (csq + one.solid.shear / one.rho)) return COLLAPSED;
    rho[lane] = one.rho;
    c[lane] = csq;
    if (!due || one.solid.failed()) continue;
    if (solid != own.solid && !go()) return NOT_A_NUMBER;
    solid = own.solid;
    states[waiting] = &one.solid;
    inputs[waiting] = input(one);
    inputs[waiting].p = step.p;
    inputs[waiting].L = {felt[0], felt[1], felt[2], felt[3], felt[4],
                         felt[5], felt[6], felt[7], felt[8]};
    inputs[waiting].expansion = trace_felt;
    lanes[waiting++] = lane;
  }
  if (!go()) return NOT_A_NUMBER;

  for (lane = 0; lane < n; lane++) {
    const Element &one = batch.element[lane];
    ElementStep &step = batch.step[lane];
    const double least = one.solid.failed() ? 0.0
        : due                               ? one.solid.p_min
                                            : law(one).solid->p_min(one.solid, input(one));
    step.p = clip_tension(step.p, least);
    c[lane] = step.c = std::sqrt(c[lane] + 4.0 / 3.0 * one.solid.shear / one.rho);
  }
  Vec speed;
  const Vec q = hex_bulk_viscosity(rho, c, batch.V, gradient[0] + gradient[4] + gradient[8],
                                   options.q1, options.q2, speed);
  const Vec stable = hex_length(batch.V, batch.B) / (speed + sqrt(speed * speed + c * c));
  for (lane = 0; lane < n; lane++) {
    batch.element[lane].q = q[lane];
    batch.element[lane].stable = stable[lane];
  }
  return NO_TROUBLE;
}

void ElementMechanics::resume(ElementBatch &batch) const
{
  for (int lane = 0; lane < batch.n; lane++) {
    const Element &one = batch.element[lane];
    ElementStep &step = batch.step[lane];
    double csq;
    law(one).eos->evaluate(one.rho, one.ahead, step.p, csq);
    step.p = clip_tension(step.p, one.solid.failed() ? 0.0 : one.solid.p_min);
    std::copy_n(one.L, 9, step.L);
  }
}

/* ----------------------------------------------------------------------
   f_a = - (sigma - q 1 - K) B_a and hourglass forces
------------------------------------------------------------------------- */

void ElementMechanics::forces(ElementBatch &batch, double dt) const
{
  HexNodes f;
  Vec rho = Vec{} + 1.0, c = rho, stiff = {}, s[9] = {}, gradient[9] = {}, Q[12] = {};
  for (int lane = 0; lane < batch.n; lane++) {
    const Element &one = batch.element[lane];
    const ElementStep &step = batch.step[lane];
    const Deviator &S = one.solid.S;
    const double p = step.p + one.q;
    const double sigma[9] = {S.xx - p, S.xy, S.xz, S.xy, S.yy - p, S.yz, S.xz, S.yz, S.zz - p};
    for (int k = 0; k < 9; k++) {
      s[k][lane] = sigma[k] - step.K[k];
      gradient[k][lane] = step.L[k];
    }
    for (int k = 0; k < 12; k++) Q[k][lane] = one.Q[k];
    rho[lane] = one.rho;
    c[lane] = step.c;

    // with plastic strain stiffness would be that of an elastic body on top of one that flows

    const bool elastic = one.solid.eps == 0.0 && !one.solid.failed();
    const double G = one.solid.shear, K = one.rho * step.c * step.c - 4.0 / 3.0 * G;
    if (elastic) stiff[lane] = options.stiffness >= 0.0 ? options.stiffness : hex_stiffness(K, G);
  }
  hex_forces(s, batch.B, f);
  const Vec power = hex_hourglass(batch.x, batch.v, batch.B, batch.V, rho, c, gradient,
                                  options.viscous, stiff, dt, Q, f);
  Vec work = Vec{};
  for (int k = 0; k < 3; k++)
    for (int a = 0; a < CORNERS; a++) work += f[k][a] * batch.v[k][a];
  for (int lane = 0; lane < batch.n; lane++) {
    Element &one = batch.element[lane];
    batch.step[lane].work = work[lane];
    for (int k = 0; k < 12; k++) one.Q[k] = Q[k][lane];
    one.hourglass += dt * power[lane];
    for (int a = 0; a < CORNERS; a++)
      for (int k = 0; k < 3; k++) one.force[a][k] = f[k][a][lane];
  }
}

}    // namespace HVI
