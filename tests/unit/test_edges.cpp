/* ----------------------------------------------------------------------
   lammps-hvi: hypervelocity impact for LAMMPS, GNU GPL version 2, see LICENSE
   Where laws, tables and loops begin and end: what make mutate found to be tested nowhere else.
------------------------------------------------------------------------- */

#include "hexahedra.h"
#include "hvi_contact_step.h"
#include "hvi_element_mechanics.h"
#include "hvi_eos_gruneisen.h"
#include "hvi_eos_idealgas.h"
#include "hvi_eos_table.h"
#include "hvi_material.h"
#include "hvi_sleep.h"
#include "hvi_spall_voids.h"
#include "hvi_strength_johnson_cook.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace HVI;

// below 1/s, as in units micro

TEST(Edges, DragOfJohnsonCookWithASmallD)
{
  const double values[] = {26.0, 2.0, 0.0, 0.5, 0.0, 1.0, 1.0, 300.0, 800.0, 0.5, 2.0};
  const StrengthJohnsonCook law = StrengthJohnsonCook::make(values);
  EXPECT_DOUBLE_EQ(law.flow(0.0, 2.0, {}), 2.0 * (1.0 + 2.0));    // sqrt(2/0.5)
  EXPECT_DOUBLE_EQ(law.flow(0.0, 0.0, {}), 2.0);
}

TEST(Edges, IdealGasIsNotColderThanZero)
{
  const double values[] = {1.4, 2.0};
  const EosIdealGas gas = EosIdealGas::make(values);
  EXPECT_EQ(gas.temperature(1.0, -1.0), 0.0);
  EXPECT_EQ(gas.temperature(1.0, 0.5), 0.25);
}

TEST(Edges, VoidsThatTakeNothingFromTheTensionDoNotGrow)
{
  const double values[] = {1.0, 2.0, 0.5, 0.1, 0.0};
  const SpallVoids law = SpallVoids::make(values);
  EXPECT_EQ(law.growth(3.0, 0.0, 0.0, 1.0), 0.0);
  EXPECT_EQ(law.growth(0.0, 1.0, 0.0, 1.0), 0.0);
  // y + c y^2 = x of m = 1/2, in tensions over sigma: y = 1, c = 2, so x = 3, and what has grown is c y^2/K
  EXPECT_NEAR(law.growth(3.0, 1.0, 0.0, 1.0), 2.0, 1e-7);
}

TEST(Edges, DamageOfOneKindIsNotTakenForTheOther)
{
  const std::string text =
      "# UNITS: si\neos linear\nrho0 2700\nK 76e9\nstrength perfect\nG 26e9\nY 0.3e9\n"
      "damage johnson-cook\nD1 0.2\nD2 0\nD3 0\nD4 0\nD5 0\n";
  SolidOptions options;
  options.strength = "perfect";
  options.thermal = false;
  options.spall = Spall::NONE;
  for (const bool softens : {false, true}) {
    Material material;
    std::string why;
    ASSERT_EQ(parse_material(text + (softens ? "u_f 1e-5\n" : ""), "x.hvi", "si", material), "");
    const auto model = SolidModel::make(material, options, why);
    ASSERT_TRUE(model) << why;
    EXPECT_EQ(model->softens(), softens);
    SolidState s = SolidModel::blank();
    const auto first = [&]() {
      const SolidModel::Begun *const begun = SolidModel::misread(model.get(), s);
      return begun ? std::string(begun->what) : "";
    };
    EXPECT_EQ(first(), "");
    s.damage = 0.5;    // of a law without u_f
    EXPECT_EQ(first().empty(), !softens);
    s.initiation = 1.0;    // with it
    EXPECT_EQ(first().empty(), softens);
    s.damage = 0.0;
    s.initiation = 0.3;    // its begin
    EXPECT_EQ(first().empty(), softens);
  }
}

// with these laws a pressure is asked for again only where a state has voids

