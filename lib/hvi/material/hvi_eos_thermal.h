/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_EOS_THERMAL_H
#define LMP_HVI_EOS_THERMAL_H

#include <algorithm>
#include <cmath>
#include <limits>

namespace HVI {

/* ----------------------------------------------------------------------
   Temperature of a solid of constant heat capacity cp with the pressure

     p = p0(eta) + rho0 g(eta) e,   eta = 1 - rho0/rho

   On the isentrope through the reference state (eta = 0, e = 0, T = T0)
   de = p/rho0 deta and dT = g T deta, and off it T - T_s = (e - e_s)/cp:

     T = tau(eta) + e/cp,   tau = T_s - e_s/cp,
     dtau/deta = g tau - p0/(rho0 cp),   tau(0) = T0

   Compressing a solid stores energy without heating it much, so T0 + e/cp
   would be far too hot.  In expansion nothing is stored,
     T = T0 + e/cp   for rho < rho0:
   there the law describes tension, which debris does not hold.

   tau is tabulated once and interpolated by cubics (Hermite's).  The law
   gives p0(eta) and g(eta), eta >= 0, and rho0, cp, T0, rho_max.
------------------------------------------------------------------------- */

struct ThermalTable {
  static constexpr int N = 128;
  double spacing;
  double tau[N + 1], slope[N + 1];    // slope times spacing

  template <class Law> static double derivative(const Law &law, double eta, double tau)
  {
    return law.g(eta) * tau - law.p0(eta) / (law.rho0 * law.cp);
  }

  // Runge-Kutta of fourth order, n steps

  template <class Law>
  static double integrate(const Law &law, double eta, double tau, double end, int n)
  {
    const double d = (end - eta) / n;
    for (int i = 0; i < n; i++, eta += d) {
      const double k1 = derivative(law, eta, tau);
      const double k2 = derivative(law, eta + 0.5 * d, tau + 0.5 * d * k1);
      const double k3 = derivative(law, eta + 0.5 * d, tau + 0.5 * d * k2);
      const double k4 = derivative(law, eta + d, tau + d * k3);
      tau += d / 6.0 * (k1 + 2.0 * (k2 + k3) + k4);
    }
    return tau;
  }

  // to 9/10 of the way to the pole of the Hugoniot, or to a density of 3.3 rho0

  template <class Law> void fill(const Law &law)
  {
    if (law.cp <= 0.0) return;
    spacing = std::min(0.9 * (1.0 - law.rho0 / law.rho_max), 0.7) / N;
    tau[0] = law.T0;
    for (int i = 0; i <= N; i++) {
      if (i) tau[i] = integrate(law, (i - 1) * spacing, tau[i - 1], i * spacing, 8);
      slope[i] = derivative(law, i * spacing, tau[i]) * spacing;
    }
  }

  // tau, with x = eta/spacing in [0, N)

  double interpolate(double x) const
  {
    const int i = (int) x;
    const double s = x - i, r = 1.0 - s;
    return r * r * ((1.0 + 2.0 * s) * tau[i] + s * slope[i]) +
        s * s * ((1.0 + 2.0 * r) * tau[i + 1] - r * slope[i + 1]);
  }

  template <class Law> double temperature(const Law &law, double rho, double e) const
  {
    if (law.cp <= 0.0) return std::numeric_limits<double>::quiet_NaN();
    const double x = (1.0 - law.rho0 / rho) / spacing;
    double t = law.T0;
    if (x >= N)
      t = integrate(law, N * spacing, tau[N], x * spacing, 64);
    else if (x > 0.0)
      t = interpolate(x);
    return std::max(t + e / law.cp, 0.0);
  }
};

}    // namespace HVI

#endif
