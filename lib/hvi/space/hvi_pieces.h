/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_PIECES_H
#define LMP_HVI_PIECES_H

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

// fragments: how large the one is that a particle of the matter is in; the n^3 equal parts of a cube of side 1,
// turned at random

namespace HVI {

class Pieces {
 public:
  // their middles, whose mean is 0; the same number turns them the same way

  static std::vector<std::array<double, 3>> places(int n, uint64_t number)
  {
    double turn[3][3];
    rotation(number, turn);
    std::vector<std::array<double, 3>> found;
    found.reserve(n * n * n);
    for (int i = 0; i < n; i++)
      for (int j = 0; j < n; j++)
        for (int k = 0; k < n; k++) {
          const double c[3] = {middle(i, n), middle(j, n), middle(k, n)};
          found.push_back({});
          for (int a = 0; a < 3; a++)
            for (int b = 0; b < 3; b++) found.back()[a] += turn[a][b] * c[b];
        }
    return found;
  }

  // mean of the squares of their distances from the middle of the cube

  static double mean_square(int n) { return 0.25 * (1.0 - 1.0 / (n * n)); }

  // the largest of these distances

  static double corner(int n) { return std::sqrt(0.75) * (1.0 - 1.0 / n); }

  // Width of the fragment that matter is in over that of a fragment of the mean mass, at random by a number.
  // Numbers of fragments go as exp(-m/m0) over their mass m (Grady & Kipp, J. Appl. Phys. 58 (1985) 1210), mass
  // as m/m0 exp(-m/m0): the sum of two exponential variables.

  static double width(uint64_t number)
  {
    uint64_t state = ~number;    // not the numbers of the turn
    const double u = 1.0 - uniform(state), v = 1.0 - uniform(state);
    return std::cbrt(-std::log(u * v));
  }

 private:
  static double middle(int i, int n) { return (i + 0.5) / n - 0.5; }

  // Steele, Lea & Flood, OOPSLA 2014: splitmix64; from 0 to 1

  static double uniform(uint64_t &state)
  {
    uint64_t z = (state += 0x9e3779b97f4a7c15);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return ((z ^ (z >> 31)) >> 11) * 0x1p-53;
  }

  // all directions alike: Shoemake, Graphics Gems III (1992) 124

  static void rotation(uint64_t number, double (*turn)[3])
  {
    const double u = uniform(number), a = 2.0 * M_PI * uniform(number),
                 b = 2.0 * M_PI * uniform(number);
    const double x = std::sqrt(1.0 - u) * std::sin(a), y = std::sqrt(1.0 - u) * std::cos(a),
                 z = std::sqrt(u) * std::sin(b), w = std::sqrt(u) * std::cos(b);
    const double r[3][3] = {
        {1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - z * w), 2.0 * (x * z + y * w)},
        {2.0 * (x * y + z * w), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - x * w)},
        {2.0 * (x * z - y * w), 2.0 * (y * z + x * w), 1.0 - 2.0 * (x * x + y * y)}};
    for (int k = 0; k < 9; k++) turn[k / 3][k % 3] = r[k / 3][k % 3];
  }
};

}    // namespace HVI

#endif
