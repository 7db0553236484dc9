/* ----------------------------------------------------------------------
  lammps-hvi: hypervelocity impact for LAMMPS, GNU GPL version 2, see LICENSE
  Resistance of hexahedra to hourglasses.
------------------------------------------------------------------------- */

#include "hexahedra.h"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

using namespace HVI_TEST;

namespace {

// an element with what it resists hourglasses by

struct Element {
  Nodes x, v, f = Nodes::Zero();
  Tensor L = Tensor::Zero();
  double rho = 1.7, c = 2.3, viscous = 0.0, stiff = 0.0, dt = 0.0;
  Vec Q[12] = {};

  double resist()    // returns the power
  {
    HexNodes X, U, B, F;
    Vec l[9];
    spread(x, X);
    spread(v, U);
    spread(f, F);
    for (int k = 0; k < 9; k++) l[k] = Vec{} + L(k / 3, k % 3);
    const Vec V = hex_gradient(X, B), one = Vec{} + 1.0;
    const Vec power =
        hex_hourglass(X, U, B, V, rho * one, c * one, l, viscous, stiff * one, dt, Q, F);
    f = lane(F);
    return power[0];
  }
};

int sign(int mode, int a)
{
  const int *s = CORNER[a];
  return mode == 3 ? s[0] * s[1] * s[2] : s[(mode + 1) % 3] * s[(mode + 2) % 3];
}

// one of its modes, less what of it is linear in x

Eigen::Matrix<double, CORNERS, 1> gamma(int mode, const Nodes &x)
{
  Nodes B;
  const double V = gradient(x, B);
  Eigen::Matrix<double, CORNERS, 1> shape;
  for (int a = 0; a < CORNERS; a++) shape[a] = sign(mode, a);
  const Eigen::Vector3d slope = x * shape / V;
  return shape - B.transpose() * slope;
}

}    // namespace

// no motion that is linear in x, turning among them, feels it

TEST(Hourglass, Linear)
{
  for (int n = 0; n < TRIES; n++) {
    Element e;
    e.x = distorted();
    const Tensor A = random_tensor();
    e.L = n % 2 ? A : A - A.transpose();
    e.v = (e.L * e.x).colwise() + Eigen::Vector3d(any(), any(), any());
    e.viscous = e.stiff = 1.0;
    e.dt = 0.1;
    EXPECT_LT(std::fabs(e.resist()), 1e-25);
    EXPECT_LT(e.f.norm(), 1e-12);
  }
}

// beside a sum over all modes and corners, written out

TEST(Hourglass, Forces)
{
  for (int n = 0; n < TRIES; n++) {
    Element e;
    e.x = distorted();
    e.v = random_nodes();
    e.viscous = 0.1;
    e.stiff = n % 2 ? 0.25 : 0.0;
    e.dt = 0.01;
    Nodes B, f = Nodes::Zero();
    double work = 0.0;
    const double V = gradient(e.x, B), drag = 0.1 * e.rho * e.c * std::cbrt(V * V) / 4.0;
    const double step = e.stiff * e.rho * e.c * e.c * B.squaredNorm() / (24.0 * V) * e.dt;
    for (int mode = 0; mode < 4; mode++) {
      const Eigen::Vector3d rate = e.v * gamma(mode, e.x);
      Eigen::Vector3d Q = step * rate;
      for (int i = 0; i < 3 && e.stiff > 0.0; i++) {
        const double old = any();
        e.Q[3 * mode + i] += old;
        Q[i] += old;
      }
      f -= (drag * rate + Q) * gamma(mode, e.x).transpose();
      work += (drag * rate + Q - 0.5 * step * rate).dot(rate);
    }
    const double power = e.resist();
    EXPECT_LT((e.f - f).norm(), 1e-13 * f.norm());
    EXPECT_NEAR(power, work, 1e-13);
    EXPECT_LT(e.f.rowwise().sum().norm(), 1e-13);
    EXPECT_LT((e.x * e.f.transpose()).norm(), 1e-13);
    if (e.stiff == 0.0) { EXPECT_GT(power, 0.0); }
  }
}

// adds to the forces; no time, no change; without stiffness nothing is left of Q, lane by lane

TEST(Hourglass, State)
{
  Element e;
  e.x = distorted();
  e.v = random_nodes();
  e.L = random_tensor();
  e.viscous = 0.1;
  Element other = e;
  other.f = random_nodes();
  const Nodes before = other.f;
  e.resist();
  other.resist();
  EXPECT_LT((other.f - before - e.f).norm(), 1e-15);

  HexNodes x, v, B, f = {};
  Vec Q[12], old[12], L[9], stiff = Vec{} + 0.2;
  const Vec one = Vec{} + 1.0;
  stiff[1] = 0.0;
  spread(e.x, x);
  spread(e.v, v);
  for (int k = 0; k < 9; k++) L[k] = Vec{} + any();
  for (int k = 0; k < 12; k++) Q[k] = old[k] = Vec{} + any();
  const Vec V = hex_gradient(x, B);
  hex_hourglass(x, v, B, V, one, one, L, 0.1, stiff, 0.0, Q, f);
  for (int k = 0; k < 12; k++)
    for (int l = 0; l < LANES; l++) EXPECT_EQ(Q[k][l], l == 1 ? 0.0 : old[k][l]);
}

