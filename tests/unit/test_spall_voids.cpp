/* ----------------------------------------------------------------------
   lammps-hvi: hypervelocity impact for LAMMPS, GNU GPL version 2, see LICENSE
   Voids: growth against an integration of its own, any step, closing; what a solid does with them.
------------------------------------------------------------------------- */

#include "hvi_solid_model.h"
#include "hvi_spall_voids.h"

#include <cmath>
#include <gtest/gtest.h>

using namespace HVI;

namespace {

const SpallVoids LAW = {1.2e9, 1e5, 0.2, 0.075, 0.0};
const std::vector<double> AL = {2703, 5240, 1.4, 1.97, 0.48, 885};
const double RHO0 = 2703, LN = 5240.0 * 5240.0 * RHO0;

std::unique_ptr<Eos> made(const std::string &name, const std::vector<double> &args)
{
  std::string problem;
  auto eos = make_eos(name, args, problem);
  EXPECT_TRUE(eos) << problem;
  return eos;
}

double pressure_of(const Eos &eos, const SpallVoids::State &v, double rho, double e)
{
  double p, csq;
  EXPECT_TRUE(eos.evaluate(rho / (1.0 - v.phi), e, p, csq));
  return (1.0 - v.phi) * p;
}

struct Stretched {
  double peak, work, strain;    // tension; taken up per volume and stretched until D = 1
};

// stretched at a constant rate by the law in steps of that strain, and with it the work of -p dV

Stretched stretched(const SpallVoids &law, const Eos &eos, double rate, double step)
{
  SpallVoids::State v = {};
  Stretched s = {};
  double before = 0.0;
  while (v.D < 1.0 && s.strain < 1.0) {
    s.strain += step;
    law.advance(v, eos, RHO0 * std::exp(-s.strain), 0.0, 1.0, step / rate);
    const double tension = v.D < 1.0 ? -pressure_of(eos, v, RHO0 * std::exp(-s.strain), 0.0) : 0.0;
    s.peak = std::max(s.peak, tension);
    s.work += 0.5 * (before + tension) * step * std::exp(s.strain - 0.5 * step);
    before = tension;
  }
  EXPECT_NEAR(v.work * RHO0, s.work, 0.05 * s.work);
  return s;
}

// the same from the equations, p of matter in units of its own: Runge & Kutta's method on (psi, D),
// psi = -ln(1 - phi), for p_eos = K ln(rho/rho0) with K a number

Stretched exact(const SpallVoids &law, double K, double rate, double step)
{
  Stretched s = {};
  double psi = 0.0, D = 0.0;
  const auto tension = [&](double strain, double voids) {
    return std::exp(-voids) * K * (strain - voids);
  };
  const auto growth = [&](double strain, double voids, double damage) {
    const double x = tension(strain, voids) / (law.sigma * std::max(1.0 - damage, 1e-6));
    return x > 0.0 ? law.rate / rate * std::pow(x, 1.0 / law.m) : 0.0;
  };
  double before = 0.0;
  while (D < 1.0 && s.strain < 1.0) {
    // D follows phi: D = (1 - exp(-psi))/phi_c
    const auto f = [&](double strain, double voids) {
      return growth(strain, voids, (1.0 - std::exp(-voids)) / law.phi_c);
    };
    const double k1 = f(s.strain, psi), k2 = f(s.strain + 0.5 * step, psi + 0.5 * step * k1),
                 k3 = f(s.strain + 0.5 * step, psi + 0.5 * step * k2),
                 k4 = f(s.strain + step, psi + step * k3);
    psi += step / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
    s.strain += step;
    D = (1.0 - std::exp(-psi)) / law.phi_c;
    const double now = D < 1.0 ? tension(s.strain, psi) : 0.0;
    s.peak = std::max(s.peak, now);
    s.work += 0.5 * (before + now) * step * std::exp(s.strain - 0.5 * step);
    before = now;
  }
  return s;
}

// p = K ln(rho/rho0): what is stretched by psi of voids is that much less stretched itself

class Logarithmic final : public Eos {
 public:
  const char *name() const override { return "logarithmic"; }
  double rho0() const override { return RHO0; }
  double c0() const override { return 5240.0; }
  double rho_max() const override { return NO_LIMIT; }
  bool evaluate(double rho, double, double &p, double &csq) const override
  {
    p = LN * std::log(rho / RHO0);
    csq = LN / rho;
    return rho > 0.0;
  }
  double temperature(double, double) const override { return 0.0; }
};

// counts how often it is asked

class Counted final : public Eos {
 public:
  explicit Counted(std::unique_ptr<Eos> eos) : eos(std::move(eos)) {}
  const char *name() const override { return eos->name(); }
  double rho0() const override { return eos->rho0(); }
  double c0() const override { return eos->c0(); }
  double rho_max() const override { return eos->rho_max(); }
  bool evaluate(double rho, double e, double &p, double &csq) const override
  {
    count++;
    return eos->evaluate(rho, e, p, csq);
  }
  double temperature(double rho, double e) const override { return eos->temperature(rho, e); }
  mutable int count = 0;

