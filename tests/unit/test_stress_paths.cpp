/* ----------------------------------------------------------------------
   lammps-hvi: hypervelocity impact for LAMMPS, GNU GPL version 2, see LICENSE
   Stress along paths: radial return of every law against the rate equations of plasticity,
   integrated by a Runge-Kutta method of fourth order, and against closed forms.
------------------------------------------------------------------------- */

#include "hvi_laws.h"

#include <Eigen/Dense>
#include <functional>
#include <gtest/gtest.h>

using namespace HVI;
using Eigen::Matrix3d;

namespace {

const double NONE = std::numeric_limits<double>::quiet_NaN();

Matrix3d matrix(const Deviator &s)
{
  Matrix3d m;
  m << s.xx, s.xy, s.xz, s.xy, s.yy, s.yz, s.xz, s.yz, s.zz;
  return m;
}

Matrix3d matrix(const VelocityGradient &l)
{
  Matrix3d m;
  m << l.xx, l.xy, l.xz, l.yx, l.yy, l.yz, l.zx, l.zy, l.zz;
  return m;
}

// what a path is judged by: S, plastic strain, plastic work, temperature

using State = Eigen::Matrix<double, 9, 1>;

State state(const Deviator &s, double eps, double work, double T)
{
  State y;
  y << s.xx, s.yy, s.zz, s.xy, s.xz, s.yz, eps, work, T;
  return y;
}

// a path: velocity gradient and conditions in time (the temperature of the conditions is that of
// the start, it rises by heating per work)

struct Path {
  std::function<VelocityGradient(double)> L;
  std::function<Conditions(double)> c;
  double heating, end;
  Deviator S0;
  double eps0;
};

Path path(const VelocityGradient &L, double end, const Deviator &S0, double eps0, double T = NONE,
          double heating = 0.0)
{
  return {[=](double) {
            return L;
          },
          [=](double) {
            return Conditions{2.7, 2.7, 0.0, T};
          },
          heating,
          end,
          S0,
          eps0};
}

// the package's way: elastic trial of second order (from the middle of the step), radial return

State walk(const Strength &law, const Path &path, int n)
{
  const double dt = path.end / n;
  Deviator S = path.S0;
  double eps = path.eps0, work = 0.0, rise = 0.0;
  for (int i = 0; i < n; i++) {
    const VelocityGradient L = path.L((i + 0.5) * dt);
    Conditions middle = path.c((i + 0.5) * dt), c = path.c((i + 1) * dt);
    middle.T += rise;
    c.T += rise;
    const double G = law.shear_modulus(middle);
    const Deviator half = jaumann_rate(L, G, S);
    const Matrix3d h = matrix(S) + 0.5 * dt * matrix(half);
    const Deviator rate =
        jaumann_rate(L, G, {h(0, 0), h(1, 1), h(2, 2), h(0, 1), h(0, 2), h(1, 2)});
    const Deviator trial = {S.xx + dt * rate.xx, S.yy + dt * rate.yy, S.zz + dt * rate.zz,
                            S.xy + dt * rate.xy, S.xz + dt * rate.xz, S.yz + dt * rate.yz};
    const Plastic r = law.radial_return(trial, dt, G, eps, c);
    S = r.S;
    eps += r.d_eps;
    work += r.work;
    rise += path.heating * r.work;
  }
  return state(S, eps, work, rise);
}

// its limit of small steps, by Richardson's extrapolation; order: that of the coarse walks

State limit(const Strength &law, const Path &path, int n, double *order = nullptr)
{
  constexpr int LEVELS = 6;
  State t[LEVELS];
  for (int k = 0; k < LEVELS; k++) t[k] = walk(law, path, n << k);
  const double coarse = (t[LEVELS - 2] - t[LEVELS - 3]).norm();
  const double last = (t[LEVELS - 1] - t[LEVELS - 2]).norm();
  if (order) *order = std::log2(coarse / last);
  for (int j = 1; j < LEVELS; j++)
    for (int k = LEVELS - 1; k >= j; k--) t[k] += (t[k] - t[k - 1]) / (std::pow(2.0, j) - 1.0);
  return t[LEVELS - 1];
}

// The rate equations: dS/dt = 2 G (D' - 3/2 depsdt S/s) + W S - S W.  The plastic strain rate comes
// from flow(s, eps, T, t, drive): drive = 3 G S:D/s, what ds/dt would be without plastic flow.

using FlowRate = std::function<double(double s, double eps, double T, double t, double drive)>;

State exact(const FlowRate &flow, const std::function<double(double)> &G, const Path &path, int n)
{
  struct Y {
    Matrix3d S;
    Eigen::Vector3d rest;    // eps, work, temperature
  };
  auto rates = [&](double t, const Y &y) {
    const Matrix3d L = matrix(path.L(t)), D = 0.5 * (L + L.transpose()),
                   W = 0.5 * (L - L.transpose());
    const double s = std::sqrt(1.5 * y.S.squaredNorm());
    const double drive = s > 0.0 ? 3.0 * G(t) / s * y.S.cwiseProduct(D).sum() : 0.0;
    const double rate = flow(s, y.rest[0], path.c(t).T + y.rest[2], t, drive);
    Y f;
    f.S = 2.0 * G(t) * (D - D.trace() / 3.0 * Matrix3d::Identity()) + W * y.S - y.S * W;
    if (rate > 0.0) f.S -= 3.0 * G(t) * rate / s * y.S;
    f.rest << rate, s * rate, path.heating * s * rate;
    return f;
  };
  auto ahead = [](const Y &y, double h, const Y &f) {
    return Y{y.S + h * f.S, y.rest + h * f.rest};
  };
  Y y = {matrix(path.S0), {path.eps0, 0.0, 0.0}};
  const double h = path.end / n;
  for (int i = 0; i < n; i++) {
    const double t = i * h;
    const Y k1 = rates(t, y), k2 = rates(t + 0.5 * h, ahead(y, 0.5 * h, k1)),
            k3 = rates(t + 0.5 * h, ahead(y, 0.5 * h, k2)), k4 = rates(t + h, ahead(y, h, k3));
    y.S += h / 6.0 * (k1.S + 2.0 * k2.S + 2.0 * k3.S + k4.S);
    y.rest += h / 6.0 * (k1.rest + 2.0 * k2.rest + 2.0 * k3.rest + k4.rest);
  }
  return state({y.S(0, 0), y.S(1, 1), y.S(2, 2), y.S(0, 1), y.S(0, 2), y.S(1, 2)}, y.rest[0],
               y.rest[1], y.rest[2]);
}

// relative to the size of the stress, the strain, the work, the rise of temperature

void expect_same(const State &a, const State &b, double tolerance)
{
  EXPECT_LT((a - b).head<6>().norm(), tolerance * b.head<6>().norm());
  for (int i = 6; i < 9; i++) EXPECT_LE(std::fabs(a[i] - b[i]), tolerance * std::fabs(b[i])) << i;
}

std::unique_ptr<Strength> made(const std::string &law, const std::map<std::string, double> &values)
{
  std::string problem;
  auto strength = make_strength({"strength", law, values}, problem);
  EXPECT_EQ(problem, "");
  return strength;
}

VelocityGradient shear(double rate)
{
  VelocityGradient L = {};
  L.xy = rate;
  return L;
}

VelocityGradient uniaxial(double rate)
{
  VelocityGradient L = {};
  L.xx = rate;
  return L;
}

VelocityGradient general(double f)
{
  return {0.3 * f, 0.8 * f, -0.2 * f, 0.1 * f, -0.6 * f, 0.5 * f, 0.4 * f, -0.3 * f, 0.2 * f};
}

Deviator pure_shear(double s)
{
  return {0.0, 0.0, 0.0, s / std::sqrt(3.0), 0.0, 0.0};
}

const double G = 26.0;

}    // namespace

