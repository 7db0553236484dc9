/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifdef BOND_CLASS
// clang-format off
BondStyle(hvi/spring,BondHVISpring);
// clang-format on
#else

#ifndef LMP_BOND_HVI_SPRING_H
#define LMP_BOND_HVI_SPRING_H

#include "bond.h"
#include "hvi_energy_carrier.h"
#include "hvi_spring.h"
#include "hvi_timestep.h"

namespace LAMMPS_NS {

class BondHVISpring : public Bond, public HVI::TimeStepSource, public HVI::EnergyCarrier {
 public:
  BondHVISpring(class LAMMPS *);
  ~BondHVISpring() override;

  void compute(int, int) override;
  void coeff(int, char **) override;
  void init_style() override;
  double equilibrium_distance(int) override;
  void write_restart(FILE *) override;
  void read_restart(FILE *) override;
  void write_data(FILE *) override;
  double single(int, double, int, int, double &) override;
  void born_matrix(int, double, int, int, double &, double &) override;
  void *extract(const char *, int &) override;
  int pack_forward_comm(int, int *, double *, int, int *) override;
  void unpack_forward_comm(int, int, double *) override;
  double memory_usage() override;
  void tighten(HVI::TimeStepBounds &) override;
  double bond_energy(int, double, double &) const override;

 protected:
  double *kappa, *r_eq, *r_cut;
  HVI::Spring *law;
  class FixHVILedger *ledger;

  bool dropped;        // lists of special neighbors are not those of the bonds
  bool warned;         // that they cannot be made again
  int exact_images;    // 1 if bonds are measured between coordinates as their owners hold them
  int nmax;
  double **xowner;    // coordinates of ghosts without periodic shifts, only if exact_images

  static constexpr int NBATCH = 128;

  void allocate();
  void drop_special();
  void restore_special();
  void break_bond(int, int, int, int, double, double, double, double);
  int erase_record(int, tagint, int);
  template <int EVFLAG, int NEWTON_BOND, int EXACT> void eval();
};

}    // namespace LAMMPS_NS

#endif
#endif
