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

  const auto inverse = [along](const SphGradV &M) {
    Symmetric N = {along[0] ? M.mxx / M.nu : 1.0,
                   along[1] ? M.myy / M.nu : 1.0,
                   along[2] ? M.mzz / M.nu : 1.0,
                   M.mxy / M.nu,
                   M.mxz / M.nu,
                   M.myz / M.nu};
    Symmetric inverse = HVI::limited_inverse(N);
    double *const c = &inverse.xx;
    for (int k = 0; k < 6; k++) c[k] /= M.nu;
    return inverse;
  };

  for (int i = 0; i < atom->nlocal; i++) {
    const int itype = atom->type[i];
    if (!is_ours[itype]) continue;
    const HVI::SphState &s = records.state[i];
    SphGradV &own = records.gradv[i];
    own.nu += s.w * sweeps->w(0.0) * set.laws.norm /
        MathSpecial::powint(records.place[i].h, set.laws.dim);
    const Symmetric by_own = inverse(own);
    const HVI::VelocityGradient L = {own.xx, own.xy, own.xz, own.yx, own.yy,
                                     own.yz, own.zx, own.zy, own.zz};
    const HVI::VelocityGradient exact = product(L, by_own);

    SphGradV all = own;
    Symmetric by_all = by_own;
    if (records.contact && records.contact[i].nu > 0.0) {
      for (int k = 0; k < SphGradV::SENT; k++) (&all.xx)[k] += (&records.contact[i].xx)[k];
      by_all = inverse(all);
    }
    const double V = records.traction[i].volume;

    const HVI::SphStress &S = records.stress[i];
    const HVI::VelocityGradient dev = {S.xx, S.xy, S.xz, S.xy, S.yy, S.yz, S.xz, S.yz, S.zz};
    const HVI::VelocityGradient B = product(dev, by_own);
    const double scale = V / s.w, p = scale * s.p;
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
                         -p * by_all.xz, -p * by_all.yz, {0.0, 0.0}};

    const HVI::VelocityGradient L_all = {all.xx, all.xy, all.xz, all.yx, all.yy,
                                         all.yz, all.zx, all.zy, all.zz};
    HVI::SphRates &rates = records.rates[i];
    rates.drho -= s.rho * trace(L_all, by_all);
    rates.de += V *
        (S.xx * exact.xx + S.yy * exact.yy + S.zz * exact.zz + S.xy * (exact.xy + exact.yx) +
         S.xz * (exact.xz + exact.zx) + S.yz * (exact.yz + exact.zy) - s.p * trace(L, by_all));

    // the law of the solid sees what hangs together

    const HVI::VelocityGradient seen = strength->failed(i) ? product(L_all, by_all) : exact;
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
  if (set.riemann) forward(records.gradv, 9);
}
