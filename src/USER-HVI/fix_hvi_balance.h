/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifdef FIX_CLASS
// clang-format off
FixStyle(hvi/balance,FixHVIBalance);
// clang-format on
#else

#ifndef LMP_FIX_HVI_BALANCE_H
#define LMP_FIX_HVI_BALANCE_H

#include "fix.h"

#include <memory>
#include <vector>

namespace LAMMPS_NS {

/* ----------------------------------------------------------------------
   Recursive bisection into columns: sub-domains that are cut across two axes and reach through the box along the
   third, each with the same cost of particles.  LAMMPS's fix balance rcb cuts along all axes, its shift cuts all
   columns of a grid at once, of which that over the crater has more than its share.
------------------------------------------------------------------------- */

class FixHVIBalance : public Fix {
 public:
  FixHVIBalance(class LAMMPS *, int, char **);
  ~FixHVIBalance() override;
  int setmask() override;
  void init() override;
  void setup_pre_exchange() override;
  void pre_exchange() override;
  double compute_scalar() override { return after; }
  double compute_vector(int i) override { return i == 0 ? before : largest; }
  double memory_usage() override;

 private:
  double most;    // cost of the fullest rank over the mean
  int axis;       // of the columns
  class FixHVIStore *store;
  std::unique_ptr<class RCB> rcb;
  std::unique_ptr<class Irregular> irregular;
  double before, after;    // cost of the fullest rank over the mean, when it was last looked at
  double largest;          // that cost
  bigint looked_at;        // step

  std::vector<double> costs;

  void look();
  void balance();
  double imbalance(double own);
};

}    // namespace LAMMPS_NS

#endif
#endif
