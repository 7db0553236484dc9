/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing authors: the lammps-hvi developers
------------------------------------------------------------------------- */

#include "hvi_data_rows.h"

#include "atom.h"
#include "error.h"
#include "read_data.h"
#include "tokenizer.h"

#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;

HVIDataRows::HVIDataRows(LAMMPS *lmp, const std::string &title, const std::string &columns_in) :
    Pointers(lmp), name(title), columns(utils::split_words(columns_in))
{
  if (ReadData::is_data_section(title))
    error->all(FLERR, "Fix ID {} must not be the name of a section of data files", title);
}

/* ---------------------------------------------------------------------- */

void HVIDataRows::write_keyword(FILE *fp, const std::string &id) const
{
  utils::logmesg(lmp, "  section {1}: for read_data, fix {0} NULL {1}\n", id, name);
  std::string line = fmt::format("\n{} # id", name);
  for (const std::string &column : columns) line += " " + column;
  utils::print(fp, "{}\n\n", line);
}

void HVIDataRows::pack_ids(double **buf) const
{
  for (int i = 0; i < atom->nlocal; i++) buf[i][0] = ubuf(atom->tag[i]).d;
}

void HVIDataRows::write(FILE *fp, int n, double **buf) const
{
  for (int i = 0; i < n; i++) {
    std::string line = fmt::format("{}", (tagint) ubuf(buf[i][0]).i);
    for (size_t k = 1; k <= columns.size(); k++) line += fmt::format(" {}", buf[i][k]);
    if (line.size() > 254)
      error->one(FLERR, "Section {}: line too long for read_data: {}", name, line);
    utils::print(fp, "{}\n", line);
  }
}

/* ----------------------------------------------------------------------
   as fix property/atom does
------------------------------------------------------------------------- */

void HVIDataRows::read(int n, char *buf, tagint offset,
                       const std::function<void(int, const double *)> &set)
{
  const bool no_map = atom->map_style == Atom::MAP_NONE;
  if (no_map) {
    atom->map_init();
    atom->map_set();
  }
  rows.resize(atom->nmax, 0);
  std::vector<double> row(columns.size());

  for (int k = 0; k < n; k++) {
    char *const end = strchr(buf, '\n');
    if (!end) error->all(FLERR, "Unexpected end of section {} of data file", name);
    *end = '\0';
    try {
      ValueTokenizer values(buf);
      if ((int) values.count() != width())
        error->all(FLERR, "Section {} of data file: {} values in the line, not {}: {}", name,
                   values.count(), width(), utils::trim(buf));
      const tagint tag = values.next_tagint() + offset;
      if (tag <= 0 || tag > atom->map_tag_max)
        error->all(FLERR, "Section {} of data file: there is no particle {}", name, tag);
      for (double &value : row) {
        value = values.next_double();
        if (!std::isfinite(value))
          error->all(FLERR, "Section {} of data file: not a finite number in the line: {}", name,
                     utils::trim(buf));
      }
      const int i = atom->map(tag);
      if (i >= 0) {
        set(i, row.data());
        rows[i] = 1;
      }
    } catch (TokenizerException &e) {
      error->all(FLERR, "Section {} of data file: {} in the line: {}", name, e.what(),
                 utils::trim(buf));
    }
    buf = end + 1;
  }

  if (no_map) {
    atom->map_delete();
    atom->map_style = Atom::MAP_NONE;
  }
}

bool HVIDataRows::take(int i)
{
  if (!has(i)) return false;
  rows[i] = 0;
  return true;
}
