/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_ENERGY_CARRIER_H
#define LMP_HVI_ENERGY_CARRIER_H

namespace HVI {

/* ----------------------------------------------------------------------
   What a pair style, bond style or fix knows about energy beyond LAMMPS's own
   arrays (v, esph) and tallies of pairs and bonds.  Whoever implements this is
   found and asked by the ledger and by compute hvi/energy.  What does not
   apply is left as it is here.
------------------------------------------------------------------------- */

class EnergyCarrier {
 public:
  virtual ~EnergyCarrier() noexcept(false) {}

  // of owned particle i, and what leaves with it: internal energy beyond its esph, at the time
  // its velocity stands for, also in the middle of a step; plastic work and that of opening voids
  // so far, parts of the internal energy

  virtual double internal_energy(int /*i*/) const { return 0.0; }
  virtual double plastic_work(int /*i*/) const { return 0.0; }

  virtual double void_work(int /*i*/) const { return 0.0; }

  // whether particle i is to be removed with the next lists, as if beyond a fixed face; whether any ever can be

  virtual bool is_to_go(int /*i*/) const { return false; }
  virtual bool may_send_away() const { return false; }

  // of a pair that is torn apart, which types and distance say all about: below which squared
  // distance it has energy, that energy, and the force divided by distance

  virtual double pair_cutsq(int /*itype*/, int /*jtype*/) const { return 0.0; }
  virtual double pair_energy(int /*itype*/, int /*jtype*/, double /*rsq*/, double &fforce) const
  {
    fforce = 0.0;
    return 0.0;
  }
  virtual double bond_energy(int /*btype*/, double /*rsq*/, double &fforce) const
  {
    fforce = 0.0;
    return 0.0;
  }
};

}    // namespace HVI

#endif
