/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing authors: the lammps-hvi developers
------------------------------------------------------------------------- */

// the records of particles, before and after the loop over pairs, which is in pair_hvi_sph.cpp

#include "pair_hvi_sph.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "fix_hvi_johnson_cook.h"
#include "fix_hvi_sph.h"
#include "force.h"
#include "hvi_artstress.h"
#include "hvi_kernel.h"
#include "neigh_list.h"
#include "update.h"

#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;

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

  for (int i = 0; i < nall; i++) {
    const int itype = type[i];
    rates[i] = {};
    if (solid) gradv[i] = {};
    if (!materials[itype]) continue;    // of another style in a hybrid
    const double m = rmass ? rmass[i] : atom->mass[itype];
    double p, csq;
    if (!std::isfinite(esph[i]) || !materials[itype]->eos->evaluate(rho[i], esph[i] / m, p, csq))
      error->one(FLERR,
                 "Pair hvi/sph: equation of state {} of particle {} (type {}) has no answer at "
                 "density {} and energy per mass {} at step {}",
                 materials[itype]->eos->name(), atom->tag[i], itype, rho[i], esph[i] / m,
                 update->ntimestep);

    // failed particles are not pulled; signals in solids are longitudinal

    if (solid) {
      p = MAX(p, stress[i].p_min);
      csq += 4.0 / 3.0 * stress[i].shear / rho[i];
    }

    // the package SPH takes the speed of sound of liquids as constant, of gases as sqrt(p/rho)

    if (laws.stock) {
      const double c0 = materials[itype]->eos->c0();
      csq = c0 > 0.0 ? c0 * c0 : p / rho[i];
      if (!(csq >= 0.0))
        error->one(FLERR, "Pair hvi/sph: energy {} of particle {} is negative at step {}", esph[i],
                   atom->tag[i], update->ntimestep);
    }

    place[i].x = x[i][0];
    place[i].y = x[i][1];
    place[i].z = x[i][2];
    place[i].h = variable ? smoothing_length(itype, rho[i], fix->hscale(i)) : htype[itype];

    HVI::SphState &s = state[i];
    s.vx = vest[i][0];
    s.vy = vest[i][1];
    s.vz = vest[i][2];
    s.rho = rho[i];
    s.w = laws.symmetric ? m : m / rho[i];
    s.p = laws.symmetric ? p / (rho[i] * rho[i]) : p;
    s.c = std::sqrt(csq);
    s.type = itype;
  }
}

/* ----------------------------------------------------------------------
   stress at this step, of owned particles from the fix that integrates it
------------------------------------------------------------------------- */

void PairHVISPH::gather_stress()
{
  for (int i = 0; i < atom->nlocal; i++) stress[i] = strength->stress(i);
  sending = STRESS;
  comm->forward_comm(this);
}

/* ----------------------------------------------------------------------
   Of owned particles and ghosts, whose pressure and stress are known here.  The spacing dp is
   that of the material's own density, (m/rho0)^(1/dim), over the H of pair_coeff: as Gray's,
   it stays what it was at the start, and in units of h with variable h too.
------------------------------------------------------------------------- */

void PairHVISPH::artificial_stress()
{
  const double *const rmass = atom->rmass;
  HVI::with_kernel(kernel, [&](auto k) {
    for (int i = 0; i < atom->nlocal + atom->nghost; i++) {
      const int itype = atom->type[i];
      if (!materials[itype]) continue;
      const HVI::SphStress &s = stress[i];
      const HVI::Deviator T = HVI::tensile_part(state[i].p, {s.xx, s.yy, s.zz, s.xy, s.xz, s.yz});
      double f = 0.0;
      if (T.xx + T.yy + T.zz > 0.0) {
        const double V = (rmass ? rmass[i] : atom->mass[itype]) / materials[itype]->eos->rho0();
        const double dp = laws.dim == 3 ? std::cbrt(V) : (laws.dim == 2 ? std::sqrt(V) : V);
        const double w = decltype(k)::template w<double>(dp / htype[itype]);
        if (!(w > 0.0))
          error->one(FLERR,
                     "Pair hvi/sph artstress: the spacing {} of type {} is beyond the reach of its "
                     "h {}",
                     dp, itype, htype[itype]);
        f = -laws.art_eps / std::pow(w, laws.art_n);
      }
      art[i] = {f * T.xx, f * T.yy, f * T.zz, f * T.xy, f * T.xz, f * T.yz, 0.0, 0.0};
    }
  });
}

// L M^-1 is exact in a linear field.  The law sees it, forces do not.  Where neighbors lie in
// a plane or are few, M cannot be inverted and the plain one stays.

HVI::VelocityGradient PairHVISPH::velocity_gradient(int i) const
{
  const HVI::SphGradV &L = gradv[i];
  HVI::VelocityGradient g = {L.xx, L.xy, L.xz, L.yx, L.yy, L.yz, L.zx, L.zy, L.zz};
  if (!corrected) return g;
  const double xx = L.mxx, yy = laws.dim > 1 ? L.myy : 1.0, zz = laws.dim > 2 ? L.mzz : 1.0;
  const double xy = L.mxy, xz = L.mxz, yz = L.myz;
  const double cxx = yy * zz - yz * yz, cxy = xz * yz - xy * zz, cxz = xy * yz - xz * yy;
  const double cyy = xx * zz - xz * xz, cyz = xy * xz - xx * yz, czz = xx * yy - xy * xy;
  const double det = xx * cxx + xy * cxy + xz * cxz;
  if (!(det > 0.05)) return g;
  const auto correct = [&](double &x, double &y, double &z) {
    const double gx = x / det, gy = y / det, gz = z / det;
    x = gx * cxx + gy * cxy + gz * cxz;
    y = gx * cxy + gy * cyy + gz * cyz;
    z = gx * cxz + gy * cyz + gz * czz;
  };
  correct(g.xx, g.xy, g.xz);
  correct(g.yx, g.yy, g.yz);
  correct(g.zx, g.zy, g.zz);
  return g;
}

