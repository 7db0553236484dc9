/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#include "hvi_material.h"

#include "hvi_laws.h"
#include "hvi_text.h"

#include <cmath>
#include <cstring>

namespace HVI {

namespace {

  // all laws: those of hvi_eos.cpp and those of hvi_laws.cpp

  bool is_kind(const std::string &word)
  {
    return word == "eos" || is_kind_of_law(word);
  }

  std::string kinds()
  {
    return "eos, " + kinds_of_laws();
  }

  std::string laws_of(const std::string &kind)
  {
    return kind == "eos" ? eos_names() : law_names(kind);
  }

  // false: no such law

  bool find_params(const std::string &kind, const std::string &name, const Parameter *&params,
                   int &n)
  {
    params = nullptr;
    n = 0;
    if (kind == "eos") return (params = eos_params(name, n)) || name == EOS_TABLE;
    const LawEntry *const law = find_law(kind, name);
    if (!law) return false;
    params = law->params;
    n = law->nparams;
    return true;
  }

  // powers of ten of the units of mass, length and time in kg, m, s

  bool decades(const std::string &units, int &mass, int &length, int &time)
  {
    mass = length = time = 0;
    if (units == "si") return true;
    if (units == "cgs") {
      mass = -3;
      length = -2;
      return true;
    }
    if (units == "micro") {    // picogram, micrometer, microsecond
      mass = -15;
      length = time = -6;
      return true;
    }
    return false;
  }

  // a section while it is read

  struct Open {
    std::string kind, law;
    int line = 0, n = 0;
    const Parameter *params = nullptr;
    std::vector<double> values;
    std::vector<int> lines;    // where a value was given; 0: not yet
    std::string file;          // of a table, in place of values
    int file_line = 0;

    std::string label() const { return kind + " " + law; }
    bool table() const { return kind == "eos" && law == EOS_TABLE; }
  };

  // of a value of that parameter; exponents come before what they are of

  double convert(double x, const Parameter &par, const std::vector<double> &values,
                 const std::string &from, const std::string &to)
  {
    x = HVI::convert(x, par.dim, from, to);
    if (par.exponent < 0) return x;
    return x * std::pow(HVI::convert(1.0, par.base, from, to), values[par.exponent]);
  }

  // fills in presets and converts; says what is missing

  std::string finish(Open &open, const std::string &units, const std::string &run_units)
  {
    for (int i = 0; i < open.n; i++) {
      const Parameter &par = open.params[i];
      if (open.lines[i]) {
        open.values[i] = convert(open.values[i], par, open.values, units, run_units);
        if (!par.range.holds(open.values[i]))
          return std::string(par.key) + " is out of range in units " + run_units;
      } else if (std::isnan(par.preset))
        return "missing key " + std::string(par.key);
      else if (convertible("si", run_units))
        open.values[i] = convert(par.preset, par, open.values, "si", run_units);
      else if (par.preset == 0.0 || par.dim.none())
        open.values[i] = par.preset;
      else
        return "missing key " + std::string(par.key) + ", which has no default in units " +
            run_units;
    }
    return "";
  }
  // FNV-1a.  Checksums of the numbers of a file are added up: their order does not matter, nor do comments.

  std::uint64_t checksum(const std::string &text, std::uint64_t hash = 0xcbf29ce484222325u)
  {
    for (const unsigned char c : text) hash = (hash ^ c) * 0x100000001b3u;
    return hash;
  }

