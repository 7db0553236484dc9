/* ----------------------------------------------------------------------
   lammps-hvi: hypervelocity impact for LAMMPS, GNU GPL version 2, see LICENSE
   Laws of spall other than voids, by themselves and in a solid, against closed forms and integrals of their own.
------------------------------------------------------------------------- */

#include "hvi_solid_model.h"
#include "hvi_spall_grady.h"
#include "hvi_spall_tuler_butcher.h"

#include <cmath>
#include <gtest/gtest.h>

using namespace HVI;

namespace {

const std::string EOS = "eos gruneisen\nrho0 2703\nC 5240\nS1 1.4\ng0 1.97\na 0.48\ncp 885\n";
const std::string PERFECT = "strength perfect\nG 27.6e9\nY 0.3e9\n";
const std::string IMPULSE = "spall tuler-butcher\nsigma_0 0.4e9\nlambda 2.5\nK 2e16\n";

Material parsed(const std::string &text, const std::string &units = "si")
{
  Material material;
  EXPECT_EQ(parse_material("# UNITS: si\n" + text, "x.hvi", units, material), "");
  return material;
}

SolidOptions options(Spall spall)
{
  SolidOptions o;
  o.strength = "perfect";
  o.damage = o.thermal = false;
  o.spall = spall;
  return o;
}

std::unique_ptr<SolidModel> made(const std::string &text, const SolidOptions &o)
{
  std::string problem;
  auto model = SolidModel::make(parsed(text), o, problem);
  EXPECT_EQ(problem, "");
  EXPECT_TRUE(model);
  return model;
}

// a step of something stretched along x, under that tension

void step(const SolidModel &model, SolidState &s, double tension, double rate, double dt)
{
  SolidInput in = {};
  in.rho = 2703;
  in.p = -tension;
  in.size = 1.0;
  in.L.xx = in.expansion = rate;
  model.begin_step(s, in);
  SolidState *const list[] = {&s};
  if (!s.failed()) { EXPECT_EQ(model.advance(1, list, &in, dt), -1); }
}

}    // namespace

/* ----------------------------------------------------------------------
   Stress that grows as M rate t: (sigma - sigma_0)^(lambda + 1) = (lambda + 1) K M rate at the end.  With
   sigma_0 = 0 and lambda = 1/m - 1 that is a strength that goes with rate^m.
------------------------------------------------------------------------- */

TEST(SpallTulerButcher, StressThatGrows)
{
  const double M = 74e9;
  for (double sigma_0 : {0.0, 0.4e9})
    for (double lambda : {0.5, 2.0, 4.0})
      for (double rate : {1e4, 1e5, 1e6}) {
        const double want = sigma_0 + 1e9 * std::pow(rate / 1e5, 1 / (lambda + 1));
        const double K = std::pow(1e9, lambda + 1) / ((lambda + 1) * M * 1e5);
        const SpallTulerButcher law = {sigma_0, lambda, K};
        double error[2];
        for (int k = 0; k < 2; k++) {
          const double dt = want / (M * rate) / (2000 << k);
          double used = 0.0, sigma = 0.0;
          for (int n = 1; used < 1.0; n++) used = law.advance(used, sigma = M * rate * dt * n, dt);
          EXPECT_EQ(used, 1.0);
          error[k] = std::fabs(sigma / want - 1.0);
        }
        EXPECT_LT(error[0], 2e-3) << sigma_0 << " " << lambda << " " << rate;
        EXPECT_LT(error[1], 1e-3) << sigma_0 << " " << lambda << " " << rate;
      }
}

// below the threshold nothing, however long; what is used up stays

TEST(SpallTulerButcher, Threshold)
{
  const SpallTulerButcher law = {0.4e9, 2.0, 1e9};
  EXPECT_EQ(law.advance(0.3, 0.4e9, 1e9), 0.3);
  EXPECT_EQ(law.advance(0.3, -5e9, 1e9), 0.3);
  EXPECT_GT(law.advance(0.3, 0.4e9 + 1.0, 1e8), 0.3);
  EXPECT_EQ(law.advance(0.3, 1e300, 1e9), 1.0);    // beyond all numbers
}

/* ----------------------------------------------------------------------
   A solid that yields under a sine of tension: its largest principal stress is that and 2/3 Y.  Simpson's
   rule says how much of K is used up, and until then nothing else changes.
------------------------------------------------------------------------- */