TEST(Edges, OpenAreThoseThatHaveVoids)
{
  Material material;
  std::string why;
  ASSERT_EQ(parse_material("# UNITS: si\neos linear\nrho0 2700\nK 76e9\nstrength perfect\nG "
                           "26e9\nY 0.3e9\nspall limit\nsigma_p 1e9\n"
                           "spall voids\nsigma 1.2e9\nrate 1e5\nm 0.2\nphi_c 0.05\n",
                           "x.hvi", "si", material),
            "");
  SolidOptions options;
  options.strength = "perfect";
  options.thermal = options.damage = false;
  for (const Spall spall : {Spall::PRINCIPAL, Spall::PRESSURE, Spall::VOIDS}) {
    options.spall = spall;
    const auto model = SolidModel::make(material, options, why);
    ASSERT_TRUE(model) << why;
    EXPECT_FALSE(model->own_limit());    // all have the same
    SolidState s = SolidModel::blank();
    EXPECT_FALSE(model->open(s) || model->looks(s));
    s.voids.phi = 0.01;
    EXPECT_EQ(model->open(s), spall == Spall::VOIDS);
    EXPECT_EQ(model->looks(s), spall == Spall::VOIDS);
    s.spalled = 1.0;
    EXPECT_FALSE(model->open(s) || model->looks(s));
  }
}

// close to the pole of the Hugoniot, dtau/deta = g tau - p0/(rho0 cp), by many small steps

TEST(Edges, TemperatureNearThePole)
{
  const double values[] = {8000.0, 4000.0, 2.5, 1.5, 0.0, 400.0, 0.0, 0.0, 300.0};
  const EosGruneisen law = EosGruneisen::make(values);
  for (const double eta : {0.3, 0.39, 0.394, 0.3955}) {
    const int n = 400000;
    const double d = eta / n;
    double tau = 300.0;
    const auto slope = [](double eta, double tau) {
      const double D = 1.0 - 2.5 * eta, p0 = 8000.0 * 16e6 * eta * (1.0 - 0.75 * eta) / (D * D);
      return 1.5 * tau - p0 / (8000.0 * 400.0);
    };
    for (int k = 0; k < n; k++) {
      const double half = tau + 0.5 * d * slope(k * d, tau);
      tau += d * slope((k + 0.5) * d, half);
    }
    const double e = 400.0 * (1000.0 - tau);
    EXPECT_NEAR(law.temperature(8000.0 / (1.0 - eta), e), 1000.0, 1e-3 * std::fabs(tau)) << eta;
  }
}

/* ---------------------------------------------------------------------- */

TEST(Edges, ContactStepLosesNoNanInAnyLane)
{
  const Contact law = Contact::make(1.0, 1.0, 1.0);
  for (int bad = 0; bad < 16; bad++) {
    UniformContactStep step(law, 1.0);
    const auto row = step.row();
    for (int n = 0; n < 16; n++) {
      row.rsq[n] = 1.1;
      row.rdotv[n] = n == bad ? NAN : -1.0;
    }
    step.filled(16);
    ContactTimes least = {1e200, 1e200};
    step.finish(least);
    EXPECT_TRUE(std::isnan(least.approach)) << bad;
  }
}

TEST(Edges, CellsReachThoseNextToThem)
{
  EXPECT_EQ(Sleep().fastest(), 0.0);
  constexpr int N = 9;    // a row of cells, one point each, every one next to the last
  double at[N][3];
  const double *x[N];
  for (int i = 0; i < N; i++) {
    at[i][0] = 1.3 * i + 0.65;
    at[i][1] = at[i][2] = 0.0;
    x[i] = at[i];
  }
  RelativeMotion motion;
  motion.start(N, x, 1.0, 0.1);
  ASSERT_EQ(motion.cells(), N);
  Sleep sleep;
  sleep.start(motion);
  for (int i = 0; i < N; i++) {
    const double v[3] = {i == 2 ? 3.0 : 0.0, i == 2 ? -4.0 : 0.0, 0.0};
    sleep.add(motion.cell_of(i), v, false);
  }
  sleep.settle(motion, 1e-3);
  EXPECT_EQ(sleep.fastest(), 5.0);
  sleep.spread(motion);
  for (int i = 0; i < N; i++) {
    EXPECT_EQ(sleep.asleep(motion.cell_of(i)), i == 0 || i > 3) << i;
    EXPECT_EQ(sleep.near_awake(motion.cell_of(i)), i <= 4) << i;
  }
  sleep.reach_out(motion, {motion.cell_of(8)});    // and a ghost in the last
  for (int i = 0; i < N; i++) EXPECT_EQ(sleep.reached(motion.cell_of(i)), i <= 5 || i >= 7) << i;
  sleep.reach_out(motion, {});
  for (int i = 0; i < N; i++) EXPECT_EQ(sleep.reached(motion.cell_of(i)), i <= 5) << i;
}

