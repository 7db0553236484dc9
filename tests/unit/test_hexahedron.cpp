/* ----------------------------------------------------------------------
  lammps-hvi: hypervelocity impact for LAMMPS, GNU GPL version 2, see LICENSE
  Hexahedra: gradients, forces, viscosity, lengths, shapes, subcells.
------------------------------------------------------------------------- */

#include "hexahedra.h"

#include <cmath>
#include <gtest/gtest.h>

using namespace HVI_TEST;

// Gauss's rule with two points in each direction is exact for the Jacobian of a trilinear map

TEST(Hexahedron, Volume)
{
  for (int n = 0; n < TRIES; n++) {
    const Nodes x = distorted();
    double V = 0.0;
    for (int p = 0; p < CORNERS; p++) {
      Tensor J = Tensor::Zero();
      for (int a = 0; a < CORNERS; a++) {
        double N[3], slope[3];
        for (int d = 0; d < 3; d++) {
          N[d] = 0.5 * (1.0 + CORNER[a][d] * CORNER[p][d] / std::sqrt(3.0));
          slope[d] = 0.5 * CORNER[a][d];
        }
        const Eigen::Vector3d grad(slope[0] * N[1] * N[2], N[0] * slope[1] * N[2],
                                   N[0] * N[1] * slope[2]);
        J += x.col(a) * grad.transpose();
      }
      ASSERT_GT(J.determinant(), 0.0);
      V += J.determinant();
    }
    EXPECT_NEAR(volume(x), V, 1e-14);
  }
  EXPECT_DOUBLE_EQ(volume(cube(3.0)), 27.0);
  Nodes inside_out = cube(1.0);
  inside_out.row(0) *= -1.0;
  EXPECT_DOUBLE_EQ(volume(inside_out), -1.0);
}

// V is linear in each coordinate: central differences are exact

TEST(Hexahedron, Gradient)
{
  for (int n = 0; n < TRIES; n++) {
    const Nodes x = distorted();
    Nodes B;
    const double V = gradient(x, B);
    for (int d = 0; d < 3; d++)
      for (int a = 0; a < CORNERS; a++) {
        Nodes low = x, high = x;
        low(d, a) -= 0.125;
        high(d, a) += 0.125;
        EXPECT_NEAR(B(d, a), (volume(high) - volume(low)) / 0.25, 1e-13);
      }
    EXPECT_LT(B.rowwise().sum().norm(), 1e-15);
    EXPECT_LT((x * B.transpose() - V * Tensor::Identity()).norm(), 1e-14);
  }
}

// a small element far from the origin: what is lost is what its coordinates have lost

TEST(Hexahedron, FarAway)
{
  const Nodes x = distorted(0x1p-10);
  Nodes B, far, rounded;
  const Eigen::Vector3d offset(256.0, -256.0, 512.0);
  const Nodes moved = x.colwise() + offset;
  rounded = moved.colwise() - offset;
  const double V = gradient(rounded, B);
  EXPECT_DOUBLE_EQ(gradient(moved, far), V);
  EXPECT_LT((far - B).norm(), 1e-14 * B.norm());
}

TEST(Hexahedron, UniformVelocityGradient)
{
  for (int n = 0; n < TRIES; n++) {
    const Nodes x = distorted();
    const Tensor A = random_tensor(), spin = A - A.transpose();
    EXPECT_LT((velocity_gradient(x, A * x) - A).norm(), 1e-13);
    const Tensor L = velocity_gradient(x, (spin * x).colwise() + A.col(0));
    EXPECT_LT((L + L.transpose()).norm(), 1e-13);
    EXPECT_LT((L - spin).norm(), 1e-13);
  }
}

// virtual work, momentum, and with a symmetric stress moments

