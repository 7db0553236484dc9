/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_STRENGTH_JOHNSON_COOK_H
#define LMP_HVI_STRENGTH_JOHNSON_COOK_H

#include "hvi_strength.h"
#include "hvi_vector_math.h"

namespace HVI {

/* ----------------------------------------------------------------------
   Johnson & Cook, Proc. 7th Int. Symp. Ballistics (1983) 541

     Y = (A + B eps^n) (1 + C ln(epsdot/epsdot0)) (1 - T*^m)
     T* = (T - Tref)/(Tm - Tref) in [0, 1]

   G is constant below Tm.  The factor of the rate is not below 1.  With D it has one term more, that of Cowper &
   Symonds, Brown University, Technical Report 28 (1957), for rates at which dislocations are dragged:

     1 + C ln(epsdot/epsdot0) + (epsdot/D)^(1/p)
------------------------------------------------------------------------- */

struct StrengthJohnsonCook {
  static constexpr const char *name = "johnson-cook";
  static constexpr Parameter params[] = {
      {"G", PRESSURE, POSITIVE, REQUIRED},
      {"A", PRESSURE, POSITIVE, REQUIRED},
      {"B", PRESSURE, NOT_NEGATIVE, REQUIRED},
      {"n", NUMBER, NOT_NEGATIVE, REQUIRED},
      {"C", NUMBER, NOT_NEGATIVE, REQUIRED},
      {"m", NUMBER, POSITIVE, REQUIRED},
      {"epsdot0", RATE, POSITIVE, 1.0},
      {"Tref", TEMPERATURE, POSITIVE, REQUIRED},
      {"Tm", TEMPERATURE, POSITIVE, REQUIRED},
      {"D", RATE, NOT_NEGATIVE, 0.0},
      {"p", NUMBER, POSITIVE, 1.0},
  };

  double G, A, B, n, C, m, epsdot0, Tref, Tm, D, p;

  static std::string problem(const double *v) { return v[8] > v[7] ? "" : "Tm must be above Tref"; }

  static StrengthJohnsonCook make(const double *v)
  {
    StrengthJohnsonCook law;
    law.G = v[0];
    law.A = v[1];
    law.B = v[2];
    law.n = v[3];
    law.C = v[4];
    law.m = v[5];
    law.epsdot0 = v[6];
    law.Tref = v[7];
    law.Tm = v[8];
    law.D = v[9];
    law.p = v[10];
    return law;
  }

  double modulus(const Conditions &) const { return G; }
  double melt(const Conditions &) const { return Tm; }

  double scale(const Conditions &c) const
  {
    if (!(c.T > Tref)) return 1.0;
    const double T = (c.T - Tref) / (Tm - Tref);
    return 1.0 - (m == 1.0 ? T : std::pow(T, m));
  }

  double flow(double eps, double rate, const Conditions &) const
  {
    const double y = A + B * std::pow(eps, n);
    if (!(rate > 0.0)) return y;
    double factor = 1.0;
    if (C > 0.0 && rate > epsdot0) factor += C * std::log(rate / epsdot0);
    if (is_dragged()) factor += std::pow(rate / D, 1.0 / p);
    return y * factor;
  }

  /* ----------------------------------------------------------------------
     y = Y(x), x = (trial - y)/(3 G), for LANES particles, by Halley's method in
     ln x.  There trial - 3 G x - Y(x) falls and is concave, at the kink too, so that
     steps from x of Y(0), the largest, come down to the root without passing it by
     much.  The error of a step is like the cube of the one before.  Where that fails: NaN.
  ------------------------------------------------------------------------- */

  Vec solve(const Vec &trial, const Vec &shear, const Vec &factor, const Vec &eps, double dt) const
  {
    const Vec zero = {}, unknown = zero + NAN;
    const Vec y0 = factor * (A + B * power(eps)), G3 = 3.0 * shear;
    Vec end = trial > y0 ? unknown : trial;
    Vec x = (trial - y0) / G3;
    const double c = dt > 0.0 ? C : 0.0;
    const bool dragged = dt > 0.0 && is_dragged();
    Vec L = c > 0.0 ? log(x * (1.0 / dt / epsdot0)) : zero;
    Vec drag = dragged ? exp(log(x * (1.0 / dt / D)) * (1.0 / p)) : zero;
    for (int k = 0; k < 30; k++) {
      const Vec strain = eps + x, G3x = G3 * x;
      const Vec hard = factor * B * power(strain);
      const Vec y = factor * A + hard;    // and its derivatives to ln x
      const Vec y1 = n * hard * x / strain, y2 = y1 * (eps + n * x) / strain;
      const Vec c1 = L > 0.0 ? zero + c : zero, R = 1.0 + c1 * L;
      Vec Y = y * R, Y1 = y1 * R + y * c1, Y2 = y2 * R + 2.0 * y1 * c1;
      if (dragged) {
        const Vec drag1 = drag * (1.0 / p);
        Y += y * drag;
        Y1 += y1 * drag + y * drag1;
        Y2 += y2 * drag + 2.0 * y1 * drag1 + y * drag1 * (1.0 / p);
      }
      const Vec slope = 1.0 / (G3x + Y1);
      const Vec newton = (trial - G3x - Y) * slope;
      const Vec bend = 1.0 + 0.5 * newton * (G3x + Y2) * slope;
      const Vec step = newton / (bend > 0.5 ? bend : zero + 0.5);
      const Vec last = abs(step) < 1e-5 ? Y + step * (Y1 + 0.5 * step * Y2) : unknown;
      end = end == end ? end : last;    // NOLINT(misc-redundant-expression): where NaN
      if (sum(end) == sum(end)) break;
      x *= exp(step);
      L += step;
      if (dragged) drag *= exp(step * (1.0 / p));
    }
    return end;
  }

 private:
  bool is_dragged() const { return D > 0.0; }
  Vec power(const Vec &x) const    // x^n
  {
    const Vec zero = {};
    return x > 1e-300 ? exp(n * log(x)) : zero + (n > 0.0 ? 0.0 : 1.0);
  }
};

}    // namespace HVI

#endif
