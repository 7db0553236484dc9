/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_SCHEME_SOLID_H
#define LMP_HVI_SCHEME_SOLID_H

#include "hvi_components.h"
#include "hvi_mesh.h"
#include "hvi_scheme.h"

namespace LAMMPS_NS {

/* ----------------------------------------------------------------------
   Solids: the velocity gradient of the middle of a step brings density and stress to its end, and forces are those
   of tractions with corrected gradients.  See hvi_sph_solid.h and doc/src/Howto_sph.rst.
------------------------------------------------------------------------- */

class HVISchemeSolid : public HVIScheme {
 public:
  HVISchemeSolid(class LAMMPS *, const HVIPairTables &);
  double widest(int itype, int jtype) const override;
  Traffic traffic() const override;

 private:
  class FixHVIJohnsonCook *strength;    // keeps and integrates stress
  HVI::Mesh *mesh;                      // has elements; null: there are none

  // of the begin of the step, owned and ghosts: least pressure borne, shear modulus; weight in the middle of the step
  // over that at its end

  struct Limits {
    double p_min, shear, weight;
  };
  std::vector<Limits> limits;

  void evaluate() override;
  void gather_limits() override;
  bool looks_at_all() const override;
  double gather(int, const EosState &, HVI::SphState &) override;
  void forces_done() override;

  const bool can_fail;           // by a law
  HVI::Components components;    // of sound matter

  void label_bodies();
  void part_from_images();
  void sum_gradients();
  void correct_gradients();
  void advance();
  void find_tractions();
  void artificial_stress();
  void exchange();

  bool is_embedded(int i) const { return !fields.embedded.empty() && fields.embedded[i]; }
  bool touches(int i) const;    // something that it does not hang together with
  int sent_rates() const { return mesh ? HVI::SphRates::WITH_POWER : HVI::SphRates::FORCE; }
};

}    // namespace LAMMPS_NS

#endif
