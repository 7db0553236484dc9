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
#include <utility>

namespace HVI {

/* ----------------------------------------------------------------------
   Smoothing kernels of SPH.

     W(r, h) = norm(D)/h^D w(q),   q = r/h,   D = 1, 2, 3
     w(q) = 0 for q >= support

   dw is dw/dq, and dw_q is (dw/dq)/q: grad W = norm/h^(D+2) dw_q x_ij.
   All functions are valid for every q >= 0 and free of branches, so that
   loops over them vectorize (GCC needs -fno-trapping-math for the selects,
   unless the machine has AVX-512).  Each kernel has its own constant in 1D, 2D
   and 3D; all follow from D-dimensional integrals of w in closed form.

   Esposito (2024) eq 2.26 prints a cubic spline whose constants (eq 2.27)
   belong to the polynomial 2/3 - q^2 + q^3/2; that one is used here.
------------------------------------------------------------------------- */

namespace Kernel {
  static constexpr double PI = 3.14159265358979323846;
  // T: double, or a vector of them

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
  template <class T> static inline T pow4(const T &x)
  {
    return (x * x) * (x * x);
  }
  template <class T> static inline T pow5(const T &x)
  {
    return (x * x) * (x * x) * x;
  }
}    // namespace Kernel

// Lucy, Astron. J. 82 (1977) 1013; h is the support here, as in LAMMPS's package SPH

struct Lucy {
  static constexpr const char *name = "lucy";
  static constexpr double support = 1.0;

  static double norm(int dim)
  {
    return dim == 1 ? 1.25 : dim == 2 ? 5.0 / Kernel::PI : 105.0 / (16.0 * Kernel::PI);
  }
  template <class T> static inline T w(const T &q)
  {
    const T a = Kernel::positive<T>(1.0 - q);
    return (1.0 + 3.0 * q) * a * a * a;
  }
  template <class T> static inline T dw_q(const T &q)
  {
    const T a = Kernel::positive<T>(1.0 - q);
    return -12.0 * a * a;
  }
  template <class T> static inline T dw(const T &q) { return q * dw_q(q); }
};

// Johnson, Stryk & Beissel, Comput. Methods Appl. Mech. Eng. 139 (1996) 347.
// The slope is finite at q = 0, so dw_q is not: it is bounded there by a number that is
// large, but finite, so that an exact overlap gives no force instead of NaN.

struct Quadratic {
  static constexpr const char *name = "quadratic";
  static constexpr double support = 2.0;

  static double norm(int dim)
  {
    return dim == 1 ? 1.0 : dim == 2 ? 2.0 / Kernel::PI : 1.25 / Kernel::PI;
  }
  template <class T> static inline T w(const T &q)
  {
    const T a = Kernel::positive<T>(2.0 - q);
    return 0.1875 * a * a;
  }
  template <class T> static inline T dw(const T &q)
  {
    return -0.375 * Kernel::positive<T>(2.0 - q);
  }
  template <class T> static inline T dw_q(const T &q)
  {
    return dw(q) / Kernel::at_least<T>(q, 1e-30);
  }
};

// Splines of Schoenberg: M4, M5, M6.  Constants: Price, J. Comput. Phys. 231 (2012) 759.
// Near q = 0 the sums of truncated powers cancel; there the polynomial is used.

struct Cubic {
  static constexpr const char *name = "cubic";
  static constexpr double support = 2.0;

  static double norm(int dim)
  {
    return dim == 1 ? 1.0 : dim == 2 ? 15.0 / (7.0 * Kernel::PI) : 1.5 / Kernel::PI;
  }
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
  template <class T> static inline T dw(const T &q) { return q * dw_q(q); }
};

struct Quartic {
  static constexpr const char *name = "quartic";
  static constexpr double support = 2.5;

  static double norm(int dim)
  {
    return dim == 1 ? 1.0 / 24.0
        : dim == 2  ? 96.0 / (1199.0 * Kernel::PI)
                    : 1.0 / (20.0 * Kernel::PI);
  }
  template <class T> static inline T w(const T &q)
  {
    const T inner = 14.375 + q * q * (6.0 * q * q - 15.0);
    const T outer = Kernel::pow4<T>(Kernel::positive<T>(2.5 - q)) -
        5.0 * Kernel::pow4<T>(Kernel::positive<T>(1.5 - q));
    return q < 0.5 ? inner : outer;
  }
  template <class T> static inline T dw_q(const T &q)
  {
    const T a = Kernel::positive<T>(2.5 - q);
    const T b = Kernel::positive<T>(1.5 - q);
    const T inner = 24.0 * q * q - 30.0;
    const T outer = (20.0 * b * b * b - 4.0 * a * a * a) / Kernel::at_least<T>(q, 0.5);
    return q < 0.5 ? inner : outer;
  }
  template <class T> static inline T dw(const T &q) { return q * dw_q(q); }
};

struct Quintic {
  static constexpr const char *name = "quintic";
  static constexpr double support = 3.0;

