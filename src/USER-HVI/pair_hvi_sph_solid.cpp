/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing authors: the lammps-hvi developers
------------------------------------------------------------------------- */

// gradient corrected: between the two sweeps; the rest of the class is in pair_hvi_sph.cpp

#include "pair_hvi_sph.h"

#include "atom.h"
#include "fix_hvi_johnson_cook.h"
#include "fix_hvi_sph.h"
#include "force.h"
#include "hvi_inverse.h"
#include "math_special.h"

using namespace LAMMPS_NS;
using HVI::SphGradV;
using HVI::SphTraction;
using HVI::Symmetric;
using HVI::VelocityGradient;

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
   Between the sweeps.  L is that of the middle of the step: with that density and stress are brought to its
   end, by the fixes that integrate them, and make tractions.
------------------------------------------------------------------------- */

void PairHVISPH::finish_gradients()
{
  const HVI::SphView &records = store->fields.view();
  if (force->newton_pair) {
    reverse(records.gradv, SphGradV::SENT);
    if (records.contact) reverse(records.contact, SphGradV::SENT);
  }
  const auto is_out = [this](int i) {
    return !is_ours[atom->type[i]] || store->fields.asleep(i) || store->fields.is_idle(i);
  };
  for (int i = 0; i < atom->nlocal; i++)
    if (!is_out(i) && !is_embedded(i)) correct_gradient(i);
  if (mesh) mesh->settle();
  integrator->settle_solids();
  for (int i = 0; i < atom->nlocal; i++)
    if (!is_out(i)) find_traction(i);

  forward(records.traction, SphTraction::SENT);
  if (records.art) {
    artificial_stress();
    forward(records.art, HVI::SphStress::FIRST_LIMIT);
  }
  if (records.push) forward(records.push, HVI::SphPush::SENT);
  if (set.riemann) forward(records.gradv, SphGradV::SENT_L);
}

/* ----------------------------------------------------------------------
   Of what is nearly alone M says little: then the weights stay as they are.  full: the part of its
   volume that the neighborhood has, 0.15 of two particles, 0.4 at the corner of a cube, 0.5 in a sheet
------------------------------------------------------------------------- */

static Symmetric inverse(const SphGradV &M, double full, const bool *along)
{
  static constexpr double ALONE = 0.2, ENOUGH = 0.35;
  const Symmetric N = {along[0] ? M.mxx / M.nu : 1.0,
                       along[1] ? M.myy / M.nu : 1.0,
                       along[2] ? M.mzz / M.nu : 1.0,
                       M.mxy / M.nu,
                       M.mxz / M.nu,
                       M.myz / M.nu};
  Symmetric inverse = HVI::limited_inverse(N);
  const double part = MAX(0.0, MIN(1.0, (full - ALONE) / (ENOUGH - ALONE)));
  const double counts = part * part * (3.0 - 2.0 * part);
  double *const c = &inverse.xx;
  for (int k = 0; k < 6; k++) c[k] = counts * c[k] / M.nu + (k < 3 ? 1.0 - counts : 0.0);
  return inverse;
}

static VelocityGradient gradient(const SphGradV &L)
{
  return {L.xx, L.xy, L.xz, L.yx, L.yy, L.yz, L.zx, L.zy, L.zz};
}

/* ----------------------------------------------------------------------
   L M^-1 with M of the middle of the step, which L belongs to: M - dt/2 (L + L^T), but for (dt/2)^2 v (x) v.
   So nothing expands that turns, whether its M can be inverted or not.
------------------------------------------------------------------------- */

static VelocityGradient corrected(const SphGradV &sum, double full, const bool *along, double half)
{
  SphGradV middle = sum;
  middle.mxx -= half * 2.0 * sum.xx;
  middle.myy -= half * 2.0 * sum.yy;
  middle.mzz -= half * 2.0 * sum.zz;
  middle.mxy -= half * (sum.xy + sum.yx);
  middle.mxz -= half * (sum.xz + sum.zx);
  middle.myz -= half * (sum.yz + sum.zy);
  return product(gradient(sum), inverse(middle, full, along));
}

// what of the stress is normal to the contact, in place of L of what touches

static void put_normal(SphGradV &contact, double nu)
{
  Symmetric normal = {};
  if (contact.mxx + contact.myy + contact.mzz > 0.0)
    normal = HVI::along_largest(
        {contact.mxx, contact.myy, contact.mzz, contact.mxy, contact.mxz, contact.myz});
  double *const n = &normal.xx;
  for (int k = 0; k < 6; k++) n[k] *= MIN(1.0, 4.0 * contact.nu / nu);
  contact.set_normal(normal);
}

/* ----------------------------------------------------------------------
   In gradv L M^-1 of what hangs together, and M^-1 in place of M.  Where something else touches, in
   contact the M^-1 of all, and in place of L what of the stress is normal to the contact.  Density
   and pressure.
------------------------------------------------------------------------- */

