/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_EOS_H
#define LMP_HVI_EOS_H

#include "hvi_parameter.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace HVI {

/* ----------------------------------------------------------------------
   Equation of state p(rho, e), e the internal energy per mass, zero at
   rho0 and the reference temperature.

   A law is a plain struct with
     name, nargs               nargs: how many of its parameters the short form takes, the first
     params[]                  its table of parameters, density first
     problem(const double *)   if it has any: what is wrong with values that are right one by one
     make(const double *)      from values in the order of params
     rho0, c0, rho_max         rho_max: the law holds below it
     state(rho, e, p, csq)     pressure, and dp/drho at constant entropy,
                               which is dp/drho|e + (p/rho^2) dp/de|rho
     temperature(rho, e)       NaN without a heat capacity
   Guards are here, once for all laws.
------------------------------------------------------------------------- */

class Eos {
 public:
  virtual ~Eos() = default;
  virtual const char *name() const = 0;
  virtual double rho0() const = 0;    // 0 if the law has no reference density (ideal gas)
  virtual double c0() const = 0;      // sound speed at rho0 and e = 0; 0 for the ideal gas

  // Densities at and beyond this are outside the law's range: see hvi_eos_hugoniot.h.  Infinite for
  // laws without an end; behind its last density for a table.
  virtual double rho_max() const = 0;

  // False outside the law's range: rho not in (0, rho_max), anything not finite.  Then p and csq
  // are NaN.  Sound speeds are not below c0/1000, so that one may divide by them.
  virtual bool evaluate(double rho, double e, double &p, double &csq) const = 0;

  virtual double temperature(double rho, double e) const = 0;    // NaN without a heat capacity
};

template <class Law> class EosModel final : public Eos {
 public:
  explicit EosModel(const Law &law) : law(law), csq_min(std::max(1e-6 * law.c0 * law.c0, 1e-200)) {}

  const char *name() const override { return law.name; }
  double rho0() const override { return law.rho0; }
  double c0() const override { return law.c0; }
  double rho_max() const override { return law.rho_max; }

  bool evaluate(double rho, double e, double &p, double &csq) const override
  {
    p = csq = std::numeric_limits<double>::quiet_NaN();
    if (!(rho > 0.0) || !(rho < law.rho_max)) return false;
    double pressure, slope;
    law.state(rho, e, pressure, slope);
    if (!std::isfinite(pressure) || !std::isfinite(slope)) return false;
    p = pressure;
    csq = std::max(slope, csq_min);
    return true;
  }

  double temperature(double rho, double e) const override { return law.temperature(rho, e); }

 private:
  Law law;
  double csq_min;
};

// The laws by name.  Short form of pair_coeff: the first eos_nargs(name) parameters, in order, in
// the units of the run; the others have presets (T0 = 300, S2 = S3 = 0).  eos_nargs is -1 for an
// unknown name.  make_eos returns null for an unknown name or wrong arguments and says in problem
// what is wrong, without naming the law, which its caller does.  The law of tables is only among
// eos_names(): it has a file in place of parameters, see hvi_eos_table.h.

static constexpr char EOS_TABLE[] = "table";

std::string eos_names();                          // "linear, tait, ..."
std::string eos_args(const std::string &name);    // "rho0 K"
int eos_nargs(const std::string &name);
std::unique_ptr<Eos> make_eos(const std::string &name, const std::vector<double> &args,
                              std::string &problem);

// for material files: the table of a law (null if unknown), and the law from all its parameters

const Parameter *eos_params(const std::string &name, int &n);
std::unique_ptr<Eos> make_eos_full(const std::string &name, const std::vector<double> &values,
                                   std::string &problem);

}    // namespace HVI

#endif
