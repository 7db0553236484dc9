/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifdef FIX_CLASS
// clang-format off
FixStyle(hvi/johnson-cook,FixHVIJohnsonCook);
// clang-format on
#else

#ifndef LMP_FIX_HVI_JOHNSON_COOK_H
#define LMP_FIX_HVI_JOHNSON_COOK_H

#include "fix.h"
#include "hvi_data_rows.h"
#include "hvi_energy_carrier.h"
#include "hvi_spall.h"
#include "hvi_sph.h"
#include "hvi_strength.h"

#include <memory>
#include <string>
#include <vector>

namespace LAMMPS_NS {

class FixHVIJohnsonCook : public Fix, public HVI::EnergyCarrier {
 public:
  // of a solid particle

  struct Solid {
    HVI::Deviator S;    // deviatoric stress, of the time of v, rho, e
    struct {
      HVI::Deviator S;
      double p_min, shear;
    } sent;    // extrapolated to the full step, as in the forces; changes before them only
    HVI::Deviator middle;    // trial stress in the middle of the step; between steps rate of S
    double eps;              // equivalent plastic strain
    double damage;           // failed from 1 on
    double spalled;          // 1: spalled for good
    double heat;             // plastic work per mass
    double shear;            // modulus
    double rate;             // of plastic strain
    double yield;            // von Mises's stress on the yield surface of S
  };

  FixHVIJohnsonCook(class LAMMPS *, int, char **);
  ~FixHVIJohnsonCook() override;
  int setmask() override;
  void init() override;
  void set_arrays(int) override;
  void grow_arrays(int) override;
  void copy_arrays(int, int, int) override;
  int pack_exchange(int, double *) override;
  int unpack_exchange(int, double *) override;
  int pack_restart(int, double *) override;
  void unpack_restart(int, int) override;
  int maxsize_restart() override;
  int size_restart(int) override;
  void write_restart(FILE *) override;
  void restart(char *) override;
  void write_data_section_size(int, int &, int &) override;
  void write_data_section_pack(int, double **) override;
  void write_data_section_keyword(int, FILE *) override;
  void write_data_section(int, FILE *, int, double **, int) override;
  bigint read_data_skip_lines(char *) override { return -1; }    // one per particle
  void read_data_section(char *, int, char *, tagint) override;
  double memory_usage() override;

  // called by fix hvi/sph, with the time step

  void start(int, bool);
  void first_half(double);
  void second_half(double);
  void reflect(int, int);

  static FixHVIJohnsonCook *find(class LAMMPS *);    // of this simulation, nullptr: none

  // for the pair style and computes; owned particles

  HVI::SphStress stress(int i) const
  {
    const HVI::Deviator &S = solid[i].sent.S;
    return {S.xx,
            S.yy,
            S.zz,
            S.xy,
            S.xz,
            S.yz,
            solid[i].sent.p_min,
            solid[i].sent.shear > 0.0 ? solid[i].sent.shear : 0.0};
  }
  const Solid &state(int i) const { return solid[i]; }
  double temperature(int) const;
  double plastic_work(int) const override;    // energy, from the start on
  bool failed(int i) const { return solid[i].damage >= 1.0 || solid[i].spalled != 0.0; }

 private:
  static constexpr int NSOLID = sizeof(Solid) / sizeof(double);
  static constexpr double UNKNOWN = -1.0;    // yield
  static constexpr double UNSENT = -1.0;     // sent.shear, before the first forces

  struct Laws;    // of a type
  std::vector<std::unique_ptr<Laws>> laws;
  std::string strength_name;
  HVI::Spall spall;
  int with_damage, thermal, from_work;
  double weibull;    // modulus of the scatter of damage, 0: none
  int weibull_seed;
  std::string text, restored;    // settings, and those in the restart file

  Solid *solid;
  class FixHVIStore *store;
  bool fresh;                            // a run begins: rates of S are to be made
  HVIDataRows state_rows, force_rows;    // sections of data files

  HVIDataRows &rows(int section) { return section == 0 ? state_rows : force_rows; }
  static Solid blank();         // of a new particle
  const Laws *of(int) const;    // null: no solid
  HVI::Conditions conditions(int, double) const;
  HVI::Deviator rate(int) const;
  void advance(int, const int *, const Laws &, double);
  void rubble(int);
  double scatter(int) const;
  void send(int, const Laws *, const HVI::Deviator &);
};

}    // namespace LAMMPS_NS

#endif
#endif