 private:
  std::unique_ptr<Eos> eos;
};

// a solid with LAW and an equation of state that counts

struct Solid {
  std::shared_ptr<Counted> eos = std::make_shared<Counted>(made("gruneisen", AL));
  std::unique_ptr<SolidModel> model;
  SolidState s = SolidModel::blank(), *const list[1] = {&s};
  SolidInput in = {};

  Solid()
  {
    Material material;
    material.eos = eos;
    material.sections = {{"spall",
                          "voids",
                          {{"sigma", LAW.sigma},
                           {"rate", LAW.rate},
                           {"m", LAW.m},
                           {"phi_c", LAW.phi_c},
                           {"delta_c", 0.0}}}};
    SolidOptions options;
    options.strength = "none";
    options.damage = options.thermal = false;
    options.spall = Spall::VOIDS;
    std::string problem;
    model = SolidModel::make(material, options, problem);
    EXPECT_TRUE(model) << problem;
    put(1.0);
    model->start(s, in, true);
  }

  void put(double part)
  {
    in.rho = part * RHO0;
    double csq;
    EXPECT_TRUE(made("gruneisen", AL)->evaluate(in.rho, 0.0, in.p, csq));
  }
};

}    // namespace

/* ---------------------------------------------------------------------- */

// peak, energy and strain of failure of the law, of first order in the step

TEST(SpallVoids, StretchedAtAConstantRate)
{
  const Logarithmic eos;
  for (double rate : {1e4, 1e5, 1e6}) {
    const Stretched want = exact(LAW, LN, rate, 2e-7);
    double peak[3], work[3], strain[3];
    for (int k = 0; k < 3; k++) {
      const Stretched got = stretched(LAW, eos, rate, 4e-5 / (1 << k));
      peak[k] = got.peak / want.peak - 1.0;
      work[k] = got.work / want.work - 1.0;
      strain[k] = got.strain / want.strain - 1.0;
    }
    EXPECT_LT(std::fabs(peak[2]), 2e-3) << rate;
    EXPECT_LT(std::fabs(work[2]), 2e-3) << rate;
    EXPECT_LT(std::fabs(strain[2]), 2e-3) << rate;
    EXPECT_NEAR(peak[0] / peak[1], 2.0, 0.2) << rate;
    EXPECT_NEAR(peak[1] / peak[2], 2.0, 0.2) << rate;

    // measured strengths are nearly sigma (rate/1e5)^m, energy half of that times phi_c
    const double strength = LAW.sigma * std::pow(rate / LAW.rate, LAW.m);
    EXPECT_GT(want.peak, 0.90 * strength) << rate;
    EXPECT_LT(want.peak, 0.95 * strength) << rate;
    EXPECT_GT(want.work, 0.5 * strength * LAW.phi_c) << rate;
    EXPECT_LT(want.work, 0.6 * strength * LAW.phi_c) << rate;
  }
}

// whatever the step and the tension, of a law that is steep or not: (2) with the tension of the end, which is
// between none and that without voids