/* ---------------------------------------------------------------------- */

// FNV-1a of "kind law", then of each key after that and of the bytes of its value after this; all added up.  Restart
// files have it

TEST(Edges, ChecksumOfAMaterial)
{
  const auto fnv = [](const void *bytes, size_t n, std::uint64_t hash) {
    for (size_t k = 0; k < n; k++)
      hash = (hash ^ ((const unsigned char *) bytes)[k]) * 1099511628211ull;
    return hash;
  };
  const auto of = [&](const std::string &law,
                      const std::vector<std::pair<std::string, double>> &values) {
    const std::uint64_t first = fnv(law.data(), law.size(), 14695981039346656037ull);
    std::uint64_t sum = first;
    for (const auto &[key, value] : values)
      sum += fnv(&value, sizeof(double), fnv(key.data(), key.size(), first));
    return sum;
  };
  Material material;
  ASSERT_EQ(
      parse_material("# UNITS: si\neos linear\nK 90 # [1]\nrho0 1.5\nstrength perfect\nG 26\nY 3\n",
                     "x.hvi", "si", material),
      "");
  EXPECT_EQ(material.checksum,
            of("eos linear", {{"rho0", 1.5}, {"K", 90.0}}) +
                of("strength perfect", {{"G", 26.0}, {"Y", 3.0}}));

  const std::string words = "a b 1 ";
  const std::uint64_t table = fnv("table", 5, 14695981039346656037ull);
  EXPECT_EQ(checksum_of_table("# no\n a  b\n\n1 # one\n"), fnv(words.data(), words.size(), table));
}

/* ---------------------------------------------------------------------- */

namespace {

std::string problem(const TableData &data)
{
  std::string why;
  const auto law = make_eos_table(data, why);
  EXPECT_EQ(law == nullptr, !why.empty());
  return why;
}

TableData bilinear(const std::vector<double> &rho, const std::vector<double> &e,
                   const std::vector<double> &p)
{
  TableData data;
  data.name = "x";
  data.rho = rho;
  data.e = e;
  data.p = p;
  data.bicubic = false;
  return data;
}
}    // namespace

// csq = (1 - t) (1 - s^2/(1 + s)^2): 0 at the last energy, and below it only beyond the table

TEST(Edges, TableIsLookedAtWhereItIs)
{
  EXPECT_EQ(problem(bilinear({1.0, 2.0}, {0.0, 1.0}, {0.0, 0.0, 1.0, 0.0})), "");
}

// p = rho - 1 + p0, so csq = 1, and p may be 0.01 rho0 csq at rho0 = 1

TEST(Edges, TableHasAboutNoPressureAtItsReference)
{
  for (const double p0 : {0.0095, -0.0095, 0.0105, -0.0105}) {
    TableData data = bilinear({0.5, 2.0}, {-1.0, 1.0}, {p0 - 0.5, p0 - 0.5, p0 + 1.0, p0 + 1.0});
    data.rho0 = 1.0;
    EXPECT_EQ(problem(data).empty(), std::fabs(p0) < 0.01) << p0;
  }
}

TEST(Edges, TableOfOneDensityIsTooSmall)
{
  const std::string head = "# UNITS: si\ninterpolation bilinear\n";
  std::string why, date;
  EXPECT_FALSE(parse_table(head + "pressure 1 2\ne 0 1\n1 2 3\n", "x.table", "si", why, date));
  EXPECT_EQ(why, "x.table: 1 densities and 2 energies are too few, bilinear needs 2");
  EXPECT_FALSE(parse_table(head + "pressure 2 1\ne 0\n1 2\n2 3\n", "x.table", "si", why, date));
  EXPECT_EQ(why, "x.table: 2 densities and 1 energies are too few, bilinear needs 2");
}