/* ----------------------------------------------------------------------
   the elastic rate
------------------------------------------------------------------------- */

TEST(Jaumann, IsItsDefinition)
{
  const VelocityGradient L = {0.3, 0.8, -0.2, 0.1, -0.6, 0.5, 0.4, -0.3, 0.25};
  const Deviator S = {0.7, -0.2, -0.5, 0.3, -0.9, 0.4};
  const Matrix3d l = matrix(L), D = 0.5 * (l + l.transpose()), W = 0.5 * (l - l.transpose());
  const Matrix3d want =
      2.0 * G * (D - D.trace() / 3.0 * Matrix3d::Identity()) + W * matrix(S) - matrix(S) * W;
  EXPECT_LT((matrix(jaumann_rate(L, G, S)) - want).norm(), 1e-14 * want.norm());
}

// a prestressed block that turns about a tilted axis: S = R S0 R^T, reached with fourth order

TEST(Jaumann, RigidRotation)
{
  const Eigen::Vector3d axis = Eigen::Vector3d(1.0, -2.0, 0.5).normalized();
  const double omega = 3.0, end = 1.7;
  Matrix3d l;
  l << 0.0, -axis[2], axis[1], axis[2], 0.0, -axis[0], -axis[1], axis[0], 0.0;
  l *= omega;    // v = omega x r
  const VelocityGradient L = {l(0, 0), l(0, 1), l(0, 2), l(1, 0), l(1, 1),
                              l(1, 2), l(2, 0), l(2, 1), l(2, 2)};
  const Deviator S0 = {0.7, -0.2, -0.5, 0.3, -0.9, 0.4};
  const Matrix3d R = Eigen::AngleAxisd(omega * end, axis).toRotationMatrix();
  const Matrix3d want = R * matrix(S0) * R.transpose();
  ASSERT_GT((want - matrix(S0)).norm(), 0.5);
  ASSERT_GT((want - R.transpose() * matrix(S0) * R).norm(), 0.5);    // the wrong sign would show
  double error[2];
  for (int k = 0; k < 2; k++) {
    const int n = 1000 << k;
    const double h = end / n;
    auto ahead = [](const Deviator &s, double f, const Deviator &r) {
      return Deviator{s.xx + f * r.xx, s.yy + f * r.yy, s.zz + f * r.zz,
                      s.xy + f * r.xy, s.xz + f * r.xz, s.yz + f * r.yz};
    };
    Deviator S = S0;
    for (int i = 0; i < n; i++) {
      const Deviator k1 = jaumann_rate(L, G, S), k2 = jaumann_rate(L, G, ahead(S, 0.5 * h, k1)),
                     k3 = jaumann_rate(L, G, ahead(S, 0.5 * h, k2)),
                     k4 = jaumann_rate(L, G, ahead(S, h, k3));
      S = ahead(ahead(ahead(ahead(S, h / 6, k1), h / 3, k2), h / 3, k3), h / 6, k4);
    }
    error[k] = (matrix(S) - want).norm();
    EXPECT_NEAR(von_mises(S), von_mises(S0), 1e-5);
  }
  EXPECT_LT(error[1], 1e-10);
  EXPECT_NEAR(std::log2(error[0] / error[1]), 4.0, 0.1);
}