// error of the forces of an element that turns by a right angle, with a Q as it is or with
// hourglasses that grow at a constant rate

static double turned(int steps, bool growing)
{
  Element e;
  std::mt19937_64 random(3);
  auto draw = [&] {
    return std::uniform_real_distribution<double>(-1.0, 1.0)(random);
  };
  const Nodes x0 = cube(1.0) + 0.1 * Nodes::NullaryExpr(draw), v0 = Nodes::NullaryExpr(draw);
  const Eigen::Vector3d axis = Eigen::Vector3d(1.0, 2.0, -0.5).normalized();
  e.dt = 0.5 * M_PI / steps;    // spin 1
  e.stiff = 0.25;
  e.L = cross(axis);
  Nodes B, force = Nodes::Zero();
  const double V = gradient(x0, B), T = 0.5 * M_PI;
  const double C = e.stiff * e.rho * e.c * e.c * B.squaredNorm() / (24.0 * V);
  const Tensor R = Eigen::AngleAxisd(T, axis).toRotationMatrix();
  double size = 0.0;
  for (int mode = 0; mode < 4; mode++) {
    Eigen::Vector3d Q = Eigen::Vector3d::Zero();
    if (!growing) Q = Eigen::Vector3d::NullaryExpr(draw);
    for (int i = 0; i < 3; i++) e.Q[3 * mode + i] = Vec{} + Q[i];
    size += Q.squaredNorm();
    if (growing) Q += C * T * (v0 * gamma(mode, x0));
    force -= R * Q * gamma(mode, x0).transpose();
  }
  for (int n = 0; n < steps; n++) {
    const Tensor middle = Eigen::AngleAxisd((n + 0.5) * e.dt, axis).toRotationMatrix();
    e.x = Eigen::AngleAxisd((n + 1) * e.dt, axis).toRotationMatrix() * x0;
    e.v = e.L * e.x;
    if (growing) e.v += middle * v0;
    e.f.setZero();
    e.resist();
  }
  double end = 0.0;
  for (const Vec &q : e.Q) end += q[0] * q[0];
  if (!growing) { EXPECT_NEAR(end / size, 1.0, 1e-12); }
  return (e.f - force).norm() / force.norm();
}

TEST(Hourglass, StiffnessTurns)
{
  for (const bool growing : {false, true}) {
    const double coarse = turned(500, growing), fine = turned(1000, growing);
    EXPECT_LT(fine, 5e-7) << growing;
    EXPECT_NEAR(coarse / fine, 4.0, 0.02) << growing;
  }
}

// what hourglasses that vibrate have given: as much as is in Q, however long

TEST(Hourglass, EnergyOfVibration)
{
  Element e;
  e.x = cube(1.0);
  e.rho = e.c = 1.0;
  e.stiff = 0.25;
  e.dt = 0.3;
  e.v = Nodes::Zero();
  const double mass = e.rho / CORNERS;
  for (int a = 0; a < CORNERS; a++) e.v(0, a) = 0.1 * sign(4, a);
  const double start = 0.5 * mass * e.v.squaredNorm();
  double taken = 0.0, largest = 0.0;
  for (int n = 0; n < 1000; n++) {
    const Nodes before = e.v;
    e.f.setZero();
    taken += e.dt * e.resist();
    e.v += e.dt / mass * e.f;
    largest = std::max(largest, taken);
    EXPECT_NEAR(taken + 0.5 * mass * before.cwiseProduct(e.v).sum(), start, 1e-12 * start);
  }
  EXPECT_NEAR(largest, start, 0.05 * start);
}

// a square piece of a plate, bent

TEST(Hourglass, BendsAsPlate)
{
  const double K = 76.7, G = 27.6, edge = 0.3, u = 1e-3;    // aluminum
  const double E = 9.0 * K * G / (3.0 * K + G), nu = (3.0 * K - 2.0 * G) / (6.0 * K + 2.0 * G);
  Element e;
  e.x = cube(edge);
  e.rho = 2.7;
  e.c = std::sqrt((K + 4.0 / 3.0 * G) / e.rho);
  e.stiff = hex_stiffness(K, G);
  e.dt = 1.0;
  e.v = Nodes::Zero();
  for (int a = 0; a < CORNERS; a++) e.v(0, a) = u * CORNER[a][0] * CORNER[a][2];
  const double energy = e.resist(), curvature = 4.0 * u / (edge * edge);
  const double D = E * edge * edge * edge / (12.0 * (1.0 - nu * nu));
  EXPECT_NEAR(energy / (0.5 * D * curvature * curvature * edge * edge), 1.0, 1e-12);
  EXPECT_NEAR(e.stiff, 0.245, 5e-4);
  EXPECT_EQ(hex_stiffness(K, 0.0), 0.0);
}