TEST(SpallTulerButcher, Solid)
{
  const auto model = made(EOS + PERFECT + IMPULSE, options(Spall::TULER_BUTCHER));
  EXPECT_TRUE(model->spall_limited());
  EXPECT_FALSE(made(EOS + PERFECT, options(Spall::TULER_BUTCHER))->spall_limited());
  const double T = 1e-6, Y = 0.3e9, PI = 3.14159265358979323846;
  for (double peak : {0.15e9, 0.5e9, 0.95e9, 1.6e9}) {
    const int n = 4000;
    double sum = 0.0;
    for (int k = 0; k <= n; k++) {
      const double above = peak * std::sin(PI * k / n) + 2.0 / 3.0 * Y - 0.4e9;
      const double weight = k == 0 || k == n ? 1.0 : (k % 2 ? 4.0 : 2.0);
      sum += weight * std::pow(std::max(0.0, above), 2.5);
    }
    const double want = sum * T / n / 3.0 / 2e16;

    SolidState s = SolidModel::blank();
    SolidInput in = {};
    in.rho = 2703;
    model->start(s, in, true);
    for (int k = 0; k < 50; k++) step(*model, s, 0.0, 1e6, 1e-9);    // until it yields
    EXPECT_EQ(s.voids.D, 0.0);
    EXPECT_NEAR(largest_principal(s.S), 2.0 / 3.0 * Y, 1e-6 * Y);
    for (int k = 1; k <= n && !s.failed(); k++) {
      step(*model, s, peak * std::sin(PI * k / n), 1e6, T / n);
      in.p = -1e9;
      EXPECT_EQ(model->pressure(s, in), s.failed() ? 0.0 : -1e9);
      if (!s.failed()) { EXPECT_NEAR(von_mises(s.S), Y, 1e-6 * Y); }
      EXPECT_EQ(s.voids.phi, 0.0);
    }
    EXPECT_EQ(s.failed(), want >= 1.0) << want;
    EXPECT_EQ(s.spalled, s.failed() ? 1.0 : 0.0);
    if (s.failed()) {
      EXPECT_EQ(s.voids.D, 1.0);
      EXPECT_EQ(von_mises(s.S), 0.0);
    } else {
      EXPECT_NEAR(s.voids.D, want, 1e-3 * want);
    }
  }
}

// K is stress to the power of lambda times time, in the units of the run; it must not be lost there

TEST(SpallTulerButcher, Units)
{
  const Material micro = parsed(EOS + IMPULSE, "micro"), cgs = parsed(EOS + IMPULSE, "cgs");
  const auto at = [](const Material &m, const char *key) {
    return m.section("spall", "tuler-butcher")->values.at(key);
  };
  EXPECT_DOUBLE_EQ(at(micro, "sigma_0"), 0.4e6);
  EXPECT_DOUBLE_EQ(at(micro, "K"), 2e16 * 1e6 * std::pow(1e-3, 2.5));
  EXPECT_DOUBLE_EQ(at(cgs, "K"), 2e16 * std::pow(10.0, 2.5));
  EXPECT_EQ(at(micro, "lambda"), 2.5);
  Material material;
  const auto problem = [&](const std::string &text, const std::string &units) {
    return parse_material("# UNITS: si\n" + EOS + text, "x.hvi", units, material);
  };
  EXPECT_NE(problem("spall tuler-butcher\nsigma_0 1\nlambda 500\nK 1\n", "cgs")
                .find("K is out of range in units cgs"),
            std::string::npos);
  EXPECT_NE(problem("spall tuler-butcher\nsigma_0 1\nlambda 500\nK 1\n", "micro")
                .find("K is out of range in units micro"),
            std::string::npos);
  EXPECT_NE(problem("spall tuler-butcher\nsigma_0 1\nK 1\n", "cgs").find("missing key lambda"),
            std::string::npos);
  EXPECT_NE(problem("spall tuler-butcher\nsigma_0 1\nlambda 0\nK 1\n", "si").find("lambda = 0"),
            std::string::npos);
}

// 2.69 GPa of 6061-T6 with a yield stress of 0.324 GPa and eps_c 0.15

TEST(SpallGrady, Limit)
{
  const SpallGrady law = {0.15};
  EXPECT_NEAR(law.limit(2703, 5240, 0.324e9), 2.686e9, 0.001e9);
  EXPECT_EQ(law.limit(2703, 5240, 0.0), 0.0);
  const double P = law.limit(2703, 5240, 0.324e9);
  EXPECT_NEAR(P * P / (2.0 * 2703 * 5240.0 * 5240.0), 0.15 * 0.324e9, 1.0);
}

/* ----------------------------------------------------------------------
   A solid that hardens as it yields: its limit rises with its yield stress.  It spalls in the step in which
   the tension and 2/3 Y come to the limit, of the yield stress then.
------------------------------------------------------------------------- */

