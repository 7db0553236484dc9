/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_ELEMENT_H
#define LMP_HVI_ELEMENT_H

#include "hvi_hexahedron.h"
#include "hvi_solid_model.h"

#include <cstdint>
#include <type_traits>

namespace HVI {

/* ----------------------------------------------------------------------
   A hexahedron of fix hvi/fem: all that goes along with its first node to other ranks and into restart
   files.  Numbers of eight bytes only.  Forces and powers are those of the last force evaluation.
------------------------------------------------------------------------- */

struct Element {
  static constexpr int IDS =
      12;    // numbers in the section Elements of data files: those down to first

  std::int64_t id;
  std::int64_t type;             // of its material; 0: it is no more
  std::int64_t node[CORNERS];    // IDs of its nodes
  std::int64_t n;                // embedded particles along an edge; 0: none
  std::int64_t first;            // ID of the first of its n^3 embedded particles; the others follow

  double fingerprint;        // of its nodes at the end of the last run; 0: none
  double mass;               // 0: not known yet
  double V0;                 // volume at the start
  double V;                  // volume
  double rho;                // density
  double e;                  // energy per mass, of the time of its nodes' velocities
  double ahead;              // energy per mass at the end of the step
  double change;             // of e in the last half of a step
  double q;                  // pressure of bulk viscosity
  double hourglass;          // energy that has gone into hourglass forces
  double shared;             // corners that others had, too, at the start
  double kick;               // what half kicks gave to nodes beyond e, per mass; 0 but at output
  double stable;             // longest stable step
  double stable_at_start;    // that at the start; 0: not known yet
  double pair_power;         // of pairs of its particles: what they gain and forces on them work
  double pair_force[CORNERS][3];    // on nodes, of pairs of its particles
  double force[CORNERS][3];         // on nodes, of its stress, viscosity and hourglasses
  double Q[12];                     // hourglass stiffness, see hex_hourglass()
  double step;                      // that has led to those forces
  double L[9];                      // velocity gradient in that step
  SolidState solid;                 // stress, strain, damage

  bool alive() const { return type > 0; }
  int particles() const { return n * n * n; }
};

static constexpr int ELEMENT_SIZE = sizeof(Element) / sizeof(double);

static_assert(sizeof(Element) % sizeof(double) == 0 && std::is_trivially_copyable<Element>::value,
              "elements are sent as numbers of eight bytes");

}    // namespace HVI

#endif