  static double norm(int dim)
  {
    return dim == 1 ? 1.0 / 120.0
        : dim == 2  ? 7.0 / (478.0 * Kernel::PI)
                    : 1.0 / (120.0 * Kernel::PI);
  }
  template <class T> static inline T w(const T &q)
  {
    const T inner = 66.0 + q * q * (q * q * (30.0 - 10.0 * q) - 60.0);
    const T outer = Kernel::pow5<T>(Kernel::positive<T>(3.0 - q)) -
        6.0 * Kernel::pow5<T>(Kernel::positive<T>(2.0 - q));
    return q < 1.0 ? inner : outer;
  }
  template <class T> static inline T dw_q(const T &q)
  {
    const T inner = q * q * (120.0 - 50.0 * q) - 120.0;
    const T outer = (30.0 * Kernel::pow4<T>(Kernel::positive<T>(2.0 - q)) -
                     5.0 * Kernel::pow4<T>(Kernel::positive<T>(3.0 - q))) /
        Kernel::at_least<T>(q, 1.0);
    return q < 1.0 ? inner : outer;
  }
  template <class T> static inline T dw(const T &q) { return q * dw_q(q); }
};

// Zisis et al. (2013) eq 11, truncated at 3h.  The constant is that of the cut kernel: the
// usual pi^(-D/2) misses 2e-5 of the integral in 1D, 1e-4 in 2D and 4e-4 in 3D.  The step at
// the cut remains: gradients are low by 4e-4 in 1D, 1e-3 in 2D and 2.5e-3 in 3D.

struct Gauss {
  static constexpr const char *name = "gauss";
  static constexpr double support = 3.0;

  static double norm(int dim)
  {
    const double cut = std::exp(-9.0);
    const double erf3 = std::sqrt(Kernel::PI) * std::erf(3.0);
    return 1.0 /
        (dim == 1       ? erf3
             : dim == 2 ? Kernel::PI * (1.0 - cut)
                        : Kernel::PI * (erf3 - 6.0 * cut));
  }

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
  template <class T> static inline T dw(const T &q) { return q * dw_q(q); }
};

// Wendland, Adv. Comput. Math. 4 (1995) 389, with the scaling and constants of Dehnen & Aly,
// MNRAS 425 (2012) 1068, table 1, for a support of 2h.  In 1D the functions of 2D and 3D are
// used, which are smoother than needed there, with their own constants.

struct Wendland2 {
  static constexpr const char *name = "wendland2";
  static constexpr double support = 2.0;

  static double norm(int dim)
  {
    return dim == 1 ? 0.75 : dim == 2 ? 1.75 / Kernel::PI : 21.0 / (16.0 * Kernel::PI);
  }
  template <class T> static inline T w(const T &q)
  {
    return Kernel::pow4<T>(Kernel::positive<T>(1.0 - 0.5 * q)) * (1.0 + 2.0 * q);
  }
  template <class T> static inline T dw_q(const T &q)
  {
    const T a = Kernel::positive<T>(1.0 - 0.5 * q);
    return -5.0 * a * a * a;
  }
  template <class T> static inline T dw(const T &q) { return q * dw_q(q); }
};

struct Wendland4 {
  static constexpr const char *name = "wendland4";
  static constexpr double support = 2.0;

  static double norm(int dim)
  {
    return dim == 1 ? 27.0 / 32.0 : dim == 2 ? 2.25 / Kernel::PI : 495.0 / (256.0 * Kernel::PI);
  }
  template <class T> static inline T w(const T &q)
  {
    const T a = Kernel::positive<T>(1.0 - 0.5 * q);
    return Kernel::pow4<T>(a) * a * a * (1.0 + q * (3.0 + q * (35.0 / 12.0)));
  }
  template <class T> static inline T dw_q(const T &q)
  {
    return -(14.0 / 3.0) * Kernel::pow5<T>(Kernel::positive<T>(1.0 - 0.5 * q)) * (1.0 + 2.5 * q);
  }
  template <class T> static inline T dw(const T &q) { return q * dw_q(q); }
};

// calls f(Kernel{}) for the kernel of that name; false if there is none

static constexpr const char *KERNEL_NAMES =
    "lucy, quadratic, cubic, quartic, quintic, gauss, wendland2, wendland4";

template <typename F, typename... Kernels> bool with_kernel_of(const std::string &name, F &&f)
{
  return ((name == Kernels::name && (f(Kernels{}), true)) || ...);
}

template <typename F> bool with_kernel(const std::string &name, F &&f)
{
  return with_kernel_of<F, Lucy, Quadratic, Cubic, Quartic, Quintic, Gauss, Wendland2, Wendland4>(
      name, std::forward<F>(f));
}

}    // namespace HVI

#endif
