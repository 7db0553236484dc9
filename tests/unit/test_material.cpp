/* ----------------------------------------------------------------------
   lammps-hvi: hypervelocity impact for LAMMPS, GNU GPL version 2, see LICENSE
   Material files: format, units, what is said about wrong ones, the files in potentials/.
------------------------------------------------------------------------- */

#include "hvi_material.h"

#include <cstdio>
#include <filesystem>
#include <gtest/gtest.h>

using HVI::Material;

namespace {

const std::string HEAD = "# DATE: 2026-02-01 UNITS: si CITATION: nobody\n\n";
const std::string EOS =
    "eos gruneisen\n rho0 2703 # [1]\n C 5240\n S1 1.4\n g0 1.97\n a 0.48\n cp 885\n";
const std::string JC = "strength johnson-cook\nG 27.6e9\nA 324e6\nB 114e6\nn .42\nC .002\nm 1.34\n"
                       "Tref 294\nTm 775\n";

Material parsed(const std::string &text, const std::string &units = "si")
{
  Material material;
  EXPECT_EQ(HVI::parse_material(text, "x.hvi", units, material), "");
  return material;
}

std::string problem(const std::string &text, const std::string &units = "si")
{
  Material material;
  return HVI::parse_material(text, "x.hvi", units, material);
}

/* ---------------------------------------------------------------------- */

TEST(Material, OfAFile)
{
  const Material m =
      parsed(HEAD + EOS + "\n" + JC + "damage johnson-cook\n" +
             "D1 -0.77\nD2 1.45\nD3 -.47\nD4 0\nD5 1.6\nspall limit\nsigma_p +1.2E9");
  EXPECT_EQ(m.name, "x.hvi");
  EXPECT_EQ(m.date, "2026-02-01");
  EXPECT_STREQ(m.eos->name(), "gruneisen");
  EXPECT_EQ(m.eos->rho0(), 2703);
  EXPECT_EQ(m.eos->c0(), 5240);
  EXPECT_EQ(m.eos->temperature(2703, 885), 301);
  ASSERT_TRUE(m.section("strength", "johnson-cook"));
  EXPECT_EQ(m.section("strength", "johnson-cook")->values.at("A"), 324e6);
  EXPECT_EQ(m.section("strength", "johnson-cook")->values.at("epsdot0"), 1.0);
  EXPECT_EQ(m.section("damage", "johnson-cook")->values.at("D1"), -0.77);
  EXPECT_EQ(m.section("spall", "limit")->values.at("sigma_p"), 1.2e9);
  EXPECT_FALSE(m.section("strength", "steinberg-guinan"));
  EXPECT_FALSE(m.section("thermal", "work"));
}

TEST(Material, BlanksTabsAndCarriageReturns)
{
  const Material m =
      parsed("# UNITS: si\r\n\r\n\teos   linear\r\n\trho0\t1000\r\n  K 1e9#comment\r\n# UNITS: "
             "of no interest here\n");
  EXPECT_EQ(m.eos->rho0(), 1000);
  EXPECT_EQ(m.eos->c0(), 1000);
}

TEST(Material, PresetsOfEveryLaw)
{
  const Material m = parsed("# UNITS: si\neos tait\nrho0 1000\nc0 1500\n");
  double p, csq;
  EXPECT_TRUE(m.eos->evaluate(1100, 0, p, csq));
  EXPECT_NEAR(p, 1000.0 * 1500 * 1500 / 7.0 * (std::pow(1.1, 7) - 1), 1e-3);
}

/* ---------------------------------------------------------------------- */

TEST(Units, PowersOfTen)
{
  using HVI::convert;
  EXPECT_EQ(convert(2703, HVI::DENSITY, "si", "cgs"), 2.703);
  EXPECT_EQ(convert(2703, HVI::DENSITY, "si", "micro"), 2.703);    // pg/um^3 = g/cm^3
  EXPECT_EQ(convert(1.0, HVI::PRESSURE, "si", "cgs"), 10.0);
  EXPECT_EQ(convert(1.0, HVI::PRESSURE, "si", "micro"), 1e-3);
  EXPECT_EQ(convert(5240, HVI::SPEED, "si", "cgs"), 524000);
  EXPECT_EQ(convert(5240, HVI::SPEED, "si", "micro"), 5240);
  EXPECT_EQ(convert(885, HVI::HEAT_CAPACITY, "si", "cgs"), 8.85e6);
  EXPECT_EQ(convert(1.0, HVI::RATE, "si", "micro"), 1e-6);
  EXPECT_EQ(convert(300, HVI::TEMPERATURE, "si", "micro"), 300);
}

TEST(Units, ThereAndBack)
{
  const HVI::Dimension dims[] = {HVI::NUMBER,        HVI::DENSITY,      HVI::SPEED,
                                 HVI::PRESSURE,      HVI::PER_PRESSURE, HVI::SPECIFIC_ENERGY,
                                 HVI::HEAT_CAPACITY, HVI::TEMPERATURE,  HVI::PER_TEMPERATURE,
                                 HVI::RATE,          {1, 2, -2, 0}};
  for (const auto &dim : dims)
    for (double x : {1.0, 2703.0, 324.1e6, 6.16e-4}) {
      double y = HVI::convert(x, dim, "si", "cgs");
      y = HVI::convert(y, dim, "cgs", "micro");
      EXPECT_NEAR(y / HVI::convert(x, dim, "si", "micro"), 1.0, 1e-14);
      y = HVI::convert(y, dim, "micro", "si");
      EXPECT_NEAR(y / x, 1.0, 1e-14);
    }
}

// p/(rho c^2) of the same state is the same number in all units, whatever units the file has

TEST(Units, OfFilesAndRuns)
{
  const std::string cgs = "# UNITS: cgs\neos gruneisen\nrho0 2.703\nC 5.24e5\nS1 1.4\ng0 1.97\n"
                          "a 0.48\ncp 8.85e6\nstrength johnson-cook\nG 27.6e10\nA 324e7\nB 114e7\n"
                          "n .42\nC .002\nm 1.34\nTref 294\nTm 775\n";
  const double rho[3] = {2703, 2.703, 2.703}, c[3] = {5240, 5.24e5, 5240};
  const double A[3] = {324e6, 324e7, 324e3}, rate[3] = {1, 1, 1e-6};
  const char *runs[3] = {"si", "cgs", "micro"};
  for (const std::string &text : {HEAD + EOS + JC, cgs})
    for (int i = 0; i < 3; i++) {
      const Material m = parsed(text, runs[i]);
      EXPECT_NEAR(m.eos->rho0(), rho[i], 1e-14 * rho[i]);
      EXPECT_NEAR(m.eos->c0(), c[i], 1e-14 * c[i]);
      double p, csq;
      EXPECT_TRUE(m.eos->evaluate(1.2 * rho[i], 0.1 * c[i] * c[i], p, csq));
      double p0, csq0;
      EXPECT_TRUE(parsed(HEAD + EOS).eos->evaluate(1.2 * 2703, 0.1 * 5240 * 5240, p0, csq0));
      EXPECT_NEAR(p / (rho[i] * c[i] * c[i]) / (p0 / (2703.0 * 5240 * 5240)), 1.0, 1e-13);
      EXPECT_NEAR(m.eos->temperature(1.2 * rho[i], 0.1 * c[i] * c[i]),
                  parsed(HEAD + EOS).eos->temperature(1.2 * 2703, 0.1 * 5240 * 5240), 1e-9);
      const auto &jc = m.section("strength", "johnson-cook")->values;
      EXPECT_NEAR(jc.at("A"), A[i], 1e-14 * A[i]);
      EXPECT_NEAR(jc.at("epsdot0"), rate[i], 1e-14 * rate[i]);    // a preset, too
      EXPECT_EQ(jc.at("Tm"), 775);
      EXPECT_EQ(jc.at("n"), 0.42);
    }
}

TEST(Units, LjFilesForLjRunsOnly)
{
  const std::string text = "# UNITS: lj\neos linear\nrho0 0.5\nK 2\n";
  EXPECT_EQ(parsed(text, "lj").eos->c0(), 2.0);
  EXPECT_EQ(problem(text, "si"), "x.hvi:1: UNITS: lj cannot be converted to units si of the run");
  EXPECT_EQ(problem(HEAD + EOS, "lj"),
            "x.hvi:1: UNITS: si cannot be converted to units lj of the run");
  EXPECT_EQ(problem(HEAD + EOS, "metal"),
            "x.hvi:1: UNITS: si cannot be converted to units metal of the run");
  // what is 300 K or 1/s in lj units, nobody knows
  EXPECT_EQ(problem("# UNITS: lj\neos gruneisen\nrho0 1\nC 1\nS1 1\ng0 1\n", "lj"),
            "x.hvi:2: eos gruneisen: missing key T0, which has no default in units lj");
  parsed("# UNITS: lj\neos gruneisen\nrho0 1\nC 1\nS1 1\ng0 1\nT0 1\n", "lj");
}

/* ---------------------------------------------------------------------- */

TEST(WrongFile, Header)
{
  EXPECT_EQ(problem(""), "x.hvi: no section eos");
  EXPECT_EQ(problem("# UNITS: si\n"), "x.hvi: no section eos");
  EXPECT_EQ(problem(EOS), "x.hvi:1: no UNITS: in the comments before the first section");
  EXPECT_EQ(problem("# UNITS: metal\n" + EOS),
            "x.hvi:1: unknown UNITS: metal; known are si, cgs, micro, lj");
  EXPECT_EQ(problem("# UNITS:\n" + EOS),
            "x.hvi:2: no UNITS: in the comments before the first section");
  EXPECT_EQ(problem("# UNITS: si\n# UNITS: cgs\n" + EOS), "x.hvi:2: UNITS: given twice");
}

TEST(WrongFile, Sections)
{
  EXPECT_EQ(problem(HEAD + "rho0 1\n"),
            "x.hvi:3: expected a section (eos, strength, damage, spall, thermal), found rho0");
  EXPECT_EQ(problem(HEAD + "eos\n"),
            "x.hvi:3: section eos names no law; known are linear, tait, idealgas, gruneisen, "
            "mie-gruneisen, polynomial, tillotson, table");
  EXPECT_EQ(problem(HEAD + EOS + "strength mts\n"),
            "x.hvi:10: unknown law strength mts; known are johnson-cook, steinberg-guinan, "
            "cowper-symonds, zerilli-armstrong, perfect, none");
  EXPECT_EQ(problem(HEAD + "eos linear 3\n"), "x.hvi:3: eos linear: unexpected text 3");
  EXPECT_EQ(problem(HEAD + EOS + "eos linear\n"),
            "x.hvi:10: second section eos, the first is in line 3");
  EXPECT_EQ(problem(HEAD + JC + JC),
            "x.hvi:12: second section strength johnson-cook, the first is in line 3");
  EXPECT_EQ(problem(HEAD + JC), "x.hvi: no section eos");
}

TEST(WrongFile, Keys)
{
  EXPECT_EQ(problem(HEAD + EOS + "gamma 2\n"),
            "x.hvi:10: eos gruneisen: unknown key gamma; known are rho0 C S1 g0 a cp S2 S3 T0");
  EXPECT_EQ(problem(HEAD + EOS + "strenght johnson-cook\n"),
            "x.hvi:10: eos gruneisen: unknown key strenght; known are rho0 C S1 g0 a cp S2 S3 T0");
  EXPECT_EQ(problem(HEAD + EOS + "\n C 5000\n"),
            "x.hvi:11: eos gruneisen: key C given twice, first in line 5");
  EXPECT_EQ(problem(HEAD + "eos linear\nrho0 1\n"), "x.hvi:3: eos linear: missing key K");
  EXPECT_EQ(problem(HEAD + EOS + "damage johnson-cook\nD1 1\n"),
            "x.hvi:10: damage johnson-cook: missing key D2");
}

TEST(WrongFile, Values)
{
  auto with = [](const std::string &value) {
    return problem(HEAD + "eos linear\nrho0 " + value);
  };
  EXPECT_EQ(with(""), "x.hvi:4: eos linear: key rho0 has no value");
  EXPECT_EQ(with("# 1"), "x.hvi:4: eos linear: key rho0 has no value");
  EXPECT_EQ(with("1 2"), "x.hvi:4: eos linear: rho0: unexpected text 2 after the value");
  EXPECT_EQ(with("1 kg/m^3"), "x.hvi:4: eos linear: rho0: unexpected text kg/m^3 after the value");
  for (const char *bad :
       {"abc", "1.0x", "1,5", "0x10", "nan", "NaN", "inf", "1e", "1d3", "--1", ".", "1.2.3"})
    EXPECT_EQ(with(bad), "x.hvi:4: eos linear: rho0: " + std::string(bad) + " is not a number");
  EXPECT_EQ(with("0"), "x.hvi:4: eos linear: rho0 = 0 must be > 0");
  EXPECT_EQ(with("-1"), "x.hvi:4: eos linear: rho0 = -1 must be > 0");
  EXPECT_EQ(with("1e999"), "x.hvi:4: eos linear: rho0 = inf is not a finite number");
  EXPECT_EQ(problem(HEAD + EOS + "thermal work\nchi 1.5"),
            "x.hvi:11: thermal work: chi = 1.5 is outside [0, 1]");
  EXPECT_EQ(problem(HEAD + EOS + "spall limit\nsigma_p -1e9"),
            "x.hvi:11: spall limit: sigma_p = -1e+09 must be > 0");
  EXPECT_EQ(problem("# UNITS: si\neos linear\nrho0 1\nK 1e308", "cgs"),
            "x.hvi:2: eos linear: K is out of range in units cgs");
}

// a law without parameters

TEST(Material, StrengthNone)
{
  const Material m = parsed(HEAD + EOS + "strength none\nspall limit\nsigma_p 1e9\n");
  ASSERT_TRUE(m.section("strength", "none"));
  EXPECT_TRUE(m.section("strength", "none")->values.empty());
  EXPECT_EQ(m.section("spall", "limit")->values.at("sigma_p"), 1e9);
  EXPECT_EQ(problem(HEAD + EOS + "strength none\nG 1\n"),
            "x.hvi:11: strength none: takes no keys, but got G");
  EXPECT_TRUE(m.is_liquid());
  EXPECT_FALSE(parsed(HEAD + EOS).is_liquid());
  EXPECT_FALSE(parsed(HEAD + EOS + JC).is_liquid());
  EXPECT_EQ(problem(HEAD + EOS + "strength none\n" + JC),
            "x.hvi:11: strength johnson-cook beside strength none in line 10");
  EXPECT_EQ(problem(HEAD + EOS + JC + "strength none\n"),
            "x.hvi:19: strength none beside strength johnson-cook in line 10");
}

// after an error nothing of the file is left to be used by mistake

TEST(WrongFile, LeavesNoEos)
{
  Material m;
  HVI::parse_material(HEAD + EOS, "x.hvi", "si", m);
  EXPECT_NE(HVI::parse_material(HEAD + EOS + "C 1", "x.hvi", "si", m), "");
  EXPECT_FALSE(m.eos);
}

/* ---------------------------------------------------------------------- */

namespace fs = std::filesystem;

std::string text_of(const fs::path &path)
{
  std::string text;
  FILE *fp = fopen(path.string().c_str(), "rb");
  for (int c; fp && (c = fgetc(fp)) != EOF;) text += (char) c;
  if (fp) fclose(fp);
  return text;
}

fs::path potentials()
{
  return fs::path(__FILE__).parent_path().parent_path().parent_path() / "potentials";
}

TEST(Potentials, AreRightAndCited)
{
  int n = 0;
  for (const auto &entry : fs::directory_iterator(potentials())) {
    if (entry.path().extension() != ".hvi") continue;
    n++;
    const std::string name = entry.path().filename().string(), text = text_of(entry.path());
    const bool lj = text.find("UNITS: lj") != std::string::npos;
    for (const char *units : {"si", "cgs", "micro"})
      if (!lj) {
        Material m;
        EXPECT_EQ(HVI::parse_material(text, name, units, m), "");
        EXPECT_EQ(m.date.size(), 10u) << name;
      }
    if (lj) {
      Material m;
      EXPECT_EQ(HVI::parse_material(text, name, "lj", m), "");
    }
    EXPECT_NE(text.find("CITATION: "), std::string::npos) << name;
    for (char c : text) EXPECT_TRUE(c == '\n' || (c >= ' ' && c <= '~')) << name;

    // every number has its comment
    for (size_t from = 0; from < text.size();) {
      const size_t to = std::min(text.find('\n', from), text.size());
      const std::string line = text.substr(from, to - from);
      if (line.compare(0, 2, "  ") == 0) {
        EXPECT_NE(line.find("# "), std::string::npos) << name << line;
      }
      from = to + 1;
    }
  }
  EXPECT_EQ(n, 26);
}

struct Handbook {
  const char *file;
  double rho0, c0, S1;
};

// Steinberg (1996), typed once more; through pressures: p/(rho0 c0^2) at eta and e = 0 gives S1

TEST(Potentials, HugoniotsOfTheHandbook)
{
  const Handbook table[] = {
      {"Al1100-O.hvi", 2707, 5386, 1.339}, {"Al2024-T3.hvi", 2785, 5328, 1.338},
      {"Al6061-T6.hvi", 2703, 5240, 1.40}, {"Al7075-T6.hvi", 2803, 5200, 1.36},
      {"Cu-OFHC.hvi", 8930, 3940, 1.489},  {"Ta.hvi", 16690, 3410, 1.20},
      {"Pb.hvi", 11340, 2006, 1.429},      {"steel-304.hvi", 7900, 4570, 1.49},
      {"steel-4340.hvi", 7810, 4578, 1.33}};
  for (const Handbook &row : table) {
    Material m;
    ASSERT_EQ(HVI::parse_material(text_of(potentials() / row.file), row.file, "si", m), "");
    EXPECT_EQ(m.eos->rho0(), row.rho0) << row.file;
    EXPECT_EQ(m.eos->c0(), row.c0) << row.file;
    // lead has a curved Hugoniot, which shows in third order only
    const double eta = 1e-3, Us = row.c0 / (1 - row.S1 * eta), u = eta * Us;
    double p, csq;
    EXPECT_TRUE(m.eos->evaluate(row.rho0 / (1 - eta), 0.5 * u * u, p, csq));
    EXPECT_NEAR(p / (row.rho0 * Us * u), 1.0, 2e-6) << row.file;
  }
}

// Tillotson's sets, typed once more; every parameter shows in a pressure

struct TillotsonSet {
  const char *file;
  std::vector<double> values;
};

TEST(Potentials, TillotsonSets)
{
  const TillotsonSet table[] = {
      {"Al-Tillotson.hvi", {2700, .5, 1.63, 75.2e9, 65e9, 5e6, 3e6, 13.9e6, 5, 5, 884}},
      {"Fe-Tillotson.hvi", {7860, .5, 1.5, 128e9, 105e9, 9.5e6, 1.42e6, 8.45e6, 5, 5, 449}},
      {"Cu-Tillotson.hvi", {8900, .5, 1.5, 139e9, 110e9, 32.5e6, 1.35e6, 3e6, 5, 5, 383}}};
  for (const TillotsonSet &row : table) {
    Material m;
    ASSERT_EQ(HVI::parse_material(text_of(potentials() / row.file), row.file, "si", m), "");
    std::string why;
    const auto law = HVI::make_eos("tillotson", row.values, why);
    ASSERT_TRUE(law) << why;
    EXPECT_EQ(m.eos->rho0(), row.values[0]);
    for (double x : {0.3, 0.9, 1.2, 2.0})
      for (double e : {1e5, 2e6, 5e6, 2e7}) {
        double p[2], csq[2];
        EXPECT_TRUE(m.eos->evaluate(x * m.eos->rho0(), e, p[0], csq[0]));
        EXPECT_TRUE(law->evaluate(x * m.eos->rho0(), e, p[1], csq[1]));
        EXPECT_EQ(p[0], p[1]) << row.file;
        EXPECT_EQ(m.eos->temperature(x * m.eos->rho0(), e), law->temperature(x * m.eos->rho0(), e));
      }
  }
}

// the laws' quotients of pressures do not depend on units

TEST(Units, OfTillotson)
{
  const std::string text = text_of(potentials() / "Al-Tillotson.hvi");
  Material si, cgs, micro;
  ASSERT_EQ(HVI::parse_material(text, "x", "si", si), "");
  ASSERT_EQ(HVI::parse_material(text, "x", "cgs", cgs), "");
  ASSERT_EQ(HVI::parse_material(text, "x", "micro", micro), "");
  for (double x : {0.5, 1.5})
    for (double e : {1e6, 5e6, 2e7}) {
      double p[3], csq[3];
      EXPECT_TRUE(si.eos->evaluate(2700 * x, e, p[0], csq[0]));
      EXPECT_TRUE(cgs.eos->evaluate(2.7 * x, e * 1e4, p[1], csq[1]));
      EXPECT_TRUE(micro.eos->evaluate(2.7 * x, e, p[2], csq[2]));
      EXPECT_NEAR(p[1], 10 * p[0], 1e-12 * std::fabs(p[1]));
      EXPECT_NEAR(p[2], 1e-3 * p[0], 1e-12 * std::fabs(p[2]));
      EXPECT_NEAR(csq[1], 1e4 * csq[0], 1e-12 * csq[1]);
      EXPECT_NEAR(csq[2], csq[0], 1e-12 * csq[2]);
      EXPECT_NEAR(cgs.eos->temperature(2.7 * x, e * 1e4), si.eos->temperature(2700 * x, e), 1e-8);
    }
}

TEST(Potentials, EspositoExchangedTheSoundSpeeds)
{
  for (const char *file : {"Al6061-T6-Esposito2024.hvi", "Al2024-T3-Esposito2024.hvi"}) {
    Material m;
    ASSERT_EQ(HVI::parse_material(text_of(potentials() / file), file, "si", m), "");
    EXPECT_EQ(m.eos->c0(), file[2] == '6' ? 5328 : 5240);
    EXPECT_EQ(m.section("spall", "limit")->values.at("sigma_p"), 1.2e9);
    EXPECT_EQ(m.section("strength", "johnson-cook")->values.at("Tref"), file[2] == '6' ? 273 : 294);
  }
}

}    // namespace