/* ---------------------------------------------------------------------- */

// forces() keeps all that hex_hourglass() returns, and adds up its power and its work

TEST(Edges, ElementKeepsAllOfItsHourglasses)
{
  using namespace HVI_TEST;
  Material material;
  ASSERT_EQ(parse_material("# UNITS: lj\neos linear\nrho0 1.5\nK 90\n", "x.hvi", "lj", material),
            "");
  ElementMechanics mechanics;
  mechanics.laws = {{nullptr, nullptr}, {material.eos.get(), nullptr}};
  mechanics.options.stiffness = 0.3;
  const double dt = 0.01;
  const Nodes x = distorted(), v = random_nodes();
  Element one = {};
  one.type = 1;
  one.rho = 1.7;
  one.q = 0.2;
  one.hourglass = 5.0;
  one.solid = SolidModel::blank();
  one.solid.S = {0.3, -0.1, -0.2, 0.05, 0.06, 0.07};
  one.solid.shear = 26.0;
  for (int k = 0; k < 12; k++) one.Q[k] = 0.01 * (k + 1);
  ElementStep step;
  step.p = 0.4;
  step.c = 8.0;
  for (int k = 0; k < 9; k++) {
    step.L[k] = 0.1 * (k - 3);
    step.K[k] = 0.02 * k;
  }
  ElementBatch b;
  b.n = 1;
  b.element = &one;
  b.step = &step;
  spread(x, b.x);
  spread(v, b.v);
  b.V = hex_gradient(b.x, b.B);

  Vec s[9], L[9], Q[12];
  const double p = 0.6, S[9] = {0.3, 0.05, 0.06, 0.05, -0.1, 0.07, 0.06, 0.07, -0.2};
  for (int k = 0; k < 9; k++) {
    s[k] = Vec{} + (S[k] - (k % 4 == 0 ? p : 0.0) - step.K[k]);
    L[k] = Vec{} + step.L[k];
  }
  for (int k = 0; k < 12; k++) Q[k] = Vec{} + one.Q[k];
  HexNodes f;
  hex_forces(s, b.B, f);
  const Vec power = hex_hourglass(b.x, b.v, b.B, b.V, Vec{} + 1.7, Vec{} + 8.0, L,
                                  mechanics.options.viscous, Vec{} + 0.3, dt, Q, f);
  mechanics.forces(b, dt);
  double work = 0.0;
  for (int k = 0; k < 12; k++) EXPECT_NEAR(one.Q[k], Q[k][0], 1e-13) << k;
  for (int a = 0; a < CORNERS; a++)
    for (int k = 0; k < 3; k++) {
      EXPECT_NEAR(one.force[a][k], f[k][a][0], 1e-12);
      work += f[k][a][0] * v(k, a);
    }
  EXPECT_NEAR(step.work, work, 1e-12);
  EXPECT_NEAR(one.hourglass, 5.0 + dt * power[0], 1e-13);
  EXPECT_GT(std::fabs(power[0]), 1e-3);

  // with plastic strain, and when it has failed, nothing is stiff
  for (const bool failed : {false, true}) {
    one.Q[0] = 1.0;
    one.solid.eps = failed ? 0.0 : 0.1;
    one.solid.damage = failed ? 1.0 : 0.0;
    mechanics.forces(b, dt);
    EXPECT_EQ(one.Q[0], 0.0);
  }
}

// L^ = L (1 - M) + L_pair, its trace with that of other bodies, in density, stress and what a failure remembers

