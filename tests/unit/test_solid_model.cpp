/* ----------------------------------------------------------------------
   lammps-hvi: hypervelocity impact for LAMMPS, GNU GPL version 2, see LICENSE
   A solid by itself: strength, damage, spall and temperature over steps, against closed forms.
------------------------------------------------------------------------- */

#include "hvi_solid_model.h"
#include "hvi_vector.h"

#include <cmath>
#include <cstring>
#include <gtest/gtest.h>

using namespace HVI;

namespace {

const double G = 26.0, Y = 0.3, NONE = std::numeric_limits<double>::quiet_NaN();

const std::string EOS =
    "# UNITS: lj\neos gruneisen\nrho0 1\nC 8\nS1 1.4\ng0 2\na 0\ncp 5\nT0 300\n";
const std::string PERFECT = "strength perfect\nG 26\nY 0.3\n";
const std::string COOK = "strength johnson-cook\nG 26\nA 0.3\nB 0\nn 1\nC 0\nm 1\nepsdot0 1\n"
                         "Tref 300\nTm 900\n";
const std::string DAMAGE = "damage johnson-cook\nD1 0.1\nD2 0\nD3 0\nD4 0\nD5 0\nepsdot0 1\n";
const std::string SPALL = "spall limit\nsigma_p 1.2\n";

Material parsed(const std::string &text)
{
  Material material;
  EXPECT_EQ(parse_material(text, "x.hvi", "lj", material), "");
  return material;
}

SolidOptions options(const std::string &strength)
{
  SolidOptions o;
  o.strength = strength;
  o.damage = o.thermal = false;
  o.spall = Spall::NONE;
  return o;
}

std::unique_ptr<SolidModel> made(const std::string &text, const SolidOptions &o)
{
  std::string problem = "old";
  auto model = SolidModel::make(parsed(text), o, problem);
  EXPECT_EQ(problem, "");
  EXPECT_TRUE(model);
  return model;
}

std::string refused(const Material &material, const SolidOptions &o)
{
  std::string problem;
  EXPECT_FALSE(SolidModel::make(material, o, problem));
  return problem;
}

SolidInput input(const VelocityGradient &L, double p = 0.0, double e = 0.0)
{
  return {1.0, e, p, L, 7, 1.0};
}

double borne(const SolidModel &model, const SolidState &s, double p)
{
  return model.pressure(s, input({}, p));
}

VelocityGradient uniaxial(double rate)
{
  VelocityGradient L = {};
  L.xx = rate;
  return L;
}

VelocityGradient shear(double rate)
{
  VelocityGradient L = {};
  L.xy = rate;
  return L;
}

// as a particle goes through steps: started anew where a run begins

SolidState begun(const SolidModel &model, const SolidInput &in)
{
  SolidState s = SolidModel::blank();
  model.start(s, in, true);
  return s;
}

void step(const SolidModel &model, SolidState &s, const SolidInput &in, double dt)
{
  model.begin_step(s, in);
  SolidState *const list[] = {&s};
  if (!s.failed()) { EXPECT_EQ(model.advance(1, list, &in, dt), -1); }
}

SolidState walked(const SolidModel &model, const SolidInput &in, double end, int n)
{
  SolidState s = begun(model, in);
  for (int i = 0; i < n; i++) step(model, s, in, end / n);
  return s;
}

bool same(const SolidState &a, const SolidState &b)
{
  return memcmp(&a, &b, sizeof(SolidState)) == 0;
}

}    // namespace

/* ----------------------------------------------------------------------
   strength
------------------------------------------------------------------------- */

// stress 4/3 G e up to 2/3 Y, then Y; plastic strain 2/3 e - Y/(3 G), work Y eps: with any step