// elastic simple shear: Sxy = G sin(gamma), Sxx = -Syy = G (1 - cos(gamma))

TEST(Jaumann, SimpleShear)
{
  auto law = made("perfect", {{"G", G}, {"Y", 1e3}});
  const Path p = path(shear(2.0), 1.1, {}, 0.0);
  const State y = walk(*law, p, 4000);
  EXPECT_NEAR(y[3], G * std::sin(2.2), 1e-5 * G);
  EXPECT_NEAR(y[0], G * (1.0 - std::cos(2.2)), 1e-5 * G);
  EXPECT_NEAR(y[1], -y[0], 1e-12 * G);
  EXPECT_EQ(y[6], 0.0);
}

/* ----------------------------------------------------------------------
   paths that keep their direction and do not know rates: exact with any step
------------------------------------------------------------------------- */

// stress and plastic strain under a total equivalent strain e that grew from nothing

double hardened(double e, double A, double B, double n, double &eps)
{
  double lo = 0.0, hi = e;
  for (int k = 0; k < 200; k++) {
    eps = 0.5 * (lo + hi);
    (3.0 * G * (e - eps) > A + B * std::pow(eps, n) ? lo : hi) = eps;
  }
  return A + B * std::pow(eps, n);
}

TEST(Path, UniaxialStrain)
{
  const double A = 0.3, B = 0.2, n = 0.4;
  auto law = made("johnson-cook",
                  {{"G", G},
                   {"A", A},
                   {"B", B},
                   {"n", n},
                   {"C", 0.0},
                   {"m", 1.0},
                   {"epsdot0", 1.0},
                   {"Tref", 300.0},
                   {"Tm", 900.0},
                   {"D", 0.0},
                   {"p", 1.0}});
  for (double sign : {1.0, -1.0})
    for (int steps : {1, 3, 50}) {
      const State y = walk(*law, path(uniaxial(sign), 0.2, {}, 0.0), steps);
      double eps;
      const double s = hardened(0.2 * 2.0 / 3.0, A, B, n, eps);
      EXPECT_NEAR(y[0], sign * 2.0 / 3.0 * s, 1e-13);
      EXPECT_NEAR(y[1], -sign / 3.0 * s, 1e-13);
      EXPECT_NEAR(y[2], -sign / 3.0 * s, 1e-13);
      EXPECT_NEAR(y[6], eps, 1e-13);
    }
}

