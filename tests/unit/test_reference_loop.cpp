/* ----------------------------------------------------------------------
   lammps-hvi: hypervelocity impact for LAMMPS, GNU GPL version 2, see LICENSE
   The sweeps over pairs: vectors beside the reference loop, on particles, ghosts and images in random states.
------------------------------------------------------------------------- */

#include "hvi_kernel.h"
#include "hvi_sph_reference.h"
#include "hvi_sph_sweep.h"
#include "hvi_sph_touching.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <random>
#include <string>
#include <vector>

using namespace HVI;

namespace {

constexpr int H = SPH_OWN_H, B = SPH_BODIES, D = SPH_DENSITY, R = SPH_RIEMANN, S = SPH_SOLID,
              W = SPH_SPACINGS, A = SPH_ARTSTRESS;
constexpr int TYPES = 3, OWNED = 90, ALL = 130;

using Random = std::mt19937_64;

double between(Random &random, double a, double b)
{
  return std::uniform_real_distribution<double>(a, b)(random);
}

// owned particles and ghosts in random states; who is near; tables of type pairs

struct State {
  int scene, dim;
  MirrorPlanes mirror;
  std::vector<SphPlace> place{ALL};
  std::vector<SphState> state{ALL};
  std::vector<double> places;
  std::vector<const double *> x;
  std::vector<int> type, embedded, number, ilist;
  std::vector<std::vector<int>> neighbors;
  std::vector<const int *> first;
  double tables[5][TYPES + 1][TYPES + 1] = {};
  const double *rows[5][TYPES + 1];
  SphLaws laws = {};

  State(const std::string &kernel, int scene, int dim, bool planes, bool elements);
};

State::State(const std::string &kernel, int scene, int dim, bool planes, bool elements) :
    scene(scene), dim(dim), place(ALL), state(ALL), places(3 * ALL), x(ALL), type(ALL),
    embedded(elements ? ALL : 0), number(OWNED), ilist(OWNED), neighbors(OWNED), first(OWNED)
{
  Random random(scene + 1000 * dim);
  const KernelFunctions &known = *find_kernel(kernel);
  if (planes) {
    mirror.planes = dim > 1 ? 3 : 1;
    mirror.at[0] = mirror.at[1] = -0.4;
  }
  laws.dim = dim;
  laws.norm = known.norm[dim - 1];
  laws.h = 2.4 / known.support;
  laws.a = 1.0;
  laws.b = 2.0;
  laws.alpha = scene & 1 ? 0.0 : 0.3;
  laws.automatic = scene & 1;
  laws.art_n = 3.5;

  enum { VISC_A, VISC_B, TENSION, RATIO, WEIGHT };
  const double size[TYPES + 1] = {0.0, 1.0, 1.15, 0.9};
  for (int s = 1; s <= TYPES; s++)
    for (int t = 1; t <= TYPES; t++) {
      const bool pull = s == t || s + t == 3;
      tables[VISC_A][s][t] = 0.5 + 0.1 * (s + t);
      tables[VISC_B][s][t] = 1.5 + 0.1 * s * t;
      tables[TENSION][s][t] = pull;
      tables[RATIO][s][t] = size[t] / size[s];
      tables[WEIGHT][s][t] = std::pow(size[t] / size[s], 2.5);
    }
  for (int k = 0; k < 5; k++)
    for (int s = 0; s <= TYPES; s++) rows[k][s] = tables[k][s];

  const int side = dim == 1 ? ALL : dim == 2 ? 12 : 5;
  for (int i = 0; i < ALL; i++) {
    const int cell[3] = {i % side, dim > 1 ? i / side % side : 0, dim > 2 ? i / side / side : 0};
    double *const at = &places[3 * i];
    for (int k = 0; k < 3; k++) at[k] = k < dim ? cell[k] + between(random, -0.25, 0.25) : 0.0;
    x[i] = at;
    type[i] = 1 + random() % TYPES;
    const double h = scene & (H | W) ? laws.h * size[type[i]] * between(random, 0.8, 1.2) : laws.h;
    place[i] = {at[0], at[1], at[2], h};
    SphState &s = state[i];
    s.vx = between(random, -1, 1);
    s.vy = dim > 1 ? between(random, -1, 1) : 0.0;
    s.vz = dim > 2 ? between(random, -1, 1) : 0.0;
    s.rho =
        between(random, 0.8, 2.0) * (between(random, 0, 1) < 0.2 ? 8.0 : 1.0);    // some are dense
    s.w = between(random, 0.7, 1.3);
    s.p = between(random, -1, 1.5);
    s.c = between(random, 1, 3);
    const bool rubble = scene & S && between(random, 0, 1) < 0.3;
    s.body =
        SphState::code(type[i], scene & S && between(random, 0, 1) < 0.4 ? 4000000000 : 0, rubble);
    if (elements && i % 3 == 0) embedded[i] = 1 + i % 2;
  }

  // the half list, with pairs beyond reach, and other bits in its entries

  for (int i = 0; i < OWNED; i++) {
    ilist[i] = OWNED - 1 - i;
    for (int j = i + 1; j < ALL; j++) {
      const double d[3] = {x[i][0] - x[j][0], x[i][1] - x[j][1], x[i][2] - x[j][2]};
      if (d[0] * d[0] + d[1] * d[1] + d[2] * d[2] < 5.0 * 5.0)
        neighbors[i].push_back(j % 7 ? j : j | 1 << 30);
    }
    number[i] = neighbors[i].size();
    first[i] = neighbors[i].data();
  }
}

// what came of it: by name, a number for each particle

struct Found : SphWatcher {
  std::vector<std::pair<std::string, std::vector<double>>> numbers;
  double virial[9] = {};
  int pairs = 0;
  double momentum[3] = {}, energy = 0.0, power = 0.0;

