/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#include "hvi_eos_table.h"
#include "hvi_material.h"
#include "hvi_text.h"

#include <cmath>

namespace HVI {

namespace {

  class TableText {
   public:
    TableText(const std::string &text, const std::string &filename, const std::string &run_units) :
        lines(text, filename), filename(filename), run_units(run_units)
    {
      data.name = filename;
    }

    TableData data;
    Header header;

    std::string parse();

   private:
    Lines lines;
    const std::string &filename, &run_units;
    bool started = false;    // behind the comments at the head
    bool rho0_given = false, density_given = false, interpolation_given = false;

    bool next(std::string &problem);
    std::string value(const std::string &what, const std::string &word, const Dimension &dim,
                      double &x) const;
    std::string key();
    std::string block(const Dimension &dim, std::vector<double> &values);
    std::string twice() const { return lines.here(lines.words[0] + " given twice"); }
  };

  // the next line with words in it

  bool TableText::next(std::string &problem)
  {
    while (lines.next()) {
      if (!started) {
        problem = header.read(split(lines.comment), run_units);
        if (!problem.empty()) {
          problem = lines.here(problem);
          return false;
        }
      }
      if (!lines.words.empty()) return started = true;
    }
    return false;
  }

  std::string TableText::value(const std::string &what, const std::string &word,
                               const Dimension &dim, double &x) const
  {
    if (!number(word, x)) return lines.here(what + ": " + word + " is not a number");
    x = convert(x, dim, header.units, run_units);
    if (!std::isfinite(x))
      return lines.here(what + ": " + word + " is not a finite number in units " + run_units);
    return "";
  }

  /* ----------------------------------------------------------------------
     word N M
     e     e1   ...  eM
     rho1  p11  ...  p1M
     ...
     rhoN  pN1  ...  pNM
  ------------------------------------------------------------------------- */

  std::string TableText::block(const Dimension &dim, std::vector<double> &values)
  {
    const std::string what = lines.words[0];
    const int start = lines.line;
    if (!values.empty()) return twice();
    double size[2] = {0.0, 0.0};
    for (int k = 0; k < 2; k++) {
      const std::string word = k + 1 < int(lines.words.size()) ? lines.words[k + 1] : "nothing";
      if (!number(word, size[k]) || !(size[k] >= 1 && size[k] <= 1e6) ||
          size[k] != std::floor(size[k]))
        return lines.here(what + " needs the numbers of densities and energies, found " + word);
    }
    if (lines.words.size() > 3) return lines.here(what + ": unexpected text " + lines.words[3]);
    const int nrho = size[0], ne = size[1];
    const bool first = data.rho.empty();
    if (!first && (nrho != int(data.rho.size()) || ne != int(data.e.size())))
      return lines.here(what + " is not on the grid of the block before");

    for (int i = -1; i < nrho; i++) {
      std::string problem;
      if (!next(problem))
        return problem.empty()
            ? lines.at(start,
                       what + ": the file ends after " + std::to_string(std::max(i, 0)) + " of " +
                           std::to_string(nrho) + " densities")
            : problem;
      const std::vector<std::string> &words = lines.words;
      if (i < 0 && words[0] != "e")
        return lines.here(what + ": expected e and the energies, found " + words[0]);
      double x = 0.0;
      if (i >= 0) {
        problem = value("density", words[0], DENSITY, x);
        if (!problem.empty()) return problem;
        if (!(x > 0.0)) return lines.here("density " + words[0] + " must be > 0");
        if (first && i > 0 && !(x > data.rho.back()))
          return lines.here("density " + words[0] + " is not above that of the row before");
        if (!first && x != data.rho[i])
          return lines.here("density " + words[0] + " is not that of the block before");
        if (first) data.rho.push_back(x);
      }
      if (int(words.size()) != ne + 1)
        return lines.here(what + ": " + std::to_string(words.size() - 1) +
                          " values in the row, not " + std::to_string(ne));
      for (int j = 1; j <= ne; j++) {
        problem = value(i < 0 ? "energy" : what, words[j], i < 0 ? SPECIFIC_ENERGY : dim, x);
        if (!problem.empty()) return problem;
        if (i >= 0)
          values.push_back(x);
        else if (!first) {
          if (x != data.e[j - 1])
            return lines.here("energy " + words[j] + " is not that of the block before");
        } else {
          if (j > 1 && !(x > data.e.back()))
            return lines.here("energy " + words[j] + " is not above the one before");
          data.e.push_back(x);
        }
      }
    }
    return "";
  }

  std::string TableText::key()
  {
    const std::vector<std::string> &words = lines.words;
    const std::string &name = words[0];
    if (words.size() < 2) return lines.here(name + " has no value");
    if (words.size() > 2)
      return lines.here(name + ": unexpected text " + words[2] + " after the value");
    bool &given = name == "rho0" ? rho0_given
        : name == "density"      ? density_given
                                 : interpolation_given;
    if (given) return twice();
    given = true;
    if (name == "rho0") {
      std::string problem = value(name, words[1], DENSITY, data.rho0);
      if (problem.empty() && !(data.rho0 > 0.0)) return lines.here("rho0 must be > 0");
      return problem;
    }
    const char *choices[2] = {name == "density" ? "linear" : "bilinear",
                              name == "density" ? "log" : "bicubic"};
    if (words[1] != choices[0] && words[1] != choices[1])
      return lines.here(name + " must be " + choices[0] + " or " + choices[1] + ", not " +
                        words[1]);
    (name == "density" ? data.log_density : data.bicubic) = words[1] == choices[1];
    return "";
  }

  std::string TableText::parse()
  {
    std::string problem;
    while (next(problem)) {
      const std::string name = lines.words[0];
      if (header.units.empty()) return lines.here("no UNITS: in the comments before the first key");
      if (name == "pressure")
        problem = block(PRESSURE, data.p);
      else if (name == "temperature") {
        if (data.p.empty()) return lines.here("temperature stands before pressure");
        problem = block(TEMPERATURE, data.T);
      } else if (name == "rho0" || name == "density" || name == "interpolation")
        problem = key();
      else
        problem = lines.here("unknown key " + name +
                             "; known are rho0, density, interpolation, pressure, temperature");
      if (!problem.empty()) return problem;
    }
    if (problem.empty() && data.p.empty()) return filename + ": no pressure";
    return problem;
  }
}    // namespace

/* ---------------------------------------------------------------------- */

std::unique_ptr<Eos> parse_table(const std::string &text, const std::string &filename,
                                 const std::string &run_units, std::string &problem,
                                 std::string &date)
{
  TableText table(text, filename, run_units);
  problem = table.parse();
  date = table.header.date;
  if (!problem.empty()) return nullptr;
  auto eos = make_eos_table(table.data, problem);
  if (!eos) problem = filename + ": " + problem;
  return eos;
}

}    // namespace HVI