// forward, back and forward: the yield surface grows and stays centered

TEST(Path, Cyclic)
{
  const double A = 0.3, B = 0.2, n = 0.4;
  auto law = made("johnson-cook",
                  {{"G", G},
                   {"A", A},
                   {"B", B},
                   {"n", n},
                   {"C", 0.0},
                   {"m", 1.0},
                   {"epsdot0", 1.0},
                   {"Tref", 300.0},
                   {"Tm", 900.0},
                   {"D", 0.0},
                   {"p", 1.0}});
  for (int steps : {1, 7, 40}) {
    Path p = path(uniaxial(1.0), 0.1, {}, 0.0);
    double sign = 1.0, s = 0.0, eps = 0.0;    // s along the direction of the first way
    for (int leg = 0; leg < 5; leg++, sign = -sign) {
      p.L = [=](double) {
        return uniaxial(sign);
      };
      const State y = walk(*law, p, steps);
      // 3 G (e - (eps' - eps)) + sign s = Y(eps')
      const double push = 3.0 * G * 0.1 * 2.0 / 3.0 + sign * s;
      double lo = 0.0, hi = 0.2;
      for (int k = 0; k < 200; k++) {
        const double d = 0.5 * (lo + hi);
        (push - 3.0 * G * d > A + B * std::pow(eps + d, n) ? lo : hi) = d;
      }
      eps += lo;
      s = sign * (A + B * std::pow(eps, n));
      EXPECT_NEAR(y[0], 2.0 / 3.0 * s, 1e-12);
      EXPECT_NEAR(y[6], eps, 1e-12);
      p.S0 = {y[0], y[1], y[2], y[3], y[4], y[5]};
      p.eps0 = y[6];
    }
    EXPECT_GT(eps, 0.28);
  }
}

/* ----------------------------------------------------------------------
   paths that turn, know rates or heat: limits of small steps
------------------------------------------------------------------------- */

TEST(Path, PerfectInShear)
{
  auto law = made("perfect", {{"G", G}, {"Y", 0.3}});
  const FlowRate flow = [](double, double, double, double, double drive) {
    return std::max(drive, 0.0) / (3.0 * G);
  };
  // starts stressed across the shear, so that the direction turns
  const Path p = path(shear(10.0), 0.02, {0.2, -0.1, -0.1, 0.0, 0.0, 0.0}, 0.0);
  const State want = exact(
      flow,
      [](double) {
        return G;
      },
      p, 20000);
  double order;
  expect_same(limit(*law, p, 200, &order), want, 1e-10);
  EXPECT_NEAR(order, 1.0, 0.1);
}

