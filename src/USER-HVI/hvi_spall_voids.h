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
     tension of the end over s, c = K dt rate/s, that is y + c y^(1/m) = x: convex, so Newton's steps from
     above stay above.
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
      const double step = (y + f - x) / (1.0 + n * f / y);
      y -= step;
      f = c * std::pow(y, n);
      if (!(step > 1e-9 * y)) break;
    }
    return f * s / K;
  }

  // a step to the density rho and the energy e, of something that size

  void advance(State &v, const Eos &eos, double rho, double e, double size, double dt) const
  {
    double p, csq;
    if (!eos.evaluate(rho / (1.0 - v.phi), e, p, csq) || p >= 0.0) {
      if (v.phi > 0.0) close(v, eos, rho, e);
      return;
    }

    // Tension is nearly, not quite linear in what is grown: K is that of the chord.  At rho0 none is
    // left, or little.  Where the equation of state is far from that, between lo and hi.

    const double before = 1.0 - v.phi, tension = -before * p;
    const double apart = std::log(eos.rho0() * before / rho);
    double K = apart > 0.0 ? std::max(rho * csq, tension / apart) : rho * csq;
    double g = growth(tension, K, v.D, dt), now = tension, left = before;
    if (g == 0.0) return;
    double lo = 0.0, hi = 1.0 + std::max(apart, 0.0);
    for (int k = 0; k < 200; k++) {
      const bool chord = k % 4 < 3 && g > lo && g < hi;
      if (!chord) g = 0.5 * (lo + hi);
      left = before * std::exp(-g);
      now = eos.evaluate(rho / left, e, p, csq) ? -left * p : -tension;
      if (chord && std::fabs(now - (tension - K * g)) <= 1e-10 * tension) break;
      if (hi - lo <= 1e-14 * hi) break;
      (grown(now, v.D, dt) > g ? lo : hi) = g;
      K = now < tension ? (tension - now) / g : 2.0 * K;
      g = growth(tension, K, v.D, dt);
    }
    g = std::log(before / left);
    v.D += (before - left) / critical(size);
    v.phi = 1.0 - left;
    v.work += std::max(now, 0.0) * g / rho;
  }

  // the least pressure of what has voids: a little less than 0, which is that of rubble

  static double least(double phi, const Eos &eos, double rho, double e)
  {
    double p, csq;
    if (!eos.evaluate(rho / (1.0 - phi), e, p, csq)) return -NO_LIMIT;
    return std::min((1.0 - phi) * p, -1e-300);
  }

 private:
  static constexpr double NOTHING = 1e-13;    // of a volume, in a step

  double strength(double D) const { return sigma * std::max(1.0 - D, 1e-6); }

  // (2) under a constant tension

  double grown(double tension, double D, double dt) const
  {
    return tension > 0.0 ? dt * rate * std::pow(tension / strength(D), 1.0 / m) : 0.0;
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