TEST(SolidModel, UniaxialStrain)
{
  const auto model = made(EOS + PERFECT, options("perfect"));
  for (double sign : {1.0, -1.0})
    for (int n : {1, 2, 7, 100}) {
      const SolidInput in = input(uniaxial(sign));
      const double little = 0.4 * Y / (2.0 * G);
      SolidState s = walked(*model, in, little, n);
      EXPECT_NEAR(s.S.xx, sign * 4.0 / 3.0 * G * little, 1e-14);
      EXPECT_NEAR(s.S.yy, -0.5 * s.S.xx, 1e-14);
      EXPECT_EQ(s.eps, 0.0);
      EXPECT_EQ(s.shear, G);
      s = walked(*model, in, 0.2, n);
      const double eps = 2.0 / 3.0 * 0.2 - Y / (3.0 * G);
      EXPECT_NEAR(s.S.xx, sign * 2.0 / 3.0 * Y, 1e-14);
      EXPECT_NEAR(s.eps, eps, 1e-13);
      EXPECT_NEAR(s.heat, Y * eps, 1e-13);
      EXPECT_NEAR(s.rate, n == 1 ? eps / 0.2 : 2.0 / 3.0, 1e-12);
      EXPECT_NEAR(von_mises(s.S), Y, 1e-14);
      EXPECT_EQ(s.before.shear, G);
      EXPECT_EQ(s.before.p_min, -NO_LIMIT);
      EXPECT_EQ(s.p_min, -NO_LIMIT);
      // and pulled back it goes the elastic way, from the first step on
      const double before = s.S.xx, strained = s.eps;
      step(*model, s, input(uniaxial(-sign)), 1e-3);
      EXPECT_NEAR(s.S.xx, before - sign * 4.0 / 3.0 * G * 1e-3, 1e-13);
      EXPECT_EQ(s.eps, strained);
    }
}

// elastic simple shear, Sxy = G sin(gamma): steps are of second order

TEST(SolidModel, SecondOrder)
{
  const auto model = made(EOS + "strength perfect\nG 26\nY 1e6\n", options("perfect"));
  double error[3];
  for (int k = 0; k < 3; k++) {
    const SolidState s = walked(*model, input(shear(2.0)), 1.1, 100 << k);
    error[k] = std::hypot(s.S.xy - G * std::sin(2.2), s.S.xx - G * (1.0 - std::cos(2.2)));
  }
  EXPECT_LT(error[2], 1e-3 * G);
  EXPECT_NEAR(std::log2(error[0] / error[1]), 2.0, 0.05);
  EXPECT_NEAR(std::log2(error[1] / error[2]), 2.0, 0.05);
}

// strength none: a liquid that spalls

TEST(SolidModel, WithoutStrength)
{
  SolidOptions o = options("none");
  o.spall = Spall::PRINCIPAL;
  const auto model = made(EOS + PERFECT + SPALL, o);
  EXPECT_STREQ(model->strength().name(), "none");
  SolidState s = walked(*model, input(shear(2.0), -1.19), 1.0, 10);
  EXPECT_EQ(von_mises(s.S), 0.0);
  EXPECT_EQ(s.shear, 0.0);
  EXPECT_EQ(s.eps, 0.0);
  EXPECT_FALSE(s.failed());
  step(*model, s, input(shear(2.0), -1.21), 0.1);
  EXPECT_EQ(s.spalled, 1.0);
}

/* ----------------------------------------------------------------------
   spall, damage
------------------------------------------------------------------------- */

// -p + 2/3 Y comes to sigma_p: the step before nothing, then for good

TEST(SolidModel, SpallsAtItsLimit)
{
  SolidOptions o = options("perfect");
  o.spall = Spall::PRINCIPAL;
  const auto model = made(EOS + PERFECT + SPALL, o);
  EXPECT_TRUE(model->spall_limited());
  SolidState s = walked(*model, input(uniaxial(1.0)), 0.1, 10);
  const double tension = 1.2 - 2.0 / 3.0 * Y;
  step(*model, s, input(uniaxial(1.0), -tension + 1e-9), 0.01);
  EXPECT_EQ(s.spalled, 0.0);
  EXPECT_EQ(borne(*model, s, -5.0), -5.0);
  const double eps = s.eps;
  step(*model, s, input(uniaxial(1.0), -tension - 1e-9), 0.01);
  EXPECT_EQ(s.spalled, 1.0);
  EXPECT_TRUE(s.failed());
  EXPECT_EQ(von_mises(s.S), 0.0);
  EXPECT_EQ(s.shear, 0.0);
  EXPECT_EQ(s.rate, 0.0);
  EXPECT_GT(s.eps, eps);
  EXPECT_EQ(s.damage, 0.0);
  EXPECT_EQ(borne(*model, s, -5.0), 0.0);
  EXPECT_EQ(borne(*model, s, 5.0), 5.0);
  // at the begin of that step it was solid, at that of the next rubble
  EXPECT_EQ(s.before.p_min, -NO_LIMIT);
  EXPECT_EQ(s.before.shear, G);
  const SolidState rubble = s;
  step(*model, s, input(uniaxial(-1.0), 3.0), 0.01);
  EXPECT_EQ(s.before.p_min, 0.0);
  EXPECT_EQ(s.before.shear, 0.0);
  EXPECT_EQ(von_mises(s.S), 0.0);
  EXPECT_EQ(s.eps, rubble.eps);
  EXPECT_EQ(s.heat, rubble.heat);

  o.spall = Spall::PRESSURE;
  const auto limited = made(EOS + PERFECT + SPALL, o);
  s = walked(*limited, input(uniaxial(1.0), -5.0), 0.1, 10);
  EXPECT_FALSE(s.failed());
  EXPECT_EQ(s.before.p_min, -1.2);
  EXPECT_EQ(s.p_min, -1.2);
  EXPECT_EQ(borne(*limited, s, -5.0), -1.2);

  // an inactive particle keeps a limit of its own
  o.weibull = 3.0;
  o.reference = 1.0;
  const auto scattered = made(EOS + PERFECT + SPALL, o);
  SolidInput in = input(uniaxial(1.0), -5.0);
  in.id = 7;
  in.size = 0.5;
  SolidState own = begun(*scattered, in);
  own.before.p_min = 0.0;
  scattered->begin_step(own, in);
  EXPECT_EQ(own.before.p_min, -1.2 * weibull_factor(0, 7, 3.0) * 2.0);
  o.weibull = o.reference = 0.0;
  EXPECT_NEAR(von_mises(s.S), Y, 1e-14);

  o.spall = Spall::ZERO;
  EXPECT_FALSE(made(EOS + PERFECT, o)->spall_limited());
}

