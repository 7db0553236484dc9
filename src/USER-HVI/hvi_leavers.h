/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_LEAVERS_H
#define LMP_HVI_LEAVERS_H

#include "hvi_excluded.h"
#include "pointers.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {

/* ----------------------------------------------------------------------
   Particles about to be removed, beyond a fixed face of the box or sent away by
   an EnergyCarrier: counts up what leaves with them and takes them out.  Needs neither ghosts nor a neighbor
   list: a rank sees all leavers near its own particles, if any style can tear
   pairs or bonds apart.
------------------------------------------------------------------------- */

class HVILeavers : protected Pointers {
 public:
  struct Account {    // on this rank, but nrecords of all
    double energy;    // kinetic, internal, of contacts and bonds torn apart
    double momentum[3], mass, count;
    double plastic, voids;               // work, parts of the internal energy
    bigint nrecords;                     // of bonds: one or, newton_bond off, two a bond
    std::vector<std::string> unknown;    // styles whose energy is not in it
  };

  HVILeavers(class LAMMPS *lmp) : Pointers(lmp), dt(0.0), reach(0.0), number(0) {}

  bigint pick(bool at_faces);    // how many, on all ranks
  Account take_out(double dt);

 private:
  struct Leaver {
    tagint tag;
    int type, rank;
    double x[3], v[3];
    int mask;
    tagint molecule;
  };
  struct LeaverBond {
    tagint tag, partner;
    int type;
  };

  double dt, reach;            // of pairs, and of what holds a bond together
  bigint number;               // of leavers, on all ranks
  std::vector<int> leaving;    // owned particles that leave
  std::vector<int> near;      // owned particles that stay, but may be in touch with one that leaves
  std::vector<Leaver> out;    // leavers near particles of this rank, and its own
  std::vector<LeaverBond> bonds;    // that those hold

  void share(bool bonded);
  template <class Law>
  double torn(const Law &, const double *, const double *, const Leaver &) const;
  double contact(const class HVITorn &, const HVI::ExcludedBy &, const double *, const double *,
                 const Leaver &) const;
  double spring(const class HVITorn &, int, const double *, const double *, const Leaver &) const;
  double tear_contacts(const class HVITorn &) const;
  double tear_bonds(const class HVITorn &, bigint &);
  void fractional(const double *, double *) const;
  void fraction_of_box(double, double *) const;
  void remove();
};

}    // namespace LAMMPS_NS

#endif
