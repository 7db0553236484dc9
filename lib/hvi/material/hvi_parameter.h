/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_PARAMETER_H
#define LMP_HVI_PARAMETER_H

#include <cmath>
#include <cstdio>
#include <limits>
#include <string>

namespace HVI {

/* ----------------------------------------------------------------------
   What a law says about its parameters: name, physical dimension, range.
   From such tables material files are read, converted to the units of the
   run and checked; a new law brings a table and no parser.
------------------------------------------------------------------------- */

// exponents of mass, length, time, temperature

struct Dimension {
  int mass, length, time, temperature;

  constexpr bool none() const { return !mass && !length && !time && !temperature; }
};

static constexpr Dimension NUMBER = {0, 0, 0, 0};
static constexpr Dimension LENGTH = {0, 1, 0, 0};
static constexpr Dimension DENSITY = {1, -3, 0, 0};
static constexpr Dimension SPEED = {0, 1, -1, 0};
static constexpr Dimension PRESSURE = {1, -1, -2, 0};
static constexpr Dimension PER_PRESSURE = {-1, 1, 2, 0};
static constexpr Dimension SPECIFIC_ENERGY = {0, 2, -2, 0};
static constexpr Dimension HEAT_CAPACITY = {0, 2, -2, -1};
static constexpr Dimension TEMPERATURE = {0, 0, 0, 1};
static constexpr Dimension PER_TEMPERATURE = {0, 0, 0, -1};
static constexpr Dimension RATE = {0, 0, -1, 0};

struct Range {
  double lo, hi;
  bool open;    // lo itself is outside

  bool holds(double x) const { return std::isfinite(x) && (open ? x > lo : x >= lo) && x <= hi; }
};

static constexpr double NO_LIMIT = std::numeric_limits<double>::infinity();
static constexpr Range ANY = {-NO_LIMIT, NO_LIMIT, true};
static constexpr Range POSITIVE = {0.0, NO_LIMIT, true};
static constexpr Range NOT_NEGATIVE = {0.0, NO_LIMIT, false};
static constexpr Range FRACTION = {0.0, 1.0, false};
static constexpr Range ABOVE_ONE = {1.0, NO_LIMIT, true};

// the preset is the value of a parameter that is not given, in SI; NaN: it must be given.  A dimension
// may have the power of a quantity in it whose exponent is a parameter, too, one before this one

static constexpr double REQUIRED = std::numeric_limits<double>::quiet_NaN();

struct Parameter {
  const char *key;
  Dimension dim;
  Range range;
  double preset;
  int exponent = -1;    // its place in the table
  Dimension base = NUMBER;
};

// what is wrong with a value, or nothing

inline std::string value_problem(const char *key, double x, const Range &range)
{
  if (range.holds(x)) return "";
  char text[160];
  if (!std::isfinite(x))
    std::snprintf(text, sizeof(text), "%s = %g is not a finite number", key, x);
  else if (range.hi < NO_LIMIT)
    std::snprintf(text, sizeof(text), "%s = %g is outside %s%g, %g]", key, x,
                  range.open ? "(" : "[", range.lo, range.hi);
  else
    std::snprintf(text, sizeof(text), "%s = %g must be %s %g", key, x,
                  range.open ? ">" : ">=", range.lo);
  return text;
}

}    // namespace HVI

#endif
