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

static double g(double lambda)
{
  const double w = std::max(
      0.0, std::min(1.0, (lambda - SMALL_EIGENVALUE) / (LARGE_EIGENVALUE - SMALL_EIGENVALUE)));
  const double smooth = w * w * (3.0 - 2.0 * w);
  return smooth > 0.0 ? 1.0 - smooth + smooth / lambda : 1.0;
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
          0.0)
    return {cxx / det, cyy / det, czz / det, cxy / det, cxz / det, cyz / det};

  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(matrix(N));
  const Eigen::Vector3d &lambda = solver.eigenvalues();
  const Eigen::Matrix3d m = solver.eigenvectors() *
      Eigen::Vector3d(g(lambda[0]), g(lambda[1]), g(lambda[2])).asDiagonal() *
      solver.eigenvectors().transpose();
  return {m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(0, 2), m(1, 2)};
}

}    // namespace HVI
