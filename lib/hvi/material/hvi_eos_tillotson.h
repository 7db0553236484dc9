/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_EOS_TILLOTSON_H
#define LMP_HVI_EOS_TILLOTSON_H

#include "hvi_eos_thermal.h"
#include "hvi_parameter.h"

namespace HVI {

/* ----------------------------------------------------------------------
   Tillotson, from compressed metal to its vapor.  x = rho/rho0, mu = x - 1,
   z = 1/x - 1, omega = 1 + e/(E0 x^2):

     p1 = (a + b/omega) rho e + A mu + B mu^2
     p2 = a rho e + [b rho e/omega + A mu exp(-beta z)] exp(-alpha z^2)

     compressed, or cold and expanded   rho >= rho0 or e <= Eiv    p1
     vapor                              rho < rho0 and e >= Ecv    p2
     in between                         rho < rho0
                          [(e - Eiv) p2 + (Ecv - e) p1]/(Ecv - Eiv)

   Tillotson, GA-3216, General Atomic (1962); Melosh, Impact Cratering (1989),
   appendix II; Brundage, Procedia Eng. 58 (2013) 461.  p is continuous
   everywhere, so is c at rho0; at Eiv and Ecv dp/de jumps, and c with it.

   omega has a zero at negative e, close to e = 0 where x is small, and there
   one comes by a round-off of e.  omega is 1 for e < 0: p keeps its slope at
   e = 0.  There is no cutoff of tension at low density: the other laws have
   none, and it is the spall limit that says what a material bears.
------------------------------------------------------------------------- */

struct EosTillotson {
  static constexpr const char *name = "tillotson";
  static constexpr int nargs = 11;
  static constexpr Parameter params[] = {
      {"rho0", DENSITY, POSITIVE, REQUIRED},
      {"a", NUMBER, NOT_NEGATIVE, REQUIRED},
      {"b", NUMBER, NOT_NEGATIVE, REQUIRED},
      {"A", PRESSURE, POSITIVE, REQUIRED},
      {"B", PRESSURE, NOT_NEGATIVE, REQUIRED},
      {"E0", SPECIFIC_ENERGY, POSITIVE, REQUIRED},
      {"Eiv", SPECIFIC_ENERGY, NOT_NEGATIVE, REQUIRED},
      {"Ecv", SPECIFIC_ENERGY, POSITIVE, REQUIRED},
      {"alpha", NUMBER, POSITIVE, 5.0},
      {"beta", NUMBER, POSITIVE, 5.0},
      {"cp", HEAT_CAPACITY, NOT_NEGATIVE, 0.0},    // 0: no temperature
      {"T0", TEMPERATURE, POSITIVE, 300.0},
  };

  double rho0, a, b, A, B, E0, Eiv, Ecv, alpha, beta, cp, T0, c0, rho_max;
  ThermalTable thermal;
  double last_e, last_T;    // of the isentrope where the table of temperatures ends

  // of parameters that are right one by one

  static std::string problem(const double *v)
  {
    char text[120];
    std::snprintf(text, sizeof(text), "Ecv = %g must be > Eiv = %g", v[7], v[6]);
    return v[7] > v[6] ? "" : text;
  }

  static EosTillotson make(const double *v)
  {
    EosTillotson law = {v[0], v[1],  v[2],  v[3], v[4],     v[5], v[6], v[7], v[8],
                        v[9], v[10], v[11], 0.0,  NO_LIMIT, {},   0.0,  0.0};
    law.c0 = std::sqrt(law.A / law.rho0);
    law.fill();
    return law;
  }

  // p, dp/drho and dp/de

  struct Surface {
    double p, by_rho, by_e;
  };