TEST(Hexahedron, Forces)
{
  for (int n = 0; n < TRIES; n++) {
    const Nodes x = distorted(), v = random_nodes();
    const Tensor s = random_tensor(), symmetric = s + s.transpose();
    const double work = s.cwiseProduct(velocity_gradient(x, v)).sum() * volume(x);
    EXPECT_NEAR(forces(x, s).cwiseProduct(v).sum(), -work, 1e-13);
    EXPECT_LT(forces(x, s).rowwise().sum().norm(), 1e-14);
    const Tensor moment = x * forces(x, symmetric).transpose();
    EXPECT_LT((moment - moment.transpose()).norm(), 1e-13);
  }
}

TEST(Hexahedron, BulkViscosity)
{
  const double rho = 2.7, c = 5.3, V = 0.027, trace = -0.4, q1 = 1.5, q2 = 0.06;
  const Vec one = Vec{} + 1.0;
  Vec rate = one * trace, speed;
  rate[1] = 0.4;
  const Vec q = hex_bulk_viscosity(rho * one, c * one, V * one, rate, q1, q2, speed);
  const double closing = 0.3 * 0.4;
  EXPECT_NEAR(speed[0], q1 * q1 * closing + q2 * c, 1e-14);
  EXPECT_NEAR(q[0], rho * closing * (q1 * q1 * closing + q2 * c), 1e-14);
  EXPECT_EQ(speed[1], 0.0);
  EXPECT_EQ(q[1], 0.0);
  const Vec bad = hex_bulk_viscosity(rho * one, c * one, V * one, one * NAN, q1, q2, speed);
  EXPECT_TRUE(std::isnan(bad[0]) && std::isnan(speed[0]));
  for (const double x : {1e-30, 1e-12, 0.9, 1.0, 8.0, 1e9})
    EXPECT_NEAR(cube_root(x * one)[0] / std::cbrt(x), 1.0, 1e-14);
  EXPECT_TRUE(std::isnan(cube_root(-one)[0]) && std::isnan(cube_root(0.0 * one)[0]));
}

// highest frequency of an elastic element with an eighth of its mass at each corner, by iteration

static double highest(const Nodes &x, double lambda, double mu)
{
  const double m = volume(x) / CORNERS;
  Nodes u = random_nodes();
  double square = 0.0;
  for (int n = 0; n < 300; n++) {
    const Tensor L = velocity_gradient(x, u);
    const Tensor s = lambda * L.trace() * Tensor::Identity() + mu * (L + L.transpose());
    const Nodes next = forces(x, s) * (-1.0 / m);
    square = next.norm() / u.norm();
    u = next / next.norm();
  }
  return std::sqrt(square);
}

TEST(Hexahedron, Length)
{
  auto length = [](const Nodes &x) {
    HexNodes X, B;
    spread(x, X);
    const Vec V = hex_gradient(X, B);
    return hex_length(V, B)[0];
  };
  EXPECT_NEAR(length(cube(0.7)), 0.7 / std::sqrt(3.0), 1e-15);
  EXPECT_NEAR(length(cube(0.7)) * highest(cube(0.7), 1.0, 0.0), 2.0, 1e-12);    // sharp: a liquid
  for (int n = 0; n < 10; n++) {
    Nodes x = distorted();
    x.row(0) *= any(0.1, 1.0);
    const double stable = length(x) * highest(x, 1.0, 0.5) / std::sqrt(2.0);    // c^2 = 2
    EXPECT_LE(stable, 2.0);
    EXPECT_GT(stable, 1.0);
  }
}

static HexShape shape(const Nodes &x)
{
  double flat[CORNERS][3];
  for (int a = 0; a < CORNERS; a++)
    for (int d = 0; d < 3; d++) flat[a][d] = x(d, a);
  return hex_shape(flat);
}