  void tally(int, int, const double *d, const double *f) override
  {
    pairs++;
    for (int k = 0; k < 9; k++) virial[k] += d[k / 3] * f[k % 3];
  }
  void overlap(int i, int j) override { ADD_FAILURE() << i << " and " << j; }
  template <class Record, class Number>
  void keep(const std::string &name, const std::vector<Record> &records, const Number &number)
  {
    std::vector<double> all;
    for (int i = 0; i < ALL; i++) all.push_back(number(records[i]));
    numbers.push_back({name, all});
  }
  template <class Record>
  void keep(const std::string &name, const std::vector<Record> &records, int first, int n)
  {
    for (int k = first; k < first + n; k++)
      keep(name + " " + std::to_string(k), records, [k](const Record &r) {
        return ((const double *) &r)[k];
      });
  }
};

// random numbers in place of what the pair style makes of the sums

void settle(Random &random, const State &s, std::vector<SphSlopes> &slopes,
            std::vector<SphGradV> &gradv, std::vector<SphTraction> &traction, SphTouching &touching,
            std::vector<SphStress> &art)
{
  const auto fill = [&](double *a, int n, double size) {
    for (int k = 0; k < n; k++) a[k] = between(random, -size, size);
  };
  for (int i = 0; i < ALL; i++) {
    fill(&slopes[i].xx, 9, 0.5);
    slopes[i].replace_sums(between(random, 0.7, 1.3),
                           s.scene & H ? between(random, 0.6, 1.4) : 1.0);
    fill(&gradv[i].xx, SphGradV::SENT, 0.5);
    fill(&traction[i].xx, SphTraction::SENT, 1.0);
    traction[i].volume = between(random, 0.7, 1.3);
    SphPush push;
    fill(&push.xx, SphPush::SENT, 1.0);
    if (touching.has(i)) touching.at(i).push = push;
    fill(&art[i].xx, 6, 1.0);
  }
}

Found run(const SphSweeps &sweeps, const State &s)
{
  Found found;
  Images images;
  const std::vector<char> is_ours(TYPES + 1, 1);
  images.find(s.mirror, s.x.data(), s.type.data(), is_ours, OWNED, ALL, 5.0 * 5.0);
  const int n = images.end();
  std::vector<SphPlace> place(s.place);
  std::vector<SphState> state(s.state);
  place.resize(n);
  state.resize(n);
  std::vector<SphRates> rates(n);
  std::vector<SphSlopes> slopes(n);
  std::vector<SphGradV> gradv(n);
  Random weights(78);
  for (SphGradV &g : gradv) g.weight = between(weights, 0.9, 1.1);
  std::vector<SphTraction> traction(n);
  SphTouching touching;
  touching.start(n);
  std::vector<SphStress> art(n);
  SphKept kept;

  SphWork work;
  work.records.place = place.data();
  work.records.state = state.data();
  work.records.rates = rates.data();
  const bool solid = s.scene & S, riemann = (s.scene & R) && !solid;
  if (riemann) work.records.slopes = slopes.data();
  if (solid) {
    work.records.gradv = gradv.data();
    work.records.traction = traction.data();
    if (s.scene & B) work.records.touching = &touching;
    if (s.scene & A) work.records.art = art.data();
  }
  work.list = {OWNED, s.ilist.data(), s.number.data(), s.first.data()};
  work.laws = s.laws;
  work.visc_a = s.rows[0];
  work.visc_b = s.rows[1];
  work.tension = s.rows[2];
  work.ratio = s.rows[3];
  work.weight = s.rows[4];
  work.type = s.type.data();
  work.embedded = s.embedded.empty() ? nullptr : s.embedded.data();
  work.images = s.mirror.planes ? &images : nullptr;
  work.kept = &kept;
  work.watcher = &found;
  work.tally = true;
  work.half_step = 0.02;

  images.fill(s.mirror, work.records);
  if (sweeps.has_first()) {
    sweeps.first(work);
    images.fold_sums(work.records);
    if (riemann) {
      found.keep("slopes", slopes, 0, s.scene & H ? 11 : 10);
    } else {
      found.keep("gradv", gradv, 0, SphGradV::SENT);
      std::vector<SphGradV> sums;
      for (int i = 0; i < ALL; i++) sums.push_back(touching.of(i).sums);
      if (s.scene & B) found.keep("touching", sums, 0, SphGradV::SENT);
    }
    Random random(77);
    settle(random, s, slopes, gradv, traction, touching, art);
    images.fill_sums(work.records);
  }
  sweeps.forces(work);
  for (int i = 0; i < n; i++) {
    const double *const v = solid ? &traction[i].vx : &state[i].vx;
    for (int k = 0; k < 3; k++) {
      found.momentum[k] += (&rates[i].fx)[k];
      found.power += (&rates[i].fx)[k] * v[k];
    }
    found.energy += rates[i].de();
  }
  images.fold(work.records, true);
  found.keep("rates", rates, 0, 4);
  found.keep("rates 4", rates, [](const SphRates &r) {
    return r.de();
  });
  found.keep("rates 5", rates, [](const SphRates &r) {
    return r.heat;
  });
  found.numbers.push_back({"fastest", {work.fastest}});
  found.numbers.push_back({"virial", {found.virial, found.virial + 9}});
  found.numbers.push_back({"planes", {images.force, images.force + 3}});
  return found;
}

// numbers of one record and kind have one size: that of the largest of them

std::string kind(const std::string &name)
{
  static const char *const RATES[] = {"force", "force", "force", "drho", "de", "heat"};
  if (name.rfind("rates", 0) == 0) return RATES[name.back() - '0'];
  const int k = name.find(' ') == std::string::npos ? 0 : std::stoi(name.substr(name.find(' ')));
  if (name.rfind("slopes", 0) == 0) return k < 6 ? "grad v" : k < 9 ? "grad p" : name;
  if (k == 15) return name;
  return name.substr(0, 5) + (k % 4 < 3 && k < 12 ? " L" : " M");
}

void expect_same(const Found &got, const Found &want, const std::string &what)
{
  std::map<std::string, double> size, error;
  ASSERT_EQ(got.numbers.size(), want.numbers.size()) << what;
  EXPECT_EQ(got.pairs, want.pairs) << what;
  for (std::size_t n = 0; n < want.numbers.size(); n++) {
    const auto &[name, a] = want.numbers[n];
    const auto &b = got.numbers[n].second;
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); i++) {
      size[kind(name)] = std::max(size[kind(name)], std::fabs(a[i]));
      error[kind(name)] = std::max(error[kind(name)], std::fabs(a[i] - b[i]));
      ASSERT_TRUE(std::isfinite(a[i]) && std::isfinite(b[i])) << what << " " << name << " " << i;
    }
  }
  for (const auto &[name, largest] : size)
    EXPECT_LE(error[name], 1e-12 * largest) << what << " " << name;
}

