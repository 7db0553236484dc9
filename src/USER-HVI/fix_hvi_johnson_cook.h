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
#include "hvi_solid_model.h"
#include "hvi_sph.h"

#include <memory>
#include <string>
#include <vector>

namespace LAMMPS_NS {

class FixHVIJohnsonCook : public Fix, public HVI::EnergyCarrier {
 public:
  using Solid = HVI::SolidState;

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
    const Solid::Seen &s = solid[i].seen;
    return {s.S.xx, s.S.yy, s.S.zz, s.S.xy, s.S.xz, s.S.yz, s.p_min, s.shear > 0.0 ? s.shear : 0.0};
  }
  const Solid &state(int i) const { return solid[i]; }
  double plastic_work(int) const override;    // energy, from the start on
  bool failed(int i) const { return solid[i].failed(); }
  int bytes_per_particle() const { return sizeof(Solid); }
  std::string laws_of(int itype) const;    // in words

 private:
  static constexpr int NSOLID = sizeof(Solid) / sizeof(double);

  HVI::SolidOptions options;
  std::string text, restored;    // settings, and those in the restart file
  std::vector<std::unique_ptr<HVI::SolidModel>> models;    // of types; null: no solid
  std::vector<int> warned;                                 // of types that do not spall

  Solid *solid;
  class FixHVIStore *store;
  bool fresh;                            // a run begins: rates of S are to be made
  HVIDataRows state_rows, force_rows;    // sections of data files

  HVIDataRows &rows(int section) { return section == 0 ? state_rows : force_rows; }
  const HVI::SolidModel *of(int) const;      // null: no solid
  enum Needs { STATE, FORCES, GRADIENT };    // each with those before it
  HVI::SolidInput input(int, Needs) const;
  void second_half(int, const int *, double);
};

}    // namespace LAMMPS_NS

#endif
#endif