// failed at the plastic strain D1, or that times Weibull's factor, to the step; then rubble

TEST(SolidModel, DamageToRubble)
{
  SolidOptions o = options("perfect");
  o.damage = true;
  for (double modulus : {0.0, 3.0}) {
    o.weibull = modulus;
    o.seed = 11;
    const auto model = made(EOS + PERFECT + DAMAGE, o);
    ASSERT_TRUE(model->damage());
    EXPECT_STREQ(model->damage()->name(), "johnson-cook");
    const SolidInput in = input(uniaxial(1.0));
    SolidState s = begun(*model, in), before = s;
    for (int i = 0; !s.failed(); i++) {
      before = s;
      step(*model, s, in, 1e-3);
      ASSERT_LT(i, 1000);
    }
    const double want = 0.1 * (modulus > 0.0 ? weibull_factor(11, 7, modulus) : 1.0);
    EXPECT_LT(before.eps, want);
    EXPECT_GE(s.eps, want * (1.0 - 1e-12));
    EXPECT_NEAR(before.damage, before.eps / want, 1e-12);
    EXPECT_EQ(s.spalled, 0.0);
    EXPECT_EQ(von_mises(s.S), 0.0);
    EXPECT_EQ(s.shear, 0.0);
    EXPECT_EQ(borne(*model, s, -1.0), 0.0);
  }
}

/* ----------------------------------------------------------------------
   temperature
------------------------------------------------------------------------- */

TEST(SolidModel, Temperature)
{
  SolidOptions o = options("johnson-cook");
  const SolidInput in = input({}, 0.0, 50.0);
  SolidState s = SolidModel::blank();
  s.heat = 20.0;
  EXPECT_NEAR(made(EOS + COOK, o)->temperature(s, in), 310.0, 1e-9);    // T0 + e/cp at rho0
  o.from_work = true;
  EXPECT_NEAR(made(EOS + COOK, o)->temperature(s, in), 304.0, 1e-9);    // T0 + heat/cp
  const auto part = made(EOS + COOK + "thermal work\nchi 0.9\n", o);
  EXPECT_NEAR(part->temperature(s, in), 303.6, 1e-9);
  o.from_work = false;
  const std::string cold = "# UNITS: lj\neos linear\nrho0 1\nK 60\n";
  EXPECT_TRUE(std::isnan(made(cold + COOK, o)->temperature(s, in)));

  // around voids matter is denser; rubble has the density it has, whatever voids it failed with

  o.spall = Spall::VOIDS;
  const auto open = made(EOS + COOK + "spall voids\nsigma 1\nrate 1\nm 0.2\nphi_c 0.1\n", o);
  s.voids.phi = 0.1;
  SolidInput dense = in;
  dense.rho = in.rho / 0.9;
  const double around = made(EOS + COOK, options("johnson-cook"))->temperature(s, dense);
  EXPECT_NEAR(open->temperature(s, in), around, 1e-9);
  EXPECT_GT(std::fabs(around - 310.0), 1e-6);
  s.spalled = 1.0;
  EXPECT_NEAR(open->temperature(s, in), 310.0, 1e-9);
}

