/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_DAMAGE_H
#define LMP_HVI_DAMAGE_H

#include "hvi_damage_johnson_cook.h"
#include "hvi_spall.h"

#include <cmath>
#include <cstdint>

namespace HVI {

/* ----------------------------------------------------------------------
   Scatter of a threshold from particle to particle: a factor with Weibull's
   distribution of the given modulus and the mean 1,

     (-ln u)^(1/modulus)/Gamma(1 + 1/modulus),

   u in (0, 1) from a hash of seed and ID (the finalizer of SplitMix64,
   Steele, Lea & Flood, OOPSLA 2014), so that it does not depend on ranks, order
   or time.  An infinite modulus: no scatter.
------------------------------------------------------------------------- */

inline std::uint64_t hash64(std::uint64_t x)
{
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

inline double weibull_factor(std::uint64_t seed, std::int64_t tag, double modulus)
{
  const std::uint64_t h = hash64(hash64(seed) ^ std::uint64_t(tag));
  const double u = (double(h >> 12) + 0.5) * 0x1p-52;
  return std::pow(-std::log(u), 1.0 / modulus) / std::tgamma(1.0 + 1.0 / modulus);
}

}    // namespace HVI

#endif
