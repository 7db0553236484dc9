/* ----------------------------------------------------------------------
   lammps-hvi: hypervelocity impact for LAMMPS, GNU GPL version 2, see LICENSE
   Damage that takes plastic displacement; thresholds of particles of their own.
------------------------------------------------------------------------- */

#include "hvi_solid_model.h"

#include <cmath>
#include <cstring>
#include <gtest/gtest.h>

using namespace HVI;

namespace {

const double Y = 0.3e9, RHO = 2700.0;
const std::string EOS = "eos gruneisen\nrho0 2700\nC 5240\nS1 1.4\ng0 2\na 0.5\ncp 885\n";
const std::string PERFECT = "strength perfect\nG 26e9\nY 0.3e9\n";
const std::string DAMAGE = "damage johnson-cook\nD1 0.2\nD2 0\nD3 0\nD4 0\nD5 0\n";

std::unique_ptr<SolidModel> made(const std::string &text, const SolidOptions &o)
{
  Material material;
  std::string problem;
  EXPECT_EQ(parse_material("# UNITS: si\n" + text, "x.hvi", "si", material), "");
  auto model = SolidModel::make(material, o, problem);
  EXPECT_EQ(problem, "");
  EXPECT_TRUE(model);
  return model;
}

SolidOptions options(Spall spall, bool damage)
{
  SolidOptions o;
  o.strength = "perfect";
  o.damage = damage;
  o.thermal = false;
  o.spall = spall;
  return o;
}

SolidInput sheared(double rate, double size)
{
  SolidInput in = {};
  in.rho = RHO;
  in.size = size;
  in.L.xy = rate;
  return in;
}

void step(const SolidModel &model, SolidState &s, const SolidInput &in, double dt)
{
  model.begin_step(s, in);
  SolidState *const list[] = {&s};
  EXPECT_EQ(model.advance(1, list, &in, dt), -1);
}

}    // namespace

TEST(SolidModel, LargestSize)
{
  const auto model = made(EOS + PERFECT + DAMAGE + "u_f 20e-6\n", options(Spall::NONE, true));
  EXPECT_DOUBLE_EQ(model->largest_size(), 3.0 * 26.0 / 0.3 * 20e-6);
  EXPECT_EQ(made(EOS + PERFECT + DAMAGE, options(Spall::NONE, true))->largest_size(), NO_LIMIT);
}

/* ----------------------------------------------------------------------
   A layer as thick as its particles, sheared until it has failed: plastic work per area is Y (0.2 size + u_f/2), so what
   softening takes up is Y u_f/2, whatever the size.  Before that the law's damage counts as initiation.
------------------------------------------------------------------------- */

TEST(Softening, EnergyPerArea)
{
  const double u_f = 20e-6;
  const auto model = made(EOS + PERFECT + DAMAGE + "u_f 20e-6\n", options(Spall::NONE, true));
  ASSERT_TRUE(model->softens() && model->has_size());
  for (double size : {5e-6, 50e-6, 500e-6}) {
    SolidInput in = sheared(1e5, size);
    SolidState s = SolidModel::blank();
    model->start(s, in, true);
    const double end = 0.2 + u_f / size, dt = end * 1e-4 / 1e5;
    double worst = 0.0, last = 0.0;
    int n = 0;
    for (; !s.failed(); n++) {
      ASSERT_LT(n, 100000);
      step(*model, s, in, dt);
      if (s.failed()) break;
      EXPECT_EQ(s.damage > 0.0, s.initiation >= 1.0 && s.eps > last && last > 0.0);
      if (s.initiation >= 1.0) last = last > 0.0 ? last : s.eps;
      const double left = 1.0 - std::max(0.0, (s.eps - 0.2) * size / u_f);
      if (s.eps > 1e-3) worst = std::max(worst, std::fabs(von_mises(s.S) / Y - left));
    }
    EXPECT_NEAR(s.eps, end, 4e-4 * end);
    EXPECT_NEAR(s.heat * RHO * size, Y * (0.2 * size + 0.5 * u_f),
                1e-3 * Y * (0.2 * size + 0.5 * u_f));
    EXPECT_LT(worst, 1e-3);
    EXPECT_NEAR(s.damage, 1.0, 1e-3);
    EXPECT_GE(s.damage, 1.0);
    EXPECT_NEAR(s.initiation, 1.0, 1e-3);
    EXPECT_EQ(von_mises(s.S), 0.0);
    EXPECT_EQ(s.spalled, 0.0);
  }
}

