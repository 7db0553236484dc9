/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing authors: the lammps-hvi developers
------------------------------------------------------------------------- */

#include "hvi_inverse.h"

#include <Eigen/Dense>

#include <algorithm>

namespace HVI {

static constexpr double SMALL_EIGENVALUE = 0.15, LARGE_EIGENVALUE = 0.3;

// g of the eigenvalues, and its derivatives

struct Limited {
  double value, slope, bend;
};

static Limited g(double lambda)
{
  static constexpr double WIDTH = LARGE_EIGENVALUE - SMALL_EIGENVALUE;
  const double w = std::max(0.0, std::min(1.0, (lambda - SMALL_EIGENVALUE) / WIDTH));
  if (w == 0.0) return {1.0, 0.0, 0.0};
  const double s = w * w * (3.0 - 2.0 * w), s1 = 6.0 * w * (1.0 - w) / WIDTH;
  const double s2 = w < 1.0 ? 6.0 * (1.0 - 2.0 * w) / (WIDTH * WIDTH) : 0.0;
  const double inverse = 1.0 / lambda, square = inverse * inverse;
  return {1.0 - s + s * inverse, s1 * (inverse - 1.0) - s * square,
          s2 * (inverse - 1.0) - 2.0 * s1 * square + 2.0 * s * square * inverse};
}

static Eigen::Matrix3d matrix(const Symmetric &s)
{
  Eigen::Matrix3d m;
  m << s.xx, s.xy, s.xz, s.xy, s.yy, s.yz, s.xz, s.yz, s.zz;
  return m;
}

Symmetric along_largest(const Symmetric &M)
{
  const Eigen::Matrix3d m = matrix(M) / (M.xx + M.yy + M.zz), square = m * m,
                        fourth = square * square, part = fourth / fourth.trace();
  return {part(0, 0), part(1, 1), part(2, 2), part(0, 1), part(0, 2), part(1, 2)};
}

/* ---------------------------------------------------------------------- */

Symmetric limited_inverse(const Symmetric &N)
{
  const double cxx = N.yy * N.zz - N.yz * N.yz, cxy = N.xz * N.yz - N.xy * N.zz,
               cxz = N.xy * N.yz - N.xz * N.yy;
  const double cyy = N.xx * N.zz - N.xz * N.xz, cyz = N.xy * N.xz - N.xx * N.yz,
               czz = N.xx * N.yy - N.xy * N.xy;
  const double det = N.xx * cxx + N.xy * cxy + N.xz * cxz;

  // all eigenvalues are above LARGE where N - LARGE is positive definite: its leading minors are

  const double xx = N.xx - LARGE_EIGENVALUE, yy = N.yy - LARGE_EIGENVALUE,
               zz = N.zz - LARGE_EIGENVALUE;
  if (xx > 0.0 && xx * yy > N.xy * N.xy &&
      xx * (yy * zz - N.yz * N.yz) + N.xy * (N.xz * N.yz - N.xy * zz) +
              N.xz * (N.xy * N.yz - yy * N.xz) >
          0.0) {
    const double by = 1.0 / det;
    return {cxx * by, cyy * by, czz * by, cxy * by, cxz * by, cyz * by};
  }

  // Newton's interpolation of g at the eigenvalues a <= b <= c (Smith, Commun. ACM 4 (1961) 168).  Those of
  // nearly equal eigenvalues are known to half of the digits only, which is of no account here: the error of
  // the interpolation goes with the product of theirs.

  static constexpr double CLOSE = 1.0e-7, THIRD = 2.0943951023931953;    // 2 pi/3
  const double mean = (N.xx + N.yy + N.zz) / 3.0;
  const double dx = N.xx - mean, dy = N.yy - mean, dz = N.zz - mean;
  const double off = N.xy * N.xy + N.xz * N.xz + N.yz * N.yz;
  const double p = std::sqrt((dx * dx + dy * dy + dz * dz + 2.0 * off) / 6.0);
  const double shifted = dx * (dy * dz - N.yz * N.yz) + N.xy * (N.xz * N.yz - N.xy * dz) +
      N.xz * (N.xy * N.yz - dy * N.xz);
  const double turn = p > 0.0 ? 0.5 * shifted / (p * p * p) : 0.0;
  const double angle = std::acos(std::max(-1.0, std::min(1.0, turn))) / 3.0;
  const double c = mean + 2.0 * p * std::cos(angle), a = mean + 2.0 * p * std::cos(angle + THIRD),
               b = 3.0 * mean - a - c;

  const Limited at_a = g(a), at_b = g(b), at_c = g(c);
  const double ab = b - a > CLOSE ? (at_b.value - at_a.value) / (b - a) : g(0.5 * (a + b)).slope;
  const double bc = c - b > CLOSE ? (at_c.value - at_b.value) / (c - b) : g(0.5 * (b + c)).slope;
  const double abc = c - a > CLOSE ? (bc - ab) / (c - a) : 0.5 * g(mean).bend;

  // at_a + ab (N - a) + abc (N - a)(N - b)

  const double one = at_a.value - a * ab + a * b * abc, linear = ab - (a + b) * abc;
  const double xx2 = N.xx * N.xx + N.xy * N.xy + N.xz * N.xz,
               yy2 = N.xy * N.xy + N.yy * N.yy + N.yz * N.yz,
               zz2 = N.xz * N.xz + N.yz * N.yz + N.zz * N.zz;
  return {one + linear * N.xx + abc * xx2,
          one + linear * N.yy + abc * yy2,
          one + linear * N.zz + abc * zz2,
          linear * N.xy + abc * (N.xx * N.xy + N.xy * N.yy + N.xz * N.yz),
          linear * N.xz + abc * (N.xx * N.xz + N.xy * N.yz + N.xz * N.zz),
          linear * N.yz + abc * (N.xy * N.xz + N.yy * N.yz + N.yz * N.zz)};
}

}    // namespace HVI
