/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_INVERSE_H
#define LMP_HVI_INVERSE_H

namespace HVI {

struct Symmetric {
  double xx, yy, zz, xy, xz, yz;
};

/* ----------------------------------------------------------------------
   The inverse of N, symmetric with eigenvalues from 0 to about 1, as far as it can be trusted:
   sum g(lambda) n (x) n over its eigenvectors, with g = 1/lambda from LARGE on, 1 below SMALL, and
   smooth in between.
------------------------------------------------------------------------- */

Symmetric limited_inverse(const Symmetric &N);

// M^4 / tr M^4: n (x) n with n the axis of M's largest eigenvalue, where that stands out; a mean where
// several are alike, so that it does not jump

Symmetric along_largest(const Symmetric &M);

}    // namespace HVI

#endif
