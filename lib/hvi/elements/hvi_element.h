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
  static constexpr int IDS = 12;    // of the first numbers, in data files

  std::int64_t id, type;         // of its material
  std::int64_t node[CORNERS];    // IDs
  std::int64_t n, first;         // n^3 particles with IDs from first on; 0: none
  double mark;                   // fingerprint of its nodes at the end of the last run; 0: none
  double mass;                   // 0: not known yet
  double V0, V, rho;             // volume of the start and now; density
  double e, ahead, change;    // energy per mass; of the end of a step, and half of the change in it
  double q;                   // bulk viscosity
  double hourglass;           // energy that has gone into hourglass forces
  double shared;              // corners that others had, too, at the start
  double kick;    // what half kicks gave to nodes beyond e, per mass, as known at output
  double stable, at_start;    // step that it bears, now and at the start
  double power;    // of pairs of its particles: what they gain and what forces on them work
  double pair_force[3 * CORNERS];    // of those, on nodes
  double force[3 * CORNERS];         // its own, on nodes
  double Q[12];                      // hourglass stiffness, see hex_hourglass()
  double step, L[9];                 // step that has led to those forces, velocity gradient in it
  SolidState s;

  static constexpr int SIZE =
      IDS + 1 + 14 + 6 * CORNERS + 12 + 10 + sizeof(SolidState) / sizeof(double);
  int particles() const { return n * n * n; }
};

static_assert(sizeof(Element) == Element::SIZE * sizeof(double) &&
                  std::is_trivially_copyable<Element>::value,
              "elements are sent as numbers of eight bytes");

}    // namespace HVI

#endif
