/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_VECTOR_MATH_H
#define LMP_HVI_VECTOR_MATH_H

#include "hvi_vector.h"

namespace HVI {

/* ----------------------------------------------------------------------
   exp and log lane by lane, to two units in the last place, for laws that many
   particles ask for: a call per number of the C library takes several times as long.
   exp: |x| < 700, beyond it the value there.  log: normal numbers x > 0.  What is not a number
   gives that.
------------------------------------------------------------------------- */

typedef long long Bits __attribute__((vector_size(8 * LANES)));
typedef unsigned long long UBits __attribute__((vector_size(8 * LANES)));    // these may overflow

static constexpr double LN2_HIGH = 0x1.62e42fefa3800p-1, LN2_LOW = 0x1.ef35793c76730p-45;

// c[0] + c[1] x + ..., in pairs (Estrin's scheme): many short chains instead of a long one

HVI_INLINE Vec polynomial(const double (&c)[12], const Vec &x)
{
  const Vec x2 = x * x, x4 = x2 * x2;
  Vec four[3];
  for (int k = 0; k < 3; k++)
    four[k] = (c[4 * k] + c[4 * k + 1] * x) + x2 * (c[4 * k + 2] + c[4 * k + 3] * x);
  return four[0] + x4 * (four[1] + x4 * four[2]);
}

HVI_INLINE Vec exp(const Vec &number)
{
  const Vec low = Vec{} - 700.0, high = Vec{} + 700.0;
  Vec x = number < low ? low : number;
  x = x > high ? high : x;

  // x = n ln2 + r; n in the last bits of a number that large

  static constexpr double LARGE = 0x1.8p52;
  const Vec shifted = x * 0x1.71547652b82fep+0 + LARGE, n = shifted - LARGE;
  const Vec r = x - n * LN2_HIGH - n * LN2_LOW;
  static constexpr double over[12] = {
      0.5,         1.0 / 6,      1.0 / 24,      1.0 / 120,      1.0 / 720,       1.0 / 5040,
      1.0 / 40320, 1.0 / 362880, 1.0 / 3628800, 1.0 / 39916800, 1.0 / 479001600, 1.0 / 6227020800};
  const Vec fraction = 1.0 + (r + r * r * polynomial(over, r));
  return (Vec) ((UBits) fraction + ((UBits) shifted << 52));    // times 2^n
}

HVI_INLINE Vec log(const Vec &x)
{
  // x = 2^n m, m within sqrt(1/2) and sqrt(2);  ln m = 2 artanh((m - 1)/(m + 1))

  static constexpr unsigned long long ROOT = 0x3fe6a09e667f3bcd;    // bits of sqrt(1/2)
  const Bits up = (Bits) ((UBits) x - ROOT) >> 52;
  const Vec m = (Vec) ((UBits) x - ((UBits) up << 52));
  const Vec n = (Vec) ((UBits) up + 0x4338000000000000ull) - 0x1.8p52;
  const Vec f = (m - 1.0) / (m + 1.0), s = f * f;
  static constexpr double odd[12] = {1.0 / 3,  1.0 / 5,  1.0 / 7,  1.0 / 9,  1.0 / 11, 1.0 / 13,
                                     1.0 / 15, 1.0 / 17, 1.0 / 19, 1.0 / 21, 1.0 / 23, 1.0 / 25};
  const Vec value = n * LN2_HIGH + (2.0 * f + (2.0 * f * s * polynomial(odd, s) + n * LN2_LOW));
  return x == x ? value : x;    // NOLINT(misc-redundant-expression): a NaN stays
}

}    // namespace HVI

#endif
