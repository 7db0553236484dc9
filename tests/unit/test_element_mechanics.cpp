/* ----------------------------------------------------------------------
  lammps-hvi: hypervelocity impact for LAMMPS, GNU GPL version 2, see LICENSE
  Elements over a step by themselves: state, forces, energy, failure.
------------------------------------------------------------------------- */

#include "hexahedra.h"
#include "hvi_element_mechanics.h"

#include <cmath>
#include <gtest/gtest.h>

using namespace HVI_TEST;

namespace {

const double G = 26.0, DT = 0.01;
const std::string EOS =
    "# UNITS: lj\neos gruneisen\nrho0 1.5\nC 8\nS1 1.4\ng0 2\na 0\ncp 5\nT0 300\n";

// a material, elastic up to Y, for all types

struct Solid {
  Material material;
  std::unique_ptr<SolidModel> model;
  ElementMechanics mechanics;

  explicit Solid(const std::string &Y = "1000")
  {
    SolidOptions options;
    options.strength = "perfect";
    options.damage = options.thermal = false;
    options.spall = Spall::NONE;
    std::string problem;
    EXPECT_EQ(
        parse_material(EOS + "strength perfect\nG 26\nY " + Y + "\n", "x.hvi", "lj", material), "");
    model = SolidModel::make(material, options, problem);
    mechanics.laws = {{nullptr, nullptr}, {material.eos.get(), model.get()}};
  }
};

// an element with nodes of its own, an eighth of its mass each

struct Body {
  Solid &solid;
  Element one = {};
  ElementStep step;
  Node nodes[CORNERS] = {};

  Body(Solid &solid, const Nodes &x) : solid(solid)
  {
    one.id = one.type = 1;
    place(x);
    Corners corners;
    for (int a = 0; a < CORNERS; a++) std::copy_n(nodes[a].x, 3, corners[a]);
    EXPECT_TRUE(solid.mechanics.start(one, corners));
    for (Node &node : nodes) node.valence = 2.0;
    one.shared = CORNERS;
  }
  void place(const Nodes &x)
  {
    for (int a = 0; a < CORNERS; a++) Eigen::Map<Eigen::Vector3d>(nodes[a].x) = x.col(a);
  }
  void move(const Nodes &v)
  {
    for (int a = 0; a < CORNERS; a++) Eigen::Map<Eigen::Vector3d>(nodes[a].v) = v.col(a);
  }
  Nodes places() const
  {
    Nodes x;
    for (int a = 0; a < CORNERS; a++) x.col(a) = Eigen::Map<const Eigen::Vector3d>(nodes[a].x);
    return x;
  }
  Nodes velocities() const
  {
    Nodes v;
    for (int a = 0; a < CORNERS; a++) v.col(a) = Eigen::Map<const Eigen::Vector3d>(nodes[a].v);
    return v;
  }
  Nodes forces() const { return Eigen::Map<const Nodes>(one.force[0]); }
  ElementNodes list() const
  {
    ElementNodes l;
    for (int a = 0; a < CORNERS; a++) l[a] = &nodes[a];
    return l;
  }
  ElementBatch batch()
  {
    ElementBatch b;
    b.n = 1;
    b.element = &one;
    b.step = &step;
    spread(places(), b.x);
    spread(velocities(), b.v);
    b.V = hex_gradient(b.x, b.B);
    return b;
  }
  int advance(double dt, bool due = true)
  {
    ElementBatch b = batch();
    int lane = -1;
    const int trouble = solid.mechanics.advance(b, dt, due, lane);
    if (trouble) { EXPECT_EQ(lane, 0); }
    return trouble;
  }

  // what an integrator does: nodes by leapfrog, v is that of the middles of steps

  void whole_step(double dt)
  {
    place(places() + dt * velocities());
    solid.mechanics.first_half(one, list(), dt, 0.0);
    ASSERT_EQ(advance(dt), ElementMechanics::NO_TROUBLE);
    ElementBatch b = batch();
    solid.mechanics.forces(b, dt);
    solid.mechanics.second_half(one, step, dt);
  }
  void kick(double dt) { move(velocities() + dt / (one.mass / CORNERS) * forces()); }

  // of the end of a step, before its kick

