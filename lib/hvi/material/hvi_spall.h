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

#include <iterator>
#include <string>

namespace HVI {

/* ----------------------------------------------------------------------
   Spall, the models of LS-DYNA's SPALL = 1, 2, 3 (materials 10 and 15):

     PRESSURE    tension is limited to sigma_p; S stays, nothing is for good
     PRINCIPAL   spalled for good once the largest principal stress of -p I + S
                 exceeds sigma_p
     ZERO        spalled for good once the tension -p exceeds sigma_p

   one whose limit goes with the yield stress, as PRINCIPAL with that:

     GRADY       see hvi_spall_grady.h

   and two that take time:

     VOIDS            voids grow, at a rate that tension decides; spalled for good once they have done
                      all their damage: see hvi_spall_voids.h
     TULER_BUTCHER    spalled for good once the largest principal stress has been above a threshold
                      for long enough: see hvi_spall_tuler_butcher.h

   What has spalled, or failed (damage 1), is rubble from then on: S = 0 and no
   tension, but it bears compression.
------------------------------------------------------------------------- */

enum class Spall { NONE, PRESSURE, PRINCIPAL, ZERO, VOIDS, TULER_BUTCHER, GRADY };

// what users call them, and the section of material files that each needs

struct SpallModel {
  const char *name;
  Spall model;
  const char *section;
};

static constexpr SpallModel SPALL_MODELS[] = {
    {"none", Spall::NONE, nullptr},
    {"pressure", Spall::PRESSURE, "limit"},
    {"principal", Spall::PRINCIPAL, "limit"},
    {"zero", Spall::ZERO, "limit"},
    {"voids", Spall::VOIDS, "voids"},
    {"tuler-butcher", Spall::TULER_BUTCHER, "tuler-butcher"},
    {"grady", Spall::GRADY, "grady"}};

// of a model; of a name, nullptr: none such; all names

constexpr const SpallModel &spall_model(Spall model)
{
  for (const SpallModel &spall : SPALL_MODELS)
    if (model == spall.model) return spall;
  return SPALL_MODELS[0];
}

inline const SpallModel *find_spall(const std::string &name)
{
  for (const SpallModel &spall : SPALL_MODELS)
    if (name == spall.name) return &spall;
  return nullptr;
}

inline std::string spall_names()
{
  std::string names;
  const int n = std::size(SPALL_MODELS);
  for (int k = 0; k < n; k++)
    names += (k == 0 ? "" : (k < n - 1 ? ", " : " or ")) + std::string(SPALL_MODELS[k].name);
  return names;
}

// the largest eigenvalue of S; in closed form, good to 1e-8 of S at the worst

inline double largest_principal(const Deviator &S)
{
  Eigen::Matrix3d m;
  m << S.xx, S.xy, S.xz, S.xy, S.yy, S.yz, S.xz, S.yz, S.zz;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(m, Eigen::EigenvaluesOnly);
  return solver.eigenvalues()[2];
}

// The largest principal stress of -p I + S if it exceeds a limit, else something that does not.  No
// eigenvalue of a deviator is above 2/3 of von Mises's stress.

inline double principal_above(double limit, double p, const Deviator &S)
{
  if ((2.0 / 3.0 + 1e-6) * von_mises(S) - p <= limit) return limit;
  return largest_principal(S) - p;
}

// Whether a particle spalls under the stress -p I + S.  That of the law is meant, before clip_tension().

inline bool spalls(Spall model, double p, const Deviator &S, double sigma_p)
{
  if (model == Spall::ZERO) return -p > sigma_p;
  return (model == Spall::PRINCIPAL || model == Spall::GRADY) &&
      principal_above(sigma_p, p, S) > sigma_p;
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