TEST(SpallGrady, Solid)
{
  const std::string cook = "strength johnson-cook\nG 27.6e9\nA 0.2e9\nB 0.4e9\nn 0.5\nC 0\nm 1\n"
                           "epsdot0 1\nTref 300\nTm 900\n";
  SolidOptions o = options(Spall::GRADY);
  o.strength = "johnson-cook";
  const auto model = made(EOS + cook + "spall grady\neps_c 0.15\n", o);
  EXPECT_TRUE(model->spall_limited());
  for (double strain : {0.01, 0.1, 0.5}) {
    SolidState s = SolidModel::blank();
    SolidInput in = {};
    in.rho = 2703;
    model->start(s, in, true);
    for (int k = 0; k < 500; k++) step(*model, s, 0.0, strain * 1e6, 2e-9);
    const double Y = 0.2e9 + 0.4e9 * std::sqrt(s.eps);
    EXPECT_NEAR(von_mises(s.S), Y, 1e-6 * Y);
    const double limit = std::sqrt(2.0 * 2703 * 5240.0 * 5240.0 * Y * 0.15);
    const double tension = limit - 2.0 / 3.0 * Y;
    step(*model, s, 0.9999 * tension, 0.0, 1e-12);
    EXPECT_FALSE(s.failed()) << strain;
    step(*model, s, 1.0001 * tension, 0.0, 1e-12);
    EXPECT_EQ(s.spalled, 1.0) << strain;
    EXPECT_EQ(von_mises(s.S), 0.0);
  }
}

TEST(SpallGrady, NeedsAYieldStress)
{
  SolidOptions o = options(Spall::GRADY);
  o.strength = "none";
  std::string problem;
  EXPECT_FALSE(SolidModel::make(parsed(EOS + PERFECT + "spall grady\neps_c 0.15\n"), o, problem));
  EXPECT_NE(problem.find("no yield stress"), std::string::npos) << problem;
  EXPECT_TRUE(SolidModel::make(parsed(EOS + PERFECT), o, problem));
  EXPECT_FALSE(SolidModel::make(parsed(EOS + PERFECT), o, problem)->spall_limited());
}

/* ----------------------------------------------------------------------
   Size of fragments: with P = rho c0^2 epsdot t what is stretched has the energy P^2/(2 rho c0^2) after t;
   sound has come 2 c0 t when that is the energy of parting
------------------------------------------------------------------------- */

TEST(Fragments, Size)
{
  const double rho = 2703, c = 5240;
  for (double energy : {4.5e7, 2e6})
    for (double rate : {1e3, 1e5, 1e7}) {
      double lo = 0.0, hi = 1.0;
      for (int k = 0; k < 200; k++) {
        const double t = 0.5 * (lo + hi), P = rho * c * c * rate * t;
        (P * P / (2.0 * rho * c * c) < energy ? lo : hi) = t;
      }
      EXPECT_NEAR(fragment_size(energy, rho, rate) / (2.0 * c * lo), 1.0, 1e-9);
    }
  EXPECT_NEAR(fragment_size(0.3e9 * 0.15, rho, 1e5), 3.65e-3, 0.01e-3);
  EXPECT_EQ(fragment_size(4.5e7, rho, 0.0), 0.0);
  EXPECT_EQ(fragment_size(4.5e7, rho, -1e5), 0.0);
  EXPECT_EQ(fragment_size(0.0, rho, 1e5), 0.0);
}

// the energy that a material's fragments are made with; what it failed by matters only where it has several

TEST(Fragments, Energy)
{
  const std::string limit = "spall limit\nsigma_p 1.2e9\n", grady = "spall grady\neps_c 0.15\n";
  const std::string voids = "spall voids\nsigma 1.2e9\nrate 1e5\nm 0.2\nphi_c 0.05\n";
  const auto size = [](const std::string &text, Spall spall) {
    const auto model = made(EOS + PERFECT + text, options(spall));
    SolidState s = SolidModel::blank();
    s.expansion = 1e5;
    EXPECT_EQ(model->fragments(s), 0.0);    // not failed
    s.spalled = 1.0;
    return model->fragments(s);
  };
  const double by_grady = std::sqrt(8.0 * 0.3e9 * 0.15 / 2703) / 1e5;
  const double by_voids = std::sqrt(8.0 * 0.5 * 1.2e9 * 0.05 / 2703) / 1e5;
  for (Spall spall : {Spall::PRINCIPAL, Spall::NONE, Spall::GRADY, Spall::VOIDS}) {
    EXPECT_EQ(size(limit, spall), 0.0);
    EXPECT_DOUBLE_EQ(size(limit + grady, spall), by_grady);
    EXPECT_DOUBLE_EQ(size(limit + voids, spall), by_voids);
    EXPECT_DOUBLE_EQ(size(limit + voids + grady, spall),
                     spall == Spall::GRADY ? by_grady : by_voids);
  }
}