TEST(SpallVoids, AnyStep)
{
  for (const auto &eos :
       {made("gruneisen", AL), made("linear", {RHO0, 74e9}), made("tait", {RHO0, 5240, 7})})
    for (double m : {0.01, 0.06, 0.2, 1.0})
      for (double rate : {1.0, 1e5, 1e9})
        for (double dt : {1e-12, 1e-9, 1e-6, 1.0, 1e6})
          for (double strain : {1e-6, 1e-3, 0.03, 0.2, 0.5})
            for (double D : {0.0, 0.5, 1.0 - 1e-9}) {
              const SpallVoids law = {1.2e9, rate, m, 0.075, 0.0};
              SpallVoids::State v = {0.01, D, 0.0};
              const double rho = RHO0 * std::exp(-strain) * 0.99;
              const double without = pressure_of(*eos, v, rho, 0.0);
              law.advance(v, *eos, rho, 0.0, 1.0, dt);
              const double p = pressure_of(*eos, v, rho, 0.0),
                           grown = -std::log((1.0 - v.phi) / 0.99);
              ASSERT_GE(v.phi, 0.01);
              ASSERT_LT(v.phi, 1.0);
              ASSERT_LE(p, 1e-9 * std::fabs(without));
              if (without > -20e9) { ASSERT_GE(p, without); }
              ASSERT_GE(v.D, D);
              ASSERT_GE(v.work, 0.0);
              EXPECT_NEAR(v.D - D, (v.phi - 0.01) / 0.075, 1e-12);
              if (grown < 1e-11 || -p < 1e-7 * std::fabs(without)) continue;
              const double want = dt * rate * std::pow(-p / 1.2e9 / std::max(1.0 - D, 1e-6), 1 / m);
              EXPECT_NEAR(std::log(want / grown), 0.0, (1e-4 + 2e-10 * without / p) / m)
                  << eos->name() << " " << m << " " << rate << " " << dt << " " << strain << " "
                  << D;
            }
}

// nothing without tension; pressed shut without resistance, then as if there had been none

TEST(SpallVoids, Closing)
{
  const auto eos = made("gruneisen", AL);
  SpallVoids::State v = {};
  LAW.advance(v, *eos, RHO0 * 1.01, 0.0, 1.0, 1.0);
  EXPECT_EQ(v.phi, 0.0);
  EXPECT_EQ(v.D, 0.0);
  for (double e : {0.0, 1e4, 1e5})
    for (double rho : {0.96, 0.975, 0.99, 0.9999, 1.0, 1.05, 1.5}) {
      v = {0.05, 0.7, 3.0};
      const SpallVoids::State none = {};
      const double alone = pressure_of(*eos, none, rho * RHO0, e);
      LAW.advance(v, *eos, rho * RHO0, e, 1.0, 1e-9);
      EXPECT_EQ(v.D, 0.7);
      EXPECT_EQ(v.work, 3.0);
      if (alone >= 0.0) {
        EXPECT_EQ(v.phi, 0.0);
        EXPECT_EQ(pressure_of(*eos, v, rho * RHO0, e), alone);
      } else {
        EXPECT_GT(v.phi, 0.0);
        EXPECT_LT(v.phi, 0.05);
        EXPECT_NEAR(pressure_of(*eos, v, rho * RHO0, e), 0.0, 1e-2);
        const double least = SpallVoids::least(v.phi, *eos, rho * RHO0, e);
        EXPECT_LT(least, 0.0);    // 0 is rubble
        EXPECT_GT(least, -1e-2);
      }
    }
}

// matter spread far apart: voids open until no tension is left, not beyond, where equations of state have other roots

TEST(SpallVoids, SpreadFarApart)
{
  const auto eos = made("gruneisen", AL);
  for (double rho = 0.02; rho < 0.5; rho += 0.002)
    for (double phi : {0.0, 0.05, 0.3})
      for (double dt : {1e-9, 1e-7, 1e-5}) {
        SpallVoids::State v = {phi, 0.0, 0.0};
        const double tension = -pressure_of(*eos, v, rho * RHO0, 0.0);
        const double most = tension * std::log((1.0 - phi) / rho) / (rho * RHO0);
        const double least = LAW.advance(v, *eos, rho * RHO0, 0.0, 1.0, dt);
        ASSERT_LE(rho / (1.0 - v.phi), 1.0 + 1e-6) << rho << " " << phi << " " << dt;
        ASSERT_LT(least, 0.0);
        ASSERT_GE(v.work, 0.0);
        ASSERT_LE(v.work, most);
        ASSERT_GE(least, -tension);
      }
}

