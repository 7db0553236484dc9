/* ----------------------------------------------------------------------
   lammps-hvi: hypervelocity impact for LAMMPS, GNU GPL version 2, see LICENSE
   Laws of strength: their values, guards, sections of material files, and the solver of the radial
   return.
------------------------------------------------------------------------- */

#include "hvi_laws.h"
#include "hvi_material.h"
#include "hvi_strength_johnson_cook.h"
#include "hvi_strength_model.h"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <random>
#include <sstream>

using namespace HVI;

namespace {

const double NONE = std::numeric_limits<double>::quiet_NaN();
const double INFINITE = std::numeric_limits<double>::infinity();

const Section JC = {"strength",
                    "johnson-cook",
                    {{"G", 26e9},
                     {"A", 369e6},
                     {"B", 684e6},
                     {"n", 0.73},
                     {"C", 0.0083},
                     {"m", 1.7},
                     {"epsdot0", 1.0},
                     {"Tref", 300.0},
                     {"Tm", 775.0},
                     {"D", 0.0},
                     {"p", 1.0}}};
const double JC_VALUES[] = {26e9, 369e6, 684e6, 0.73, 0.0083, 1.7, 1.0, 300.0, 775.0, 0.0, 1.0};
const double DRAGGED[] = {26e9, 369e6, 684e6, 0.73, 0.0083, 1.7, 1.0, 300.0, 775.0, 5e4, 2.5};

Section dragged()
{
  Section section = JC;
  section.values["D"] = 5e4;
  section.values["p"] = 2.5;
  return section;
}
const Section SG = {"strength",
                    "steinberg-guinan",
                    {{"G0", 27.6e9},
                     {"Y0", 0.29e9},
                     {"Ymax", 0.68e9},
                     {"beta", 125.0},
                     {"n", 0.1},
                     {"A", 6.52e-11},
                     {"B", 6.16e-4},
                     {"Tm0", 1220.0},
                     {"g0", 1.97},
                     {"a", 1.5}}};
const Section CS = {
    "strength", "cowper-symonds", {{"G", 77e9}, {"Y0", 250e6}, {"D", 40.4}, {"p", 5.0}}};

// Zerilli and Armstrong (1987), OFHC copper and Armco iron; C0 with the term of the grain size

const Section ZA_CU = {"strength",
                       "zerilli-armstrong",
                       {{"G", 47.7e9},
                        {"C0", 65e6},
                        {"C1", 0.0},
                        {"C2", 890e6},
                        {"C3", 0.0028},
                        {"C4", 0.000115},
                        {"C5", 0.0},
                        {"n", 0.0},
                        {"epsdot0", 1.0},
                        {"Tm", 1356.0}}};
const Section ZA_FE = {"strength",
                       "zerilli-armstrong",
                       {{"G", 80e9},
                        {"C0", 65e6},
                        {"C1", 1033e6},
                        {"C2", 0.0},
                        {"C3", 0.00698},
                        {"C4", 0.000415},
                        {"C5", 266e6},
                        {"n", 0.289},
                        {"epsdot0", 1.0},
                        {"Tm", 1811.0}}};
const Section PERFECT = {"strength", "perfect", {{"G", 28.6e9}, {"Y", 0.26e9}}};

std::unique_ptr<Strength> made(const Section &section)
{
  std::string problem = "old";
  auto law = make_strength(section, problem);
  EXPECT_EQ(problem, "");
  EXPECT_TRUE(law);
  return law;
}

std::string refused(Section section, const std::string &key = "", double value = 0.0)
{
  if (!key.empty()) section.values[key] = value;
  std::string problem;
  EXPECT_FALSE(make_strength(section, problem));
  return problem;
}

Conditions at(double T, double p = 0.0, double eta = 1.0)
{
  return {2703.0 * eta, 2703.0, p, T};
}

}    // namespace

/* ----------------------------------------------------------------------
   values by hand
------------------------------------------------------------------------- */

TEST(JohnsonCook, Values)
{
  auto law = made(JC);
  EXPECT_STREQ(law->name(), "johnson-cook");
  EXPECT_DOUBLE_EQ(law->yield(0.0, 1.0, at(300.0)), 369e6);
  EXPECT_DOUBLE_EQ(law->yield(1.0, 1.0, at(300.0)), 1053e6);
  EXPECT_NEAR(law->yield(0.1, 0.0, at(300.0)), 496.366760e6, 10.0);        // 10^-0.73 = 0.186208714
  EXPECT_NEAR(law->yield(0.0, 1e5, at(300.0)), 404.260637e6, 10.0);        // ln 1e5 = 11.5129255
  EXPECT_NEAR(law->yield(0.0, 0.0, at(537.5)), 255.426928e6, 10.0);        // .5^1.7 = 0.307786103
  EXPECT_NEAR(law->yield(0.1, 1e5, at(537.5)) / 1e6, 376.424684, 1e-5);    // all three
  EXPECT_EQ(law->shear_modulus(at(774.0)), 26e9);
}

