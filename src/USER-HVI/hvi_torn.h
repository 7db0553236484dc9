/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_TORN_H
#define LMP_HVI_TORN_H

#include "pointers.h"

#include <string>
#include <vector>

namespace HVI {
class EnergyCarrier;
}

namespace LAMMPS_NS {

/* ----------------------------------------------------------------------
   Energy and force of pairs and bonds that are torn apart when a particle
   leaves, by types and distance alone: the two may belong to any ranks, and
   ghosts are gone.  Styles that are no EnergyCarrier are asked through their
   single(), unless that may read data of particles: theirs is not known.
------------------------------------------------------------------------- */

class HVITorn : protected Pointers {
 public:
  HVITorn(class LAMMPS *);

  bool has_pairs() const;                           // that have energy which is known
  double pair_cutsq(int itype, int jtype) const;    // 0: no such pair has
  double pair(int itype, int jtype, double rsq, double &fforce) const;
  double bond(int btype, double rsq, double &fforce) const;
  const std::vector<std::string> &unknown() const { return names; }    // styles

 private:
  // the style as what it is to us and to LAMMPS; who is no carrier is asked through single()

  struct PairSource {
    const HVI::EnergyCarrier *carrier;
    class Pair *pair;    // null: a carrier that is no pair style
  };
  struct BondSource {
    const HVI::EnergyCarrier *carrier;
    class Bond *bond;
  };
  std::vector<PairSource> pairs;
  std::vector<BondSource> bonds;    // by type; both null: not known
  std::vector<std::string> names;
  bool weighs;    // pairs have a weight by bonds, which are not known of particles that have left

  void find_pairs();
  void find_bonds();
  bool needs_types_only(class Pair *) const;
  bool has_energy(const HVI::EnergyCarrier &) const;
  double cutsq(const PairSource &, int, int) const;
};

}    // namespace LAMMPS_NS

#endif
