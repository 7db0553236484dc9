/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_HEXAHEDRON_H
#define LMP_HVI_HEXAHEDRON_H

#include "hvi_vector_math.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace HVI {

/* ----------------------------------------------------------------------
   Hexahedra of eight nodes, LANES at a time, with one strain and one stress each: the mean of
   those of the trilinear element over its volume, and resistance to the twelve motions that have
   no mean (hourglasses), after Flanagan & Belytschko, Int. J. Numer. Meth. Eng. 17 (1981) 679.
   Corners as in VTK and Abaqus: 0 to 3 around the bottom, 4 to 7 above them.

   What is of the corners, a = 0 ... 7, has as many modes: the values at the corners, 1 or -1, of

     1   xi   eta   zeta   eta zeta   zeta xi   xi eta   xi eta zeta

   in the coordinates of the cube that the element is mapped from.  The last four are the hourglasses.
------------------------------------------------------------------------- */

static constexpr int CORNERS = 8;
static constexpr int MODES = 7;        // all but the first
static constexpr int HOURGLASS = 3;    // the first of them

typedef Vec HexNodes[3][CORNERS];    // a component of all corners

static constexpr int CORNER[CORNERS][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                           {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};

// sums over the corners of the modes times x: differences first, wherever the element is

HVI_INLINE void hex_modes(const Vec (&x)[CORNERS], Vec (&m)[MODES])
{
  const Vec d0 = x[1] - x[0], d1 = x[2] - x[3], d2 = x[5] - x[4], d3 = x[6] - x[7];
  const Vec e0 = (x[3] - x[0]) + (x[2] - x[1]), e1 = (x[7] - x[4]) + (x[6] - x[5]);
  m[0] = (d0 + d1) + (d2 + d3);
  m[1] = e0 + e1;
  m[2] = (x[4] - x[0]) + (x[5] - x[1]) + (x[6] - x[2]) + (x[7] - x[3]);
  m[3] = e1 - e0;
  m[4] = (d2 + d3) - (d0 + d1);
  m[5] = (d1 - d0) + (d3 - d2);
  m[6] = (d3 - d2) - (d1 - d0);
}

// at the corners, what is the sum of the modes times m

HVI_INLINE void hex_corners(const Vec (&m)[MODES], Vec (&x)[CORNERS])
{
  // even and odd in xi, on each edge along it

  const Vec even[4] = {m[3] - m[1] - m[2], m[1] - m[2] - m[3], m[2] - m[1] - m[3],
                       m[1] + m[2] + m[3]};
  const Vec odd[4] = {m[0] - m[4] - m[5] + m[6], m[0] - m[4] + m[5] - m[6],
                      m[0] + m[4] - m[5] - m[6], m[0] + m[4] + m[5] + m[6]};
  x[0] = even[0] - odd[0];
  x[1] = even[0] + odd[0];
  x[2] = even[1] + odd[1];
  x[3] = even[1] - odd[1];
  x[4] = even[2] - odd[2];
  x[5] = even[2] + odd[2];
  x[6] = even[3] + odd[3];
  x[7] = even[3] - odd[3];
}

/* ----------------------------------------------------------------------
   B = dV/dx of all corners, and the volume V = sum x_a B_xa.  V is the integral of the determinant
   of the Jacobian over the cube; of its products of modes only those stay that are even in xi, eta and
   zeta.  With the modes b of B_x and y, z of the other two components, where k, i, j are xi, eta, zeta
   or in cyclic order, and ij is the mode i times j:

     64 b_k = y_i z_j - y_j z_i + (y_ki z_kj - y_kj z_ki)/3
     192 b_ij = y_j z_kj - y_kj z_j + y_ki z_i - y_i z_ki

   These are the same B that Flanagan & Belytschko write out for each corner, in 0.56 of the time.
------------------------------------------------------------------------- */

HVI_INLINE Vec hex_gradient(const HexNodes &x, HexNodes &B)
{
  Vec m[3][MODES], V;
  for (int d = 0; d < 3; d++) hex_modes(x[d], m[d]);
  for (int d = 0; d < 3; d++) {
    const Vec(&y)[MODES] = m[(d + 1) % 3], (&z)[MODES] = m[(d + 2) % 3];
    Vec b[MODES];
    for (int k = 0; k < 3; k++) {
      const int i = (k + 1) % 3, j = (k + 2) % 3, ki = 3 + j, kj = 3 + i;
      b[k] = (y[i] * z[j] - y[j] * z[i]) * (1.0 / 64.0) +
          (y[ki] * z[kj] - y[kj] * z[ki]) * (1.0 / 192.0);
      b[3 + k] = ((y[j] * z[kj] - y[kj] * z[j]) + (y[ki] * z[i] - y[i] * z[ki])) * (1.0 / 192.0);
    }
    b[6] = Vec{};
    if (d == 0) {
      V = m[0][0] * b[0];
      for (int k = 1; k < 6; k++) V += m[0][k] * b[k];
    }
    hex_corners(b, B[d]);
  }
  return V;
}

// L_ij = dv_i/dx_j in L[3 * i + j], the mean over the volume

HVI_INLINE void hex_velocity_gradient(const HexNodes &v, const HexNodes &B, const Vec &inverse_V,
                                      Vec L[9])
{
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) {
      Vec l = v[i][0] * B[j][0];
      for (int a = 1; a < CORNERS; a++) l += v[i][a] * B[j][a];
      L[3 * i + j] = l * inverse_V;
    }
}