TEST(JohnsonCook, TemperatureIsClipped)
{
  auto law = made(JC);
  const double cold = law->yield(0.1, 10.0, at(300.0));
  EXPECT_EQ(law->yield(0.1, 10.0, at(3.0)), cold);
  EXPECT_EQ(law->yield(0.1, 10.0, at(NONE)), cold);
  EXPECT_LT(law->yield(0.1, 10.0, at(301.0)), cold);
  EXPECT_GT(law->yield(0.1, 10.0, at(774.9)), 0.0);
  for (double T : {775.0, 776.0, 1e5}) {
    EXPECT_EQ(law->yield(0.1, 10.0, at(T)), 0.0);
    EXPECT_EQ(law->shear_modulus(at(T)), 0.0);
    EXPECT_EQ(law->homologous_temperature(at(T)), 1.0);
  }
  EXPECT_EQ(law->homologous_temperature(at(3.0)), 0.0);
  EXPECT_EQ(law->homologous_temperature(at(NONE)), 0.0);
  EXPECT_DOUBLE_EQ(law->homologous_temperature(at(537.5)), 0.5);
}

// slow motion does not take away strength

TEST(JohnsonCook, SlowRates)
{
  auto law = made(JC);
  const double y = 369e6;
  for (double rate : {0.0, 1e-9, 0.5, 1.0}) EXPECT_EQ(law->yield(0.0, rate, at(300.0)), y);
  EXPECT_GT(law->yield(0.0, 1.01, at(300.0)), y);
  EXPECT_EQ(law->yield(0.0, NONE, at(300.0)), y);    // without rate terms
}

// with the term of Cowper and Symonds beside the logarithm

TEST(JohnsonCook, Dragged)
{
  auto law = made(dragged()), plain = made(JC);
  const double y = 369e6;
  EXPECT_EQ(law->yield(0.0, NONE, at(300.0)), y);    // without rate terms
  EXPECT_EQ(law->yield(0.0, 0.0, at(300.0)), y);
  EXPECT_NEAR(law->yield(0.0, 5e4, at(300.0)), plain->yield(0.0, 5e4, at(300.0)) + y, 1.0);
  EXPECT_NEAR(law->yield(0.0, 32 * 5e4, at(300.0)) - plain->yield(0.0, 32 * 5e4, at(300.0)), 4 * y,
              1.0);    // 32^(1/2.5) = 4
  EXPECT_NEAR(law->yield(0.0, 0.1, at(300.0)) / y, 1.0 + std::pow(2e-6, 0.4), 1e-12);
  EXPECT_EQ(law->yield(0.1, 1e6, at(775.0)), 0.0);
}

TEST(SteinbergGuinan, Values)
{
  auto law = made(SG);
  EXPECT_STREQ(law->name(), "steinberg-guinan");
  EXPECT_DOUBLE_EQ(law->shear_modulus(at(300.0)), 27.6e9);
  EXPECT_DOUBLE_EQ(law->yield(0.0, 7.0, at(300.0)), 0.29e9);
  EXPECT_EQ(law->yield(1e3, 7.0, at(300.0)), 0.68e9);
  EXPECT_NEAR(law->yield(0.1, 7.0, at(300.0)), 0.29e9 * std::pow(13.5, 0.1), 1.0);
  // 10 GPa, eta 1.125 (cube root 1.04004191), 500 K: 1 + .652/1.04004191 - .1232 = 1.503698
  const double f = 1.0 + 0.652 / 1.04004191 - 0.1232;
  EXPECT_NEAR(law->shear_modulus(at(500.0, 1e10, 1.125)), 27.6e9 * f, 300.0);
  EXPECT_NEAR(law->yield(0.0, 0.0, at(500.0, 1e10, 1.125)), 0.29e9 * f, 10.0);
  EXPECT_NEAR(law->shear_modulus(at(NONE, 1e10, 1.125)), 27.6e9 * (f + 0.1232), 300.0);
  // melting at eta 1.25: 1220 exp(3 (1 - .8)) 1.25^(2 (1.97 - 1.5 - 1/3)) = 1220 1.8221188 1.0628848
  EXPECT_NEAR(law->homologous_temperature(at(1300.0, 0.0, 1.25)), 1000.0 / 2062.76, 1e-5);
  // heat lowers it, cold raises it
  EXPECT_DOUBLE_EQ(law->shear_modulus(at(250.0)), 27.6e9 * (1.0 + 50.0 * 6.16e-4));
}

