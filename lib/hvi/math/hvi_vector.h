/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_VECTOR_H
#define LMP_HVI_VECTOR_H

namespace HVI {

/* ----------------------------------------------------------------------
   Vectors of doubles, so that loops over pairs are written as for one pair, and
   records of LANES particles become columns, one vector for each of their
   numbers, and rows again.  By GCC's and Clang's vector extension: all operators
   and ?: work lane by lane.

   Four lanes also where registers have eight (AVX-512): that is 5 to 10 % faster
   on Zen 4, since rows turn into columns with less shuffling, fewer lanes are
   left empty at the end of a list, and the square roots take as long; on a Xeon the
   sweeps of solids take as long with either.  Two where registers are short: vectors
   that the compiler must split are far slower.
------------------------------------------------------------------------- */

#if defined(__AVX__)
static constexpr int LANES = 4;
#else
static constexpr int LANES = 2;
#endif

typedef double Vec __attribute__((vector_size(8 * LANES), may_alias));
typedef double Vec4 __attribute__((vector_size(32), may_alias));    // part of a record
typedef double Vec2 __attribute__((vector_size(16), may_alias));

static inline Vec sqrt(const Vec &x)
{
  Vec r;
  for (int k = 0; k < LANES; k++) r[k] = __builtin_sqrt(x[k]);
  return r;
}

static inline Vec abs(const Vec &x)
{
  return x < 0.0 ? -x : x;
}

// lanes of whole numbers: the bits of doubles, and what compares doubles, all bits where it holds

typedef long long Bits __attribute__((vector_size(8 * LANES), may_alias));

static inline Bits all_lanes(long long bits)
{
  return Bits{} + bits;
}

static inline Vec where(const Bits &holds, const Vec &x)    // else 0
{
  return (Vec) (holds & (Bits) x);
}

static inline bool any(const Bits &holds)
{
#if defined(__AVX__)
  return __builtin_ia32_movmskpd256((Vec) holds) != 0;
#else
  return (holds[0] | holds[1]) != 0;
#endif
}

static inline double sum(const Vec &x)
{
  double s = 0.0;
  for (int k = 0; k < LANES; k++) s += x[k];
  return s;
}

// a call would put all vectors in memory

#define HVI_INLINE static inline __attribute__((always_inline))

// four doubles of a record; a vector of space that has another number in the last place

template <class Record> static inline Vec4 &part(Record *record, int n)
{
  return *((Vec4 *) record + n);
}

template <class Record> static inline const Vec4 &part(const Record *record, int n)
{
  return *((const Vec4 *) record + n);
}

HVI_INLINE Vec4 of_four(double x)
{
  return Vec4{x, x, x, x};
}

HVI_INLINE Vec4 with_last(const Vec4 &space, double last)
{
  typedef long long Which __attribute__((vector_size(32)));
  return Which{0, 0, 0, -1} ? of_four(last) : space;
}

// GCC has the other name since version 12

#if defined(__GNUC__) && !defined(__clang__) && __GNUC__ < 12
typedef long long Index __attribute__((vector_size(8 * LANES)));
#define HVI_SHUFFLE(a, b, ...) __builtin_shuffle(a, b, Index{__VA_ARGS__})
#else
#define HVI_SHUFFLE(a, b, ...) __builtin_shufflevector(a, b, __VA_ARGS__)
#endif

static constexpr int IN_TURN[4] = {0, 1, 2, 3};    // of records one after the other

// one number of the records

template <class Record>
HVI_INLINE Vec read_column(const Record *records, const int *j, double Record::*number)
{
  Vec column;
  for (int k = 0; k < LANES; k++) column[k] = records[j[k]].*number;
  return column;
}

template <class Record>
HVI_INLINE void add_column(Record *records, const int *j, double Record::*number, const Vec &column)
{
  for (int k = 0; k < LANES; k++) records[j[k]].*number += column[k];
}

// for either width, of part n of the records with numbers j[0] ... j[LANES - 1]:
//   read_columns: column[k] is number k of them all
//   add_columns: adds to them
//   sums: of four columns
// columns that are written from are gone afterwards

#if defined(__AVX__)

HVI_INLINE void transpose(Vec *r)
{
  const Vec t[4] = {HVI_SHUFFLE(r[0], r[1], 0, 4, 2, 6), HVI_SHUFFLE(r[0], r[1], 1, 5, 3, 7),
                    HVI_SHUFFLE(r[2], r[3], 0, 4, 2, 6), HVI_SHUFFLE(r[2], r[3], 1, 5, 3, 7)};
  for (int k = 0; k < 2; k++) {
    r[k] = HVI_SHUFFLE(t[k], t[k + 2], 0, 1, 4, 5);
    r[k + 2] = HVI_SHUFFLE(t[k], t[k + 2], 2, 3, 6, 7);
  }
}

template <class Record>
HVI_INLINE void read_columns(Record *records, const int *j, int n, Vec *column)
{
  for (int k = 0; k < 4; k++) column[k] = part(records + j[k], n);
  transpose(column);
}

template <class Record>
HVI_INLINE void add_columns(Record *records, const int *j, int n, Vec *column)
{
  transpose(column);
  for (int k = 0; k < 4; k++) part(records + j[k], n) += column[k];
}

HVI_INLINE Vec4 sums(Vec *column)
{
  transpose(column);
  return column[0] + column[1] + column[2] + column[3];
}

#else

template <class Record> static inline Vec2 &quarter(Record *record, int n)
{
  return *((Vec2 *) record + n);
}

template <class Record>
HVI_INLINE void read_columns(Record *records, const int *j, int n, Vec *column)
{
  for (int k = 0; k < 4; k += 2) {
    const Vec a = quarter(records + j[0], 2 * n + k / 2),
              b = quarter(records + j[1], 2 * n + k / 2);
    column[k] = HVI_SHUFFLE(a, b, 0, 2);
    column[k + 1] = HVI_SHUFFLE(a, b, 1, 3);
  }
}

template <class Record>
HVI_INLINE void add_columns(Record *records, const int *j, int n, Vec *column)
{
  for (int k = 0; k < 4; k += 2) {
    quarter(records + j[0], 2 * n + k / 2) += HVI_SHUFFLE(column[k], column[k + 1], 0, 2);
    quarter(records + j[1], 2 * n + k / 2) += HVI_SHUFFLE(column[k], column[k + 1], 1, 3);
  }
}

HVI_INLINE Vec4 sums(Vec *column)
{
  return Vec4{sum(column[0]), sum(column[1]), sum(column[2]), sum(column[3])};
}

#endif

}    // namespace HVI

#endif
