/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_SCHEME_RIEMANN_H
#define LMP_HVI_SCHEME_RIEMANN_H

#include "hvi_scheme.h"

namespace LAMMPS_NS {

/* ----------------------------------------------------------------------
   Fluids with Riemann problems between particles: a first sweep has gradients and the number density.  See
   hvi_sph_riemann.h and doc/src/Howto_sph.rst.
------------------------------------------------------------------------- */

class HVISchemeRiemann : public HVIScheme {
 public:
  HVISchemeRiemann(class LAMMPS *, const HVIPairTables &);
  ~HVISchemeRiemann() override;
  double widest(int itype, int jtype) const override;
  const double *const *weights() const override { return differ ? weight : nullptr; }
  Traffic traffic() const override;

 private:
  double **ratio, **weight;    // by types: of h, and see find_weights()
  bool differ;                 // types do, in one of them

  void evaluate() override;
  double gather(int, const EosState &, HVI::SphState &) override;
  void find_weights();
  void finish_slopes();
};

}    // namespace LAMMPS_NS

#endif