// Adiabatic: Y = A (1 - T*) and dT = chi Y deps/cp give Y = A exp(-k eps), k = chi A/cp/(Tm - Tref);
// of first order in the step, so extrapolated

TEST(SolidModel, SoftensByItsOwnWork)
{
  SolidOptions o = options("johnson-cook");
  o.thermal = o.from_work = true;
  const std::string text = EOS + COOK + "thermal work\nchi 0.9\n";
  std::string soft = text;
  soft.replace(soft.find("cp 5\n"), 5, "cp 1e-3\n");
  const auto model = made(soft, o);
  const double k = 0.9 * 0.3 / 1e-3 / 600.0;
  double stress[2], eps = 0.0;
  for (int i = 0; i < 2; i++) {
    const SolidState s = walked(*model, input(uniaxial(1.0)), 1.5, 20000 << i);
    stress[i] = von_mises(s.S);
    eps = s.eps;
    EXPECT_NEAR(model->temperature(s, input({})) - 300.0, 900.0 * s.heat, 1e-9 * 900.0 * s.heat);
  }
  EXPECT_GT(eps, 0.9);
  EXPECT_NEAR(2.0 * stress[1] - stress[0], 0.3 * std::exp(-k * eps), 1e-5 * 0.3);

  // thermal no: it does not know
  o.thermal = false;
  EXPECT_NEAR(von_mises(walked(*made(soft, o), input(uniaxial(1.0)), 1.5, 100).S), 0.3, 1e-13);
}

// above Tm by the energy from outside nothing is left, and no plastic strain is added

TEST(SolidModel, Melts)
{
  SolidOptions o = options("johnson-cook");
  o.thermal = true;
  const auto model = made(EOS + COOK, o);
  SolidState s = walked(*model, input(uniaxial(1.0)), 0.1, 10);
  EXPECT_NEAR(von_mises(s.S), 0.3, 1e-13);
  const double eps = s.eps;
  step(*model, s, input(uniaxial(1.0), 0.0, 5.0 * 599.0), 0.01);
  EXPECT_GT(von_mises(s.S), 0.0);
  EXPECT_LT(von_mises(s.S), 0.001);
  EXPECT_GT(s.eps, eps);
  const double warm = s.eps;
  step(*model, s, input(uniaxial(1.0), 0.0, 5.0 * 601.0), 0.01);
  EXPECT_EQ(von_mises(s.S), 0.0);
  EXPECT_EQ(s.shear, 0.0);
  EXPECT_EQ(s.eps, warm);
  EXPECT_FALSE(s.failed());
}

// with melt, what is molten bears no tension; compressed it is whole

TEST(SolidModel, MeltsBearNoTension)
{
  const std::string VOIDS = "spall voids\nsigma 1.2\nrate 1\nm 0.2\nphi_c 0.1\n";
  for (const bool melt : {true, false})
    for (const double above : {-1.0, 1.0}) {
      SolidOptions o = options("johnson-cook");
      o.spall = Spall::VOIDS;
      o.thermal = true;
      o.melt = melt;
      const auto model = made(EOS + COOK + VOIDS, o);
      SolidState s = begun(*model, input({}));
      const double e = 5.0 * (600.0 + above);
      for (const double p : {1.0, 0.0}) step(*model, s, input(uniaxial(1.0), p, e), 0.01);
      EXPECT_FALSE(s.failed());
      SolidInput pulled = input(uniaxial(1.0), -1e-6, e);
      pulled.expansion = 3.0;
      step(*model, s, pulled, 0.01);
      const bool parts = melt && above > 0.0;
      EXPECT_EQ(s.failed(), parts);
      EXPECT_EQ(s.spalled, parts ? 1.0 : 0.0);
      EXPECT_EQ(model->fragments(s) > 0.0, parts);
      EXPECT_EQ(s.expansion, parts ? 3.0 : 0.0);
      if (parts) { EXPECT_GE(borne(*model, s, -0.5), -1e-200); }
    }
  SolidOptions o = options("none");    // of which no melting is known
  o.spall = Spall::VOIDS;
  o.thermal = o.melt = true;
  const auto model = made(EOS + VOIDS, o);
  SolidState s = begun(*model, input({}));
  step(*model, s, input(uniaxial(1.0), -1e-6, 5.0 * 1e4), 0.01);
  EXPECT_FALSE(s.failed());

  // voids that were there before

  o = options("johnson-cook");
  o.spall = Spall::VOIDS;
  o.thermal = o.melt = true;
  const auto cook = made(EOS + COOK + VOIDS, o);
  s = begun(*cook, input({}));
  s.voids.phi = 0.01;
  s.voids.D = 0.1;
  step(*cook, s, input(uniaxial(1.0), -1e-6, 5.0 * 601.0), 0.01);
  EXPECT_TRUE(s.failed());

  // what never melts

  o.strength = "perfect";
  EXPECT_NE(refused(parsed(EOS + PERFECT + VOIDS), o).find("never melts"), std::string::npos);
}