// f_ia = - s_ij B_ja, from virtual work; s by rows, symmetric or not

HVI_INLINE void hex_forces(const Vec s[9], const HexNodes &B, HexNodes &f)
{
  for (int i = 0; i < 3; i++)
    for (int a = 0; a < CORNERS; a++)
      f[i][a] = -(s[3 * i] * B[0][a] + s[3 * i + 1] * B[1][a] + s[3 * i + 2] * B[2][a]);
}

HVI_INLINE Vec hex_square(const HexNodes &B)    // B:B
{
  Vec s = Vec{};
  for (int d = 0; d < 3; d++)
    for (int a = 0; a < CORNERS; a++) s += B[d][a] * B[d][a];
  return s;
}

// time that a signal of speed 1 needs: 2/omega, with the bound omega^2 <= 8 c^2 B:B/V^2 for corners of
// an eighth of the mass each

HVI_INLINE Vec hex_length(const Vec &V, const HexNodes &B)
{
  return V / sqrt(2.0 * hex_square(B));
}

// a third of the time of the C library's for each lane; not a number without a volume

HVI_INLINE Vec cube_root(const Vec &V)
{
  return V > 0.0 ? exp(log(V) * (1.0 / 3.0)) : Vec{} + NAN;
}

/* ----------------------------------------------------------------------
   Pressure of the bulk viscosity of von Neumann & Richtmyer, J. Appl. Phys. 21 (1950) 232, and
   Landshoff, LA-1930 (1955), where the element is compressed, tr L < 0:

     q = rho l |tr L| (q1^2 l |tr L| + q2 c)   l = V^(1/3)

   and the speed in the brackets, by which the stable step is shorter:

     length/(speed + sqrt(speed^2 + c^2))
------------------------------------------------------------------------- */

HVI_INLINE Vec hex_bulk_viscosity(const Vec &rho, const Vec &c, const Vec &V, const Vec &trace,
                                  double q1, double q2, Vec &speed)
{
  const Vec closing = trace >= 0.0 ? Vec{} : -trace * cube_root(V);
  speed = trace >= 0.0 ? Vec{} : q1 * q1 * closing + q2 * c;
  return rho * closing * speed;
}

/* ----------------------------------------------------------------------
   Resistance to hourglasses.  With their modes Gamma, and gamma = Gamma less its linear part,

     gamma_a = Gamma_a - B_ja (x_jb Gamma_b)/V     q'_i = v_ia gamma_a     f_ia = - F_i gamma_a
     F = Q + viscous rho c V^(2/3)/4 q'            Q' = W Q + stiff rho c^2 B:B/(24 V) q'

   so that motions that are linear in x have q' = 0, of whatever element.  The drag is that of LULESH
   (LLNL-CODE-461231).  Q turns with the spin W, by the midpoint rule: L and v of the middle of the
   step, x, B and V of its end.  c is the speed of longitudinal waves.  Where stiff is 0, Q is too: what
   it held is left to the caller, which took the power.

   Adds to f.  Returns the power taken from the corners, with the mean of Q before and after the step: a force
   works on the velocities of the middles of both steps beside it, and the sum over steps is then
   what Q holds and what is lost.  With its end alone hourglasses that only vibrate would seem to take more
   and more.
------------------------------------------------------------------------- */

