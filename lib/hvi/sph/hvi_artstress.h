/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_ARTSTRESS_H
#define LMP_HVI_ARTSTRESS_H

#include "hvi_stress.h"

#include <Eigen/Eigenvalues>

namespace HVI {

/* ----------------------------------------------------------------------
   Artificial stress against the tensile instability: Monaghan, J. Comput. Phys. 159
   (2000) 290; Gray, Monaghan & Swift, Comput. Methods Appl. Mech. Eng. 190 (2001) 6641,
   in all dimensions.  Along the principal axes of sigma = -p I + S,

     R_a = - eps sigma_a  in tension, 0 else,     sigma_i + f^n R_i  in place of sigma_i,
     f = W(r)/W(dp)

   so that pairs that are closer than the spacing dp of particles, where F of most kernels
   gets weak, still push each other.  (Gray's R has a factor 1/rho^2, as stress has in form
   symmetric.)
------------------------------------------------------------------------- */

// the part of -p I + S with principal stresses above 0

inline Deviator tensile_part(double p, const Deviator &S)
{
  // no eigenvalue of a deviator is above sqrt(2/3 S:S)
  if (p > 0.0 && p * p >= (2.0 / 3.0) * contract(S, S)) return {0.0, 0.0, 0.0, 0.0, 0.0, 0.0};

  Eigen::Matrix3d m;
  m << S.xx - p, S.xy, S.xz, S.xy, S.yy - p, S.yz, S.xz, S.yz, S.zz - p;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(m);
  const Eigen::Matrix3d &axes = solver.eigenvectors();
  const Eigen::Vector3d above = solver.eigenvalues().cwiseMax(0.0);
  const Eigen::Matrix3d t = axes * above.asDiagonal() * axes.transpose();
  return {t(0, 0), t(1, 1), t(2, 2), t(0, 1), t(0, 2), t(1, 2)};
}

}    // namespace HVI

#endif