// without u_f it fails at D = 1, without a trace of initiation, and needs no size

TEST(Softening, OffByDefault)
{
  const auto model = made(EOS + PERFECT + DAMAGE, options(Spall::NONE, true));
  const auto zero = made(EOS + PERFECT + DAMAGE + "u_f 0\n", options(Spall::NONE, true));
  EXPECT_FALSE(model->softens() || model->has_size());
  SolidInput in = sheared(1e5, 0.0);
  SolidState s = SolidModel::blank();
  model->start(s, in, true);
  SolidState t = s;
  for (int n = 0; !s.failed(); n++) {
    ASSERT_LT(n, 1000);
    step(*model, s, in, 1e-8);
    step(*zero, t, in, 1e-8);
    EXPECT_EQ(memcmp(&s, &t, sizeof(s)), 0);
    EXPECT_EQ(s.initiation, 0.0);
    if (!s.failed() && s.eps > 1e-2) { EXPECT_NEAR(von_mises(s.S), Y, 1e-6 * Y); }
  }
  EXPECT_NEAR(s.eps, 0.2, 1e-3);
}

// unloaded and loaded again: what is lost stays lost, and elastic strain does no damage

TEST(Softening, Unloading)
{
  const auto model = made(EOS + PERFECT + DAMAGE + "u_f 20e-6\n", options(Spall::NONE, true));
  SolidInput in = sheared(1e5, 50e-6);
  SolidState s = SolidModel::blank();
  model->start(s, in, true);
  while (s.damage < 0.5) step(*model, s, in, 1e-9);
  in.L.xy = -1e5;
  const double D = s.damage, eps = s.eps;
  for (int k = 0; k < 30; k++) step(*model, s, in, 1e-9);    // elastic: 66 would be
  EXPECT_EQ(s.damage, D);
  EXPECT_EQ(s.eps, eps);
  EXPECT_LT(von_mises(s.S), 0.4 * Y);
  for (int k = 0; k < 300; k++) step(*model, s, in, 1e-9);
  EXPECT_GT(s.damage, D);
  EXPECT_NEAR(von_mises(s.S), (1.0 - s.damage) * Y, 1e-3 * Y);
}

// voids and strain each take away their part of the yield stress

TEST(Softening, BesideVoids)
{
  const std::string voids = "spall voids\nsigma 1.2e9\nrate 1e5\nm 0.2\nphi_c 0.075\n";
  const auto model =
      made(EOS + PERFECT + DAMAGE + "u_f 20e-6\n" + voids, options(Spall::VOIDS, true));
  SolidInput in = sheared(1e5, 50e-6);
  SolidState s = SolidModel::blank();
  model->start(s, in, true);
  while (s.damage < 0.3) step(*model, s, in, 1e-9);
  s.voids.D = 0.4;
  const double D = s.damage;
  step(*model, s, in, 1e-9);
  EXPECT_NEAR(von_mises(s.S), 0.6 * (1.0 - D) * Y, 1e-9 * Y);
}

/* ----------------------------------------------------------------------
   Thresholds of its own: with a reference size a particle is as one of a material whose limits are that many times as
   large.  Stretched along x with growing tension until it has failed.
------------------------------------------------------------------------- */

namespace {

std::vector<SolidState> stretched(const SolidModel &model, std::int64_t id)
{
  std::vector<SolidState> out;
  SolidState s = SolidModel::blank();
  SolidInput in = sheared(0.0, 50e-6);
  in.id = id;
  in.L.xx = 1e5;
  model.start(s, in, true);
  const double dt = 1e-10;
  for (int n = 0; n < 4000 && !s.failed(); n++) {
    in.rho = RHO * std::exp(-1e5 * dt * n);
    in.p = 5240.0 * 5240.0 * (in.rho - RHO);
    step(model, s, in, dt);
    out.push_back(s);
  }
  return out;
}

bool as(const std::vector<SolidState> &a, const std::vector<SolidState> &b)
{
  if (a.size() != b.size()) return false;
  for (size_t k = 0; k < a.size(); k++) {
    const double *const x = reinterpret_cast<const double *>(&a[k]);
    const double *const y = reinterpret_cast<const double *>(&b[k]);
    for (size_t i = 0; i < sizeof(SolidState) / sizeof(double); i++)
      if (!(x[i] == y[i] || std::fabs(x[i] - y[i]) <= 1e-9 * std::fabs(y[i]))) return false;
  }
  return true;
}

std::string number(double x)
{
  char text[40];
  std::snprintf(text, sizeof(text), "%.17g", x);
  return text;
}

}    // namespace