TEST(SteinbergGuinan, MeltAndGuards)
{
  auto law = made(SG);
  EXPECT_GT(law->yield(0.0, 0.0, at(1219.9)), 0.0);
  EXPECT_EQ(law->yield(0.0, 0.0, at(1220.0)), 0.0);
  EXPECT_EQ(law->shear_modulus(at(1220.0)), 0.0);
  EXPECT_GT(law->shear_modulus(at(1220.0, 1e10, 1.1)), 0.0);    // compression keeps it solid
  EXPECT_EQ(law->shear_modulus(at(NONE, -1e11, 0.9)), 0.0);     // never negative
  EXPECT_EQ(law->yield(0.0, 0.0, at(NONE, -1e11, 0.9)), 0.0);
  for (double eta : {1e-3, 1e-30, 1e-300}) {
    EXPECT_EQ(law->homologous_temperature(at(1e-300, 0.0, eta)), 1.0) << eta;
    EXPECT_EQ(law->yield(0.0, 0.0, at(300.0, 0.0, eta)), 0.0);
  }
  EXPECT_EQ(law->homologous_temperature(at(100.0, 0.0, 0.6)), 0.0);    // solid, melts below 300 K
  EXPECT_EQ(law->homologous_temperature(at(300.0, 0.0, 0.5)), 1.0);
  EXPECT_DOUBLE_EQ(law->homologous_temperature(at(760.0)), 0.5);
}

TEST(CowperSymonds, Values)
{
  auto law = made(CS);
  EXPECT_STREQ(law->name(), "cowper-symonds");
  EXPECT_EQ(law->yield(0.3, 0.0, at(300.0)), 250e6);
  EXPECT_EQ(law->yield(0.3, NONE, at(300.0)), 250e6);
  EXPECT_DOUBLE_EQ(law->yield(0.3, 40.4, at(1e5)), 500e6);
  EXPECT_DOUBLE_EQ(law->yield(0.3, 40.4 * 32.0, at(300.0)), 750e6);
  EXPECT_EQ(law->shear_modulus(at(1e5)), 77e9);
  EXPECT_EQ(law->homologous_temperature(at(1e5)), 0.0);
}

// fcc: 65 + 890 eps^.5 exp(-.0028 T + .000115 T ln epsdot) MPa

TEST(ZerilliArmstrong, Copper)
{
  auto law = made(ZA_CU);
  EXPECT_STREQ(law->name(), "zerilli-armstrong");
  EXPECT_DOUBLE_EQ(law->yield(0.0, 1e4, at(300.0)), 65e6);
  EXPECT_NEAR(law->yield(0.25, 1.0, at(300.0)), 257.111183e6, 10.0);    // exp(-.84) = .431710523
  EXPECT_NEAR(law->yield(0.25, 1e4, at(300.0)), 328.968829e6, 10.0);    // .0345 ln 1e4 = .317756743
  EXPECT_NEAR(law->yield(0.25, 1.0, at(600.0)), 147.936419e6, 10.0);    // exp(-1.68) = .186373976
  EXPECT_DOUBLE_EQ(law->yield(0.25, 1e4, at(0.0)), 510e6);
  EXPECT_EQ(law->shear_modulus(at(1355.0)), 47.7e9);
  EXPECT_DOUBLE_EQ(law->homologous_temperature(at(828.0)), 0.5);
}

// bcc: 65 + 1033 exp(-.00698 T + .000415 T ln epsdot) + 266 eps^.289 MPa

TEST(ZerilliArmstrong, Iron)
{
  auto law = made(ZA_FE);
  EXPECT_NEAR(law->yield(0.0, 1.0, at(300.0)), 192.258757e6, 10.0);    // exp(-2.094) = 0.123193375
  EXPECT_NEAR(law->yield(0.1, 1e3, at(300.0)), 502.473175e6, 10.0);    // .1^.289 = 0.514043652
  EXPECT_NEAR(law->yield(0.0, 1e3, at(77.0)), 817.574345e6, 10.0);     // exponent -0.316722680
  // cold iron is twice as strong, and hardening does not depend on temperature
  EXPECT_DOUBLE_EQ(law->yield(0.1, 1e3, at(77.0)) - law->yield(0.0, 1e3, at(77.0)),
                   266e6 * std::pow(0.1, 0.289));
}

TEST(ZerilliArmstrong, Guards)
{
  for (const Section &section : {ZA_CU, ZA_FE}) {
    auto law = made(section);
    const double slow = law->yield(0.3, 1.0, at(300.0)), athermal = law->yield(0.3, 1.0, at(0.0));
    // slow motion, or none, does not take away strength; without temperature it is that of 300 K
    for (double rate : {0.0, 1e-9, 0.999, NONE}) EXPECT_EQ(law->yield(0.3, rate, at(300.0)), slow);
    EXPECT_EQ(law->yield(0.3, 1e5, at(NONE)), law->yield(0.3, 1e5, at(300.0)));
    EXPECT_GT(law->yield(0.3, 1e5, at(NONE)), slow);
    // nothing is stronger than at 0 K, however fast
    EXPECT_LT(law->yield(0.3, 1e7, at(1000.0)), 0.99 * athermal);
    for (double rate : {1e30, 1e300}) {
      EXPECT_EQ(law->yield(0.3, rate, at(300.0)), athermal);
      EXPECT_EQ(law->yield(0.3, rate, at(-5.0)), athermal);
    }
    // Y does not fall with strain or rate, at any temperature
    for (double T : {0.0, 50.0, 300.0, 1000.0, 1300.0}) {
      double before = 0.0;
      for (double eps = 0.0; eps < 2.0; eps += 0.1) {
        const double y = law->yield(eps, 1e4, at(T));
        EXPECT_GE(y, before);
        before = y;
      }
      before = 0.0;
      for (double rate = 1e-3; rate < 1e15; rate *= 3.0) {
        const double y = law->yield(0.1, rate, at(T));
        EXPECT_GE(y, before);
        before = y;
      }
    }
    EXPECT_EQ(law->yield(0.3, 1e4, at(1811.0)), 0.0);
    EXPECT_EQ(law->shear_modulus(at(1811.0)), 0.0);
  }
}