  double energy(double dt) const
  {
    const double m = one.mass / CORNERS;
    const Nodes v = velocities() + 0.5 * dt / m * forces();
    return one.mass * one.e + 0.5 * m * v.squaredNorm() -
        0.125 * dt * dt / m * forces().squaredNorm();
  }
  ElementMechanics::Failure failure() const
  {
    Corners x;
    for (int a = 0; a < CORNERS; a++) std::copy_n(nodes[a].x, 3, x[a]);
    return solid.mechanics.failure(one, list(), x);
  }
};

// ends a step in which nodes have moved with v = L x of its middle

void strain(Body &body, const Nodes &middle, const Tensor &L, double dt = DT)
{
  body.move(L * middle);
  body.place(middle + 0.5 * dt * L * middle);
  body.one.V = body.one.V0 = volume(middle - 0.5 * dt * L * middle);
}

Tensor stress(const Element &one)
{
  const Deviator &S = one.solid.S;
  Tensor s;
  s << S.xx, S.xy, S.xz, S.xy, S.yy, S.yz, S.xz, S.yz, S.zz;
  return s;
}

Tensor elastic(const Tensor &L, double dt)    // without rotation
{
  const Tensor D = 0.5 * (L + L.transpose());
  return 2.0 * G * dt * (D - D.trace() / 3.0 * Tensor::Identity());
}

}    // namespace

TEST(ElementMechanics, Start)
{
  Solid solid;
  Body body(solid, cube(2.0));
  EXPECT_DOUBLE_EQ(body.one.V, 8.0);
  EXPECT_DOUBLE_EQ(body.one.rho, 1.5);
  EXPECT_DOUBLE_EQ(body.one.mass, 12.0);
  Corners x;
  for (int a = 0; a < CORNERS; a++)
    for (int k = 0; k < 3; k++) x[a][k] = k == 0 ? -CORNER[a][k] : CORNER[a][k];
  EXPECT_FALSE(solid.mechanics.start(body.one, x));
}

// nothing happens in a body that moves and turns

TEST(ElementMechanics, RigidMotion)
{
  Solid solid;
  for (int n = 0; n < TRIES; n++) {
    const Nodes middle = distorted();
    Body body(solid, middle);
    strain(body, middle, cross(random_tensor().col(0)), 0.1);
    body.move(body.velocities().colwise() + Eigen::Vector3d(3.0, -2.0, 1.0));
    body.place(middle + 0.05 * body.velocities());
    ASSERT_EQ(body.advance(0.1), ElementMechanics::NO_TROUBLE);
    EXPECT_NEAR(body.one.rho, 1.5, 1e-14);
    EXPECT_LT(stress(body.one).norm() + std::fabs(body.step.p), 1e-11);
  }
}

// density by volume, pressure of the equation of state, Hooke's law for a step that is not far, the sharp bound of a cube's step

TEST(ElementMechanics, Strain)
{
  Solid solid;
  for (int n = 0; n < TRIES; n++) {
    const Nodes middle = distorted();
    Body body(solid, middle);
    Tensor L = 0.1 * random_tensor();
    L = (L + L.transpose()).eval();
    strain(body, middle, L);
    const double begin = body.one.V;
    ASSERT_EQ(body.advance(DT), ElementMechanics::NO_TROUBLE);
    EXPECT_NEAR(body.one.rho, 1.5 * begin / volume(body.places()), 1e-14);
    EXPECT_LT((stress(body.one) - elastic(L, DT)).norm(), 1e-13);
    double p, csq;
    solid.material.eos->evaluate(body.one.rho, 0.0, p, csq);
    EXPECT_DOUBLE_EQ(body.step.p, p);
    EXPECT_NEAR(body.step.c, std::sqrt(csq + 4.0 / 3.0 * G / body.one.rho), 1e-12);
    EXPECT_EQ(body.one.q > 0.0, L.trace() < 0.0);
  }
  Body body(solid, cube(2.0));
  ASSERT_EQ(body.advance(DT), ElementMechanics::NO_TROUBLE);
  EXPECT_NEAR(body.one.stable * body.step.c, 2.0 * std::sqrt(1.0 / 3.0), 1e-14);
}

// what pairs tell takes the place of the element's own gradient, as far as particles see all around