  std::uint64_t checksum(const Open &open)
  {
    const std::uint64_t law = checksum(open.label());
    std::uint64_t total = law;
    for (int i = 0; i < open.n; i++) {
      char bytes[sizeof(double)];
      std::memcpy(bytes, &open.values[i], sizeof(double));
      total += checksum(std::string(bytes, sizeof(double)), checksum(open.params[i].key, law));
    }
    return total;
  }
}    // namespace

/* ---------------------------------------------------------------------- */

std::uint64_t checksum_of_table(const std::string &text)
{
  Lines lines(text, "");
  std::uint64_t hash = checksum("table");
  while (lines.next())
    for (const std::string &word : lines.words) hash = checksum(word + " ", hash);
  return hash;
}

/* ---------------------------------------------------------------------- */

bool convertible(const std::string &from, const std::string &to)
{
  int m, l, t;
  return (from == "lj" && to == "lj") || (decades(from, m, l, t) && decades(to, m, l, t));
}

// all factors are powers of ten, so one division or multiplication by an exact number will do

double convert(double x, const Dimension &dim, const std::string &from, const std::string &to)
{
  if (from == to) return x;
  int m0, l0, t0, m1, l1, t1;
  decades(from, m0, l0, t0);
  decades(to, m1, l1, t1);
  const int n = dim.mass * (m0 - m1) + dim.length * (l0 - l1) + dim.time * (t0 - t1);
  return n < 0 ? x / std::pow(10.0, -n) : x * std::pow(10.0, n);
}

// ---------------------------------------------------------------------- head of a file

std::string Header::read(const std::vector<std::string> &words, const std::string &run_units)
{
  for (size_t i = 0; i + 1 < words.size(); i++) {
    if (words[i] == "DATE:") date = words[i + 1];
    if (words[i] != "UNITS:") continue;
    if (!units.empty()) return "UNITS: given twice";
    units = words[i + 1];
    if (!convertible(units, units))
      return "unknown UNITS: " + units + "; known are si, cgs, micro, lj";
    if (!convertible(units, run_units))
      return "UNITS: " + units + " cannot be converted to units " + run_units + " of the run";
  }
  return "";
}

const Section *Material::section(const std::string &kind, const std::string &law) const
{
  for (const Section &s : sections)
    if (s.kind == kind && (law.empty() || s.law == law)) return &s;
  return nullptr;
}

/* ----------------------------------------------------------------------
   comments start with #; those before the first section hold UNITS: and DATE:
   sections start with "kind law", their lines are "key value"
------------------------------------------------------------------------- */

std::string parse_material(const std::string &text, const std::string &filename,
                           const std::string &run_units, Material &material, const ReadText &read)
{
  material = Material();
  material.name = filename;
  Header header;
  std::vector<Open> opened;
  Lines lines(text, filename);

  while (lines.next()) {
    if (opened.empty()) {
      const std::string problem = header.read(split(lines.comment), run_units);
      if (!problem.empty()) return lines.here(problem);
    }
    const std::vector<std::string> &words = lines.words;
    if (words.empty()) continue;
    const std::string &key = words[0];

    if (is_kind(key)) {
      if (header.units.empty())
        return lines.here("no UNITS: in the comments before the first section");
      if (words.size() < 2)
        return lines.here("section " + key + " names no law; known are " + laws_of(key));
      Open open;
      open.kind = key;
      open.law = words[1];
      open.line = lines.line;
      if (!find_params(key, open.law, open.params, open.n))
        return lines.here("unknown law " + open.label() + "; known are " + laws_of(key));
      if (words.size() > 2) return lines.here(open.label() + ": unexpected text " + words[2]);
      for (const Open &old : opened)
        if (old.kind == key && (key == "eos" || old.law == open.law))
          return lines.here("second section " + (key == "eos" ? key : open.label()) +
                            ", the first is in line " + std::to_string(old.line));
      for (const Open &old : opened)
        if (key == "strength" && old.kind == key && (open.law == "none" || old.law == "none"))
          return lines.here(open.label() + " beside " + old.label() + " in line " +
                            std::to_string(old.line));
      open.values.resize(open.n);
      open.lines.resize(open.n);
      opened.push_back(open);
      continue;
    }

    if (opened.empty()) return lines.here("expected a section (" + kinds() + "), found " + key);
    Open &open = opened.back();
    const std::string label = open.label() + ": ";
    if (open.table()) {
      if (key != "file") return lines.here(label + "unknown key " + key + "; known is file");
      if (open.file_line)
        return lines.here(label + "key file given twice, first in line " +
                          std::to_string(open.file_line));
      if (words.size() < 2) return lines.here(label + "key file has no value");
      if (words.size() > 2)
        return lines.here(label + "file: unexpected text " + words[2] + " after the name");
      open.file = words[1];
      open.file_line = lines.line;
      continue;
    }
    int i = 0;
    while (i < open.n && key != open.params[i].key) i++;
    if (i == open.n) {
      if (!open.n) return lines.here(label + "takes no keys, but got " + key);
      std::string known;
      for (int k = 0; k < open.n; k++) known += " " + std::string(open.params[k].key);
      return lines.here(label + "unknown key " + key + "; known are" + known);
    }
    if (open.lines[i])
      return lines.here(label + "key " + key + " given twice, first in line " +
                        std::to_string(open.lines[i]));
    if (words.size() < 2) return lines.here(label + "key " + key + " has no value");
    double x;
    if (!number(words[1], x)) return lines.here(label + key + ": " + words[1] + " is not a number");
    if (words.size() > 2)
      return lines.here(label + key + ": unexpected text " + words[2] + " after the value");
    const std::string problem = value_problem(open.params[i].key, x, open.params[i].range);
    if (!problem.empty()) return lines.here(label + problem);
    open.values[i] = x;
    open.lines[i] = lines.line;
  }

  material.date = header.date;
  for (Open &open : opened) {
    std::string problem = finish(open, header.units, run_units);
    if (!problem.empty()) return lines.at(open.line, open.label() + ": " + problem);
    material.checksum += checksum(open);
    if (open.table()) {
      if (!open.file_line) return lines.at(open.line, open.label() + ": missing key file");
      std::string table;
      problem = read ? read(open.file, table) : "there is no way to read " + open.file;
      if (problem.empty())
        material.eos = parse_table(table, open.file, run_units, problem, material.table_date);
      if (!problem.empty()) return lines.at(open.file_line, open.label() + ": " + problem);
      material.table = open.file;
      material.checksum += checksum_of_table(table);
      continue;
    }
    if (open.kind == "eos") {
      material.eos = make_eos_full(open.law, open.values, problem);
      if (!material.eos) return lines.at(open.line, open.label() + ": " + problem);
      continue;
    }
    Section section = {open.kind, open.law, {}};
    for (int i = 0; i < open.n; i++) section.values[open.params[i].key] = open.values[i];
    material.sections.push_back(section);
  }
  if (!material.eos) return filename + ": no section eos";
  return "";
}

}    // namespace HVI