/* ---------------------------------------------------------------------- */

// one of two kinds of records, all numbers of theirs that others need

template <class Record>
static int pack(const Record *records, const int *list, int n, int first, int size, double *buf)
{
  for (int k = 0; k < n; k++)
    memcpy(buf + k * size, &records[list ? list[k] : first + k], size * sizeof(double));
  return n * size;
}

int PairHVISPH::pack_forward_comm(int n, int *sent, double *buf, int /*pbc_flag*/, int * /*pbc*/)
{
  if (sending == SLOPES) return pack(slopes.get(), sent, n, 0, HVI::SphSlopes::SENT, buf);
  return pack(stress.get(), sent, n, 0, HVI::SphStress::SENT, buf);
}

void PairHVISPH::unpack_forward_comm(int n, int first, double *buf)
{
  for (int k = 0; k < n; k++)
    if (sending == SLOPES)
      memcpy((void *) &slopes[first + k], buf + k * HVI::SphSlopes::SENT,
             HVI::SphSlopes::SENT * sizeof(double));
    else
      memcpy((void *) &stress[first + k], buf + k * HVI::SphStress::SENT,
             HVI::SphStress::SENT * sizeof(double));
}

int PairHVISPH::pack_reverse_comm(int n, int first, double *buf)
{
  if (sending == SLOPES) return pack(slopes.get(), nullptr, n, first, HVI::SphSlopes::SENT, buf);
  return pack(gradv.get(), nullptr, n, first, HVI::SphGradV::SENT, buf);
}

void PairHVISPH::unpack_reverse_comm(int n, int *owned, double *buf)
{
  const int size = sending == SLOPES ? HVI::SphSlopes::SENT : HVI::SphGradV::SENT;
  for (int k = 0; k < n; k++) {
    double *const to = sending == SLOPES ? &slopes[owned[k]].xx : &gradv[owned[k]].xx;
    for (int l = 0; l < size; l++) to[l] += buf[k * size + l];
  }
}

/* ---------------------------------------------------------------------- */

void PairHVISPH::scatter()
{
  double *const *const f = atom->f;
  double *const drho = atom->drho;
  double *const desph = atom->desph;
  const int n = atom->nlocal + (force->newton_pair ? atom->nghost : 0);

  heating = 0.0;
  for (int i = 0; i < n; i++) {
    f[i][0] += rates[i].fx;
    f[i][1] += rates[i].fy;
    f[i][2] += rates[i].fz;
    drho[i] += rates[i].drho;
    if (!energy) continue;
    desph[i] += rates[i].de;
    heating += rates[i].heat;
  }
}

/* ----------------------------------------------------------------------
   shortest h/(c + approach + viscosity): Monaghan 1992 eq 4.5 with the speed at
   which the pair approaches in place of |v|, which depends on the frame.  h is
   taken as half of what the kernel reaches, for all kernels alike.
------------------------------------------------------------------------- */

void PairHVISPH::tighten(HVI::TimeStepBounds &bounds)
{
  const double scale = 0.5 * support;
  double shortest = bounds.signal;

  for (int i = 0; i < atom->nlocal; i++)
    if (materials[atom->type[i]] && !(scale * place[i].h >= shortest * state[i].c))
      shortest = scale * place[i].h / state[i].c;

  for (int ii = 0; ii < list->inum; ii++) {
    const int i = list->ilist[ii];
    const HVI::SphPlace &pi = place[i];
    const HVI::SphState &si = state[i];
    const double *const row_a = visc_a[atom->type[i]];
    const double *const row_b = visc_b[atom->type[i]];
    const int *const jlist = list->firstneigh[i];
    const int jnum = list->numneigh[i];
    const int nimages = mirror.planes ? images_near(i, jlist, jnum).size() : 0;

    for (int jj = 0; jj < jnum + nimages; jj++) {
      const int j = jj < jnum ? jlist[jj] & NEIGHMASK : nearby[jj - jnum];
      const HVI::SphPlace &pj = place[j];
      const HVI::SphState &sj = state[j];
      const double dx = pi.x - pj.x;
      const double dy = pi.y - pj.y;
      const double dz = pi.z - pj.z;
      const double rdotv = dx * (si.vx - sj.vx) + dy * (si.vy - sj.vy) + dz * (si.vz - sj.vz);
      if (rdotv >= 0.0) continue;

      // also pairs that are not yet within reach: they will be soon

      const double rsq = dx * dx + dy * dy + dz * dz;
      if (jj >= jnum && rsq > images.reachsq) continue;
      const double h = 0.5 * (pi.h + pj.h);
      const double c = MAX(si.c, sj.c);
      const double mu = -h * rdotv / (rsq + 0.01 * h * h);
      const int jtype = static_cast<int>(sj.type);
      const double signal =
          c - rdotv / std::sqrt(rsq) + 0.6 * (row_a[jtype] * c + row_b[jtype] * mu);
      if (scale * h < shortest * signal || std::isnan(signal)) shortest = scale * h / signal;
    }
  }
  bounds.signal = shortest;
}
