/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_MATERIAL_H
#define LMP_HVI_MATERIAL_H

#include "hvi_eos.h"
#include "hvi_section.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace HVI {

/* ----------------------------------------------------------------------
   A material: an equation of state and, as plain numbers in the units of the
   run, the parameters of the other laws its file describes.
------------------------------------------------------------------------- */

class Material {
 public:
  std::string name;                 // as the user typed it
  std::string date;                 // DATE: of the file, or empty
  std::string table, table_date;    // of the equation of state, if it is a table
  std::shared_ptr<const Eos> eos;
  std::vector<Section> sections;    // all but eos
  bool liquid = false;              // bears no shear, whatever its file says
  std::uint64_t checksum = 0;       // of all numbers of its file, and of the table; 0: no file

  // null if the file does not describe that law; "": any law of that kind, the first

  const Section *section(const std::string &kind, const std::string &law) const;

  // meant to be a liquid, so that nobody need be warned

  bool is_liquid() const { return liquid || section("strength", "none"); }
};

// A material from the text of its file, with values converted to the units of the run.
// Returns what is wrong as "file:line: ...", or nothing.  The text of a table that the file names
// comes from read(name, text), which returns what is wrong.

using ReadText = std::function<std::string(const std::string &, std::string &)>;

std::string parse_material(const std::string &text, const std::string &filename,
                           const std::string &run_units, Material &material,
                           const ReadText &read = nullptr);

// of the numbers of a table

std::uint64_t checksum_of_table(const std::string &text);

// a tabulated equation of state and the DATE: of its file, likewise; null if something is wrong

std::unique_ptr<Eos> parse_table(const std::string &text, const std::string &filename,
                                 const std::string &run_units, std::string &problem,
                                 std::string &date);

// Between LAMMPS's unit sets si, cgs and micro; all have Kelvin.  Same name in and out: unchanged.

bool convertible(const std::string &from, const std::string &to);
double convert(double x, const Dimension &dim, const std::string &from, const std::string &to);

}    // namespace HVI

#endif