TEST(Path, JohnsonCook)
{
  const double A = 0.3, B = 0.2, n = 0.4, C = 0.2, m = 1.3, heating = 400.0;
  const FlowRate flow = [=](double s, double eps, double T, double, double) {
    const double x = (T - 300.0) / 600.0, y = A + B * std::pow(eps, n);
    const double factor = s / (y * (1.0 - (x > 0.0 ? std::pow(x, m) : 0.0)));
    EXPECT_GT(factor, 1.0);
    return 2.0 * std::exp((factor - 1.0) / C);
  };
  auto law = made("johnson-cook",
                  {{"G", G},
                   {"A", A},
                   {"B", B},
                   {"n", n},
                   {"C", C},
                   {"m", m},
                   {"epsdot0", 2.0},
                   {"Tref", 300.0},
                   {"Tm", 900.0},
                   {"D", 0.0},
                   {"p", 1.0}});
  const Path paths[] = {
      path(shear(20.0), 0.02, pure_shear(0.45), 0.02, 350.0, heating),
      path(uniaxial(-20.0), 0.02, {-0.3, 0.15, 0.15, 0.0, 0.0, 0.0}, 0.02, 350.0, heating),
      path(general(20.0), 0.02, pure_shear(0.45), 0.02, 350.0, heating),
  };
  for (const Path &p : paths) {
    const State want = exact(
        flow,
        [](double) {
          return G;
        },
        p, 40000);
    ASSERT_GT(want[8], 5.0);
    double order;
    expect_same(limit(*law, p, 1000, &order), want, 1e-10);
    EXPECT_NEAR(order, 1.0, 0.1);
  }
}

TEST(Path, CowperSymondsCyclic)
{
  const double Y0 = 0.3, D = 40.0, p = 2.0;
  const FlowRate flow = [=](double s, double, double, double, double) {
    return s > Y0 ? D * std::pow(s / Y0 - 1.0, p) : 0.0;
  };
  auto law = made("cowper-symonds", {{"G", G}, {"Y0", Y0}, {"D", D}, {"p", p}});
  Path leg = path(uniaxial(20.0), 0.0025, {0.2, -0.1, -0.1, 0.0, 0.0, 0.0}, 0.0);
  double sign = 1.0;
  for (int k = 0; k < 3; k++) {
    const State want = exact(
        flow,
        [](double) {
          return G;
        },
        leg, 40000);
    ASSERT_GT(want[6], leg.eps0 + 0.01);
    ASSERT_LT(sign * want[1], 0.0);
    expect_same(limit(*law, leg, 1000), want, 1e-10);
    sign = -sign;
    leg.L = [=](double) {
      return general(sign * 40.0);
    };    // also turns
    leg.S0 = {want[0], want[1], want[2], want[3], want[4], want[5]};
    leg.eps0 = want[6];
  }
}

// compressed and heated from outside while it flows: modulus and flow stress follow p, rho and T

TEST(Path, SteinbergGuinan)
{
  const double Y0 = 0.29, Ymax = 0.68, beta = 125.0, n = 0.1, A = 6.52e-2, B = 6.16e-4;
  auto law = made("steinberg-guinan",
                  {{"G0", G},
                   {"Y0", Y0},
                   {"Ymax", Ymax},
                   {"beta", beta},
                   {"n", n},
                   {"A", A},
                   {"B", B},
                   {"Tm0", 1220.0},
                   {"g0", 1.97},
                   {"a", 1.5}});
  // time in us: 5 % compression, 20 GPa, 400 K
  auto c = [](double t) {
    return Conditions{2.7 * (1.0 + 5.0 * t), 2.7, 2000.0 * t, 300.0 + 4e4 * t};
  };
  auto ratio = [=](double t) {
    return 1.0 + A * 2000.0 * t / std::pow(1.0 + 5.0 * t, 1.0 / 3.0) - B * 4e4 * t;
  };
  auto ratio_rate = [=](double t) {
    const double eta = 1.0 + 5.0 * t;
    return A * 2000.0 * (std::pow(eta, -1.0 / 3.0) - t * 5.0 / 3.0 * std::pow(eta, -4.0 / 3.0)) -
        B * 4e4;
  };
  const FlowRate flow = [=](double, double eps, double, double t, double drive) {
    const double y = Y0 * std::pow(1.0 + beta * eps, n);
    EXPECT_LT(y, Ymax);
    const double hardening = ratio(t) * n * beta * y / (1.0 + beta * eps);
    return std::max(drive - y * ratio_rate(t), 0.0) / (3.0 * G * ratio(t) + hardening);
  };
  for (const VelocityGradient &L : {shear(20.0), uniaxial(-20.0), general(15.0)}) {
    const double s = Y0 * std::pow(1.0 + beta * 0.01, n);
    Path p = path(L, 0.01, pure_shear(L.xy == 20.0 ? s : 0.0), 0.01);
    if (L.xx < 0.0) p.S0 = {-2.0 / 3.0 * s, s / 3.0, s / 3.0, 0.0, 0.0, 0.0};
    if (L.xx > 0.0) p.S0 = {s / 3.0, -2.0 / 3.0 * s, s / 3.0, 0.0, 0.0, 0.0};
    p.c = c;
    const State want = exact(
        flow,
        [=](double t) {
          return G * ratio(t);
        },
        p, 20000);
    ASSERT_GT(want[6], 0.05);
    expect_same(limit(*law, p, 500), want, 1e-10);
  }
}