struct Case {
  bool planes, elements;
};
constexpr Case CASES[] = {{false, false}, {true, false}, {false, true}, {true, true}};

std::string text(const std::string &kernel, int scene, int dim, const Case &c)
{
  return kernel + " scene " + std::to_string(scene) + " dim " + std::to_string(dim) +
      (c.planes ? " planes" : "") + (c.elements ? " elements" : "");
}

}    // namespace

TEST(ReferenceLoop, IsThatOfTheVectors)
{
  const int scenes[] = {0,     H,         B,         H | B,         H | B | D,
                        R,     R | H,     R | H | B, R | H | B | W, S,
                        S | B, S | H | B, S | R,     S | R | B,     S | R | H | B};
  for (const char *const kernel : {"cubic", "gauss"})
    for (const int scene : scenes) {
      const auto vectors = make_sph_sweeps(kernel, scene), loop = make_sph_reference(kernel, scene);
      ASSERT_TRUE(vectors->vectors() && !loop->vectors());
      EXPECT_EQ(vectors->scene(), scene);
      for (int dim = 1; dim <= 3; dim++)
        for (const Case &c : CASES) {
          const State s(kernel, scene, dim, c.planes, c.elements);
          const Found want = run(*loop, s);
          EXPECT_GT(want.pairs, OWNED);
          expect_same(run(*vectors, s), want, text(kernel, scene, dim, c));
        }
    }
}

