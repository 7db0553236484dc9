/* ----------------------------------------------------------------------
   lammps-hvi: hypervelocity impact for LAMMPS, GNU GPL version 2, see LICENSE
   Tabulated equations of state: interpolation and its order, what tables are refused, files.
------------------------------------------------------------------------- */

#include "eos_paths.h"

#include "hvi_eos_table.h"
#include "hvi_material.h"

#include <stdexcept>

using HVI::Eos;
using HVI::TableData;
using namespace HVI_TEST;

namespace {

constexpr double NAN_ = std::numeric_limits<double>::quiet_NaN();

std::unique_ptr<Eos> made(const TableData &data)
{
  std::string problem;
  auto law = HVI::make_eos_table(data, problem);
  if (!law) throw std::runtime_error(problem);
  EXPECT_EQ(problem, "");
  return law;
}

// n values from lo to hi, with spacings that differ if uneven > 0

std::vector<double> values(double lo, double hi, int n, double uneven = 0.0)
{
  std::vector<double> x;
  for (int k = 0; k < n; k++) {
    const double t = double(k) / (n - 1);
    x.push_back(lo + (hi - lo) * (t + uneven * t * (1 - t)));
  }
  return x;
}

template <class F>
TableData filled(const std::vector<double> &rho, const std::vector<double> &e, bool bicubic,
                 bool log_density, const F &p)
{
  TableData data;
  data.name = "x.table";
  data.bicubic = bicubic;
  data.log_density = log_density;
  data.rho = rho;
  data.e = e;
  for (double r : rho)
    for (double x : e) data.p.push_back(p(r, x));
  return data;
}

std::unique_ptr<Eos> eos(const std::string &name, const std::vector<double> &args)
{
  std::string problem;
  auto law = HVI::make_eos(name, args, problem);
  EXPECT_TRUE(law) << problem;
  return law;
}

std::unique_ptr<Eos> aluminum(const std::string &name)
{
  if (name == "tillotson")
    return eos(name, {2700, 0.5, 1.63, 75.2e9, 65e9, 5e6, 3e6, 13.9e6, 5, 5, 0});
  return eos(name, {2703, 5240, 1.40, 1.97, 0});
}

// a law as a table of n x n

std::unique_ptr<Eos> tabulated(const Eos &law, const std::vector<double> &rho,
                               const std::vector<double> &e, bool bicubic, bool log_density = false)
{
  return made(filled(rho, e, bicubic, log_density, [&law](double r, double x) {
    return at(law, r, x).p;
  }));
}

/* ---------------------------------------------------------------------- */

// what an interpolant must give exactly: bilinear functions, and cubics in both, on uneven grids

TEST(Table, ExactForItsPolynomials)
{
  for (bool log_density : {false, true})
    for (bool bicubic : {false, true}) {
      auto p = [=](double rho, double e) {
        const double x = log_density ? std::log(rho) : rho;
        if (!bicubic) return (2 + 3 * x) * (1 + 0.5 * e);
        return (2 + x * (3 + x * (0.4 + 0.2 * x))) * (1 + e * (0.5 + e * (0.25 + 0.1 * e)));
      };
      const auto law =
          made(filled(values(1, 4, 6, 0.3), values(0, 2, 7, -0.4), bicubic, log_density, p));
      for (double rho = 1; rho < 4.001; rho += 0.0937)
        for (double e = 0; e < 2.001; e += 0.0491) {
          const double r = std::min(rho, 4.0), d = 1e-5;
          const State s = at(*law, r, e);
          EXPECT_NEAR(s.p, p(r, e), 1e-12 * s.p);
          const double by_rho = (p(r + d, e) - p(r - d, e)) / (2 * d);
          const double by_e = (p(r, e + d) - p(r, e - d)) / (2 * d);
          EXPECT_NEAR(s.csq, by_rho + s.p / (r * r) * by_e, 1e-8 * s.csq);
        }
    }
}

TEST(Table, NodesAreHit)
{
  const auto mie = aluminum("mie-gruneisen");
  const auto rho = values(2500, 6000, 23, 0.2), e = values(-1e6, 2e7, 17, -0.3);
  for (bool bicubic : {false, true}) {
    const auto law = tabulated(*mie, rho, e, bicubic, true);
    for (double r : rho)
      for (double x : e) EXPECT_NEAR(at(*law, r, x).p, at(*mie, r, x).p, 1e-12 * 1e12);
  }
}

TEST(Table, BicubicHasNoSteps)
{
  const auto mie = aluminum("mie-gruneisen");
  const auto rho = values(2500, 6000, 15), e = values(-1e6, 2e7, 11);
  const auto law = tabulated(*mie, rho, e, true);
  for (std::size_t i = 1; i + 1 < rho.size(); i++)
    for (double x = -0.9e6; x < 2e7; x += 0.77e6) {
      const State lo = at(*law, rho[i] * (1 - 1e-12), x), hi = at(*law, rho[i] * (1 + 1e-12), x);
      EXPECT_NEAR(lo.p, hi.p, 1e-9 * 1e12);
      EXPECT_NEAR(lo.csq, hi.csq, 1e-9 * hi.csq);
    }
  for (std::size_t j = 1; j + 1 < e.size(); j++)
    for (double r = 2510; r < 6000; r += 33) {
      const State lo = at(*law, r, e[j] - 1e-6), hi = at(*law, r, e[j] + 1e-6);
      EXPECT_NEAR(lo.csq, hi.csq, 1e-9 * hi.csq);
    }
}

// c^2 belongs to the interpolated p, on coarse grids, too

TEST(Table, SoundSpeedIsTheSlopeOfTheIsentrope)
{
  const auto mie = aluminum("mie-gruneisen");
  for (bool bicubic : {false, true})
    for (bool log_density : {false, true}) {
      const auto law =
          tabulated(*mie, values(2700, 6000, 9), values(0, 2e7, 8), bicubic, log_density);
      for (double rho = 2800; rho < 5900; rho += 173)
        for (double e = 0.31e6; e < 1.9e7; e += 0.92e6) {
          // not across borders of cells
          const double x = (rho - 2700) / (3300 / 8.0), y = e / (2e7 / 7.0);
          if (std::fabs(x - std::round(x)) < 0.01 || std::fabs(y - std::round(y)) < 0.02) continue;
          const double slope = slope_of_isentrope(*law, rho, e, 1e-4 * rho);
          EXPECT_NEAR(at(*law, rho, e).csq, slope, 1e-7 * slope) << rho << " " << e;
        }
    }
}

/* ---------------------------------------------------------------------- */

struct Errors {
  double hugoniot, energy, csq;
};

// root mean squares of the relative errors: of the density behind shocks, of what the isentropes
// down from there leave of the energy at end, and of c^2 on the way

Errors errors(const Eos &law, const Eos &table, double rho0, double end)
{
  Errors sum = {0, 0, 0};
  int n = 0, points = 0;
  for (double u = 1000; u < 2301; u += 50, n++) {
    const State want = hugoniot(law, rho0, u, 1.7 * rho0),
                got = hugoniot(table, rho0, u, 1.7 * rho0);
    sum.hugoniot += std::pow(got.rho / want.rho - 1, 2);
    const double e0 = isentrope(law, want.rho, want.e, end, 1000);
    const double e1 = isentrope(table, got.rho, got.e, end, 1000);
    sum.energy += std::pow((e1 - e0) / want.e, 2);
    for (double x = 1.02; x < want.rho / end; x *= 1.03, points++) {
      const double rho = want.rho / x, e = isentrope(law, want.rho, want.e, rho, 100);
      sum.csq += std::pow(at(table, rho, e).csq / at(law, rho, e).csq - 1, 2);
    }
  }
  return {std::sqrt(sum.hugoniot / n), std::sqrt(sum.energy / n), std::sqrt(sum.csq / points)};
}

void converges(const std::string &name, bool bicubic, bool log_density, double from, double end,
               double order, double order_csq)
{
  const auto law = aluminum(name);
  const double rho0 = law->rho0();
  std::vector<Errors> all;
  std::vector<int> sizes = {17, 33, 65, 129};
  for (int n : sizes)
    all.push_back(errors(*law,
                         *tabulated(*law, values(from * rho0, 1.75 * rho0, n), values(0, 2.9e6, n),
                                    bicubic, log_density),
                         rho0, end * rho0));
  // over the whole range of sizes
  const double steps = std::log2(double(sizes.back() - 1) / (sizes.front() - 1));
  auto measured = [&](double first, double last, const char *what) {
    const double o = std::log2(first / last) / steps;
    ::testing::Test::RecordProperty(what, std::to_string(o));
    if (std::getenv("HVI_PRINT"))
      printf("%s %s log %d %s: %.3g to %.3g, order %.2f\n", name.c_str(),
             bicubic ? "bicubic" : "bilinear", log_density, what, first, last, o);
    return o;
  };
  EXPECT_GT(measured(all.front().hugoniot, all.back().hugoniot, "hugoniot"), order);
  EXPECT_GT(measured(all.front().energy, all.back().energy, "energy"), order);
  EXPECT_GT(measured(all.front().csq, all.back().csq, "csq"), order_csq);
}

// down to 0.98 rho0: of Tillotson's law that is one smooth branch, of mie-gruneisen one
// with a second derivative that jumps at rho0, so there it ends above

TEST(TableOrder, BilinearTillotson)
{
  converges("tillotson", false, false, 0.95, 0.98, 1.8, 0.9);
}
TEST(TableOrder, BicubicTillotson)
{
  converges("tillotson", true, false, 0.95, 0.98, 3.6, 2.7);
}
TEST(TableOrder, BicubicTillotsonLog)
{
  converges("tillotson", true, true, 0.95, 0.98, 3.6, 2.7);
}
TEST(TableOrder, BilinearMieGruneisen)
{
  converges("mie-gruneisen", false, true, 1.0, 1.05, 1.8, 0.9);
}
TEST(TableOrder, BicubicMieGruneisen)
{
  converges("mie-gruneisen", true, false, 1.0, 1.05, 3.6, 2.7);
}

// The table's own isentrope keeps the energy equation: pressure from the speed of sound, as for
// Tillotson's law

TEST(Table, ReleaseToZeroPressure)
{
  const auto law = aluminum("tillotson");
  const auto table = tabulated(*law, values(2430, 4900, 101), values(0, 2.9e6, 61), true);
  for (double u : {700.0, 1500.0, 2200.0}) {
    const State want = released(*law, hugoniot(*law, 2700, u, 4800), 1e-3);
    const State got = released(*table, hugoniot(*table, 2700, u, 4800), 1e-3);
    EXPECT_NEAR(got.rho, want.rho, 1e-6 * want.rho);
    EXPECT_NEAR(got.e, want.e, 1e-5 * want.e);
  }
}

/* ---------------------------------------------------------------------- */

TEST(Table, NoAnswerOutside)
{
  const auto mie = aluminum("mie-gruneisen");
  for (bool bicubic : {false, true})
    for (bool log_density : {false, true}) {
      const auto law =
          tabulated(*mie, values(2500, 5000, 9), values(-1e5, 1e7, 9), bicubic, log_density);
      for (double rho : {2500.0, 3000.0, 5000.0})
        for (double e : {-1e5, 0.0, 1e7}) at(*law, rho, e);
      for (auto [rho, e] :
           {std::pair(2499.99, 0.0), std::pair(5000.01, 0.0), std::pair(3000.0, -1.0001e5),
            std::pair(3000.0, 1.0001e7), std::pair(NAN_, 0.0), std::pair(3000.0, NAN_),
            std::pair(HVI::NO_LIMIT, 0.0), std::pair(3000.0, -HVI::NO_LIMIT), std::pair(0.0, 0.0),
            std::pair(-3000.0, 0.0)}) {
        double p = 1, csq = 1;
        EXPECT_FALSE(law->evaluate(rho, e, p, csq)) << rho << " " << e;
        EXPECT_TRUE(std::isnan(p) && std::isnan(csq));
        EXPECT_TRUE(std::isnan(law->temperature(rho, e)));
      }
      EXPECT_STREQ(law->name(),
                   "table x.table (densities 2500 to 5000, energies -100000 to 1e+07)");
      EXPECT_GT(law->rho_max(), 5000);
      EXPECT_LT(law->rho_max(), 5000.001);
    }
}

TEST(Table, ReferenceState)
{
  const auto mie = aluminum("mie-gruneisen");
  TableData data =
      filled(values(2303, 3103, 11), values(-1e6, 1e6, 5), false, false, [&](double r, double e) {
        return at(*mie, r, e).p;
      });
  EXPECT_EQ(made(data)->rho0(), 0.0);
  EXPECT_EQ(made(data)->c0(), 0.0);
  data.rho0 = 2703;
  EXPECT_EQ(made(data)->rho0(), 2703);
  EXPECT_NEAR(made(data)->c0(), 5240, 0.05 * 5240);    // one-sided difference over a cell
}

TEST(Table, Temperature)
{
  TableData data = filled({1, 2, 4}, {0, 1, 3}, false, false, [](double r, double e) {
    return r * (1 + e);
  });
  EXPECT_TRUE(std::isnan(made(data)->temperature(1.5, 0.5)));
  for (double r : data.rho)
    for (double e : data.e) data.T.push_back(10 + r * 2 + e * 100 + r * e);
  EXPECT_NEAR(made(data)->temperature(1.5, 0.5), 10 + 3 + 50 + 0.75, 1e-12);
  EXPECT_NEAR(made(data)->temperature(4, 3), 10 + 8 + 300 + 12, 1e-12);
  data.T[0] = -50;
  EXPECT_EQ(made(data)->temperature(1, 0), 0.0);
}

/* ---------------------------------------------------------------------- */

void refused(const TableData &data, const std::string &why)
{
  std::string problem;
  EXPECT_FALSE(HVI::make_eos_table(data, problem));
  EXPECT_NE(problem.find(why), std::string::npos) << problem;
}

TableData gas(bool bicubic)    // p = 0.4 rho e
{
  return filled(values(1, 2, 5), values(1, 3, 5), bicubic, false, [](double r, double e) {
    return 0.4 * r * e;
  });
}

TEST(TableRefused, Grids)
{
  for (bool bicubic : {false, true}) {
    EXPECT_NEAR(at(*made(gas(bicubic)), 1.3, 2.2).csq, 1.4 * 0.4 * 2.2, 1e-12);
    TableData data = gas(bicubic);
    data.rho[2] = data.rho[1];
    refused(data, "densities do not increase: 1.25 after 1.25");
    data = gas(bicubic);
    data.e[3] = 1.1;
    refused(data, "energies do not increase: 1.1 after 2");
    data = gas(bicubic);
    data.rho[0] = 0;
    refused(data, "density 0 must be > 0");
    data = gas(bicubic);
    data.rho[4] = NAN_;
    refused(data, "densities nan is not a finite number");
    data = gas(bicubic);
    data.p[7] = NAN_;
    refused(data, "pressure nan is not a finite number");
    data = gas(bicubic);
    data.p[7] = HVI::NO_LIMIT;
    refused(data, "pressure inf is not a finite number");
    data = gas(bicubic);
    data.T.assign(25, 300);
    data.T[3] = NAN_;
    refused(data, "temperature nan is not a finite number");
    data.T.resize(24);
    refused(data, "has 25 pressures and 24 temperatures for 5 densities and 5 energies");
  }
  auto p = [](double r, double e) {
    return r * e;
  };
  refused(filled({1, 2, 3}, values(1, 2, 9), true, false, p),
          "3 densities and 9 energies are too few, bicubic needs 4");
  refused(filled(values(1, 2, 9), {1}, false, false, p),
          "9 densities and 1 energies are too few, bilinear needs 2");
  made(filled({1, 2}, {1, 2}, false, false, p));
  made(filled(values(1, 2, 4), values(1, 2, 4), true, false, p));
}

TEST(TableRefused, PressureThatFalls)
{
  for (bool bicubic : {false, true}) {
    TableData data = gas(bicubic);
    for (int j = 0; j < 5; j++) data.p[2 * 5 + j] *= 0.3;    // a dent at rho = 1.5
    refused(data, "pressure falls with density at constant entropy (c^2 = -");
    if (!bicubic) refused(data, "between densities 1.25 and 1.5");
    data = filled(values(1, 2, 5), values(1, 3, 5), bicubic, false, [](double, double) {
      return 7.0;
    });
    refused(data, "pressure nowhere rises with density");
  }
  // a dent within the table at a single node
  TableData data = filled(values(1, 2, 9), values(1, 3, 9), true, false, [](double r, double e) {
    return 0.4 * r * e;
  });
  data.p[4 * 9 + 4] -= 0.3;
  refused(data, "pressure falls");
}

// The check asks for constant entropy: dp/drho < 0 at constant e is all right where the gas is heated
// enough, dp/drho > 0 is not enough in tension

TEST(TableRefused, AtConstantEntropyNotEnergy)
{
  auto falls = [](double r, double e) {
    return e * (2.2 - 0.2 * r);
  };
  const auto law = made(filled(values(1, 2, 9), values(1, 3, 9), true, false, falls));
  EXPECT_LT(at(*law, 1.6, 2).p, at(*law, 1.5, 2).p);
  EXPECT_GT(at(*law, 1.6, 2).csq, 0);
  auto tension = [](double r, double e) {
    return r - 10 + 2 * r * e;
  };
  refused(filled(values(1, 2, 9), values(1, 2, 9), true, false, tension), "pressure falls");
}

// a plateau where tension is cut off is no mistake; c has its floor there

TEST(TableRefused, ButNotAPlateau)
{
  const auto mie = aluminum("mie-gruneisen");
  auto cut = [&](double r, double e) {
    return std::max(at(*mie, r, e).p, 0.0);
  };
  std::vector<double> rho = values(270, 2703, 26);    // with a node at the kink
  for (double x : values(2755, 4000, 25)) rho.push_back(x);
  TableData data = filled(rho, values(0, 1e7, 21), false, false, cut);
  data.rho0 = 2703;
  const auto law = made(data);
  EXPECT_EQ(at(*law, 1000, 0).p, 0.0);
  EXPECT_EQ(at(*law, 1000, 0).csq, 1e-6 * law->c0() * law->c0());
}

TEST(TableRefused, WrongReference)
{
  TableData data = gas(true);
  data.rho0 = 1.5;
  refused(data, "the reference state, rho0 = 1.5 and energy 0, is not in the table");
  data = filled(values(1, 2, 5), values(-1, 3, 5), true, false, [](double r, double e) {
    return r + 0.1 * r * e;
  });
  data.rho0 = 1.5;
  refused(data, "pressure 1.5 of the reference state, rho0 = 1.5 and energy 0, is not about 0");
}

/* ---------------------------------------------------------------------- */

const std::string HEAD = "# DATE: 2026-02-01 UNITS: si\n";
const std::string BODY = "rho0 1.5\ndensity linear\ninterpolation bilinear # comment\n\n"
                         "pressure 3 2\n e 0 2\n 1 -1 0\n 1.5 0 1.5\n 2 1 3\n";

std::unique_ptr<Eos> parsed(const std::string &text, const std::string &units = "si")
{
  std::string why, date;
  auto law = HVI::parse_table(text, "x.table", units, why, date);
  if (!law) throw std::runtime_error(why);
  EXPECT_EQ(why, "");
  return law;
}

std::string problem(const std::string &text, const std::string &units = "si")
{
  std::string why, date;
  EXPECT_FALSE(HVI::parse_table(text, "x.table", units, why, date));
  return why;
}

std::string changed(const std::string &old, const std::string &now)
{
  std::string text = HEAD + BODY;
  const auto k = text.find(old);
  EXPECT_NE(k, std::string::npos) << old;
  return text.replace(k, old.size(), now);
}

TEST(TableFile, IsRead)
{
  const auto law = parsed(HEAD + BODY);
  EXPECT_EQ(law->rho0(), 1.5);
  EXPECT_DOUBLE_EQ(at(*law, 1.75, 1).p, (0 + 1.5 + 1 + 3) / 4);
  EXPECT_DOUBLE_EQ(at(*law, 1.25, 2).p, 0.75);
  EXPECT_TRUE(std::isnan(law->temperature(1.5, 1)));
  const auto hot =
      parsed(HEAD + BODY + "\ntemperature 3 2 \r\n# again\ne 0 2\n1 300 400\n1.5 310 410\n2 1 2\n");
  EXPECT_DOUBLE_EQ(hot->temperature(1.25, 1), 355);
  // presets: bicubic, linear
  std::string many = "pressure 4 4\ne 1 2 3 4\n";
  for (int r = 1; r < 5; r++) {
    many += std::to_string(r);
    for (int e = 1; e < 5; e++) many += " " + std::to_string(r * r * r * e);
    many += "\n";
  }
  EXPECT_NEAR(at(*parsed(HEAD + many), 2.3, 2.7).p, 2.3 * 2.3 * 2.3 * 2.7, 1e-12);
  EXPECT_NEAR(
      at(*parsed(HEAD + "density log\ninterpolation bilinear\n" + many), std::sqrt(2.0), 1).p, 4.5,
      1e-12);
}

TEST(TableFile, Units)
{
  // Pa, kg/m^3, J/kg in other units
  const std::string hot = "temperature 3 2\ne 0 2\n1 300 400\n1.5 310 410\n2 320 420\n";
  const auto cgs = parsed(HEAD + BODY + hot, "cgs"), micro = parsed(HEAD + BODY + hot, "micro");
  const auto si = parsed(HEAD + BODY + hot);
  const State a = at(*si, 1.7, 1.5), b = at(*cgs, 1.7e-3, 1.5e4), c = at(*micro, 1.7e-3, 1.5);
  EXPECT_NEAR(b.p, 10 * a.p, 1e-12 * b.p);
  EXPECT_NEAR(c.p, 1e-3 * a.p, 1e-12 * c.p);
  EXPECT_NEAR(b.csq, 1e4 * a.csq, 1e-12 * b.csq);
  EXPECT_NEAR(c.csq, a.csq, 1e-12 * c.csq);
  EXPECT_NEAR(cgs->rho0(), 1.5e-3, 1e-15);
  EXPECT_NEAR(cgs->temperature(1.7e-3, 1.5e4), si->temperature(1.7, 1.5), 1e-9);
  const std::string lj = changed("UNITS: si", "UNITS: lj");
  EXPECT_EQ(at(*parsed(lj, "lj"), 1.7, 1.5).p, a.p);
  EXPECT_EQ(problem(lj), "x.table:1: UNITS: lj cannot be converted to units si of the run");
  EXPECT_EQ(problem(HEAD + BODY, "lj"),
            "x.table:1: UNITS: si cannot be converted to units lj of the run");
}

TEST(TableFile, WrongHead)
{
  EXPECT_EQ(problem(""), "x.table: no pressure");
  EXPECT_EQ(problem(HEAD + "rho0 1.5\n"), "x.table: no pressure");
  EXPECT_EQ(problem(BODY), "x.table:1: no UNITS: in the comments before the first key");
  EXPECT_EQ(problem(changed("UNITS: si", "UNITS: metal")),
            "x.table:1: unknown UNITS: metal; known are si, cgs, micro, lj");
  EXPECT_EQ(problem("# UNITS: si\n# UNITS: si\n" + BODY), "x.table:2: UNITS: given twice");
  EXPECT_EQ(problem(changed("rho0 1.5", "rho 1.5")),
            "x.table:2: unknown key rho; known are rho0, density, interpolation, pressure, "
            "temperature");
  EXPECT_EQ(problem(changed("rho0 1.5", "rho0")), "x.table:2: rho0 has no value");
  EXPECT_EQ(problem(changed("rho0 1.5", "rho0 -1")), "x.table:2: rho0 must be > 0");
  EXPECT_EQ(problem(changed("rho0 1.5", "rho0 x")), "x.table:2: rho0: x is not a number");
  EXPECT_EQ(problem(changed("rho0 1.5", "rho0 1 2")),
            "x.table:2: rho0: unexpected text 2 after the value");
  EXPECT_EQ(problem(changed("rho0 1.5", "rho0 1\nrho0 1")), "x.table:3: rho0 given twice");
  EXPECT_EQ(problem(changed("density linear", "density cubic")),
            "x.table:3: density must be linear or log, not cubic");
  EXPECT_EQ(problem(changed("density linear", "density linear\ndensity log")),
            "x.table:4: density given twice");
  EXPECT_EQ(problem(changed("bilinear", "spline")),
            "x.table:4: interpolation must be bilinear or bicubic, not spline");
}

TEST(TableFile, WrongBlocks)
{
  const std::string needs =
      "x.table:6: pressure needs the numbers of densities and energies, found ";
  EXPECT_EQ(problem(changed("pressure 3 2", "pressure 3")), needs + "nothing");
  EXPECT_EQ(problem(changed("pressure 3 2", "pressure 3 x")), needs + "x");
  EXPECT_EQ(problem(changed("pressure 3 2", "pressure 2.5 2")), needs + "2.5");
  EXPECT_EQ(problem(changed("pressure 3 2", "pressure 0 2")), needs + "0");
  EXPECT_EQ(problem(changed("pressure 3 2", "pressure 1e9 2")), needs + "1e9");
  EXPECT_EQ(problem(changed("pressure 3 2", "pressure 3 2 1")),
            "x.table:6: pressure: unexpected text 1");
  EXPECT_EQ(problem(changed(" e 0 2\n", "")),
            "x.table:7: pressure: expected e and the energies, found 1");
  EXPECT_EQ(problem(changed(" e 0 2", " e 0 2 3")),
            "x.table:7: pressure: 3 values in the row, not 2");
  EXPECT_EQ(problem(changed(" e 0 2", " e 0 0")),
            "x.table:7: energy 0 is not above the one before");
  EXPECT_EQ(problem(changed(" 1.5 0 1.5", " 1.5 0")),
            "x.table:9: pressure: 1 values in the row, not 2");
  EXPECT_EQ(problem(changed(" 1.5 0 1.5", " 1.5 0 1.5 2")),
            "x.table:9: pressure: 3 values in the row, not 2");
  EXPECT_EQ(problem(changed(" 1.5 0 1.5", " 1 0 1.5")),
            "x.table:9: density 1 is not above that of the row before");
  EXPECT_EQ(problem(changed(" 1 -1 0", " 0 -1 0")), "x.table:8: density 0 must be > 0");
  EXPECT_EQ(problem(changed(" 2 1 3\n", "")),
            "x.table:6: pressure: the file ends after 2 of 3 densities");
  EXPECT_EQ(problem(HEAD + "pressure 3 2"),
            "x.table:2: pressure: the file ends after 0 of 3 densities");
  EXPECT_EQ(
      problem(changed(" 2 1 3\n", " 2 1 3\n 3 1 3\n")),
      "x.table:11: unknown key 3; known are rho0, density, interpolation, pressure, temperature");
  for (const char *bad : {"nan", "NaN", "inf", "1e", "0x1", "1,5", "-"})
    EXPECT_EQ(problem(changed(" 1.5 0 1.5", std::string(" 1.5 0 ") + bad)),
              "x.table:9: pressure: " + std::string(bad) + " is not a number");
  EXPECT_EQ(problem(changed(" 1.5 0 1.5", " 1.5 0 1e999")),
            "x.table:9: pressure: 1e999 is not a finite number in units si");
  EXPECT_EQ(problem(HEAD + BODY + BODY), "x.table:11: rho0 given twice");
  EXPECT_EQ(problem(HEAD + BODY + "pressure 3 2\n"), "x.table:11: pressure given twice");
  // what the table says
  EXPECT_EQ(problem(changed("bilinear", "bicubic")),
            "x.table: 3 densities and 2 energies are too few, bicubic needs 4");
  EXPECT_EQ(problem(changed(" 2 1 3\n", " 2 -3 -9\n")).find("x.table: pressure falls with density"),
            0u);
  // temperatures
  EXPECT_EQ(problem(HEAD + "temperature 2 2\n"), "x.table:2: temperature stands before pressure");
  EXPECT_EQ(problem(HEAD + BODY + "temperature 2 2\n"),
            "x.table:11: temperature is not on the grid of the block before");
  EXPECT_EQ(problem(HEAD + BODY + "temperature 3 2\ne 0 1\n"),
            "x.table:12: energy 1 is not that of the block before");
  EXPECT_EQ(problem(HEAD + BODY + "temperature 3 2\ne 0 2\n1.1 300 300\n"),
            "x.table:13: density 1.1 is not that of the block before");
}

/* ---------------------------------------------------------------------- */

TEST(TableFile, ThroughAMaterialFile)
{
  auto read = [](const std::string &name, std::string &text) -> std::string {
    if (name != "x.table") return "Cannot find table file " + name;
    text = HEAD + BODY;
    return "";
  };
  auto material = [&](const std::string &text, HVI::Material &m) {
    return HVI::parse_material("# UNITS: cgs\n" + text, "x.hvi", "si", m, read);
  };
  HVI::Material m;
  EXPECT_EQ(
      material("eos table\n file x.table # units of its own\nspall limit\n sigma_p 1e10\n", m), "");
  EXPECT_DOUBLE_EQ(at(*m.eos, 1.75, 1).p, (0 + 1.5 + 1 + 3) / 4);
  EXPECT_EQ(m.section("spall", "limit")->values.at("sigma_p"), 1e9);
  EXPECT_EQ(m.table, "x.table");
  EXPECT_EQ(m.table_date, "2026-02-01");

  EXPECT_EQ(material("eos table\n", m), "x.hvi:2: eos table: missing key file");
  EXPECT_FALSE(m.eos);
  EXPECT_EQ(material("eos table\nfile\n", m), "x.hvi:3: eos table: key file has no value");
  EXPECT_EQ(material("eos table\nfile a b\n", m),
            "x.hvi:3: eos table: file: unexpected text b after the name");
  EXPECT_EQ(material("eos table\nfile a\nfile b\n", m),
            "x.hvi:4: eos table: key file given twice, first in line 3");
  EXPECT_EQ(material("eos table\nrho0 1\n", m),
            "x.hvi:3: eos table: unknown key rho0; known is file");
  EXPECT_EQ(material("eos table\nfile y.table\n", m),
            "x.hvi:3: eos table: Cannot find table file y.table");
  EXPECT_EQ(HVI::parse_material("# UNITS: si\neos table\nfile x\n", "x.hvi", "si", m),
            "x.hvi:3: eos table: there is no way to read x");
  EXPECT_EQ(HVI::parse_material("# UNITS: lj\neos table\nfile x.table\n", "x.hvi", "lj", m, read),
            "x.hvi:3: eos table: x.table:1: UNITS: si cannot be converted to units lj of the run");
}

}    // namespace