// the terms that a form lacks may be left out; rates are in 1/s in all units

TEST(ZerilliArmstrong, OfAFile)
{
  const std::string head = "# UNITS: si\neos linear\nrho0 8930\nK 1.4e11\n",
                    text = "strength zerilli-armstrong\nG 47.7e9\nC0 65e6\nC2 890e6\nC3 .0028\n"
                           "C4 .000115\nTm 1356\n";
  for (const char *units : {"si", "cgs", "micro"}) {
    Material m;
    ASSERT_EQ(parse_material(head + text, "x", units, m), "");
    const double pressure = convert(1.0, PRESSURE, "si", units),
                 rate = convert(1e4, RATE, "si", units);
    auto law = made(*m.section("strength", "zerilli-armstrong"));
    EXPECT_NEAR(law->yield(0.25, rate, at(300.0)), 328.968829e6 * pressure, 10.0 * pressure);
  }
}

TEST(Perfect, ValuesAndNone)
{
  auto law = made(PERFECT);
  EXPECT_STREQ(law->name(), "perfect");
  EXPECT_EQ(law->yield(3.0, 1e9, at(1e5)), 0.26e9);
  EXPECT_EQ(law->shear_modulus(at(1e5)), 28.6e9);
  auto fluid = made({"strength", "none", {}});
  EXPECT_STREQ(fluid->name(), "none");
  EXPECT_EQ(fluid->shear_modulus(at(300.0)), 0.0);
  EXPECT_EQ(fluid->yield(1.0, 1e9, at(300.0)), 0.0);
  const Plastic r = fluid->radial_return({1.0, 0.0, -1.0, 0.0, 0.0, 0.0}, 1.0, 0.0, 0.0, at(1.0));
  EXPECT_EQ(von_mises(r.S), 0.0);
  EXPECT_EQ(r.d_eps, 0.0);
}

/* ----------------------------------------------------------------------
   sections
------------------------------------------------------------------------- */

TEST(StrengthSection, WrongValues)
{
  EXPECT_EQ(refused(JC, "A", -1.0), "A = -1 must be > 0");
  EXPECT_EQ(refused(JC, "n", -0.1), "n = -0.1 must be >= 0");
  EXPECT_EQ(refused(JC, "B", NONE), "B = nan is not a finite number");
  EXPECT_EQ(refused(JC, "Tm", 300.0), "Tm must be above Tref");
  EXPECT_EQ(refused(JC, "Tm", 200.0), "Tm must be above Tref");
  EXPECT_EQ(refused(SG, "Ymax", 0.28e9), "Ymax must not be below Y0");
  EXPECT_EQ(refused(SG, "Tm0", 300.0), "Tm0 must be above 300 K");
  EXPECT_EQ(refused(CS, "p", 0.0), "p = 0 must be > 0");
  EXPECT_EQ(refused(CS, "D", 0.0), "D = 0 must be > 0");
  EXPECT_EQ(refused(ZA_CU, "C0", 0.0), "C0 = 0 must be > 0");
  EXPECT_EQ(refused(ZA_CU, "C4", -1.0), "C4 = -1 must be >= 0");
  EXPECT_EQ(refused(ZA_FE, "Tm", 300.0), "Tm must be above 300 K");
  EXPECT_EQ(refused(PERFECT, "Y", 0.0), "Y = 0 must be > 0");
  EXPECT_EQ(refused(PERFECT, "G", INFINITE), "G = inf is not a finite number");
  EXPECT_EQ(refused({"strength", "perfect", {{"G", 1.0}}}), "missing key Y");
  EXPECT_EQ(refused({"strength", "mts", {}}), "strength mts is no law of strength");
  EXPECT_EQ(refused({"damage", "johnson-cook", JC.values}),
            "damage johnson-cook is no law of strength");
}

// in other units the same stress: everything scales

