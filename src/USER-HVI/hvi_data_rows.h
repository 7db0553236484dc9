/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_DATA_ROWS_H
#define LMP_HVI_DATA_ROWS_H

#include "pointers.h"

#include <cstdio>
#include <functional>
#include <string>
#include <vector>

namespace LAMMPS_NS {

/* ----------------------------------------------------------------------
   A section of data files with a row of numbers per particle: its ID, then
   the columns, in as many digits as they have, up to 24 characters.  LAMMPS
   reads lines of less than 256, that is, MOST columns.
------------------------------------------------------------------------- */

class HVIDataRows : protected Pointers {
 public:
  static constexpr int MOST = 9;

  HVIDataRows(class LAMMPS *, const std::string &title, const std::string &columns);

  const std::string &title() const { return name; }
  int width() const { return 1 + columns.size(); }

  void write_keyword(FILE *, const std::string &fix_id) const;    // and says how to read it
  void pack_ids(double **) const;                                 // into the first column
  void write(FILE *, int n, double **) const;

  // what a row means is the caller's: given the particle and the numbers

  void read(int n, char *, tagint offset, const std::function<void(int, const double *)> &);

  // LAMMPS sets the arrays of new particles after it has read the sections: not those with a row

  bool has(int i) const { return i < (int) rows.size() && rows[i]; }
  bool take(int i);
  void forget() { rows.clear(); }

 private:
  std::string name;
  std::vector<std::string> columns;
  std::vector<char> rows;    // which owned particles have one
};

}    // namespace LAMMPS_NS

#endif
