/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_RESTART_H
#define LMP_HVI_RESTART_H

#include "pointers.h"

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

namespace HVI {

std::uint64_t checksum(const void *data, std::size_t bytes);

// that of numbers of eight bytes, as one more of them

double checksum(const double *values, std::size_t n);

// what the nth fix has stored of a particle, or nullptr: LAMMPS's row of it has no room for that

double *stored_at(LAMMPS_NS::Atom *, int i, int nth);

// an error if a particle is of a type that is not there: LAMMPS's part of a restart file has no checksum

void check_types(LAMMPS_NS::LAMMPS *);

// an error if ghosts lack what pairs need: they are there of one group only, or without the masses of their particles,
// or have IDs that are too large for lists

void check_ghosts(LAMMPS_NS::LAMMPS *);

/* ----------------------------------------------------------------------
   A section of ours in a restart file, after the number of its form, its size and its checksum: one of another form, or
   with a byte changed, is an error.  Values come back in the order in which they were put, on all ranks.
------------------------------------------------------------------------- */

class RestartSection {
 public:
  explicit RestartSection(int form) : form(form) {}
  template <class T> void put(const T *values, std::size_t n) { append(values, n * sizeof(T)); }
  void put(const std::string &);
  void write(FILE *) const;
  void write_state(FILE *) const;    // of a fix: after its size, by which LAMMPS reads it

  RestartSection(LAMMPS_NS::LAMMPS *, const std::string &whose, int form, FILE *);
  RestartSection(LAMMPS_NS::LAMMPS *, const std::string &whose, int form, const char *state);
  template <class T> void get(T *values, std::size_t n) { take(values, n * sizeof(T)); }
  template <class T> T get()
  {
    T value;
    get(&value, 1);
    return value;
  }
  std::string text();
  std::size_t left() const { return bytes.size() - at; }

 private:
  struct Header {
    std::uint64_t form, size, sum, own;    // own: checksum of the three before
  };

  const int form;
  std::string bytes, whose;
  std::size_t at = 0;
  LAMMPS_NS::LAMMPS *lmp = nullptr;

  Header header() const;
  void append(const void *, std::size_t);
  void take(void *, std::size_t);
  void check(const Header &) const;
  void check_sum(const Header &) const;
  [[noreturn]] void refuse() const;
};

}    // namespace HVI

#endif
