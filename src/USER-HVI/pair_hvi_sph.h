/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifdef PAIR_CLASS
// clang-format off
PairStyle(hvi/sph,PairHVISPH);
// clang-format on
#else

#ifndef LMP_PAIR_HVI_SPH_H
#define LMP_PAIR_HVI_SPH_H

#include "hvi_energy_carrier.h"
#include "hvi_scheme.h"
#include "hvi_sph_step.h"
#include "hvi_timestep.h"
#include "pair.h"

#include <memory>
#include <string>
#include <vector>

namespace LAMMPS_NS {

// an EnergyCarrier, for its pairs have no energy: nothing is torn when a particle leaves

class PairHVISPH :
    public Pair,
    public HVI::SphStep,
    public HVI::TimeStepSource,
    public HVI::EnergyCarrier,
    private HVI::SphWatcher {
 public:
  PairHVISPH(class LAMMPS *);
  ~PairHVISPH() override;

  void compute(int, int) override;
  void settings(int, char **) override;
  void coeff(int, char **) override;
  void init_style() override;
  double init_one(int, int) override;
  void setup() override;
  void write_restart(FILE *) override;
  void read_restart(FILE *) override;
  void write_restart_settings(FILE *) override;
  void read_restart_settings(FILE *) override;
  int pack_forward_comm(int, int *, double *, int, int *) override;
  void unpack_forward_comm(int, int, double *) override;
  int pack_reverse_comm(int, int, double *) override;
  void unpack_reverse_comm(int, int *, double *) override;
  void prepare() override { scheme->prepare(); }
  void tighten(HVI::TimeStepBounds &bounds) override { scheme->tighten(bounds); }
  bool at_hand() const override { return true; }
  std::string fastest_signal() const override { return scheme->fastest_signal(); }
  double memory_usage() override;

 private:
  // pair_style and pair_coeff; published in the store when a run begins

  HVI::SphSettings set;
  std::vector<std::string> specs;          // by type: what made materials, for restart files
  std::vector<double> spacings;            // by type: of its particles at rest; 0: not given
  std::vector<double> own_mass;            // by type: that pair_coeff has set; 0: none
  double own_skin;                         // that choose_skin() has set; 0: none
  double **visc_a, **visc_b, **tension;    // by types, rows have ntypes+1 entries

  // a run

  class FixHVIStore *store;             // of materials and records
  class FixHVISPH *integrator;          // null: another fix integrates
  class FixHVILists *lists;             // when they are made anew
  class FixHVIJohnsonCook *strength;    // null: there are no solids
  std::unique_ptr<HVIScheme> scheme;    // what a force evaluation does
  std::vector<char> is_ours;            // by type: has a material of this pair style
  std::vector<char> looked_for;         // by type: whether there are particles of it

  void allocate();
  void deallocate();
  void choose_skin();
  double reach(int, int) const;    // of pairs of two types
  void set_material(int ilo, int ihi, int jlo, int jhi, const std::vector<std::string> &,
                    bool restored);

  // what must be right before a run, and what may be meant

  void check_fixes() const;
  void check_materials() const;
  void check_mirror() const;
  void check_places();
  void check_sides() const;
  void check_extent();
  void warn();

  // told by the sweeps

  void tally(int, int, const double *, const double *) override;
  void tally_image(int, int, const double *, const double *);
  void overlap(int, int) override;
};

}    // namespace LAMMPS_NS

#endif
#endif