/* ----------------------------------------------------------------------
   the beginning of runs
------------------------------------------------------------------------- */

TEST(SolidModel, Starts)
{
  const auto model = made(EOS + PERFECT, options("perfect"));
  const SolidInput in = input(uniaxial(1.0));
  SolidState s = SolidModel::blank();
  EXPECT_FALSE(SolidModel::started(s));
  model->start(s, in, false);    // it has had no step: new, whatever is said
  EXPECT_TRUE(SolidModel::started(s));
  EXPECT_EQ(s.shear, G);
  EXPECT_EQ(s.before.shear, G);
  EXPECT_EQ(s.before.p_min, -NO_LIMIT);

  // one that goes on keeps all
  s = walked(*model, in, 0.1, 10);
  const SolidState kept = s;
  model->start(s, in, false);
  EXPECT_TRUE(same(s, kept));

  // one that was changed goes on from what it is: below its yield surface, although it was flowing
  s.S = scaled(s.S, 0.5);
  s.before = {};
  model->start(s, in, true);
  EXPECT_EQ(s.before.shear, G);
  EXPECT_EQ(s.before.p_min, -NO_LIMIT);
  step(*model, s, in, 1e-3);
  EXPECT_NEAR(s.S.xx, Y / 3.0 + 4.0 / 3.0 * G * 1e-3, 1e-14);
  EXPECT_EQ(s.eps, kept.eps);

  // rubble gets no modulus
  SolidState rubble = SolidModel::blank();
  rubble.damage = 1.0;
  model->start(rubble, in, true);
  EXPECT_EQ(rubble.shear, 0.0);
  EXPECT_EQ(rubble.before.p_min, 0.0);

  // a liquid's tension is not limited, but rubble stays rubble; neither has a stress left
  SolidModel::liquefy(rubble);
  EXPECT_EQ(rubble.before.p_min, 0.0);
  s.shear = G;
  SolidModel::liquefy(s);
  EXPECT_EQ(s.before.p_min, -NO_LIMIT);
  EXPECT_EQ(s.before.shear, 0.0);
  EXPECT_EQ(von_mises(s.S), 0.0);
}

/* ----------------------------------------------------------------------
   many at a time, mirrors, what is not a number
------------------------------------------------------------------------- */

TEST(SolidModel, ManyAtATime)
{
  SolidOptions o = options("johnson-cook");
  o.thermal = o.from_work = true;
  std::string text = EOS + COOK;
  text.replace(text.find("C 0\n"), 4, "C 0.1\n");
  text.replace(text.find("B 0\n"), 4, "B 0.2\n");
  text.replace(text.find("n 1\n"), 4, "n 0.4\n");
  const auto model = made(text, o);
  SolidState alone[LANES], together[LANES], *list[LANES];
  SolidInput in[LANES];
  for (int k = 0; k < LANES; k++) {
    in[k] = input(k % 2 ? shear(1.0 + k) : uniaxial(k - 2.5), 0.1 * k);
    alone[k] = together[k] = begun(*model, in[k]);
    list[k] = &together[k];
  }
  for (int i = 0; i < 50; i++) {
    for (int k = 0; k < LANES; k++) {
      step(*model, alone[k], in[k], 1e-3);
      model->begin_step(together[k], in[k]);
    }
    EXPECT_EQ(model->advance(LANES, list, in, 1e-3), -1);
  }
  for (int k = 0; k < LANES; k++) {
    EXPECT_GT(alone[k].eps, 0.01);
    EXPECT_TRUE(same(alone[k], together[k])) << k;
  }
}