// at Ymax the hardening ends

TEST(Path, SteinbergGuinanSaturates)
{
  auto law = made("steinberg-guinan",
                  {{"G0", G},
                   {"Y0", 0.29},
                   {"Ymax", 0.4},
                   {"beta", 125.0},
                   {"n", 0.1},
                   {"A", 0.0},
                   {"B", 0.0},
                   {"Tm0", 1220.0},
                   {"g0", 1.97},
                   {"a", 1.5}});
  const double at = (std::pow(0.4 / 0.29, 10.0) - 1.0) / 125.0;    // plastic strain there
  const Conditions c = {2.7, 2.7, 0.0, 300.0};
  EXPECT_NEAR(law->yield(at, 0.0, c), 0.4, 1e-14);
  EXPECT_LT(law->yield(0.99 * at, 0.0, c), 0.3999);
  EXPECT_EQ(law->yield(1.01 * at, 0.0, c), 0.4);
  const State y = walk(*law, path(uniaxial(1.0), 1.0, {}, 0.0), 3);
  EXPECT_NEAR(1.5 * y[0], 0.4, 1e-14);
  EXPECT_NEAR(y[6], 2.0 / 3.0 - 0.4 / (3.0 * G), 1e-13);
}

// Adiabatic: Y = A (1 - T*) and dT = heating Y deps give Y = A exp(-k eps), work A (1 - Y/A)/k,
// k = heating A/(Tm - Tref)

TEST(Path, AdiabaticShear)
{
  const double A = 0.3, heating = 1500.0, k = heating * A / 600.0;
  auto law = made("johnson-cook",
                  {{"G", G},
                   {"A", A},
                   {"B", 0.0},
                   {"n", 1.0},
                   {"C", 0.0},
                   {"m", 1.0},
                   {"epsdot0", 1.0},
                   {"Tref", 300.0},
                   {"Tm", 900.0},
                   {"D", 0.0},
                   {"p", 1.0}});
  VelocityGradient L = {};
  L.xy = L.yx = 10.0;    // pure shear: no spin
  const Path p = path(L, 0.1, pure_shear(A), 0.0, 300.0, heating);
  double order;
  const State y = limit(*law, p, 200, &order);
  const double s = std::sqrt(3.0) * y[3];
  EXPECT_GT(y[6], 1.0);
  EXPECT_NEAR(s, A * std::exp(-k * y[6]), 1e-9 * A);
  EXPECT_NEAR(y[7], (A - s) / k, 1e-9 * A);
  EXPECT_NEAR(y[8], 600.0 * (1.0 - s / A), 1e-7);
  // all strain is elastic or plastic: 2 G (dgamma/2 ...) gives ds = 3 G (e - eps), e = 2/sqrt(3) 10 t
  EXPECT_NEAR(y[6], 2.0 / std::sqrt(3.0) - (s - A) / (3.0 * G), 1e-9);
  EXPECT_NEAR(order, 1.0, 0.1);
}
