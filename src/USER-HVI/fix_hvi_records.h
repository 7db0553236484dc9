/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_FIX_HVI_RECORDS_H
#define LMP_FIX_HVI_RECORDS_H

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "fix.h"
#include "fix_hvi_store.h"
#include "hvi_anew.h"
#include "hvi_data_rows.h"
#include "hvi_restart.h"
#include "memory.h"
#include "modify.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <deque>
#include <string>
#include <vector>

namespace LAMMPS_NS {

/* ----------------------------------------------------------------------
   A fix that keeps a record of each particle: a plain struct of numbers of eight bytes.  One table of
   fields drives exchange, restart and data files:

     column     name in data files, nullptr: not there; columns stand in the order of the table
     section    of data files
     place      in the record, in bytes; NOWHERE: a column beside the record
     get, set   of a column that is not just the number in the record
     is_id      of a particle, if it is from 1 on: read_data may add an offset

   All of the record goes along with its particle, and into restart files.
------------------------------------------------------------------------- */

template <class Owner> struct HVIField {
  static constexpr size_t NOWHERE = -1;

  const char *column;
  int section;
  size_t place;
  double (*get)(const Owner &, int) = nullptr;
  void (*set)(Owner &, int, double) = nullptr;
  bool is_id = false;
};

// whether a table has all of a record, and nothing twice

template <class Record, class Field, int N> constexpr bool covers(const Field (&fields)[N])
{
  for (size_t place = 0; place < sizeof(Record); place += sizeof(double)) {
    int n = 0;
    for (const Field &field : fields) n += field.place == place;
    if (n != 1) return false;
  }
  return true;
}

// whether LAMMPS can read the lines of all sections

template <class Field, int N> constexpr bool have_room(const Field (&fields)[N])
{
  for (int section = 0; section < N; section++) {
    int n = 0;
    for (const Field &field : fields) n += field.column && field.section == section;
    if (n > HVIDataRows::MOST) return false;
  }
  return true;
}

template <class Owner, class Record> class FixHVIRecords : public Fix {
 public:
  void set_arrays(int) override;
  void grow_arrays(int) override;
  void copy_arrays(int i, int j, int) override { extra[j] = extra[i]; }
  int pack_exchange(int, double *) override;
  int unpack_exchange(int, double *) override;
  int pack_restart(int, double *) override;
  void unpack_restart(int, int) override;
  int maxsize_restart() override { return places.size() + 3; }    // its size, ID, and a checksum
  int size_restart(int) override { return places.size() + 3; }
  void write_restart(FILE *) override;
  void restart(char *buf) override
  {
    found = true;
    restored =
        HVI::RestartSection(lmp, fmt::format("Fix {} {}", id, style), RESTART_FORMAT, buf).text();
  }
  void write_data_section_size(int, int &, int &) override;
  void write_data_section_pack(int, double **) override;
  void write_data_section_keyword(int k, FILE *fp) override { sections[k].write_keyword(fp, id); }
  void write_data_section(int k, FILE *fp, int n, double **buf, int) override
  {
    sections[k].write(fp, n, buf);
  }
  bigint read_data_skip_lines(char *) override { return -1; }    // one per particle
  void read_data_section(char *, int, char *, tagint) override;
  static constexpr int bytes_per_particle() { return sizeof(Record); }
  double memory_usage() override { return (double) atom->nmax * sizeof(Record); }

 protected:
  using Field = HVIField<Owner>;

  Record *extra;           // of owned particles, and what the owner fills in of ghosts
  std::string restored;    // settings in the restart file

  // fresh: record of a new particle.  suffixes: of the ID, for the titles of the sections.

  template <int N>
  FixHVIRecords(LAMMPS *, int, char **, const Record &fresh, const Field (&)[N],
                const std::vector<std::string> &suffixes);
  ~FixHVIRecords() override;

  void begin();    // when the owner's constructor has found nothing wrong: LAMMPS gets to know it

  virtual std::string settings() const = 0;                  // for the restart file
  virtual Record stored(int i) const { return extra[i]; }    // in the restart file
  void forget_rows();       // of data files, once they have been read
  void check_restored();    // in init()

 private:
  static constexpr int RESTART_FORMAT =
      5;    // with the ID of the particle, and the one that it began with; missed work

  const Record fresh;
  const Field *const fields;
  const int nfields;
  std::vector<size_t> places;    // of the record
  std::vector<std::string> suffixes;
  bool known = false;
  bool may_be_lost = false;            // given between read_restart and a run
  bool found = false;                  // in the restart file
  std::deque<HVIDataRows> sections;    // they cannot be copied

  void refuse_another() const;
};

/* ---------------------------------------------------------------------- */

template <class Owner, class Record>
template <int N>
FixHVIRecords<Owner, Record>::FixHVIRecords(LAMMPS *lmp, int narg, char **arg, const Record &fresh,
                                            const Field (&table)[N],
                                            const std::vector<std::string> &suffixes) :
    Fix(lmp, narg, arg),
    extra(nullptr), fresh(fresh), fields(table), nfields(N), suffixes(suffixes)
{
  static_assert(sizeof(Record) % sizeof(double) == 0, "records hold numbers of eight bytes");
  refuse_another();
  for (int k = 0; k < (int) suffixes.size(); k++) {
    std::string columns;
    for (const Field &field : table)
      if (field.column && field.section == k) columns += std::string(field.column) + " ";
    sections.emplace_back(lmp, id + suffixes[k], columns);
  }
  for (const Field &field : table)
    if (field.place != Field::NOWHERE) places.push_back(field.place);
  std::sort(places.begin(), places.end());

  restart_global = 1;
  restart_peratom = 1;
  maxexchange = places.size();
  create_attribute = 1;
  wd_section = sections.size();
  const FixHVIStore *const store = FixHVIStore::find(lmp);
  may_be_lost = modify->nfix_restart_peratom > 0 || (store && store->has_forgotten);
}

template <class Owner, class Record> void FixHVIRecords<Owner, Record>::begin()
{
  FixHVIRecords::grow_arrays(atom->nmax);
  std::fill_n(extra, atom->nlocal, fresh);
  atom->add_callback(Atom::GROW);
  atom->add_callback(Atom::RESTART);
  known = true;
}

template <class Owner, class Record> FixHVIRecords<Owner, Record>::~FixHVIRecords()
{
  HVI::run_anew(update);
  if (known) {
    atom->delete_callback(id, Atom::GROW);
    atom->delete_callback(id, Atom::RESTART);
  }
  memory->sfree(extra);
}

/* ----------------------------------------------------------------------
   LAMMPS deletes a fix that is given again under its ID before it makes the new one, and with it
   the records.  All that is left of it is an empty place in the list.
------------------------------------------------------------------------- */

template <class Owner, class Record> void FixHVIRecords<Owner, Record>::refuse_another() const
{
  for (int k = 0; k < modify->nfix; k++)
    if (!modify->fix[k])
      error->all(
          FLERR,
          "Fix {} {} is given again, which would wipe out what it keeps of the particles: if "
          "that is meant, unfix {} first",
          id, style, id);
}

// LAMMPS gives a fix what one of the same ID and style has written, and else says so without a warning

template <class Owner, class Record> void FixHVIRecords<Owner, Record>::check_restored()
{
  if (may_be_lost && !found && comm->me == 0)
    error->warning(
        FLERR,
        "Fix {} {}: the restart file has nothing of a fix of this ID and style, so what it "
        "keeps of particles begins anew: if an earlier run had one, give it the ID that it had, "
        "before commands like balance, which make LAMMPS forget what the file has",
        id, style);
  may_be_lost = false;
}

/* ---------------------------------------------------------------------- */

template <class Owner, class Record> void FixHVIRecords<Owner, Record>::set_arrays(int i)
{
  bool given = false;
  for (HVIDataRows &rows : sections) given = rows.take(i) || given;
  if (!given) extra[i] = fresh;
}

template <class Owner, class Record> void FixHVIRecords<Owner, Record>::grow_arrays(int n)
{
  extra = (Record *) memory->srealloc(extra, n * sizeof(Record), "hvi/records:extra");
}

template <class Owner, class Record>
int FixHVIRecords<Owner, Record>::pack_exchange(int i, double *buf)
{
  int m = 0;
  for (const size_t place : places) memcpy(&buf[m++], (char *) &extra[i] + place, sizeof(double));
  return m;
}

template <class Owner, class Record>
int FixHVIRecords<Owner, Record>::unpack_exchange(int i, double *buf)
{
  int m = 0;
  for (const size_t place : places) memcpy((char *) &extra[i] + place, &buf[m++], sizeof(double));
  return m;
}

template <class Owner, class Record>
int FixHVIRecords<Owner, Record>::pack_restart(int i, double *buf)
{
  const Record record = stored(i);
  int m = 0;
  buf[m++] = places.size() + 3;
  buf[m++] = (double) atom->tag[i];
  for (const size_t place : places) memcpy(&buf[m++], (char *) &record + place, sizeof(double));
  buf[m] = HVI::checksum(buf, m);
  return m + 1;
}

template <class Owner, class Record>
void FixHVIRecords<Owner, Record>::unpack_restart(int nlocal, int nth)
{
  double *const stored = HVI::stored_at(atom, nlocal, nth);
  const size_t n = places.size() + 2;
  if (!stored || stored[0] != n + 1)
    error->one(FLERR,
               "Fix {} {}: the restart file is of another version, with {} numbers per particle "
               "in place of {}",
               id, style, stored ? stored[0] - 3 : 0, places.size());
  if (stored + n >= atom->extra[nlocal] + atom->nextra_store ||
      stored[n] != HVI::checksum(stored, n))
    error->one(
        FLERR,
        "Fix {} {}: numbers of particle {} in the restart file are damaged, their checksum is "
        "wrong: take another one",
        id, style, atom->tag[nlocal]);
  if (stored[1] != (double) atom->tag[nlocal])
    error->one(FLERR,
               "Fix {} {}: a command since read_restart (balance, delete_atoms) has put particles "
               "in another order than the numbers that the file has for this fix: give it after "
               "the fix",
               id, style);
  unpack_exchange(nlocal, &stored[2]);
}

/* ---------------------------------------------------------------------- */

template <class Owner, class Record> void FixHVIRecords<Owner, Record>::write_restart(FILE *fp)
{
  if (comm->me) return;
  HVI::RestartSection section(RESTART_FORMAT);
  section.put(settings());
  section.write_state(fp);
}

/* ---------------------------------------------------------------------- */

template <class Owner, class Record>
void FixHVIRecords<Owner, Record>::write_data_section_size(int k, int &nx, int &ny)
{
  nx = atom->nlocal;
  ny = sections[k].width();
}

template <class Owner, class Record>
void FixHVIRecords<Owner, Record>::write_data_section_pack(int k, double **buf)
{
  sections[k].pack_ids(buf);
  int column = 1;
  for (int n = 0; n < nfields; n++) {
    const Field &field = fields[n];
    if (!field.column || field.section != k) continue;
    for (int i = 0; i < atom->nlocal; i++)
      if (field.get)
        buf[i][column] = field.get(static_cast<const Owner &>(*this), i);
      else
        memcpy(&buf[i][column], (char *) &extra[i] + field.place, sizeof(double));
    column++;
  }
}

template <class Owner, class Record>
void FixHVIRecords<Owner, Record>::read_data_section(char *keyword, int n, char *buf, tagint offset)
{
  // of this fix, or of one with another ID, whose sections end alike

  int k = 0;
  for (int s = 1; s < (int) sections.size(); s++)
    if (keyword == sections[s].title() ||
        (keyword != sections[0].title() && utils::strmatch(keyword, suffixes[s] + "$")))
      k = s;

  sections[k].read(n, buf, offset, [this, k, offset](int i, const double *value) {
    const bool given = std::any_of(sections.begin(), sections.end(), [i](const HVIDataRows &rows) {
      return rows.has(i);
    });
    if (!given) extra[i] = fresh;
    for (int m = 0; m < nfields; m++) {
      const Field &field = fields[m];
      if (!field.column || field.section != k) continue;
      const double shifted = *value + offset;
      if (field.is_id && *value >= 1.0 && shifted <= MAXTAGINT)
        memcpy((char *) &extra[i] + field.place, &shifted, sizeof(double));
      else if (field.set)
        field.set(static_cast<Owner &>(*this), i, *value);
      else
        memcpy((char *) &extra[i] + field.place, value, sizeof(double));
      value++;
    }
  });
}

template <class Owner, class Record> void FixHVIRecords<Owner, Record>::forget_rows()
{
  for (HVIDataRows &rows : sections) rows.forget();
}

}    // namespace LAMMPS_NS

#endif
