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

#include "fix_hvi_store.h"
#include "hvi_energy_carrier.h"
#include "hvi_mesh.h"
#include "hvi_images.h"
#include "hvi_sleep.h"
#include "hvi_sph_sweep.h"
#include "hvi_timestep.h"
#include "pair.h"

#include <cmath>
#include <memory>
#include <string>
#include <vector>

namespace LAMMPS_NS {

// an EnergyCarrier, for its pairs have no energy: nothing is torn when a particle leaves

class PairHVISPH :
    public Pair,
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
  void tighten(HVI::TimeStepBounds &) override;
  bool at_hand() const override { return true; }
  std::string fastest_signal() const override;
  double memory_usage() override;

 private:
  // pair_style and pair_coeff; published in the store when a run begins

  HVI::SphSettings set;
  std::vector<std::string> specs;          // by type: what made materials, for restart files
  std::vector<double> spacings;            // by type: of its particles at rest; 0: not given
  std::vector<double> own_mass;            // by type: that pair_coeff has set; 0: none
  double own_skin;                         // that choose_skin() has set; 0: none
  double **visc_a, **visc_b, **tension;    // by types, rows have ntypes+1 entries
  double **ratio, **weight;                // the same, of a run: see find_weights()

  // a run

  class FixHVIStore *store;             // of materials and records
  class FixHVISPH *integrator;          // null: another fix integrates
  class FixHVILists *lists;             // when they are made anew, and who is near
  HVI::Mesh *mesh;                      // has elements; null: there are none
  class FixHVIJohnsonCook *strength;    // keeps the stress of solids; null: there are none
  std::unique_ptr<HVI::SphSweeps> sweeps;
  std::vector<char> is_ours;    // by type: has a material of this pair style
  HVI::Images images;           // of mirror planes
  HVI::SphKept kept;
  HVI::Sleep sleep;
  std::vector<double> rho_quiet, e_quiet;    // by type: undisturbed; 0: never
  double rho_far, v_quiet;                   // differences that count as none
  bool placed;                               // all are in the cells of lists
  std::vector<int> rows;                     // of the list, of those that are awake
  std::vector<char> has_neighbor;            // in the list, or its own image: owned and ghosts

  // of a density and an energy per mass: pressure, dp/drho at constant entropy, cube root of rho/rho0

  struct EosState {
    double rho = NAN, e = 0.0, p = 0.0, csq = 0.0, width = 1.0;
  };
  std::vector<EosState> eos_states;    // by type: of the last particle that was asked for

  double
      fastest;    // of the last forces: 1/time in which signals pass half of what a kernel reaches
  double alone;        // the same of particles without neighbors
  double narrowest;    // and the smallest h

  // records that are being communicated: the first numbers of each, as many as are sent

  struct {
    double *first;
    int stride, number;
  } halo;

  void allocate();
  void deallocate();
  void choose_skin();
  void set_material(int ilo, int ihi, int jlo, int jhi, const std::vector<std::string> &,
                    bool restored);

  // checks: pair_hvi_sph_checks.cpp

  void check_fixes() const;
  void check_materials() const;
  void check_mirror() const;
  void check_places();
  void check_sides() const;
  void check_extent();
  void warn() const;

  // of a force evaluation

  int choose_scene();
  bool find_weights();
  double widest(int, int) const;
  void find_neighbors();
  void find_images();
  void gather();
  void gather_stress();
  void artificial_stress();
  void find_quiet();
  bool whole_sums() const;
  void find_sleepers();
  void choose_rows();
  double fastest_to_images(double far) const;
  void finish_slopes();
  void finish_gradients();
  void correct_gradient(int);
  void find_traction(int);
  bool is_embedded(int i) const
  {
    return !store->fields.embedded.empty() && store->fields.embedded[i];
  }
  bool touches(int) const;    // something that it does not hang together with
  [[noreturn]] void no_answer(int, double) const;
  void scatter();
  template <class Record> void forward(Record *, int number = Record::SENT, int first = 0);
  template <class Record> void reverse(Record *, int number = Record::SENT);

  // told by the sweeps

  void tally(int, int, const HVI::SphNear &, bool) override;
  void tally_image(int, int, const double *, const double *);
  void overlap(int, int) override;
};

}    // namespace LAMMPS_NS

#endif
#endif