TEST(StrengthSection, Units)
{
  const std::string text = "# UNITS: si\neos linear\nrho0 2700\nK 7e10\n"
                           "strength cowper-symonds\nG 77e9\nY0 250e6\nD 40.4\np 5\n"
                           "strength perfect\nG 77e9\nY 250e6\n";
  Material si, cgs, micro;
  ASSERT_EQ(parse_material(text, "x", "si", si), "");
  ASSERT_EQ(parse_material(text, "x", "cgs", cgs), "");
  ASSERT_EQ(parse_material(text, "x", "micro", micro), "");
  ASSERT_TRUE(si.section("strength", "cowper-symonds"));
  auto a = made(*si.section("strength", "cowper-symonds")),
       b = made(*cgs.section("strength", "cowper-symonds")),
       c = made(*micro.section("strength", "cowper-symonds"));
  const double y = a->yield(0.0, 1e4, at(300.0));
  EXPECT_NEAR(b->yield(0.0, 1e4, at(300.0)) / 10.0, y, 1e-12 * y);
  EXPECT_NEAR(c->yield(0.0, 1e-2, at(300.0)) * 1e3, y, 1e-12 * y);
  EXPECT_EQ(made(*si.section("strength", "perfect"))->yield(0.0, 0.0, at(0.0)), 250e6);
}

// every file of the package: reference flow stress, modulus and melting within those of metals

TEST(StrengthSection, FilesOfThePackage)
{
  const std::filesystem::path folder =
      std::filesystem::path(__FILE__).parent_path() / ".." / ".." / "potentials";
  int strengths = 0, damages = 0, spalls = 0;
  for (const auto &entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".hvi") continue;
    std::ifstream in(entry.path());
    std::stringstream text;
    text << in.rdbuf();
    const bool lj = text.str().find("UNITS: lj") != std::string::npos;
    Material m;
    ASSERT_EQ(parse_material(text.str(), entry.path().filename(), lj ? "lj" : "si", m), "");
    const Conditions cold = {m.eos->rho0(), m.eos->rho0(), 0.0, 300.0};
    double G = 0.0, Tm = 0.0;
    for (const Section &s : m.sections) {
      SCOPED_TRACE(m.name + ": " + s.kind + " " + s.law);
      std::string problem;
      if (s.kind == "strength") {
        strengths++;
        auto law = made(s);
        ASSERT_TRUE(law);
        const bool jc = s.law == "johnson-cook";
        const double y = law->yield(0.0, 0.0, cold);
        if (s.law == "perfect") {
          EXPECT_EQ(y, s.values.at("Y"));
          EXPECT_EQ(law->shear_modulus(cold), s.values.at("G"));
          EXPECT_GT(s.values.at("G"), 10.0 * y);
          continue;
        }
        // handbook: A, or Y0; Esposito's 6061-T6 has Tref 273 K
        const double want = s.values.at(jc ? "A" : "Y0");
        EXPECT_NEAR(y, want, jc && s.values.at("Tref") < 299.0 ? 0.025 * want : 1e-9 * want);
        EXPECT_GE(law->yield(0.3, 0.0, cold), y);
        EXPECT_LE(law->yield(0.3, 1e6, cold), 2.0e9);
        EXPECT_EQ(law->shear_modulus(cold), s.values.at(jc ? "G" : "G0"));
        EXPECT_GT(law->shear_modulus(cold), 10.0 * y);
        const double melt = s.values.at(jc ? "Tm" : "Tm0");
        const Conditions warm = {cold.rho, cold.rho, 0.0, melt * (1.0 - 1e-12)};
        EXPECT_GT(law->shear_modulus(warm), 0.0);
        EXPECT_GT(melt, 500.0);
        EXPECT_LT(melt, 4500.0);
        const Conditions hot = {cold.rho, cold.rho, 0.0, melt * (1.0 + 1e-12)};
        EXPECT_EQ(law->yield(0.3, 1e6, hot), 0.0);
        EXPECT_EQ(law->shear_modulus(hot), 0.0);
        if (G > 0.0) {
          EXPECT_EQ(law->shear_modulus(cold), G);    // both laws of one metal
        }
        G = law->shear_modulus(cold);
        if (!jc) {
          // pressure hardens: along the Hugoniot at 10 GPa, say 10 % denser
          const Conditions pressed = {1.1 * cold.rho, cold.rho, 1e10, 300.0};
          EXPECT_GT(law->yield(0.0, 0.0, pressed), y);
          const Conditions liquid = {cold.rho, cold.rho, 0.0, melt},
                           squeezed = {1.1 * cold.rho, cold.rho, 1e10, melt};
          EXPECT_EQ(law->homologous_temperature(liquid), 1.0);
          EXPECT_LT(law->homologous_temperature(squeezed), 1.0);
          double p, csq;    // g0 of the law is that of the equation of state: dp/de = rho0 g0
          double q;
          ASSERT_TRUE(m.eos->evaluate(cold.rho, 0.0, p, csq));
          ASSERT_TRUE(m.eos->evaluate(cold.rho, 1e3, q, csq));
          EXPECT_NEAR((q - p) / 1e3 / cold.rho, s.values.at("g0"), 1e-9);
        } else
          Tm = melt;
      } else if (s.kind == "damage") {
        damages++;
        auto law = make_damage(s, problem);
        ASSERT_TRUE(law) << problem;
        auto failure_strain = [&](double sstar, double tstar) {
          return 1e-3 / law->increment(1e-3, 1e-3, -sstar, 1.0, tstar, 1.0);
        };
        const double tension = failure_strain(1.0 / 3.0, 0.0);
        EXPECT_NEAR(
            tension,
            std::max(1e-6,
                     s.values.at("D1") + s.values.at("D2") * std::exp(s.values.at("D3") / 3.0)),
            1e-12);
        EXPECT_GT(tension, 0.1);
        EXPECT_LT(tension, 4.0);
        EXPECT_GT(failure_strain(-0.5, 0.0), tension);
        EXPECT_LT(failure_strain(1.2, 0.0), tension);
        EXPECT_GE(failure_strain(1.0 / 3.0, 0.5), tension);
        EXPECT_GT(Tm, 0.0);    // T* needs it
      } else if (s.kind == "spall" && s.law == "limit") {
        spalls++;
        EXPECT_EQ(s.values.at("sigma_p"), 1.2e9);
      }
    }
  }
  EXPECT_EQ(strengths, 24);
  EXPECT_EQ(damages, 12);
  EXPECT_EQ(spalls, 5);
}

