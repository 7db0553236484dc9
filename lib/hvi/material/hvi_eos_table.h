/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_EOS_TABLE_H
#define LMP_HVI_EOS_TABLE_H

#include "hvi_eos.h"

#include <memory>
#include <string>
#include <vector>

namespace HVI {

/* ----------------------------------------------------------------------
   Pressure, and temperature if it is there, on a grid of densities and
   energies, interpolated over rho or ln rho, and e:

     bilinear   p continuous, its slopes not
     bicubic    p and its slopes continuous: cubics of Hermite with slopes and
                the cross derivative from differences over five nodes

   c^2 is made of the slopes of the interpolant, so it belongs to the p that
   acts.  Outside the grid there is no answer.
------------------------------------------------------------------------- */

struct TableData {
  std::string name;
  double rho0 = 0.0;    // 0: no reference state, as in gases
  bool log_density = false, bicubic = true;
  std::vector<double> rho, e;
  std::vector<double> p, T;    // at rho[i], e[j] in [i*e.size() + j]; T may be empty
};

class TableGrid {
 public:
  explicit TableGrid(const TableData &data);

  const std::string label;    // the law, its file and its range, for error messages

  // false outside the grid

  bool state(double rho, double e, double &p, double &csq) const;
  bool temperature(double rho, double e, double &T) const;

  // what is wrong, or nothing: c^2 < 0 somewhere

  std::string check() const;

 private:
  struct Node {
    double p, px, py, pxy;    // x is rho or ln rho, y is e
  };
  struct Cell {
    int i, j;
    double s, t;
  };

  std::vector<double> rho, x, y, T;
  std::vector<Node> nodes;
  bool log_density, bicubic;

  bool find(double rho, double e, Cell &cell) const;
  void interpolate(const Cell &cell, double rho, double &p, double &csq) const;
  const Node &node(int i, int j) const { return nodes[i * y.size() + j]; }
};

struct EosTable {
  const char *name;
  double rho0, c0, rho_max;
  std::shared_ptr<const TableGrid> grid;

  void state(double rho, double e, double &p, double &csq) const
  {
    if (!grid->state(rho, e, p, csq)) p = csq = std::numeric_limits<double>::quiet_NaN();
  }

  double temperature(double rho, double e) const
  {
    double T;
    return grid->temperature(rho, e, T) ? std::max(T, 0.0)
                                        : std::numeric_limits<double>::quiet_NaN();
  }
};

// null if something is wrong, which is said in problem

std::unique_ptr<Eos> make_eos_table(const TableData &data, std::string &problem);

}    // namespace HVI

#endif
