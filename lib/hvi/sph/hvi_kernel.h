/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_KERNEL_H
#define LMP_HVI_KERNEL_H

#include <algorithm>
#include <cmath>
#include <string>

namespace HVI {

/* ----------------------------------------------------------------------
   Smoothing kernels of SPH.

     W(r, h) = norm(D)/h^D w(q),   q = r/h,   D = 1, 2, 3
     w(q) = 0 for q >= support

   dw_q is (dw/dq)/q: grad W = norm/h^(D+2) dw_q x_ij.  All functions are valid for every q >= 0.
   Each kernel has its own constant in 1D, 2D and 3D; all follow from D-dimensional integrals of w in
   closed form.  KERNELS, at the end, has them all.

   Cubic and Gauss are written for doubles and for vectors of them (T), and free of branches, so that
   they vectorize (GCC needs -fno-trapping-math for the selects, unless the machine has AVX-512).

   Esposito (2024) eq 2.26 prints a cubic spline whose constants (eq 2.27)
   belong to the polynomial 2/3 - q^2 + q^3/2; that one is used here.
------------------------------------------------------------------------- */

namespace Kernel {
  static constexpr double PI = 3.14159265358979323846;

  template <class T> static inline T at_least(const T &x, double least)
  {
    return x > least ? x : T{} + least;
  }
  template <class T> static inline T at_most(const T &x, double most)
  {
    return x < most ? x : T{} + most;
  }
  template <class T> static inline T positive(const T &x)
  {
    return at_least(x, 0.0);
  }
  static inline double pow4(double x)
  {
    return (x * x) * (x * x);
  }
  static inline double pow5(double x)
  {
    return pow4(x) * x;
  }
}    // namespace Kernel

// Lucy, Astron. J. 82 (1977) 1013; h is the support here, as in LAMMPS's package SPH

struct Lucy {
  static constexpr const char *name = "lucy";
  static constexpr double support = 1.0;
  static constexpr double norm[] = {1.25, 5.0 / Kernel::PI, 105.0 / (16.0 * Kernel::PI)};

  static double w(double q)
  {
    const double a = Kernel::positive(1.0 - q);
    return (1.0 + 3.0 * q) * a * a * a;
  }
  static double dw_q(double q)
  {
    const double a = Kernel::positive(1.0 - q);
    return -12.0 * a * a;
  }
};

// Johnson, Stryk & Beissel, Comput. Methods Appl. Mech. Eng. 139 (1996) 347.
// The slope is finite at q = 0, so dw_q is not: it is bounded there by a number that is
// large, but finite, so that an exact overlap gives no force instead of NaN.

struct Quadratic {
  static constexpr const char *name = "quadratic";
  static constexpr double support = 2.0;
  static constexpr double norm[] = {1.0, 2.0 / Kernel::PI, 1.25 / Kernel::PI};

  static double w(double q)
  {
    const double a = Kernel::positive(2.0 - q);
    return 0.1875 * a * a;
  }
  static double dw_q(double q)
  {
    return -0.375 * Kernel::positive(2.0 - q) / Kernel::at_least(q, 1e-30);
  }
};

// Splines of Schoenberg: M4, M5, M6.  Constants: Price, J. Comput. Phys. 231 (2012) 759.
// Near q = 0 the sums of truncated powers cancel; there the polynomial is used.

struct Cubic {
  static constexpr const char *name = "cubic";
  static constexpr double support = 2.0;
  static constexpr double norm[] = {1.0, 15.0 / (7.0 * Kernel::PI), 1.5 / Kernel::PI};

  template <class T> static inline T w(const T &q)
  {
    const T a = Kernel::positive<T>(2.0 - q);
    const T inner = 2.0 / 3.0 + q * q * (0.5 * q - 1.0);
    const T outer = a * a * a * (1.0 / 6.0);
    return q < 1.0 ? inner : outer;
  }
  template <class T> static inline T dw_q(const T &q)
  {
    const T a = Kernel::positive<T>(2.0 - q);
    const T inner = 1.5 * q - 2.0;
    const T outer = -0.5 * a * a / Kernel::at_least<T>(q, 1.0);
    return q < 1.0 ? inner : outer;
  }
};

struct Quartic {
  static constexpr const char *name = "quartic";
  static constexpr double support = 2.5;
  static constexpr double norm[] = {1.0 / 24.0, 96.0 / (1199.0 * Kernel::PI),
                                    1.0 / (20.0 * Kernel::PI)};

  static double w(double q)
  {
    const double inner = 14.375 + q * q * (6.0 * q * q - 15.0);
    const double outer =
        Kernel::pow4(Kernel::positive(2.5 - q)) - 5.0 * Kernel::pow4(Kernel::positive(1.5 - q));
    return q < 0.5 ? inner : outer;
  }
  static double dw_q(double q)
  {
    const double a = Kernel::positive(2.5 - q);
    const double b = Kernel::positive(1.5 - q);
    const double inner = 24.0 * q * q - 30.0;
    const double outer = (20.0 * b * b * b - 4.0 * a * a * a) / Kernel::at_least(q, 0.5);
    return q < 0.5 ? inner : outer;
  }
};

struct Quintic {
  static constexpr const char *name = "quintic";
  static constexpr double support = 3.0;
  static constexpr double norm[] = {1.0 / 120.0, 7.0 / (478.0 * Kernel::PI),
                                    1.0 / (120.0 * Kernel::PI)};

