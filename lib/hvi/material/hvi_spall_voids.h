/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_SPALL_VOIDS_H
#define LMP_HVI_SPALL_VOIDS_H

#include "hvi_eos.h"

#include <algorithm>
#include <cmath>

namespace HVI {

/* ----------------------------------------------------------------------
   Spall that takes time: voids grow under tension.  phi is their part of the volume, so the matter
   around them has the density rho/(1 - phi), and of its pressure the part 1 - phi acts:

     p = (1 - phi) p_eos(rho/(1 - phi), e)                                       (1)
     phi'/(1 - phi) = rate [-p/(sigma (1 - D))]^(1/m)      while p < 0           (2)
     D' = phi'/phi_c                                       while phi grows       (3)

   (1) is that of Carroll & Holt, J. Appl. Phys. 43 (1972) 759; (2) is Norton's power law of creep
   with the strength sigma (1 - D), chosen so that what is stretched at a constant rate epsdot holds
   out up to about sigma (epsdot/rate)^m, as spall strengths are measured and published, and then takes
   up energy of the order of sigma phi_c/2 per volume until it has failed, D = 1.  Voids are pressed
   shut without resistance; damage by them stays.

   A step goes from phi to the phi of its end, with the tension of its end in (2): stable at any
   dt, of first order in it.
------------------------------------------------------------------------- */

struct SpallVoids {
  static constexpr const char *name = "voids";
  static constexpr Range PART = {0.0, 1.0, true};
  static constexpr Parameter params[] = {{"sigma", PRESSURE, POSITIVE, REQUIRED},
                                         {"rate", RATE, POSITIVE, REQUIRED},
                                         {"m", NUMBER, PART, REQUIRED},
                                         {"phi_c", NUMBER, PART, REQUIRED},
                                         {"delta_c", LENGTH, NOT_NEGATIVE, 0.0}};

  double sigma, rate, m, phi_c;
  double delta_c;    // opening at failure, 0: phi_c of any size

  static SpallVoids make(const double *v) { return {v[0], v[1], v[2], v[3], v[4]}; }

  struct State {
    double phi, D;
    double work;    // of opening voids, per mass: -p phi'/(1 - phi)/rho
  };

  // of something that size: an opening delta_c at most

  double critical(double size) const
  {
    return delta_c > 0.0 && delta_c < phi_c * size ? delta_c / size : phi_c;
  }

  /* ----------------------------------------------------------------------
     Growth of -ln(1 - phi) in dt, if it takes K times as much from the tension.  With y the
     tension of the end over s, c = K dt rate/s, that is y + c y^(1/m) = x: convex, so Halley's steps from
     above get there, and leave of the order of their cube.
  ------------------------------------------------------------------------- */

  double growth(double tension, double K, double D, double dt) const
  {
    const double upper = grown(tension, D, dt);
    if (!(K > 0.0) || !(upper > NOTHING)) return 0.0;
    const double s = strength(D), x = tension / s, n = 1.0 / m, c = K * dt * rate / s;
    double y = x, f = upper * K / s;
    if (!(f < x)) {
      y = std::pow(x / c, m);
      f = x;
    }
    for (int k = 0; k < 100; k++) {
      const double rest = y + f - x, slope = y + n * f;
      const double step = rest * slope * y / (slope * slope - 0.5 * n * (n - 1.0) * f * rest);
      y -= step;
      f = c * power(y, n);
      if (!(n * std::fabs(step) > 1e-3 * y)) break;
    }
    return f * s / K;
  }

  // A step to the density rho and the energy e, of something that size.  Returns the least pressure
  // after it, see least(), if it has voids.

  double advance(State &v, const Eos &eos, double rho, double e, double size, double dt) const
  {
    double p, csq;
    if (!eos.evaluate(rho / (1.0 - v.phi), e, p, csq) || p >= 0.0) {
      if (!(v.phi > 0.0)) return -NO_LIMIT;
      close(v, eos, rho, e);
      return least(v.phi, eos, rho, e);
    }

    // Tension is nearly, not quite linear in what is grown.  K is that of the chord: at first by
    // d tension/dg = -rho csq - (1 + gamma) tension, with gamma 2, or as if none is left at rho0.
    // Where the equation of state is far from that, between lo and hi.

    const double before = 1.0 - v.phi, tension = -before * p, full = eos.rho0() * before / rho;
    double K = std::max(rho * csq + 3.0 * tension, full > 1.0 ? tension / (1.0 - 1.0 / full) : 0.0);
    double g = growth(tension, K, v.D, dt), now = tension, left = before;
    if (g == 0.0) return std::min(-tension, NO_TENSION);
    double lo = 0.0, hi = full > 1.0 ? 1.0 + std::log(full) : 1.0;
    for (int k = 0; k < 200; k++) {
      const bool chord = (k % 4 < 3) && (g > lo) && (g < hi);
      if (!chord) g = 0.5 * (lo + hi);
      left = before * std::exp(-g);
      now = eos.evaluate(rho / left, e, p, csq) ? -left * p : -tension;
      const double off = std::fabs(now - (tension - K * g));
      if (chord && off <= std::max(std::min(0.01 * (tension - now), 3e-5 * now), 1e-10 * tension))
        break;    // the step's own error is half of what the tension loses in it
      if (hi - lo <= 1e-14 * hi) break;
      (grown(now, v.D, dt) > g ? lo : hi) = g;
      K = now < tension ? (tension - now) / g : 2.0 * K;
      g = growth(tension, K, v.D, dt);
    }
    v.D += (before - left) / critical(size);
    v.phi = 1.0 - left;
    v.work += std::max(now, 0.0) * g / rho;
    return std::min(-now, NO_TENSION);
  }

  // the least pressure of what has voids: a little less than 0, which is that of rubble

  static double least(double phi, const Eos &eos, double rho, double e)
  {
    double p, csq;
    if (!eos.evaluate(rho / (1.0 - phi), e, p, csq)) return -NO_LIMIT;
    return std::min((1.0 - phi) * p, NO_TENSION);
  }

 private:
  static constexpr double NOTHING = 1e-13;         // of a volume, in a step
  static constexpr double NO_TENSION = -1e-300;    // but not that of rubble

  double strength(double D) const { return sigma * std::max(1.0 - D, 1e-6); }

  // (2) under a constant tension

  double grown(double tension, double D, double dt) const
  {
    return tension > 0.0 ? dt * rate * power(tension / strength(D), 1.0 / m) : 0.0;
  }

  // of whole numbers by multiplication

  static double power(double y, double n)
  {
    if (n > 128.0 || n != std::floor(n)) return std::pow(y, n);
    double result = 1.0;
    for (int k = n; k; k >>= 1, y *= y)
      if (k & 1) result *= y;
    return result;
  }

  // until there is no pressure, or no void

  static void close(State &v, const Eos &eos, double rho, double e)
  {
    double p, csq, lo = rho, hi = rho / (1.0 - v.phi);
    if (!eos.evaluate(lo, e, p, csq)) return;
    if (p >= 0.0) {
      v.phi = 0.0;
      return;
    }
    double solid = lo;
    for (int k = 0; k < 100; k++) {
      const double next = solid - p / csq;
      solid = next > lo && next < hi ? next : 0.5 * (lo + hi);
      if (!eos.evaluate(solid, e, p, csq)) p = NO_LIMIT;
      (p < 0.0 ? lo : hi) = solid;
      if (std::fabs(p) <= 1e-14 * solid * csq || hi - lo <= 1e-15 * hi) break;
    }
    v.phi = std::min(v.phi, 1.0 - rho / solid);
  }
};

}    // namespace HVI

#endif