HVI_INLINE Vec hex_hourglass(const HexNodes &x, const HexNodes &v, const HexNodes &B, const Vec &V,
                             const Vec &rho, const Vec &c, const Vec L[9], double viscous,
                             const Vec &stiff, double dt, Vec Q[12], HexNodes &f)
{
  const Vec inverse_V = 1.0 / V, l = cube_root(V);
  const Vec drag = (0.25 * viscous) * rho * c * l * l;
  const Vec step = stiff * rho * c * c * hex_square(B) * inverse_V * (dt / 24.0);
  const auto stiffens = stiff > 0.0;

  // Cayley's rotation over dt, exactly orthogonal: Q + (t x Q + t x (t x Q)) 2/(1 + t t)

  const Vec t[3] = {(0.25 * dt) * (L[7] - L[5]), (0.25 * dt) * (L[2] - L[6]),
                    (0.25 * dt) * (L[3] - L[1])};
  const Vec turn = 2.0 / (1.0 + t[0] * t[0] + t[1] * t[1] + t[2] * t[2]);

  Vec X[3][MODES], U[3][MODES], G[9], F[3][MODES], power = Vec{};
  hex_velocity_gradient(v, B, inverse_V, G);
  for (int i = 0; i < 3; i++) {
    hex_modes(x[i], X[i]);
    hex_modes(v[i], U[i]);
    for (int k = 0; k < HOURGLASS; k++) F[i][k] = Vec{};
  }
  for (int k = 0; k < 4; k++) {
    const int m = HOURGLASS + k;
    Vec *q = Q + 3 * k, rate[3], mid[3], spun[3];
    for (int i = 0; i < 3; i++) {
      rate[i] = U[i][m] - (G[3 * i] * X[0][m] + G[3 * i + 1] * X[1][m] + G[3 * i + 2] * X[2][m]);
      mid[i] = q[i] + 0.5 * step * rate[i];
    }
    for (int i = 0; i < 3; i++) {
      const int a = (i + 1) % 3, b = (i + 2) % 3;
      spun[i] = t[a] * mid[b] - t[b] * mid[a];
    }
    for (int i = 0; i < 3; i++) {
      const int a = (i + 1) % 3, b = (i + 2) % 3;
      const Vec begin = q[i],
                end = mid[i] + turn * (spun[i] + (t[a] * spun[b] - t[b] * spun[a])) +
          0.5 * step * rate[i];
      q[i] = stiffens ? end : Vec{};
      F[i][m] = q[i] + drag * rate[i];
      power += (0.5 * (begin + q[i]) + drag * rate[i]) * rate[i];
    }
  }
  for (int i = 0; i < 3; i++) {
    Vec g[CORNERS], s[3];
    hex_corners(F[i], g);
    for (int j = 0; j < 3; j++) {
      s[j] = F[i][HOURGLASS] * X[j][HOURGLASS];
      for (int m = HOURGLASS + 1; m < MODES; m++) s[j] += F[i][m] * X[j][m];
      s[j] *= inverse_V;
    }
    for (int a = 0; a < CORNERS; a++)
      f[i][a] -= g[a] - (s[0] * B[0][a] + s[1] * B[1][a] + s[2] * B[2][a]);
  }
  return power;
}

/* ----------------------------------------------------------------------
   Factor of the stiffness above with which one element through its thickness bends as a plate does.
   A cube of edge a and u_x = u xi zeta has the energy 2 E' a u^2/3 where zeta is across the plate, and
   2 stiff rho c^2 a u^2 from Q: so E'/(3 (lambda + 2 mu)), with E' = E/(1 - nu^2).
------------------------------------------------------------------------- */

inline double hex_stiffness(double K, double G)
{
  return 4.0 * G * (3.0 * K + G) / ((3.0 * K + 4.0 * G) * (3.0 * K + 4.0 * G));
}

// of one element

inline double hex_volume(const double x[CORNERS][3])
{
  HexNodes y, B;
  for (int k = 0; k < 3; k++)
    for (int a = 0; a < CORNERS; a++) y[k][a] = Vec{} + x[a][k];
  return hex_gradient(y, B)[0];
}

// how far from a cube one element is: the smallest scaled Jacobian of its corners, 1 for right angles,
// and its longest over its shortest edge

struct HexShape {
  double jacobian, edges;
};

inline HexShape hex_shape(const double x[CORNERS][3])
{
  static constexpr int next[CORNERS][3] = {{1, 3, 4}, {2, 0, 5}, {3, 1, 6}, {0, 2, 7},
                                           {7, 5, 0}, {4, 6, 1}, {5, 7, 2}, {6, 4, 3}};
  double jacobian = 1.0, shortest = HUGE_VAL, longest = 0.0;
  for (int a = 0; a < CORNERS; a++) {
    double e[3][3], product = 1.0;
    for (int k = 0; k < 3; k++) {
      double square = 0.0;
      for (int d = 0; d < 3; d++) {
        e[k][d] = x[next[a][k]][d] - x[a][d];
        square += e[k][d] * e[k][d];
      }
      const double length = std::sqrt(square);
      shortest = std::min(shortest, length);
      longest = std::max(longest, length);
      product *= length;
    }
    double volume = 0.0;
    for (int d = 0; d < 3; d++) {
      const int m = (d + 1) % 3, n = (d + 2) % 3;
      volume += e[0][d] * (e[1][m] * e[2][n] - e[1][n] * e[2][m]);
    }
    jacobian = std::min(jacobian, product > 0.0 ? volume / product : 0.0);
  }
  return {jacobian, shortest > 0.0 ? longest / shortest : HUGE_VAL};
}

// weights of the corners, trilinear, at the centers of n^3 equal cells of the cube, x fastest

inline std::vector<std::array<double, CORNERS>> hex_subcells(int n)
{
  std::vector<std::array<double, CORNERS>> weights;
  for (int p = 0; p < n * n * n; p++) {
    const int cell[3] = {p % n, p / n % n, p / (n * n)};
    std::array<double, CORNERS> w;
    for (int a = 0; a < CORNERS; a++) {
      w[a] = 1.0;
      for (int d = 0; d < 3; d++)
        w[a] *= 0.5 * (1.0 + CORNER[a][d] * ((2 * cell[d] + 1.0) / n - 1.0));
    }
    weights.push_back(w);
  }
  return weights;
}

}    // namespace HVI

#endif
