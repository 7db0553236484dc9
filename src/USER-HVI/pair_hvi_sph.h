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
#include "hvi_material.h"
#include "hvi_mirror.h"
#include "hvi_sph_riemann.h"
#include "hvi_stress.h"
#include "hvi_timestep.h"
#include "pair.h"

#include <memory>
#include <string>
#include <vector>

namespace LAMMPS_NS {

// an EnergyCarrier, for its pairs have no energy: nothing is torn when a particle leaves

class PairHVISPH : public Pair, public HVI::TimeStepSource, public HVI::EnergyCarrier {
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
  double memory_usage() override;

  // for fixes and computes

  static PairHVISPH *find(class LAMMPS *);    // of this simulation, nullptr if there is none
  const HVI::Material *material(int itype) const { return materials[itype].get(); }
  bool has_volume(int itype) const    // pair_coeff says what a particle's volume is at rest
  {
    return specs[itype].find(" volume ") != std::string::npos;
  }
  double start_h(int itype) const { return htype[itype]; }
  bool is_stock() const { return laws.stock; }
  bool has_energy() const { return energy; }
  bool variable_h() const { return variable; }
  double smoothing_length(int itype, double rho, double hscale) const;
  double hscale(int itype, double rho) const;    // h rho^(1/dim), which stays as it is

  // of the last forces, owned particles

  double pressure(int i) const
  {
    const HVI::SphState &s = state[i];
    return laws.symmetric ? s.p * s.rho * s.rho : s.p;
  }
  HVI::VelocityGradient velocity_gradient(int i) const;
  double viscous_power() const { return heating; }    // of owned particles
  const HVI::MirrorPlanes &mirrors() const { return mirror; }
  const double *mirror_force() const { return images.force; }    // on this rank's particles
  const std::string &description() const { return text; }

 private:
  // pair_style

  std::string kernel, text;
  double support;
  HVI::SphLaws laws;
  bool variable, energy, density, riemann, solid, corrected;
  double hmin, hmax;    // in units of the start value

  // pair_coeff

  std::vector<std::shared_ptr<const HVI::Material>> materials;
  std::vector<std::string> specs;    // what made them, for restart files
  std::vector<double> htype;
  double **visc_a, **visc_b, **tension;    // NAN: as in pair_style; rows have ntypes+1 entries

  // a step; of two sweeps over the list the second knows who is within reach

  enum { ONLY, FIRST, SECOND };
  int nmax;
  std::unique_ptr<HVI::SphPlace[]> place;    // arrays of owned and ghost particles
  std::unique_ptr<HVI::SphState[]> state;
  std::unique_ptr<HVI::SphSlopes[]> slopes;    // dissipation riemann only
  std::vector<int> kept, numkept;              // of the neighbor list: those within reach
  std::unique_ptr<HVI::SphRates[]> rates;
  std::unique_ptr<HVI::SphStress[]> stress;    // solids only, as is the next
  std::unique_ptr<HVI::SphGradV[]> gradv;
  std::unique_ptr<HVI::SphStress[]> art;    // artificial stress, where asked for
  enum { SLOPES, STRESS } sending;
  HVI::MirrorPlanes mirror;
  HVI::Images images;
  std::vector<int> nearby;
  double heating;
  class FixHVISPH *fix;
  class FixHVIJohnsonCook *strength;    // keeps the stress of solids
  void (PairHVISPH::*sweep)();

  void allocate();
  void deallocate();
  void set_material(int ilo, int ihi, int jlo, int jhi, const std::vector<std::string> &,
                    bool with_mass);
  void gather();
  void gather_stress();
  void artificial_stress();
  void scatter();
  void report_overlap(int, int, const HVI::SphNear &);
  void check_mirror() const;
  void check_sides() const;
  void find_images();
  void fill_images();
  void fold_images();
  const std::vector<int> &images_near(int, const int *, int);
  void tally_image(int, int, const double *, const double *);
  tagint tag_of(int) const;
  template <class Kernel, int SCENE = 0> void choose_scene(int);
  template <class Kernel, int SCENE> void eval();
  template <class Kernel, int SCENE> void eval_slopes();
  template <class Kernel, int SCENE, int SWEEP, class Record, class Work>
  void each_particle(Record *, Work);
  void keep_lists();
};

}    // namespace LAMMPS_NS

#endif
#endif
