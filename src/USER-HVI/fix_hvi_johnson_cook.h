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

#include <algorithm>
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

  // called by fix hvi/sph: at the start of a run, of a particle, that a command has changed or not; at the begin of
  // a step; when a particle has crossed mirror planes, in the directions of op.  By the scheme of pair hvi/sph:
  // stress, plastic strain, damage and tensile failure, t -> t + dt

  void start(int i, bool anew);
  void start_newcomer(int i);
  void begin_step();
  void reflect(int i, int op);
  void advance(double dt);

  // for fix hvi/fem: law of a type, null: no solid; the state of an element that has the particle

  const HVI::SolidModel *model(int itype) const { return models[itype].get(); }
  void embed(int i, const Solid &s)
  {
    const double id = extra[i].id;
    extra[i] = s;
    extra[i].id = id;
  }

  static FixHVIJohnsonCook *find(class LAMMPS *);    // of this simulation, nullptr: none

  // of owned particles: least pressure borne and shear modulus at the begin of the step; and with the stress at its
  // end

  struct Limits {
    double p_min, shear;
  };
  Limits before(int i) const
  {
    return {extra[i].before.p_min, std::max(0.0, extra[i].before.shear)};
  }
  struct Stress {
    HVI::Deviator S;
    double p_min, shear;
  };
  Stress stress(int i) const;
  const Solid &state(int i) const { return extra[i]; }
  double pressure(int i, double p) const    // what is left of that of the equation of state
  {
    const HVI::SolidModel *const model = of(i);
    if (!model) return failed(i) ? std::max(p, 0.0) : p;
    HVI::SolidInput in = model->looks(extra[i]) ? input(i) : HVI::SolidInput();
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
  bool bears_shear(int i) const
  {
    const HVI::Deviator &S = extra[i].S;
    return S.xx != 0.0 || S.yy != 0.0 || S.zz != 0.0 || S.xy != 0.0 || S.xz != 0.0 || S.yz != 0.0;
  }
  bool can_fail() const;    // collective: has failed, or may fail in this run
  double
  compute_vector(int) override;    // of types: 1 if there is a law by which they fail in tension
  std::string laws_of(int itype) const;    // in words

 private:
  static const Field FIELDS[];

  std::string known_strengths() const;

  HVI::SolidOptions options;
  std::vector<std::unique_ptr<HVI::SolidModel>> models;    // of types; null: no solid
  std::vector<bigint> inside, outside;                     // of the group: particles of types
  std::vector<int> warned;                                 // of types that lack a law

  class FixHVIStore *store;
  bool in_setup;    // nothing has been advanced in this run yet
  bool checked;     // warned of what may be wrong: once per run, not again with pre no

  void read_options(int, char **);
  std::string settings() const override;
  void make_models();
  void name_thresholds(int);
  void check_state() const;
  void count_particles();
  const HVI::SolidModel *of(int) const;    // null: no solid
  HVI::SolidInput input(int) const;
  HVI::SolidInput input_of_end(int) const;
  double mass(int) const;
  double spacing(int) const;
};

}    // namespace LAMMPS_NS

#endif
#endif