/* ----------------------------------------------------------------------
   the radial return
------------------------------------------------------------------------- */

TEST(VonMises, KnownAndOfAnySize)
{
  EXPECT_DOUBLE_EQ(von_mises({2.0, -1.0, -1.0, 0.0, 0.0, 0.0}), 3.0);
  EXPECT_DOUBLE_EQ(von_mises({0.0, 0.0, 0.0, 0.0, -2.0, 0.0}), 2.0 * std::sqrt(3.0));
  EXPECT_DOUBLE_EQ(von_mises({0.0, 0.0, 0.0, 1.0, 2.0, 2.0}), 3.0 * std::sqrt(3.0));
  EXPECT_EQ(von_mises({0.0, 0.0, 0.0, 0.0, 0.0, 0.0}), 0.0);
  EXPECT_DOUBLE_EQ(von_mises({2e200, -1e200, -1e200, 0.0, 0.0, 0.0}), 3e200);
  EXPECT_DOUBLE_EQ(von_mises({2e-200, -1e-200, -1e-200, 0.0, 0.0, 0.0}), 3e-200);
  for (int i = 0; i < 6; i++)
    for (double rest : {0.0, 1.0}) {
      double s[6] = {rest, rest, rest, rest, rest, rest};
      s[i] = NONE;
      EXPECT_TRUE(std::isnan(von_mises({s[0], s[1], s[2], s[3], s[4], s[5]})));
    }
  EXPECT_EQ(contract({1, 2, 3, 4, 5, 6}, {1, 10, 100, 1000, 1e4, 1e5}), 321.0 + 2.0 * 654000.0);
}

TEST(RadialReturn, PerfectByHand)
{
  auto law = made({"strength", "perfect", {{"G", 10.0}, {"Y", 3.0}}});
  const Plastic r = law->radial_return({4.0, -2.0, -2.0, 0.0, 0.0, 0.0}, 0.1, 10.0, 0.5, at(300.0));
  EXPECT_DOUBLE_EQ(r.S.xx, 2.0);
  EXPECT_DOUBLE_EQ(r.S.yy, -1.0);
  EXPECT_DOUBLE_EQ(r.d_eps, 0.1);    // (6 - 3)/30
  EXPECT_DOUBLE_EQ(r.work, 0.3);
  const Deviator inside = {1.9, -0.95, -0.95, 0.0, 0.0, 0.0};
  const Plastic e = law->radial_return(inside, 0.1, 10.0, 0.5, at(300.0));
  EXPECT_EQ(e.S.xx, inside.xx);
  EXPECT_EQ(e.d_eps, 0.0);
  EXPECT_EQ(e.work, 0.0);
}

// d_eps and stress against a bisection in long double, for many states of every law

TEST(RadialReturn, SolvesItsEquation)
{
  std::mt19937_64 random(4);
  auto uniform = [&](double a, double b) {
    return std::uniform_real_distribution<double>(a, b)(random);
  };
  int plastic = 0;
  const std::unique_ptr<Strength> laws[] = {made(JC),    made(SG),    made(CS),
                                            made(ZA_CU), made(ZA_FE), made(PERFECT)};
  for (int k = 0; k < 40000; k++) {
    const Strength &law = *laws[k % 6];
    const Conditions c = at(uniform(200.0, 1000.0), uniform(-1e9, 3e10), uniform(0.98, 1.2));
    const double G = law.shear_modulus(c);
    if (G == 0.0) continue;
    const double size = std::pow(10.0, uniform(7.5, 12.0));
    const double eps = k % 3 ? std::pow(10.0, uniform(-12.0, 1.0)) : 0.0;
    const double dt = std::pow(10.0, uniform(-12.0, 0.0));
    const Deviator trial = {
        size * uniform(-1.0, 1.0), size * uniform(-1.0, 1.0), 0.0,
        size * uniform(-1.0, 1.0), size * uniform(-1.0, 1.0), size * uniform(-1.0, 1.0)};
    const double s = von_mises(trial);
    const Plastic r = law.radial_return(trial, dt, G, eps, c);
    if (s <= law.yield(eps, 0.0, c)) {
      EXPECT_EQ(r.d_eps, 0.0);
      continue;
    }
    plastic++;
    long double lo = 0.0L, hi = s / (3.0 * G);
    for (int i = 0; i < 200; i++) {
      const long double x = 0.5L * (lo + hi);
      (s - 3.0L * G * x > law.yield(double(eps + x), double(x / dt), c) ? lo : hi) = x;
    }
    ASSERT_NEAR(r.d_eps, double(lo), 1e-14 * s / (3.0 * G)) << law.name();
    const double stress = von_mises(r.S);
    ASSERT_NEAR(stress, double(s - 3.0L * G * lo), 2e-15 * s);
    ASSERT_NEAR(r.work, stress * r.d_eps, 1e-14 * r.work);
    // the direction stays
    ASSERT_NEAR(r.S.xy, trial.xy * stress / s, 1e-13 * stress);
    ASSERT_NEAR(r.S.xx, trial.xx * stress / s, 1e-13 * stress);
  }
  EXPECT_GT(plastic, 20000);
}