TEST(Scatter, ThresholdsOfSpall)
{
  struct Case {
    Spall spall;
    std::string (*text)(double f);
  };
  const Case cases[] = {
      {Spall::PRINCIPAL,
       [](double f) {
         return "spall limit\nsigma_p " + number(f * 1.2e9) + "\n";
       }},
      {Spall::ZERO,
       [](double f) {
         return "spall limit\nsigma_p " + number(f * 1.2e9) + "\n";
       }},
      {Spall::PRESSURE,
       [](double f) {
         return "spall limit\nsigma_p " + number(f * 1.2e9) + "\n";
       }},
      {Spall::VOIDS,
       [](double f) {
         return "spall voids\nrate 1e5\nm 0.2\nphi_c 0.01\nsigma " + number(f * 1.2e9) + "\n";
       }},
      {Spall::TULER_BUTCHER,
       [](double f) {
         return "spall tuler-butcher\nlambda 2\nsigma_0 " + number(f * 0.5e9) + "\nK " +
             number(f * f * 2e9) + "\n";
       }},
      {Spall::GRADY,
       [](double f) {
         return "spall grady\neps_c " + number(f * f * 0.03) + "\n";
       }},
  };
  for (const Case &c : cases) {
    SolidOptions o = options(c.spall, false);
    const auto plain = made(EOS + PERFECT + c.text(1.0), o);
    o.weibull = 5.0;
    o.seed = 12;
    const auto without = made(EOS + PERFECT + c.text(1.0), o);
    o.reference = 100e-6;
    o.dim = 3;
    const auto scattered = made(EOS + PERFECT + c.text(1.0), o);
    EXPECT_TRUE(scattered->has_size());
    EXPECT_FALSE(without->has_size());
    int other = 0;
    for (std::int64_t id : {1, 2, 3, 4}) {
      const double f = weibull_factor(12, id, 5.0) * std::pow(0.5, -3.0 / 5.0);
      const auto want = stretched(*made(EOS + PERFECT + c.text(f), options(c.spall, false)), id);
      const auto got = stretched(*scattered, id);
      EXPECT_TRUE(as(got, want)) << spall_model(c.spall).name << " " << id << " " << got.size()
                                 << " " << want.size();
      EXPECT_TRUE(as(stretched(*without, id), stretched(*plain, id)));
      other += !as(got, stretched(*plain, id));
      if (c.spall == Spall::PRESSURE) {
        SolidInput in = sheared(0.0, 50e-6);
        in.id = id;
        in.p = -1e12;
        EXPECT_DOUBLE_EQ(scattered->pressure(got.back(), in), -f * 1.2e9);
        EXPECT_TRUE(scattered->looks(got.back()));
      } else
        EXPECT_TRUE(got.back().failed());
    }
    EXPECT_EQ(other, 4);
  }
}

// and the strain at failure, which scatters without a reference size too, but then whatever the size is

TEST(Scatter, ThresholdOfDamage)
{
  for (double reference : {0.0, 100e-6})
    for (int dim : {1, 3}) {
      SolidOptions o = options(Spall::NONE, true);
      o.weibull = 5.0;
      o.seed = 12;
      o.reference = reference;
      o.dim = dim;
      const auto model = made(EOS + PERFECT + DAMAGE, o);
      for (double size : {20e-6, 200e-6}) {
        SolidInput in = sheared(1e5, size);
        in.id = 77;
        SolidState s = SolidModel::blank();
        model->start(s, in, true);
        for (int n = 0; !s.failed() && n < 100000; n++) step(*model, s, in, 1e-9);
        double want = 0.2 * weibull_factor(12, 77, 5.0);
        if (reference > 0.0) want *= std::pow(size / reference, -dim / 5.0);
        EXPECT_NEAR(s.eps, want, 2e-3 * want);
      }
    }
}
