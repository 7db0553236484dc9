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
#include "force.h"
#include "hvi_inverse.h"
#include "math_special.h"

using namespace LAMMPS_NS;
using HVI::SphGradV;
using HVI::Symmetric;

// a(3x3, rows) b(symmetric)

static HVI::VelocityGradient product(const HVI::VelocityGradient &a, const Symmetric &b)
{
  return {a.xx * b.xx + a.xy * b.xy + a.xz * b.xz, a.xx * b.xy + a.xy * b.yy + a.xz * b.yz,
          a.xx * b.xz + a.xy * b.yz + a.xz * b.zz, a.yx * b.xx + a.yy * b.xy + a.yz * b.xz,
          a.yx * b.xy + a.yy * b.yy + a.yz * b.yz, a.yx * b.xz + a.yy * b.yz + a.yz * b.zz,
          a.zx * b.xx + a.zy * b.xy + a.zz * b.xz, a.zx * b.xy + a.zy * b.yy + a.zz * b.yz,
          a.zx * b.xz + a.zy * b.yz + a.zz * b.zz};
}

static double trace(const HVI::VelocityGradient &L, const Symmetric &K)
{
  return L.xx * K.xx + L.yy * K.yy + L.zz * K.zz + (L.xy + L.yx) * K.xy + (L.xz + L.zx) * K.xz +
      (L.yz + L.zy) * K.yz;
}

/* ---------------------------------------------------------------------- */

void PairHVISPH::finish_gradients()
{
  const HVI::SphView &records = store->fields.view();
  const bool *const along = store->fields.along;
  if (force->newton_pair) {
    reverse(records.gradv, SphGradV::SENT);
    if (records.contact) reverse(records.contact, SphGradV::SENT);
  }

  // of what is nearly alone M says little: then the weights stay as they are.  full: the part of its
  // volume that the neighborhood has, 0.15 of two particles, 0.4 at the corner of a cube, 0.5 in a sheet

  const auto inverse = [along](const SphGradV &M, double full) {
    static constexpr double ALONE = 0.2, ENOUGH = 0.35;
    Symmetric N = {along[0] ? M.mxx / M.nu : 1.0,
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
  };

  for (int i = 0; i < atom->nlocal; i++) {
    const int itype = atom->type[i];
    if (!is_ours[itype] || store->fields.asleep(i)) continue;
    const HVI::SphState &s = records.state[i];
    SphGradV &own = records.gradv[i];
    own.nu += s.w * sweeps->w(0.0) * set.laws.norm /
        MathSpecial::powint(records.place[i].h, set.laws.dim);
    const double V = records.traction[i].volume, scale = V / s.w;
    const Symmetric by_own = inverse(own, scale * own.nu);
    const HVI::VelocityGradient L = {own.xx, own.xy, own.xz, own.yx, own.yy,
                                     own.yz, own.zx, own.zy, own.zz};
    const HVI::VelocityGradient exact = product(L, by_own);

    // what bodies push each other with is a pressure: of the stress the part normal to the contact

    const HVI::SphStress &S = records.stress[i];
    SphGradV all = own;
    Symmetric by_all = by_own;
    double push = s.p;
    if (records.contact && records.contact[i].nu > 0.0) {
      const SphGradV &c = records.contact[i];
      for (int k = 0; k < SphGradV::SENT; k++) (&all.xx)[k] += (&c.xx)[k];
      by_all = inverse(all, scale * all.nu);
      if (S.shear > 0.0 && c.mxx + c.myy + c.mzz > 0.0)
        push -= MIN(1.0, 4.0 * c.nu / all.nu) *
            HVI::stress_along_largest({c.mxx, c.myy, c.mzz, c.mxy, c.mxz, c.myz},
                                      {S.xx, S.yy, S.zz, S.xy, S.xz, S.yz});
    }

    const double rest = push - s.p, p = scale * push;
    const HVI::VelocityGradient B = product(
        {S.xx + rest, S.xy, S.xz, S.xy, S.yy + rest, S.yz, S.xz, S.yz, S.zz + rest}, by_own);
    HVI::SphTraction &T = records.traction[i];
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

    const HVI::VelocityGradient L_all = {all.xx, all.xy, all.xz, all.yx, all.yy,
                                         all.yz, all.zx, all.zy, all.zz};
    HVI::SphRates &rates = records.rates[i];
    rates.drho -= s.rho * trace(L_all, by_all);
    rates.de += V *
        (S.xx * exact.xx + S.yy * exact.yy + S.zz * exact.zz + S.xy * (exact.xy + exact.yx) +
         S.xz * (exact.xz + exact.zx) + S.yz * (exact.yz + exact.zy) +
         rest * (exact.xx + exact.yy + exact.zz) - push * trace(L, by_all));

    // the law of the solid sees what hangs together; rubble as forces see it: it may have failed since

    const bool rubble = s.type != itype;
    const HVI::VelocityGradient seen = rubble ? product(L_all, by_all) : exact;
    own.xx = seen.xx;
    own.xy = seen.xy;
    own.xz = seen.xz;
    own.yx = seen.yx;
    own.yy = seen.yy;
    own.yz = seen.yz;
    own.zx = seen.zx;
    own.zy = seen.zy;
    own.zz = seen.zz;
  }
  forward(records.traction, HVI::SphTraction::SENT);
  if (records.push) forward(records.push, HVI::SphPush::SENT);
  if (set.riemann) forward(records.gradv, SphGradV::SENT_L);
}