// many particles at a time: as one by one, whoever is beside them

TEST(RadialReturn, ManyAtATime)
{
  std::mt19937_64 random(5);
  auto uniform = [&](double a, double b) {
    return std::uniform_real_distribution<double>(a, b)(random);
  };
  for (const Section &section : {JC, dragged(), SG, CS, ZA_CU, ZA_FE, PERFECT}) {
    auto law = made(section);
    SCOPED_TRACE(law->name());
    for (int k = 0; k < 20000; k++) {
      Conditions c[LANES];
      Deviator trial[LANES];
      double G[LANES], eps[LANES];
      Plastic r[LANES], alone;
      const double dt = k % 50 ? std::pow(10.0, uniform(-12.0, 0.0)) : 0.0;
      const int n = 1 + k % LANES;
      for (int l = 0; l < n; l++) {
        const double size = std::pow(10.0, uniform(k % 7 ? 8.0 : -300.0, k % 11 ? 11.0 : 40.0));
        c[l] = at(uniform(200.0, 1000.0), uniform(-1e9, 3e10), uniform(0.98, 1.2));
        G[l] = law->shear_modulus(c[l]);
        eps[l] = (k + l) % 3 ? std::pow(10.0, uniform(-12.0, 1.0)) : 0.0;
        trial[l] = {size * uniform(-1.0, 1.0), size * uniform(-1.0, 1.0), 0.0,
                    size * uniform(-1.0, 1.0), size * uniform(-1.0, 1.0), 0.0};
        if (k % 1000 == 1) trial[l].xy = NONE;
        if (k % 1000 == 2) trial[l] = {};
      }
      law->radial_return(n, trial, dt, G, eps, c, r);
      for (int l = 0; l < n; l++) {
        const Plastic one = law->radial_return(trial[l], dt, G[l], eps[l], c[l]);
        const double s = von_mises(trial[l]);
        if (std::isnan(one.d_eps)) {
          ASSERT_TRUE(std::isnan(r[l].d_eps) && std::isnan(r[l].S.xx));
          continue;
        }
        ASSERT_NEAR(r[l].yield, one.yield, 4e-15 * std::max(s, one.yield)) << k;
        ASSERT_NEAR(von_mises(r[l].S), von_mises(one.S), 4e-15 * s);
        ASSERT_NEAR(r[l].d_eps, one.d_eps, G[l] > 0.0 ? 1e-14 * s / (3.0 * G[l]) : 0.0);
        ASSERT_NEAR(r[l].work, r[l].yield * r[l].d_eps, 1e-14 * r[l].work);
        law->radial_return(1, trial + l, dt, G + l, eps + l, c + l, &alone);
        ASSERT_EQ(alone.d_eps, r[l].d_eps);
        ASSERT_EQ(alone.S.xy, r[l].S.xy);
      }
    }
  }
}

// Johnson and Cook's own solver does not leave usual cases to the other one

TEST(RadialReturn, JohnsonCookFindsIt)
{
  const Vec zero = {};
  for (const double *values : {JC_VALUES, DRAGGED}) {
    const StrengthJohnsonCook jc = StrengthJohnsonCook::make(values);
    for (double trial = 300e6; trial < 1e11; trial *= 1.3)
      for (double eps : {0.0, 1e-9, 1e-4, 0.1, 3.0})
        for (double dt : {0.0, 1e-12, 1e-9, 1e-7, 1e-4, 1.0})
          for (double factor : {0.0, 1e-3, 1.0}) {
            const Vec y = jc.solve(zero + trial, zero + 26e9, zero + factor, zero + eps, dt);
            const double x = std::max((trial - y[0]) / 78e9, 0.0);    // not precise for small ones
            const double rate = dt > 0.0 ? x / dt : NONE;
            const double steep = values[9] > 0.0 && dt > 0.0 && x > 0.0
                ? 1.0 + factor * jc.flow(eps + x, rate, at(300.0)) / (x * 78e9)
                : 1.0;    // by how much an error of y in x comes back
            EXPECT_NEAR(y[0], std::min(trial, factor * jc.flow(eps + x, rate, at(300.0))),
                        1e-9 * trial * steep)
                << trial << " " << eps << " " << dt << " " << factor;
          }
  }
}

