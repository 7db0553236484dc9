/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_DAMAGE_H
#define LMP_HVI_DAMAGE_H

#include "hvi_parameter.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace HVI {

/* ----------------------------------------------------------------------
   Damage of a solid: grows from 0 with plastic strain; at 1 it has failed, or begins to.

   A law is a plain struct in a header of its own, an entry in the list of hvi_laws.cpp, and has
     name
     params[]                     its table of parameters
     problem(const double *)      if it has any: what is wrong with values that are right one by one
     make(const double *)         from values in the order of params
     increment(...)               as below
     u_f                          a number: see displacement(); 0 if it fails at once
------------------------------------------------------------------------- */

class Damage {
 public:
  virtual ~Damage() = default;
  virtual const char *name() const = 0;

  // dD of a step dt with the plastic strain d_eps; p and von Mises's stress vm are those at its end,
  // tstar is the law of strength's.  scatter multiplies the strain at failure.

  virtual double increment(double d_eps, double dt, double p, double vm, double tstar,
                           double scatter) const = 0;

  // from D = 1 on, the plastic displacement after which it has failed; 0: it has at once

  virtual double displacement() const = 0;
};

template <class Law> class DamageModel final : public Damage {
 public:
  explicit DamageModel(const Law &law) : law(law) {}

  const char *name() const override { return law.name; }

  double increment(double d_eps, double dt, double p, double vm, double tstar,
                   double scatter) const override
  {
    return law.increment(d_eps, dt, p, vm, tstar, scatter);
  }

  double displacement() const override { return law.u_f; }

 private:
  Law law;
};

// mean stress, positive in tension, over von Mises's; held within +-10, and 0 without stress

inline double triaxiality(double p, double vm)
{
  if (p == 0.0) return 0.0;
  return std::max(std::min(-p / vm, 10.0), -10.0);
}

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

// The weakest of the parts of a volume V0 decides when it breaks: that has the mean 1, whatever the parts,
// if the thresholds of parts V = size^dim are multiplied by (V/V0)^(-1/modulus) too (Weibull, J. Appl.
// Mech. 18 (1951) 293)

inline double size_factor(double size, double reference, int dim, double modulus)
{
  return std::pow(size / reference, -dim / modulus);
}

}    // namespace HVI

#endif