TEST(Hexahedron, Shape)
{
  EXPECT_DOUBLE_EQ(shape(cube(0.3)).jacobian, 1.0);
  EXPECT_DOUBLE_EQ(shape(cube(0.3)).edges, 1.0);

  Nodes x = cube(1.0);
  x.row(2) *= 5.0;
  EXPECT_DOUBLE_EQ(shape(x).jacobian, 1.0);
  EXPECT_DOUBLE_EQ(shape(x).edges, 5.0);

  x = cube(1.0);
  x.row(0) += std::sqrt(3.0) * x.row(1);    // sheared to 30 degrees
  EXPECT_NEAR(shape(x).jacobian, 0.5, 1e-15);
  EXPECT_NEAR(shape(x).edges, 2.0, 1e-15);

  x = cube(1.0);
  x.row(1) *= -1.0;    // inside out
  EXPECT_DOUBLE_EQ(shape(x).jacobian, -1.0);

  // each corner counts: pushed through the opposite one

  for (int a = 0; a < CORNERS; a++) {
    x = cube(1.0);
    x.col(a) *= -0.5;
    EXPECT_LT(shape(x).jacobian, 0.0) << a;
  }
  x = cube(1.0);
  x.col(1) = x.col(0);    // an edge gone
  EXPECT_EQ(shape(x).jacobian, 0.0);
  EXPECT_TRUE(std::isinf(shape(x).edges));
}

TEST(Hexahedron, Subcells)
{
  for (int n = 1; n <= 4; n++) {
    const auto weights = hex_subcells(n);
    ASSERT_EQ(weights.size(), std::size_t(n * n * n));
    const Nodes x = cube(n);
    std::array<double, CORNERS> share = {};
    for (int p = 0; p < n * n * n; p++) {
      Eigen::Vector3d center = Eigen::Vector3d::Zero();
      double sum = 0.0;
      for (int a = 0; a < CORNERS; a++) {
        sum += weights[p][a];
        share[a] += weights[p][a];
        center += weights[p][a] * x.col(a);
      }
      EXPECT_NEAR(sum, 1.0, 1e-15);
      const Eigen::Vector3d cell(p % n, p / n % n, p / (n * n));
      EXPECT_LT((center - cell - Eigen::Vector3d::Constant(0.5 * (1 - n))).norm(), 1e-14);
    }
    for (int a = 0; a < CORNERS; a++) EXPECT_NEAR(share[a], n * n * n / 8.0, 1e-13);
  }
}

// the same bits in whichever lane

TEST(Hexahedron, Lanes)
{
  Nodes x[LANES], v[LANES];
  double q[LANES][12];
  for (int k = 0; k < LANES; k++) {
    x[k] = distorted();
    v[k] = random_nodes();
    for (double &number : q[k]) number = any();
  }
  std::array<double, 41> first[LANES];
  for (int turn = 0; turn < LANES; turn++) {
    HexNodes X, U, B, f;
    Vec L[9], s[9], Q[12], stiff, speed;
    for (int k = 0; k < LANES; k++) {
      const int n = (k + turn) % LANES;
      for (int d = 0; d < 3; d++)
        for (int a = 0; a < CORNERS; a++) {
          X[d][a][k] = x[n](d, a);
          U[d][a][k] = v[n](d, a);
        }
      for (int i = 0; i < 12; i++) Q[i][k] = q[n][i];
      stiff[k] = n % 2 ? 0.2 : 0.0;
    }
    const Vec V = hex_gradient(X, B), one = Vec{} + 1.0;
    hex_velocity_gradient(U, B, 1.0 / V, L);
    const Vec viscosity = hex_bulk_viscosity(one, one, V, L[0] + L[4] + L[8], 1.5, 0.06, speed);
    for (int k = 0; k < 9; k++) s[k] = L[k] - viscosity;
    hex_forces(s, B, f);
    const Vec power = hex_hourglass(X, U, B, V, one, one, L, 0.1, stiff, 0.01, Q, f);
    const Vec length = hex_length(V, B);
    for (int k = 0; k < LANES; k++) {
      const int n = (k + turn) % LANES;
      std::array<double, 41> now = {V[k], viscosity[k], speed[k], power[k], length[k]};
      for (int i = 0; i < 12; i++) now[5 + i] = Q[i][k];
      for (int i = 0; i < 24; i++) now[17 + i] = f[i / 8][i % 8][k];
      if (turn == 0) first[n] = now;
      EXPECT_EQ(first[n], now) << n << " " << k;
    }
  }
}
