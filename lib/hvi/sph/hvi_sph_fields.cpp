/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing authors: the lammps-hvi developers
------------------------------------------------------------------------- */

#include "hvi_sph_fields.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace HVI {

double SphSettings::hscale(int itype, double rho) const
{
  return h[itype] * std::pow(rho, 1.0 / laws.dim);
}

double SphSettings::smoothing_length(int itype, double rho, double scale) const
{
  if (!variable) return h[itype];
  const double root = laws.dim == 3 ? std::cbrt(rho) : (laws.dim == 2 ? std::sqrt(rho) : rho);
  return std::max(hmin * h[itype], std::min(scale / root, hmax * h[itype]));
}

/* ---------------------------------------------------------------------- */

void SphFields::choose(bool slopes_in, bool stress_in, bool art_in, bool whole_in, bool bodies_in)
{
  if (slopes_in == has_slopes && stress_in == has_stress && art_in == has_art &&
      whole_in == has_whole && bodies_in == has_bodies)
    return;
  has_slopes = slopes_in;
  has_stress = stress_in;
  has_art = art_in;
  has_whole = whole_in;
  has_bodies = bodies_in;
  nmax = -1;    // what was there goes
  grow(0);
}

void SphFields::grow(int n, int spare)
{
  if (n <= nmax) return;
  nmax = n > 0 ? n + spare : 0;
  const auto made = [this](auto &records, bool wanted) {
    using Record = typename std::remove_reference_t<decltype(records)>::element_type;
    records.reset(wanted && nmax ? new Record[nmax] : nullptr);
    return records.get();
  };
  records.place = made(place, true);
  records.state = made(state, true);
  records.rates = made(rates, true);
  records.slopes = made(slopes, has_slopes);
  records.stress = made(stress, has_stress);
  records.gradv = made(gradv, has_stress);
  records.art = made(art, has_art);
  records.traction = made(traction, has_whole);
  records.contact = made(contact, has_whole && has_bodies);
  records.push = made(push, has_whole && has_bodies);
}

double SphFields::bytes_per_particle() const
{
  return sizeof(SphPlace) + sizeof(SphState) + sizeof(SphRates) +
      (has_slopes ? sizeof(SphSlopes) : 0) +
      (has_stress ? sizeof(SphStress) + sizeof(SphGradV) : 0) + (has_art ? sizeof(SphStress) : 0) +
      (has_whole ? sizeof(SphTraction) : 0) +
      (has_whole && has_bodies ? sizeof(SphGradV) + sizeof(SphPush) : 0);
}

std::string SphFields::arrays() const
{
  std::string text;
  const auto add = [&](const char *name, std::size_t bytes, bool there) {
    if (there) text += (text.empty() ? "" : ", ") + std::string(name) + " " + std::to_string(bytes);
  };
  add("place", sizeof(SphPlace), true);
  add("state", sizeof(SphState), true);
  add("rates", sizeof(SphRates), true);
  add("slopes", sizeof(SphSlopes), has_slopes);
  add("stress", sizeof(SphStress), has_stress);
  add("gradv", sizeof(SphGradV), has_stress);
  add("art", sizeof(SphStress), has_art);
  add("traction", sizeof(SphTraction), has_whole);
  add("contact", sizeof(SphGradV), has_whole && has_bodies);
  add("push", sizeof(SphPush), has_whole && has_bodies);
  return text;
}

/* ---------------------------------------------------------------------- */

double SphFields::pressure(int i) const
{
  return traction ? traction[i].p : state[i].p;
}

// L M^-1 is exact in a linear field.  The law sees it, forces do not.  Where neighbors lie in a
// plane or are few, M cannot be inverted and the plain one stays.  Directions that
// the scene does not have count as complete.

VelocityGradient SphFields::velocity_gradient(int i) const
{
  const SphGradV &L = gradv[i];
  VelocityGradient g = {L.xx, L.xy, L.xz, L.yx, L.yy, L.yz, L.zx, L.zy, L.zz};
  if (settings.gradient != SphSettings::LAW) return g;
  const double xx = along[0] ? L.mxx : 1.0, yy = along[1] ? L.myy : 1.0,
               zz = along[2] ? L.mzz : 1.0;
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

}    // namespace HVI