void PairHVISPH::correct_gradient(int i)
{
  const HVI::SphView &records = store->fields.view();
  const int itype = atom->type[i];
  const HVI::SphState &s = records.state[i];
  HVI::SphTraction &T = records.traction[i];
  SphGradV &own = records.gradv[i];
  own.nu +=
      s.w * sweeps->w(0.0) * set.laws.norm / MathSpecial::powint(records.place[i].h, set.laws.dim);
  const double scale = T.volume / s.w;
  const Symmetric by_own = inverse(own, scale * own.nu, store->fields.along);
  const double half = 0.5 * integrator->step();
  const VelocityGradient L = corrected(own, scale * own.nu, store->fields.along, half);
  VelocityGradient L_all = L;

  if (touches(i)) {
    SphGradV &contact = records.contact[i];
    SphGradV all = own;
    for (int k = 0; k < SphGradV::SENT; k++) (&all.xx)[k] += (&contact.xx)[k];
    const Symmetric by_all = inverse(all, scale * all.nu, store->fields.along);
    L_all = corrected(all, scale * all.nu, store->fields.along, half);
    put_normal(contact, all.nu);
    contact.set_inverse(by_all);
  }

  if (integrator->is_due()) strength->try_out(i, L, integrator->step());
  const double div = L_all.xx + L_all.yy + L_all.zz;
  T.rho = integrator->settle_density(i, div);
  records.rates[i].drho -= T.rho * div;
  const double m = atom->rmass ? atom->rmass[i] : atom->mass[itype];
  double csq;
  if (!store->materials.of(itype)->eos->evaluate(T.rho, atom->esph[i] / m, T.p, csq))
    no_answer(i, T.rho);    // what of p is borne is known after the step

  // the law of the solid sees what hangs together; rubble as forces see it: it may have failed since

  const VelocityGradient &seen = s.is_rubble() ? L_all : L;
  own.xx = seen.xx;
  own.xy = seen.xy;
  own.xz = seen.xz;
  own.yx = seen.yx;
  own.yy = seen.yy;
  own.yz = seen.yz;
  own.zx = seen.zx;
  own.zy = seen.zy;
  own.zz = seen.zz;
  own.set_inverse(by_own);
}

bool PairHVISPH::touches(int i) const
{
  const SphGradV *const contact = store->fields.view().contact;
  return contact && contact[i].nu > 0.0;
}

/* ----------------------------------------------------------------------
   B = S M^-1 of what hangs together, less the pressure times M^-1 of all that touches
------------------------------------------------------------------------- */

void PairHVISPH::find_traction(int i)
{
  const HVI::SphView &records = store->fields.view();
  const HVI::SphStress S = strength->settled(i);
  HVI::SphTraction &T = records.traction[i];
  T.p = HVI::clip_tension(T.p, S.p_min);

  // in an element, whose others are left out of the sums, neighbors are as even as on a lattice

  static constexpr Symmetric ONE = {1.0, 1.0, 1.0, 0.0, 0.0, 0.0};
  const bool held = is_embedded(i);
  if (held && touches(i))
    put_normal(records.contact[i], records.state[i].w / T.volume);    // nu of a lattice
  const Symmetric by_own = held ? ONE : records.gradv[i].inverse();
  Symmetric by_all = by_own;
  double rest = 0.0;
  if (touches(i)) {
    const SphGradV &contact = records.contact[i];
    if (!held) by_all = contact.inverse();
    const Symmetric n = contact.normal();
    if (S.shear > 0.0)
      rest = -(n.xx * S.xx + n.yy * S.yy + n.zz * S.zz +
               2.0 * (n.xy * S.xy + n.xz * S.xz + n.yz * S.yz));
  }
  const double scale = T.volume / records.state[i].w, push = T.p + rest, p = scale * push;
  const VelocityGradient B =
      product({S.xx + rest, S.xy, S.xz, S.xy, S.yy + rest, S.yz, S.xz, S.yz, S.zz + rest}, by_own);
  T.xx = scale * B.xx - p * by_all.xx;
  T.xy = scale * B.xy - p * by_all.xy;
  T.xz = scale * B.xz - p * by_all.xz;
  T.yx = scale * B.yx - p * by_all.xy;
  T.yy = scale * B.yy - p * by_all.yy;
  T.yz = scale * B.yz - p * by_all.yz;
  T.zx = scale * B.zx - p * by_all.xz;
  T.zy = scale * B.zy - p * by_all.yz;
  T.zz = scale * B.zz - p * by_all.zz;
  if (records.push)
    records.push[i] = {-p * by_all.xx, -p * by_all.yy, -p * by_all.zz, -p * by_all.xy,
                       -p * by_all.xz, -p * by_all.yz, push,           0.0};
}