  Surface surface(double rho, double e) const
  {
    const double x = rho / rho0, mu = (rho - rho0) / rho0;
    const double scale = E0 * x * x;
    const double w = e > 0.0 ? scale / (scale + e) : 1.0;    // 1/omega
    const Surface gas = {a * rho * e, a * e, a * rho};
    const Surface heat = {b * w * rho * e, b * w * e * (3.0 - 2.0 * w), b * w * w * rho};

    const Surface dense = {gas.p + heat.p + mu * (A + B * mu),
                           gas.by_rho + heat.by_rho + (A + 2.0 * B * mu) / rho0,
                           gas.by_e + heat.by_e};
    if (rho >= rho0 || e <= Eiv) return dense;

    Surface vapor = gas;
    const double z = rho0 / rho - 1.0, f = std::exp(-alpha * z * z);
    if (f > 0.0) {
      const double cold = A * mu * std::exp(-beta * z);
      vapor.p += f * (heat.p + cold);
      vapor.by_e += f * heat.by_e;
      vapor.by_rho += f *
          (heat.by_rho + A / rho0 * std::exp(-beta * z) +
           (1.0 + z) / rho * (2.0 * alpha * z * (heat.p + cold) + beta * cold));
    }
    if (e >= Ecv) return vapor;

    const double d = 1.0 / (Ecv - Eiv), t = (e - Eiv) * d, s = (Ecv - e) * d;
    return {s * dense.p + t * vapor.p, s * dense.by_rho + t * vapor.by_rho,
            s * dense.by_e + t * vapor.by_e + (vapor.p - dense.p) * d};
  }

  void state(double rho, double e, double &p, double &csq) const
  {
    const Surface s = surface(rho, e);
    p = s.p;
    csq = s.by_rho + s.p / rho / rho * s.by_e;
  }

  /* ----------------------------------------------------------------------
     As in hvi_eos_thermal.h, T = T_s + (e - e_s)/cp, but here p is not linear
     in e, so e_s and T_s of the isentrope through the reference state are
     integrated side by side: de = p/rho0 deta, dT = (dp/de)/rho0 T deta.
     Off that isentrope it is an estimate: no heat capacity that is constant
     agrees with this p in the strict sense.
  ------------------------------------------------------------------------- */

  struct Isentrope {
    double e, T;
  };

  Isentrope slope(double eta, const Isentrope &s, double d, const Isentrope &k) const
  {
    const double T = s.T + d * k.T;
    const Surface at = surface(rho0 / (1.0 - eta - d), s.e + d * k.e);
    return {at.p / rho0, at.by_e / rho0 * T};
  }

  // Runge-Kutta of fourth order, n steps

  Isentrope integrate(double eta, Isentrope s, double end, int n) const
  {
    const double d = (end - eta) / n;
    for (int i = 0; i < n; i++, eta += d) {
      const Isentrope k1 = slope(eta, s, 0.0, {0.0, 0.0}), k2 = slope(eta, s, 0.5 * d, k1),
                      k3 = slope(eta, s, 0.5 * d, k2), k4 = slope(eta, s, d, k3);
      s.e += d / 6.0 * (k1.e + 2.0 * (k2.e + k3.e) + k4.e);
      s.T += d / 6.0 * (k1.T + 2.0 * (k2.T + k3.T) + k4.T);
    }
    return s;
  }

  // to a density of 3.3 rho0

  void fill()
  {
    if (cp <= 0.0) return;
    static constexpr int N = ThermalTable::N;
    thermal.spacing = 0.7 / N;
    Isentrope s = {0.0, T0};
    for (int i = 0; i <= N; i++) {
      if (i) s = integrate((i - 1) * thermal.spacing, s, i * thermal.spacing, 8);
      const Isentrope k = slope(i * thermal.spacing, s, 0.0, {0.0, 0.0});
      thermal.tau[i] = s.T - s.e / cp;
      thermal.slope[i] = (k.T - k.e / cp) * thermal.spacing;
    }
    last_e = s.e;
    last_T = s.T;
  }

  double temperature(double rho, double e) const
  {
    if (cp <= 0.0) return std::numeric_limits<double>::quiet_NaN();
    static constexpr int N = ThermalTable::N;
    const double x = (1.0 - rho0 / rho) / thermal.spacing;
    double tau = T0;
    if (x >= N) {
      const Isentrope s = integrate(N * thermal.spacing, {last_e, last_T}, x * thermal.spacing, 64);
      tau = s.T - s.e / cp;
    } else if (x > 0.0)
      tau = thermal.interpolate(x);
    return std::max(tau + e / cp, 0.0);
  }
};

}    // namespace HVI

#endif
