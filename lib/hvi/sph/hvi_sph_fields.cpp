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

void SphFields::choose(int wanted)
{
  if (wanted == terms) return;
  terms = wanted;
  nmax = -1;    // what was there goes
  grow(0);
}

// calls each(name, array, whether the scene has it)

template <class Each> void SphFields::each_array(const Each &each)
{
  const bool solid = terms & SPH_SOLID;
  each("place", place, records.place, true);
  each("state", state, records.state, true);
  each("rates", rates, records.rates, true);
  each("slopes", slopes, records.slopes, (terms & SPH_RIEMANN) && !solid);
  each("gradv", gradv, records.gradv, solid);
  each("art", art, records.art, solid && (terms & SPH_ARTSTRESS));
  each("traction", traction, records.traction, solid);
}

bool SphFields::grow(int n, int spare)
{
  if (n <= nmax) return false;
  nmax = n > 0 ? n + spare : 0;
  each_array([this](const char *, auto &array, auto *&view, bool wanted) {
    using Record = typename std::remove_reference_t<decltype(array)>::element_type;
    array.reset(wanted && nmax ? new Record[nmax] : nullptr);
    view = array.get();
  });
  records.touching = (terms & SPH_SOLID) && (terms & SPH_BODIES) ? &touching : nullptr;
  return true;
}

double SphFields::bytes_per_particle()
{
  std::size_t bytes = 0;
  each_array([&](const char *, auto &, auto *record, bool wanted) {
    if (wanted) bytes += sizeof(*record);
  });
  return records.touching ? bytes + SphTouching::BYTES : bytes;
}

std::string SphFields::arrays()
{
  std::string text;
  each_array([&](const char *name, auto &, auto *record, bool wanted) {
    if (wanted)
      text +=
          (text.empty() ? "" : ", ") + std::string(name) + " " + std::to_string(sizeof(*record));
  });
  if (records.touching) text += ", touching " + std::to_string(SphTouching::BYTES);
  return text;
}

/* ---------------------------------------------------------------------- */

double SphFields::pressure(int i) const
{
  return traction ? traction[i].p : state[i].p;
}

}    // namespace HVI
