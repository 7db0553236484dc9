/* ----------------------------------------------------------------------
  lammps-hvi: hypervelocity impact for LAMMPS, GNU GPL version 2, see LICENSE
  Elements to test, as matrices of Eigen's; one in all lanes.
------------------------------------------------------------------------- */

#ifndef HVI_TEST_HEXAHEDRA_H
#define HVI_TEST_HEXAHEDRA_H

#include "hvi_hexahedron.h"

// GCC 12 takes its own header of AVX-512 for uninitialized where Eigen sums

#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wuninitialized"
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif

#include <Eigen/Dense>
#include <random>

namespace HVI_TEST {

using namespace HVI;

typedef Eigen::Matrix<double, 3, CORNERS> Nodes;
typedef Eigen::Matrix3d Tensor;

static constexpr int TRIES = 50;

inline double any(double low = -1.0, double high = 1.0)
{
  static std::mt19937_64 random(7);
  return std::uniform_real_distribution<double>(low, high)(random);
}

inline Nodes random_nodes(double size = 1.0)
{
  return Nodes::NullaryExpr([&] {
    return any(-size, size);
  });
}

inline Tensor random_tensor()
{
  return Tensor::NullaryExpr([] {
    return any();
  });
}

inline Nodes cube(double edge)
{
  Nodes x;
  for (int a = 0; a < CORNERS; a++)
    for (int d = 0; d < 3; d++) x(d, a) = 0.5 * edge * CORNER[a][d];
  return x;
}

// far from parallelepipeds, but none turned inside out

inline Nodes distorted(double size = 1.0)
{
  return size * (cube(1.0) + random_nodes(0.17));
}

inline Tensor cross(const Eigen::Vector3d &w)
{
  Tensor W;
  W << 0.0, -w[2], w[1], w[2], 0.0, -w[0], -w[1], w[0], 0.0;
  return W;
}

// one element in all lanes

inline void spread(const Nodes &from, HexNodes &to)
{
  for (int d = 0; d < 3; d++)
    for (int a = 0; a < CORNERS; a++) to[d][a] = Vec{} + from(d, a);
}

inline Nodes lane(const HexNodes &from, int k = 0)
{
  Nodes to;
  for (int d = 0; d < 3; d++)
    for (int a = 0; a < CORNERS; a++) to(d, a) = from[d][a][k];
  return to;
}

inline double gradient(const Nodes &x, Nodes &B)
{
  HexNodes in, out;
  spread(x, in);
  const Vec V = hex_gradient(in, out);
  B = lane(out);
  return V[0];
}

inline double volume(const Nodes &x)
{
  Nodes B;
  return gradient(x, B);
}

inline Tensor velocity_gradient(const Nodes &x, const Nodes &v)
{
  HexNodes X, U, B;
  Vec L[9];
  Tensor out;
  spread(x, X);
  spread(v, U);
  const Vec V = hex_gradient(X, B);
  hex_velocity_gradient(U, B, 1.0 / V, L);
  for (int k = 0; k < 9; k++) out(k / 3, k % 3) = L[k][0];
  return out;
}

inline Nodes forces(const Nodes &x, const Tensor &stress)
{
  HexNodes X, B, f;
  Vec s[9];
  spread(x, X);
  hex_gradient(X, B);
  for (int k = 0; k < 9; k++) s[k] = Vec{} + stress(k / 3, k % 3);
  hex_forces(s, B, f);
  return lane(f);
}

}    // namespace HVI_TEST

#endif