TEST(SolidModel, Reflected)
{
  const auto model = made(EOS + PERFECT, options("perfect"));
  const VelocityGradient L = {0.3, 0.8, -0.2, 0.1, -0.6, 0.5, 0.4, -0.3, 0.25},
                         R = {0.3, -0.8, 0.2, -0.1, -0.6, 0.5, -0.4, -0.3, 0.25};    // x
  SolidState a = walked(*model, input(L), 0.003, 10), b = walked(*model, input(R), 0.003, 10);
  EXPECT_NE(a.S.xy, 0.0);
  EXPECT_FALSE(same(a, b));
  SolidModel::reflect(b, 1);
  EXPECT_TRUE(same(a, b));
  const SolidState twice = a;
  SolidModel::reflect(a, 6);
  EXPECT_EQ(a.S.xy, -twice.S.xy);
  EXPECT_EQ(a.S.yz, twice.S.yz);
  SolidModel::reflect(a, 6);
  EXPECT_TRUE(same(a, twice));
}

// turned by a quarter in 20 steps, S is turned by that, and keeps its size to fourth order

TEST(SolidModel, Turned)
{
  const auto elastic = made(EOS + PERFECT, options("perfect"));
  VelocityGradient turn = {};
  turn.xy = -1.0;
  turn.yx = 1.0;
  double error[2];
  for (int k = 0; k < 2; k++) {
    const int n = 20 << k;
    const double dt = 0.5 * M_PI / n;
    SolidState s = begun(*elastic, input({}));
    s.S = {0.3 * Y, -0.2 * Y, -0.1 * Y, 0.1 * Y, 0.05 * Y, -0.1 * Y};
    const Deviator S = s.S;
    const SolidInput in = input(turn);
    for (int i = 0; i < n; i++) step(*elastic, s, in, dt);
    EXPECT_NEAR(von_mises(s.S), von_mises(S), 0.5 * n * pow(2.0 * dt, 4) / 4.0 * von_mises(S));
    error[k] = fabs(s.S.xx - S.yy) + fabs(s.S.yy - S.xx) + fabs(s.S.xy + S.xy) +
        fabs(s.S.xz + S.yz) + fabs(s.S.yz - S.xz);
  }
  EXPECT_LT(error[0], 0.02 * Y);
  EXPECT_NEAR(error[0] / error[1], 4.0, 0.3);
}

TEST(SolidModel, NotANumber)
{
  const auto model = made(EOS + PERFECT, options("perfect"));
  SolidState states[2] = {begun(*model, input({})), begun(*model, input({}))};
  SolidState *const list[] = {&states[0], &states[1]};
  SolidInput in[2] = {input(uniaxial(1.0)), input(uniaxial(NONE))};
  for (SolidState &s : states) model->begin_step(s, input({}));
  EXPECT_EQ(model->advance(2, list, in, 0.1), 1);
}

/* ----------------------------------------------------------------------
   what materials and options do not go together
------------------------------------------------------------------------- */

TEST(SolidModel, Refused)
{
  SolidOptions o = options("steinberg-guinan");
  EXPECT_EQ(refused(parsed(EOS + PERFECT), o), "has no section strength steinberg-guinan");
  o.strength = "johnson-cook";
  std::string text = EOS + COOK;
  text.replace(text.find("Tm 900"), 6, "Tm 200");
  EXPECT_EQ(refused(parsed(text), o),
            "has a wrong section strength johnson-cook: Tm must be above Tref");
  o.from_work = true;
  EXPECT_EQ(refused(parsed("# UNITS: lj\neos linear\nrho0 1\nK 60\n" + COOK), o),
            "has an equation of state without heat capacity, which temperature work needs");
}

// damage: the one that the material has, or the one that is named

TEST(SolidModel, DamageOfTheMaterial)
{
  SolidOptions o = options("perfect");
  Material one = parsed(EOS + PERFECT + DAMAGE), two = parsed(EOS + PERFECT + DAMAGE);
  two.sections.push_back({"damage", "other", {}});
  std::string problem;
  EXPECT_FALSE(SolidModel::make(one, o, problem)->damage());
  o.damage = true;
  EXPECT_EQ(refused(parsed(EOS + PERFECT), o), "has no section damage; use damage no");
  EXPECT_STREQ(SolidModel::make(one, o, problem)->damage()->name(), "johnson-cook");
  EXPECT_EQ(refused(two, o),
            "has several sections damage (johnson-cook, other); say which: damage LAW");
  o.damage_law = "johnson-cook";
  EXPECT_STREQ(SolidModel::make(two, o, problem)->damage()->name(), "johnson-cook");
  o.damage_law = "other";
  EXPECT_EQ(refused(one, o), "has no section damage other; use damage no");
  EXPECT_EQ(refused(two, o), "has a wrong section damage other: damage other is no law of damage");
}