// the rate of expansion of the step in which it fails; with voids of that in which they have done 1 %

TEST(Fragments, RateThen)
{
  const std::string voids = "spall voids\nsigma 1.2e9\nrate 1e5\nm 0.2\nphi_c 0.05\n";
  const auto by_limit =
      made(EOS + PERFECT + "spall limit\nsigma_p 1.2e9\n" + voids, options(Spall::PRINCIPAL));
  SolidState s = SolidModel::blank();
  SolidInput in = {};
  in.rho = 2703;
  by_limit->start(s, in, true);
  for (int k = 0; k < 20; k++) step(*by_limit, s, 0.1e9 * k + 0.05e9, 1e5 * (k + 1), 1e-8);
  ASSERT_TRUE(s.failed());
  EXPECT_EQ(s.expansion, 11e5);    // 1.05e9 and 2/3 of 0.3e9
  EXPECT_GT(by_limit->fragments(s), 0.0);

  const auto by_voids = made(EOS + PERFECT + voids, options(Spall::VOIDS));
  s = SolidModel::blank();
  by_voids->start(s, in, true);
  double want = 0.0;
  for (int k = 0; k < 4000 && !s.failed(); k++) {
    in.rho = 2703 * (1.0 - 2e-5 * k);
    double p, csq;
    parsed(EOS).eos->evaluate(in.rho, 0.0, p, csq);
    in.p = p;
    in.L.xx = in.expansion = 1e5 + k;
    in.size = 1.0;
    by_voids->begin_step(s, in);
    SolidState *const list[] = {&s};
    EXPECT_EQ(by_voids->advance(1, list, &in, 1e-9), -1);
    if (want == 0.0 && s.voids.D > 0.01) want = in.L.xx;
    EXPECT_EQ(s.expansion, want);
  }
  ASSERT_TRUE(s.failed());
  EXPECT_GT(in.L.xx, want + 100.0);
}

// what another law would drop or take for its own: voids, also those pressed shut, of which D is left; an
// impulse; not what rubble has

TEST(SolidModel, Misread)
{
  const std::string text = EOS + PERFECT + IMPULSE + "spall limit\nsigma_p 1.2e9\n" +
      "spall voids\nsigma 1.2e9\nrate 1e5\nm 0.2\nphi_c 0.05\n";
  const auto voids = made(text, options(Spall::VOIDS)),
             impulse = made(text, options(Spall::TULER_BUTCHER)),
             limit = made(text, options(Spall::PRINCIPAL)), none = made(text, options(Spall::NONE));
  const auto refuse = [&](const SolidState &s) {
    std::string who;
    const SolidModel *const models[] = {voids.get(), impulse.get(), limit.get(), none.get(),
                                        nullptr};
    for (const SolidModel *const model : models) {
      const SolidModel::Begun *const begun = SolidModel::misread(model, s);
      who += begun ? begun->what[0] : '-';
    }
    return who;
  };
  EXPECT_EQ(refuse(SolidModel::blank()), "-----");

  const auto eos = parsed(EOS).eos;
  const SpallVoids law = {1.2e9, 1e5, 0.2, 0.05, 0.0};
  SolidState s = SolidModel::blank();
  for (int k = 1; k <= 20; k++) law.advance(s.voids, *eos, 2703 * (1.0 - 1e-3 * k), 0.0, 1.0, 1e-8);
  ASSERT_GT(s.voids.phi, 1e-4);
  ASSERT_LT(s.voids.D, 1.0);
  EXPECT_EQ(refuse(s), "-vvvv");
  law.advance(s.voids, *eos, 2710, 0.0, 1.0, 1e-8);
  ASSERT_EQ(s.voids.phi, 0.0);
  ASSERT_GT(s.voids.D, 0.0);
  EXPECT_EQ(refuse(s), "-vvvv");
  s.spalled = 1.0;
  EXPECT_EQ(refuse(s), "-----");

  s = SolidModel::blank();
  s.voids.D = 0.3;
  EXPECT_EQ(refuse(s), "i-iii");
  s.damage = 1.0;
  EXPECT_EQ(refuse(s), "-----");
}