TEST(Edges, ElementFeelsPairsOfOtherBodies)
{
  using namespace HVI_TEST;
  const double dt = 1e-6;    // rotation is of second order
  for (const bool fails : {false, true}) {
    Material material;
    const std::string text =
        "# UNITS: lj\neos linear\nrho0 1.5\nK 90\nstrength perfect\nG 26\nY 1000\n"
        "spall limit\nsigma_p ";
    ASSERT_EQ(parse_material(text + (fails ? "1e-9\n" : "1e9\n"), "x.hvi", "lj", material), "");
    SolidOptions options;
    options.strength = "perfect";
    options.damage = options.thermal = false;
    options.spall = Spall::PRINCIPAL;
    std::string why;
    const auto model = SolidModel::make(material, options, why);
    ASSERT_TRUE(model) << why;
    ElementMechanics mechanics;
    mechanics.laws = {{nullptr, nullptr}, {material.eos.get(), model.get()}};

    Tensor L, M, others, pairs;
    L << 0.5, 0.1, -0.2, 0.3, 0.4, 0.15, -0.1, 0.2, 0.6;
    M << 0.3, 0.05, -0.04, 0.05, 0.2, 0.06, -0.04, 0.06, 0.25;
    others << 0.1, 0.02, 0.03, 0.02, 0.15, -0.05, 0.03, -0.05, 0.12;
    pairs << 0.07, -0.02, 0.01, 0.05, 0.03, -0.03, 0.02, 0.04, 0.09;
    const Tensor felt = L - L * M + pairs;
    const double trace_felt = felt.trace() + 0.11 - (L * others).trace();

    const Nodes middle = distorted();
    const Nodes x = middle + 0.5 * dt * L * middle, v = L * middle;
    Element one = {};
    one.type = 1;
    one.rho = 1.5;
    one.V0 = one.V = volume(middle - 0.5 * dt * L * middle);
    one.solid = SolidModel::blank();
    one.solid.shear = 26.0;
    ElementStep step;
    step.paired = true;
    for (int k = 0; k < 9; k++) step.sums.L[k] = pairs(k / 3, k % 3);
    const int at[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};
    for (int k = 0; k < 6; k++) {
      step.sums.M[k] = M(at[k][0], at[k][1]);
      step.sums.M_of_others[k] = others(at[k][0], at[k][1]);
    }
    step.sums.trace_L_of_others = 0.11;
    ElementBatch b;
    b.n = 1;
    b.element = &one;
    b.step = &step;
    spread(x, b.x);
    spread(v, b.v);
    b.V = hex_gradient(b.x, b.B);
    const double rho = 1.5 * one.V / b.V[0] * std::exp(dt * (L.trace() - trace_felt));
    int lane;
    ASSERT_EQ(mechanics.advance(b, dt, true, lane), ElementMechanics::NO_TROUBLE);
    EXPECT_NEAR(one.rho, rho, 1e-14);
    for (int k = 0; k < 9; k++) EXPECT_NEAR(step.L[k], L(k / 3, k % 3), 1e-13);
    EXPECT_EQ(one.solid.failed(), fails);
    if (fails) {
      EXPECT_NEAR(one.solid.expansion, trace_felt, 1e-13);
      continue;
    }
    const ElementStep before = step;    // at the start of a run: no step has led here
    const Deviator was = one.solid.S;
    ASSERT_EQ(mechanics.advance(b, 1000.0 * dt, false, lane), ElementMechanics::NO_TROUBLE);
    const Tensor end = velocity_gradient(x, v);
    for (int k = 0; k < 9; k++) EXPECT_NEAR(step.L[k], end(k / 3, k % 3), 1e-13);
    EXPECT_EQ(step.p, before.p);
    EXPECT_NEAR(one.rho, rho, 1e-14);
    EXPECT_EQ(one.solid.S.xy, was.xy);
    const Tensor D = 0.5 * (felt + felt.transpose());
    const Tensor S = 2.0 * 26.0 * dt * (D - D.trace() / 3.0 * Tensor::Identity());
    const Deviator &s = one.solid.S;
    const double found[6] = {s.xx, s.yy, s.zz, s.xy, s.xz, s.yz};
    for (int k = 0; k < 6; k++) EXPECT_NEAR(found[k], S(at[k][0], at[k][1]), 1e-11) << k;
  }
}