TEST(ElementMechanics, Pairs)
{
  Solid solid;
  const Nodes middle = cube(1.0);
  const Tensor L = 0.1 * Tensor(Eigen::Vector3d(1.0, -2.0, 0.5).asDiagonal());
  for (const double part : {0.0, 0.25, 1.0}) {
    Body body(solid, middle);
    strain(body, middle, L);
    const double begin = body.one.V;
    body.step.paired = true;
    Tensor pairs = 0.1 * random_tensor();
    pairs = (pairs + pairs.transpose()).eval();
    for (int k = 0; k < 9; k++) body.step.sums.L[k] = pairs(k / 3, k % 3);
    for (int k = 0; k < 3; k++) body.step.sums.M[k] = part;
    const Tensor felt = (1.0 - part) * L + pairs;
    ASSERT_EQ(body.advance(DT), ElementMechanics::NO_TROUBLE);
    EXPECT_LT((stress(body.one) - elastic(felt, DT)).norm(), 1e-13);
    EXPECT_NEAR(body.one.rho, 1.5 * begin / body.one.V * std::exp(DT * (L.trace() - felt.trace())),
                1e-14);
  }
}

// an element that rings: forces neither push nor turn it, and all that they take from nodes is in its energy, to round-off;
// the work against hourglasses is a part

TEST(ElementMechanics, Energy)
{
  Solid solid;
  for (int n = 0; n < 10; n++) {
    Body body(solid, distorted());
    body.move(random_nodes(0.3));
    body.whole_step(DT);
    const double start = body.energy(DT);
    double largest = 0.0;
    for (int k = 0; k < 50; k++) {
      body.kick(DT);
      body.whole_step(DT);
      const Nodes f = body.forces(), x = body.places();
      Eigen::Vector3d torque = Eigen::Vector3d::Zero();
      for (int a = 0; a < CORNERS; a++)
        torque += Eigen::Vector3d(x.col(a)).cross(Eigen::Vector3d(f.col(a)));
      EXPECT_LT(f.rowwise().sum().norm() + torque.norm(), 1e-12 * (1.0 + f.norm()));
      EXPECT_NEAR(body.energy(DT), start, 1e-13);
      largest = std::max(largest, body.one.e);
    }
    EXPECT_GT(largest, 1e-3);
    EXPECT_GT(body.one.hourglass, 0.0);
  }
}

// when the step changes, half kicks of the old one are given back

TEST(ElementMechanics, ChangingStep)
{
  Solid solid;
  Body body(solid, distorted());
  body.move(random_nodes(0.3));
  double last = DT;
  body.whole_step(last);
  const double start = body.energy(last), m = body.one.mass / CORNERS;
  for (int k = 0; k < 50; k++) {
    const double dt = DT * (1.0 + 0.3 * std::sin(k));
    body.kick(0.5 * (last + dt));
    for (int a = 0; a < CORNERS; a++)
      body.nodes[a].kick =
          (dt * dt - last * last) * 0.125 * body.forces().col(a).squaredNorm() / (m * m);
    body.whole_step(dt);
    EXPECT_NEAR(body.energy(dt), start, 1e-13);
    last = dt;
  }
}

TEST(ElementMechanics, Resume)
{
  Solid solid;
  Body body(solid, distorted());
  body.move(random_nodes(0.3));
  body.whole_step(DT);
  const ElementStep before = body.step;
  std::copy_n(before.L, 9, body.one.L);
  body.step = {};
  ElementBatch b = body.batch();
  solid.mechanics.resume(b);
  EXPECT_EQ(body.step.p, before.p);
  EXPECT_TRUE(std::equal(before.L, before.L + 9, body.step.L));
}

TEST(ElementMechanics, Trouble)
{
  Solid solid;
  Body body(solid, cube(1.0));
  Nodes flat = cube(1.0);
  flat.row(2) *= -0.1;
  body.place(flat);
  EXPECT_EQ(body.advance(DT), ElementMechanics::COLLAPSED);
  Body other(solid, cube(1.0));
  other.one.solid.S.xx = std::nan("");
  EXPECT_EQ(other.advance(DT), ElementMechanics::NOT_A_NUMBER);
}