  static double w(double q)
  {
    const double inner = 66.0 + q * q * (q * q * (30.0 - 10.0 * q) - 60.0);
    const double outer =
        Kernel::pow5(Kernel::positive(3.0 - q)) - 6.0 * Kernel::pow5(Kernel::positive(2.0 - q));
    return q < 1.0 ? inner : outer;
  }
  static double dw_q(double q)
  {
    const double inner = q * q * (120.0 - 50.0 * q) - 120.0;
    const double outer = (30.0 * Kernel::pow4(Kernel::positive(2.0 - q)) -
                          5.0 * Kernel::pow4(Kernel::positive(3.0 - q))) /
        Kernel::at_least(q, 1.0);
    return q < 1.0 ? inner : outer;
  }
};

// Zisis et al. (2013) eq 11, truncated at 3h.  The constant is that of the cut kernel: the
// usual pi^(-D/2) misses 2e-5 of the integral in 1D, 1e-4 in 2D and 4e-4 in 3D.  The step at
// the cut remains: gradients are low by 4e-4 in 1D, 1e-3 in 2D and 2.5e-3 in 3D.

struct Gauss {
  static constexpr const char *name = "gauss";
  static constexpr double support = 3.0;

  // sqrt(pi) erf(3), with the last digit that the C library gives, and exp(-9)

  static constexpr double erf3 = 1.7724146965190422;
  static constexpr double cut = 1.2340980408667954950e-4;
  static constexpr double norm[] = {1.0 / erf3, 1.0 / (Kernel::PI * (1.0 - cut)),
                                    1.0 / (Kernel::PI * (erf3 - 6.0 * cut))};

  // exp(-t) for 0 <= t <= 9 to 1e-14: Taylor series of exp(9/32 - t/16), which is within
  // 0.28 of 1, then four squarings.  A call of std::exp would keep loops from vectorizing.

  template <class T> static inline T exp_minus(const T &t)
  {
    const T x = 0.28125 - 0.0625 * t;
    T s = T{} + 1.0 / 479001600.0;
    s = s * x + 1.0 / 39916800.0;
    s = s * x + 1.0 / 3628800.0;
    s = s * x + 1.0 / 362880.0;
    s = s * x + 1.0 / 40320.0;
    s = s * x + 1.0 / 5040.0;
    s = s * x + 1.0 / 720.0;
    s = s * x + 1.0 / 120.0;
    s = s * x + 1.0 / 24.0;
    s = s * x + 1.0 / 6.0;
    s = s * x + 0.5;
    s = s * x + 1.0;
    s = s * x + 1.0;
    s *= s;
    s *= s;
    s *= s;
    s *= s;
    return s * 0.01110899653824230649614;    // exp(-9/2)
  }
  template <class T> static inline T w(const T &q)
  {
    const T s = exp_minus(Kernel::at_most<T>(q * q, 9.0));
    return q < 3.0 ? s : T{};
  }
  template <class T> static inline T dw_q(const T &q) { return -2.0 * w(q); }
};

// Wendland, Adv. Comput. Math. 4 (1995) 389, with the scaling and constants of Dehnen & Aly,
// MNRAS 425 (2012) 1068, table 1, for a support of 2h.  In 1D the functions of 2D and 3D are
// used, which are smoother than needed there, with their own constants.

struct Wendland2 {
  static constexpr const char *name = "wendland2";
  static constexpr double support = 2.0;
  static constexpr double norm[] = {0.75, 1.75 / Kernel::PI, 21.0 / (16.0 * Kernel::PI)};

  static double w(double q)
  {
    return Kernel::pow4(Kernel::positive(1.0 - 0.5 * q)) * (1.0 + 2.0 * q);
  }
  static double dw_q(double q)
  {
    const double a = Kernel::positive(1.0 - 0.5 * q);
    return -5.0 * a * a * a;
  }
};

struct Wendland4 {
  static constexpr const char *name = "wendland4";
  static constexpr double support = 2.0;
  static constexpr double norm[] = {27.0 / 32.0, 2.25 / Kernel::PI, 495.0 / (256.0 * Kernel::PI)};

  static double w(double q)
  {
    const double a = Kernel::positive(1.0 - 0.5 * q);
    return Kernel::pow4(a) * a * a * (1.0 + q * (3.0 + q * (35.0 / 12.0)));
  }
  static double dw_q(double q)
  {
    return -(14.0 / 3.0) * Kernel::pow5(Kernel::positive(1.0 - 0.5 * q)) * (1.0 + 2.5 * q);
  }
};

// of all, for whoever takes them one number at a time

struct KernelFunctions {
  const char *name;
  double support;        // in units of h
  const double *norm;    // in one, two, three dimensions
  double (*w)(double q), (*dw_q)(double q);

  double dw(double q) const { return q * dw_q(q); }
};

template <class K> constexpr KernelFunctions functions_of()
{
  return {K::name, K::support, K::norm,
          [](double q) {
            return K::w(q);
          },
          [](double q) {
            return K::dw_q(q);
          }};
}

static constexpr KernelFunctions KERNELS[] = {functions_of<Lucy>(),      functions_of<Quadratic>(),
                                              functions_of<Cubic>(),     functions_of<Quartic>(),
                                              functions_of<Quintic>(),   functions_of<Gauss>(),
                                              functions_of<Wendland2>(), functions_of<Wendland4>()};

// null: there is none of that name

inline const KernelFunctions *find_kernel(const std::string &name)
{
  for (const KernelFunctions &kernel : KERNELS)
    if (name == kernel.name) return &kernel;
  return nullptr;
}

inline std::string kernel_names()
{
  std::string names;
  for (const KernelFunctions &kernel : KERNELS)
    names += (names.empty() ? "" : ", ") + std::string(kernel.name);
  return names;
}

}    // namespace HVI

#endif
