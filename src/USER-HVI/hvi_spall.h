/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_SPALL_H
#define LMP_HVI_SPALL_H

#include "hvi_parameter.h"
#include "hvi_stress.h"

#include <Eigen/Eigenvalues>

namespace HVI {

/* ----------------------------------------------------------------------
   Spall, the models of LS-DYNA's SPALL = 1, 2, 3 (materials 10 and 15):

     PRESSURE    tension is limited to sigma_p; S stays, nothing is for good
     PRINCIPAL   spalled for good once the largest principal stress of -p I + S
                 exceeds sigma_p
     ZERO        spalled for good once the tension -p exceeds sigma_p

   and one that takes time:

     VOIDS       voids grow, at a rate that tension decides; spalled for good once they have done
                 all their damage: see hvi_spall_voids.h

   What has spalled, or failed (damage 1), is rubble from then on: S = 0 and no
   tension, but it bears compression.
------------------------------------------------------------------------- */

enum class Spall { NONE, PRESSURE, PRINCIPAL, ZERO, VOIDS };

// the largest eigenvalue of S; in closed form, good to 1e-8 of S at the worst

inline double largest_principal(const Deviator &S)
{
  Eigen::Matrix3d m;
  m << S.xx, S.xy, S.xz, S.xy, S.yy, S.yz, S.xz, S.yz, S.zz;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(m, Eigen::EigenvaluesOnly);
  return solver.eigenvalues()[2];
}

// Whether a particle spalls under the stress -p I + S.  That of the law is meant, before clip_tension().

inline bool spalls(Spall model, double p, const Deviator &S, double sigma_p)
{
  if (model == Spall::ZERO) return -p > sigma_p;
  if (model != Spall::PRINCIPAL) return false;

  // no eigenvalue of a deviator is above 2/3 of von Mises's stress
  if ((2.0 / 3.0 + 1e-6) * von_mises(S) - p <= sigma_p) return false;
  return largest_principal(S) - p > sigma_p;
}

// The least pressure that is borne: -infinity, -sigma_p, or 0 of rubble, which has spalled or failed,
// now or before; and what becomes of a pressure by it.  The one law of tension.  That of matter with
// voids depends on its state: SpallVoids::least().

inline double least_pressure(Spall model, bool rubble, double sigma_p)
{
  if (rubble) return 0.0;
  return model == Spall::PRESSURE ? -sigma_p : -NO_LIMIT;
}

inline double clip_tension(double p, double p_min)
{
  return p < p_min ? p_min : p;
}

}    // namespace HVI

#endif