TEST(ElementMechanics, Failure)
{
  Solid solid;
  using M = ElementMechanics;
  const auto fails = [&](const auto &how, const auto &off, M::Failure why) {
    Body body(solid, cube(1.0));
    body.one.stable = body.one.stable_at_start = 1.0;
    EXPECT_EQ(body.failure(), M::NONE);
    how(body);
    EXPECT_EQ(body.failure(), why);
    const M::Options kept = solid.mechanics.options;
    off(solid.mechanics.options);
    EXPECT_EQ(body.failure(), M::NONE);
    solid.mechanics.options = kept;
  };
  const auto never = [](M::Options &) {
  };
  fails(
      [](Body &b) {
        b.one.solid.damage = 1.0;
      },
      [](M::Options &o) {
        o.damage = false;
      },
      M::DAMAGE);
  fails(
      [](Body &b) {
        b.one.solid.spalled = 1.0;
      },
      [](M::Options &o) {
        o.spall = false;
      },
      M::SPALL);
  fails(
      [](Body &b) {
        b.one.solid.eps = 0.31;
      },
      [](M::Options &o) {
        o.strain = 0.0;
      },
      M::STRAIN);
  fails(
      [](Body &b) {
        b.one.stable = 0.09;
      },
      [](M::Options &o) {
        o.shrink = 0.0;
      },
      M::STEP);

  // shapes count when it has flowed only; a face has four corners

  const auto flat = [](Body &b) {
    Nodes x = cube(1.0);
    x.row(0) *= 0.15;
    b.place(x);
  };
  fails(flat, never, M::NONE);
  fails(
      [&](Body &b) {
        flat(b);
        b.one.solid.eps = 0.1;
      },
      [](M::Options &o) {
        o.edges = 10.0;
      },
      M::SHAPE);
  const auto alone = [](int n) {
    return [n](Body &b) {
      for (int a = n; a < CORNERS; a++) b.nodes[a].valence = 1.0;
    };
  };
  fails(alone(4), never, M::NONE);
  Body body(solid, cube(1.0));
  alone(3)(body);
  EXPECT_EQ(body.failure(), M::ORPHAN);
  body.one.shared = 3;    // as from the start
  EXPECT_EQ(body.failure(), M::NONE);
}

// particles have the momentum of the nodes, and what they lack of their kinetic energy is heat

TEST(ElementMechanics, LetGo)
{
  Solid solid;
  for (int n = 1; n <= 4; n++) {
    Body body(solid, distorted());
    body.move(random_nodes());
    const Nodes v = body.velocities();
    const Cells cells = hex_subcells(n);
    Eigen::Vector3d momentum = Eigen::Vector3d::Zero();
    double kinetic = 0.0;
    for (const Weights &N : cells) {
      const Eigen::Vector3d u = v * Eigen::Map<const Eigen::Matrix<double, CORNERS, 1>>(N.data());
      momentum += u / cells.size();
      kinetic += 0.5 * u.squaredNorm() / cells.size();
    }
    EXPECT_LT((momentum - v.rowwise().mean()).norm(), 1e-15);
    const double heat = solid.mechanics.let_go(body.one, body.list(), cells);
    EXPECT_NEAR(heat, 0.5 * v.squaredNorm() / CORNERS - kinetic, 1e-15);
    EXPECT_GT(heat, 0.0);
    EXPECT_EQ(body.one.e, heat);
    EXPECT_EQ(body.one.ahead, heat);
  }
}

// elements of two materials side by side in vectors, and fewer than lanes: as each by itself

TEST(ElementMechanics, Lanes)
{
  Solid one, two("0.01");
  one.mechanics.laws.push_back(two.mechanics.laws[1]);
  const int n = LANES - 1;
  Element elements[LANES];
  ElementStep steps[LANES];
  ElementBatch b;
  b.n = n;
  b.element = elements;
  b.step = steps;
  std::vector<Body> alone;
  for (int lane = 0; lane < LANES; lane++) {
    Body body(one, distorted());
    body.one.type = 1 + lane % 2;
    body.one.id = lane;
    body.move(random_nodes(0.3));
    for (int k = 0; k < 3; k++)
      for (int a = 0; a < CORNERS; a++) {
        b.x[k][a][lane] = body.nodes[a].x[k];
        b.v[k][a][lane] = body.nodes[a].v[k];
      }
    elements[lane] = body.one;
    alone.push_back(body);
  }
  b.V = hex_gradient(b.x, b.B);
  int lane;
  ASSERT_EQ(one.mechanics.advance(b, DT, true, lane), ElementMechanics::NO_TROUBLE);
  one.mechanics.forces(b, DT);
  for (int k = 0; k < n; k++) {
    Body &body = alone[k];
    ASSERT_EQ(body.advance(DT), ElementMechanics::NO_TROUBLE);
    ElementBatch by_itself = body.batch();
    one.mechanics.forces(by_itself, DT);
    EXPECT_EQ(body.one.rho, elements[k].rho);
    EXPECT_EQ(body.one.stable, elements[k].stable);
    EXPECT_NEAR((stress(body.one) - stress(elements[k])).norm(), 0.0, 1e-14);
    EXPECT_LT((body.forces() - Eigen::Map<const Nodes>(elements[k].force[0])).norm(), 1e-14);
    EXPECT_EQ(elements[k].solid.eps > 0.0, k % 2 == 1);
  }
}