// an opening delta_c at failure, of something large

TEST(SpallVoids, Opening)
{
  SpallVoids law = LAW;
  EXPECT_EQ(law.critical(1.0), 0.075);
  law.delta_c = 1e-5;
  EXPECT_EQ(law.critical(1e-4), 0.075);
  EXPECT_DOUBLE_EQ(law.critical(1e-3), 0.01);
  const auto eos = made("gruneisen", AL);
  SpallVoids::State v = {};
  law.advance(v, *eos, RHO0 * 0.97, 0.0, 1e-3, 1e-8);
  EXPECT_GT(v.phi, 1e-5);
  EXPECT_NEAR(v.D, v.phi / 0.01, 1e-12);
}

// what it costs: evaluations of the equation of state in a step, of steps short and long; nothing of sound
// matter under pressure

TEST(SpallVoids, Evaluations)
{
  for (double strain : {1e-5, 1e-4, 1e-3, 5e-3}) {
    const Counted eos(made("gruneisen", AL));
    SpallVoids::State v = {};
    int steps = 0;
    for (double all = strain; v.D < 1.0; all += strain, steps++)
      LAW.advance(v, eos, RHO0 * std::exp(-all), 0.0, 1.0, strain / 1e5);
    EXPECT_GE(eos.count, steps);
    EXPECT_LE(eos.count, (strain < 5e-4 ? 2.1 : 3.2) * steps) << strain;
  }
  Solid solid;
  solid.put(1.001);
  solid.eos->count = 0;
  solid.model->begin_step(solid.s, solid.in);
  EXPECT_EQ(solid.s.before.p_min, -NO_LIMIT);
  EXPECT_EQ(solid.model->advance(1, solid.list, &solid.in, 1e-8), -1);
  EXPECT_EQ(solid.s.p_min, -NO_LIMIT);
  EXPECT_EQ(solid.eos->count, 0);
}

// what a step leaves is the least pressure of what has these voids; what is kept of its begin is that without

TEST(SpallVoids, LeastPressureOfASolid)
{
  const auto close = [](double got, double want) {
    return got == want || std::fabs(got - want) <= 1e-6 * std::fabs(want) + 1e-2;
  };
  Solid solid;
  for (double part : {0.99, 0.985, 0.98, 0.99, 1.0, 1.001}) {
    SolidState &s = solid.s;
    solid.put(part);
    solid.model->begin_step(s, solid.in);
    EXPECT_EQ(s.before.p_min, -NO_LIMIT);
    EXPECT_EQ(solid.model->advance(1, solid.list, &solid.in, 1e-6), -1);
    EXPECT_EQ(s.voids.phi > 0.0, part < 1.0);
    const double least = s.voids.phi > 0.0
        ? std::min(pressure_of(*solid.eos, s.voids, solid.in.rho, 0.0), -1e-300)
        : -NO_LIMIT;
    EXPECT_TRUE(close(s.p_min, least)) << part;
    EXPECT_EQ(s.before.p_min, -NO_LIMIT);
  }
  Solid rubble;
  rubble.put(0.9);
  for (int k = 0; k < 100 && !rubble.s.failed(); k++) {
    rubble.model->begin_step(rubble.s, rubble.in);
    EXPECT_EQ(rubble.model->advance(1, rubble.list, &rubble.in, 1e-6), -1);
  }
  EXPECT_TRUE(rubble.s.failed());
  EXPECT_EQ(rubble.s.before.p_min, -NO_LIMIT);    // of the step in which it failed
  rubble.model->begin_step(rubble.s, rubble.in);
  EXPECT_EQ(rubble.s.before.p_min, 0.0);
}
