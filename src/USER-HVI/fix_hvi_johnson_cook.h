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

#include "fix_hvi_records.h"
#include "hvi_energy_carrier.h"
#include "hvi_solid_model.h"
#include "hvi_sph_records.h"

#include <memory>
#include <string>
#include <vector>

namespace LAMMPS_NS {

class FixHVIJohnsonCook :
    public FixHVIRecords<FixHVIJohnsonCook, HVI::SolidState>,
    public HVI::EnergyCarrier {
 public:
  using Solid = HVI::SolidState;

  FixHVIJohnsonCook(class LAMMPS *, int, char **);
  int setmask() override;
  void init() override;
  void setup(int) override;

  // called by fix hvi/sph, with the time step and the bit of its group

  void start(int, bool);
  void first_half(double, int);
  void second_half(double);

  // in place of that with gradient corrected, called by pair hvi/sph before forces: trial stress with L of
  // the middle of the step; then by fix hvi/sph, when all have it

  void try_out(int, const HVI::VelocityGradient &L, double);
  void whole_step(double);
  void reflect(int, int);

  // for fix hvi/fem: law of a type, null: no solid; the state of an element that has the particle

  const HVI::SolidModel *model(int itype) const { return models[itype].get(); }
  void embed(int i, const Solid &s) { extra[i] = s; }

  static FixHVIJohnsonCook *find(class LAMMPS *);    // of this simulation, nullptr: none

  // for the pair style and computes; owned particles

  HVI::SphStress stress(int i) const
  {
    const Solid::Seen &s = extra[i].seen;
    return {s.S.xx, s.S.yy, s.S.zz, s.S.xy, s.S.xz, s.S.yz, s.p_min, s.shear > 0.0 ? s.shear : 0.0};
  }
  HVI::SphStress settled(int i) const;
  const Solid &state(int i) const { return extra[i]; }
  double pressure(int i, double p) const    // what is left of that of the equation of state
  {
    const HVI::SolidModel *const model = of(i);
    if (!model) return p;
    HVI::SolidInput in = model->looks(extra[i]) ? input(i, STATE) : HVI::SolidInput();
    in.p = p;
    return model->pressure(extra[i], in);
  }
  double density(int i) const;      // of the matter around voids
  double fragments(int i) const;    // size of those it has failed into; 0: unknown, or none
  double plastic_work(int i) const override
  {
    return mass(i) * extra[i].heat;
  }    // energy, from the start on
  double void_work(int i) const override { return mass(i) * extra[i].voids.work; }
  bool failed(int i) const { return extra[i].failed(); }
  bool can_fail() const;    // collective: has failed, or may fail in this run
  double
  compute_vector(int) override;    // of types: 1 if there is a law by which they fail in tension
  std::string laws_of(int itype) const;    // in words

 private:
  static const Field FIELDS[];

  HVI::SolidOptions options;
  std::vector<std::unique_ptr<HVI::SolidModel>> models;    // of types; null: no solid
  std::vector<bigint> inside, outside;                     // of the group: particles of types
  std::vector<int> warned;                                 // of types that do not spall

  class FixHVIStore *store;
  bool fresh;      // a run begins: rates of S are to be made
  bool checked;    // warned of what may be wrong: once per run, not again with pre no

  void read_options(int, char **);
  std::string settings() const override;
  void make_models();
  void check_state() const;
  void count_particles();
  const HVI::SolidModel *of(int) const;      // null: no solid
  enum Needs { STATE, FORCES, GRADIENT };    // each with those before it
  HVI::SolidInput input(int, Needs) const;
  double mass(int) const;
  HVI::SolidInput settled_input(int) const;
  HVI::SolidInput extrapolated(int, double, int) const;
  double spacing(int) const;
  template <class Step> void each_solid(const Step &);
};

}    // namespace LAMMPS_NS

#endif
#endif