// hard cases end, and with sense

TEST(RadialReturn, HardCases)
{
  const Deviator trial = {4e8, -2e8, -2e8, 1e9, 0.0, 0.0};
  const double s = von_mises(trial), G = 26e9;
  for (const Section &section : {JC, SG, CS, ZA_CU, ZA_FE, PERFECT}) {
    auto law = made(section);
    SCOPED_TRACE(law->name());
    // no time: without rate terms
    const Plastic now = law->radial_return(trial, 0.0, G, 0.0, at(300.0));
    EXPECT_NEAR(von_mises(now.S), law->yield(now.d_eps, NONE, at(300.0)), 1e-6 * s);
    EXPECT_GT(now.d_eps, 0.0);
    EXPECT_LT(now.d_eps, s / (3.0 * G));
    // hardly any time, an age
    for (double dt : {1e-300, 1e-30, 1e30, 1e300}) {
      const Plastic r = law->radial_return(trial, dt, G, 0.0, at(300.0));
      EXPECT_GE(r.d_eps, 0.0);
      EXPECT_LE(von_mises(r.S), s * (1.0 + 1e-15));
      EXPECT_NEAR(von_mises(r.S), s - 3.0 * G * r.d_eps, 1e-14 * s) << dt;
    }
    // a huge trial comes back to the yield surface
    const Deviator huge = scaled(trial, 1e20);
    const Plastic r = law->radial_return(huge, 1e-6, G, 0.0, at(300.0));
    const double y = law->yield(r.d_eps, r.d_eps / 1e-6, at(300.0));
    EXPECT_NEAR(von_mises(r.S), y, 1e-12 * y);
    EXPECT_DOUBLE_EQ(r.d_eps, (1e20 * s - y) / (3.0 * G));
    // no modulus: no plastic strain
    const Plastic soft = law->radial_return(trial, 1e-6, 0.0, 0.0, at(300.0));
    EXPECT_EQ(soft.d_eps, 0.0);
    EXPECT_EQ(soft.work, 0.0);
    EXPECT_NEAR(von_mises(soft.S), law->yield(0.0, 0.0, at(300.0)), 1e-12 * s);
    // what is not a number stays that
    for (double bad : {NONE, INFINITE, -INFINITE}) {
      const Plastic x = law->radial_return({bad, 0, 0, 0, 0, 1}, 1e-6, G, 0.0, at(300.0));
      EXPECT_TRUE(std::isnan(x.d_eps) && std::isnan(x.S.xy) && std::isnan(x.work));
    }
    EXPECT_TRUE(std::isnan(law->radial_return(trial, 1e-6, NONE, 0.0, at(300.0)).d_eps));
    EXPECT_TRUE(std::isnan(law->radial_return(trial, 1e-6, -1.0, 0.0, at(300.0)).d_eps));
  }
  // molten: nothing is left
  for (const Section &section : {JC, SG, ZA_CU, ZA_FE}) {
    const Plastic r = made(section)->radial_return(trial, 1e-6, G, 0.1, at(2000.0));
    EXPECT_EQ(von_mises(r.S), 0.0);
    EXPECT_NEAR(r.d_eps, s / (3.0 * G), 1e-15);
    EXPECT_EQ(r.work, 0.0);
    EXPECT_EQ(von_mises(made(section)->radial_return(trial, 0.0, 0.0, 0.1, at(2000.0)).S), 0.0);
  }
  EXPECT_TRUE(std::isnan(made(SG)->radial_return(trial, 1e-6, G, 0.1, at(300.0, NONE)).d_eps));
}

// how often a step asks for the flow stress

TEST(RadialReturn, Effort)
{
  struct Counting : StrengthJohnsonCook {
    static int &total()
    {
      static int n;
      return n;
    }
    explicit Counting(const StrengthJohnsonCook &law) : StrengthJohnsonCook(law) {}
    double flow(double eps, double rate, const Conditions &c) const
    {
      total()++;
      return StrengthJohnsonCook::flow(eps, rate, c);
    }
  };
  const StrengthJohnsonCook jc = StrengthJohnsonCook::make(JC_VALUES);
  const StrengthModel<Counting> law{Counting(jc)};
  int steps = 0, most = 0;
  Counting::total() = 0;
  double eps = 0.0;
  Deviator S = {};
  for (; steps < 1000; steps++) {
    const int before = Counting::total();
    const Plastic r = law.radial_return({S.xx + 2e8, S.yy - 1e8, S.zz - 1e8, 0.0, 0.0, 0.0}, 1e-7,
                                        26e9, eps, at(400.0));
    S = r.S;
    eps += r.d_eps;
    most = std::max(most, Counting::total() - before);
  }
  EXPECT_GT(eps, 1.0);
  EXPECT_LT(Counting::total(), 8 * steps);
  EXPECT_LT(most, 60);
}