// terms that a scene has besides those asked for come out as nothing

TEST(ReferenceLoop, IsThatOfVectorsWithMoreTerms)
{
  for (const int scene : {D, B | D, H | D, R | B, S | H, S | R | H}) {
    const auto vectors = make_sph_sweeps("cubic", scene), loop = make_sph_reference("cubic", scene);
    ASSERT_TRUE(vectors->vectors());
    EXPECT_NE(vectors->scene(), scene);
    State s("cubic", scene, 3, true, false);

    // tables that a scene without bodies does not have say what it does; it has no rubble

    if (!(scene & B)) {
      for (int i = 1; i <= TYPES; i++)
        for (int j = 1; j <= TYPES; j++) {
          s.tables[0][i][j] = s.laws.a;
          s.tables[1][i][j] = s.laws.b;
          s.tables[2][i][j] = 1.0;
        }
      for (SphState &state : s.state) state.body = SphState::code(state.type());
    }
    Found want = run(*loop, s);
    s.scene |= vectors->scene() & B;
    Found got = run(*vectors, s);
    std::vector<std::pair<std::string, std::vector<double>>> asked;
    for (auto &one : got.numbers)
      if (one.first.rfind("touching", 0) != 0 || scene & B) asked.push_back(one);
    got.numbers = asked;
    expect_same(got, want, text("cubic", scene, 3, {true, false}));
  }
}

// what has no vectors

TEST(ReferenceLoop, TakesTheRest)
{
  for (const KernelFunctions &kernel : KERNELS) {
    const std::string name = kernel.name;
    const bool vectors = name == "cubic" || name == "gauss";
    for (const int scene : {0, H | B | D, R | H | B | W, S | R | H | B})
      EXPECT_EQ(make_sph_sweeps(name, scene)->vectors(), vectors) << name;
    for (const int scene :
         {+SPH_SYMMETRIC, SPH_SYMMETRIC | SPH_STOCK, S | A, S | R | A, S | D, S | H | B | D | A})
      EXPECT_FALSE(make_sph_sweeps(name, scene)->vectors()) << name << scene;
  }
  EXPECT_FALSE(make_sph_sweeps("Cubic", 0));
}

// with any kernel and all that goes together: momentum, and energy of pairs, to round-off

TEST(ReferenceLoop, KeepsMomentumAndEnergy)
{
  const int scenes[] = {0,
                        H | B | D,
                        SPH_SYMMETRIC | H | B | D,
                        SPH_SYMMETRIC | SPH_STOCK,
                        R | H | B | W,
                        S | H | B | D | A,
                        S | R | H | B | A};
  for (const KernelFunctions &kernel : KERNELS)
    for (const int scene : scenes)
      for (const bool planes : {false, true}) {
        const State s(kernel.name, scene, 3, planes, false);
        const Found found = run(*make_sph_reference(kernel.name, scene), s);
        const std::string what = text(kernel.name, scene, 3, {planes, false});
        double size = 0.0, power = 0.0;
        for (const auto &[name, a] : found.numbers)
          for (const double value : a) {
            if (kind(name) == "force") size += std::fabs(value);
            if (kind(name) == "de") power += std::fabs(value);
          }
        for (const double p : found.momentum) EXPECT_NEAR(p, 0.0, 1e-14 * size) << what;
        EXPECT_NEAR(found.energy, -found.power, 1e-13 * power) << what;
        EXPECT_GT(std::fabs(found.power), 1e-3 * power) << what;
      }
}
