/* ----------------------------------------------------------------------
   lammps-hvi: hypervelocity impact for LAMMPS, GNU GPL version 2, see LICENSE
   Small things that many rely on: materials by type, elements, what memory is said to be used, signs of mirror images.
------------------------------------------------------------------------- */

#include "hvi_element.h"
#include "hvi_inverse.h"
#include "hvi_materials.h"
#include "hvi_mirror.h"
#include "hvi_rows.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <array>
#include <numeric>

using namespace HVI;

TEST(Materials, AreThoseOfTheirTypes)
{
  const auto steel = std::make_shared<Material>(), copper = std::make_shared<Material>();
  Materials all;
  EXPECT_EQ(all.of(0), nullptr);
  EXPECT_EQ(all.of(3), nullptr);
  EXPECT_EQ(all.entry(3).volume, 0.0);
  EXPECT_FALSE(all.entry(3).restored);
  all.set(3, {steel, "pair", 0.5, true});
  all.set(1, {copper, "fix", 2.0, false});
  for (const int none : {0, 2, 4, 100}) {
    EXPECT_EQ(all.of(none), nullptr);
    EXPECT_EQ(all.entry(none).material, nullptr);
    EXPECT_EQ(all.entry(none).owner, "");
  }
  EXPECT_EQ(all.of(3), steel.get());
  EXPECT_EQ(all.entry(3).material, steel);
  EXPECT_EQ(all.entry(3).owner, "pair");
  EXPECT_EQ(all.entry(3).volume, 0.5);
  EXPECT_TRUE(all.entry(3).restored);
  EXPECT_EQ(all.of(1), copper.get());

  all.set(3, {copper, "fix", 1.0, false});
  EXPECT_EQ(all.of(3), copper.get());
  all.set(2, {steel, "pair", 1.0, false});
  all.forget("fix");
  EXPECT_EQ(all.of(1), nullptr);
  EXPECT_EQ(all.of(2), steel.get());
  EXPECT_EQ(all.of(3), nullptr);
  EXPECT_EQ(all.entry(3).owner, "");
}

TEST(Element, HasACubeOfParticles)
{
  Element one = {};
  EXPECT_FALSE(one.alive());
  EXPECT_EQ(one.particles(), 0);
  one.type = 1;
  one.n = 3;
  EXPECT_TRUE(one.alive());
  EXPECT_EQ(one.particles(), 27);
  one.type = -1;
  EXPECT_FALSE(one.alive());
  // id, type, 8 nodes, n, first; that is what data files have of it
  EXPECT_EQ(offsetof(Element, fingerprint), Element::IDS * sizeof(double));
  EXPECT_EQ(ELEMENT_SIZE * sizeof(double), sizeof(Element));
}

TEST(AlongLargest, IsTheFourthPowerOverItsTrace)
{
  Eigen::Matrix3d m;
  m << 0.8, 0.1, -0.2, 0.1, 0.5, 0.15, -0.2, 0.15, 0.3;
  const Symmetric s = along_largest({0.8, 0.5, 0.3, 0.1, -0.2, 0.15});
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> of(m);
  const Eigen::Vector3d power = of.eigenvalues().array().pow(4);
  const Eigen::Matrix3d wanted =
      of.eigenvectors() * (power / power.sum()).asDiagonal() * of.eigenvectors().transpose();
  EXPECT_NEAR(s.xx, wanted(0, 0), 1e-14);
  EXPECT_NEAR(s.yy, wanted(1, 1), 1e-14);
  EXPECT_NEAR(s.zz, wanted(2, 2), 1e-14);
  EXPECT_NEAR(s.xy, wanted(0, 1), 1e-14);
  EXPECT_NEAR(s.xz, wanted(0, 2), 1e-14);
  EXPECT_NEAR(s.yz, wanted(1, 2), 1e-14);
}

/* ---------------------------------------------------------------------- */

TEST(Mirror, PlanesAndDistances)
{
  MirrorPlanes none, two;
  const double x[3] = {5.0, 7.0, 9.0};
  for (int op = 0; op < MirrorPlanes::NOPS; op++) EXPECT_FALSE(none.is_operation(op));
  two.planes = 5;    // x and z
  two.at[0] = 2.0;
  two.at[1] = 100.0;
  two.at[2] = 10.0;
  two.side[2] = -1.0;
  EXPECT_TRUE(two.has(0));
  EXPECT_FALSE(two.has(1));
  EXPECT_TRUE(two.has(2));
  for (int op = 0; op < MirrorPlanes::NOPS; op++)
    EXPECT_EQ(two.is_operation(op), op == 1 || op == 4 || op == 5) << op;
  EXPECT_EQ(MirrorPlanes::NOPS, 8);
  EXPECT_EQ(two.depth(0, x), 3.0);
  EXPECT_EQ(two.depth(2, x), 1.0);
  EXPECT_EQ(two.depth_squared(0, x), 0.0);
  EXPECT_EQ(two.depth_squared(1, x), 9.0);
  EXPECT_EQ(two.depth_squared(4, x), 1.0);
  EXPECT_EQ(two.depth_squared(5, x), 10.0);
  for (int k = 0; k < 3; k++) EXPECT_EQ(none.depth(k, x), x[k]);
}

// the sign of what has these directions in it

TEST(Mirror, SignsOfComponents)
{
  struct Numbers {
    double xx = 1, yy = 1, zz = 1, xy = 1, xz = 1, yz = 1, yx = 1, zx = 1, zy = 1;
    double vx = 1, vy = 1, vz = 1, fx = 1, fy = 1, fz = 1, px = 1, py = 1, pz = 1;
    double mxx = 1, myy = 1, mzz = 1, mxy = 1, mxz = 1, myz = 1, hxy = 1, hxz = 1, hyz = 1;
  };
  for (int op = 0; op < 8; op++) {
    const Reflection r(op);
    const double x = op & 1 ? -1 : 1, y = op & 2 ? -1 : 1, z = op & 4 ? -1 : 1;
    Numbers n;
    r.symmetric(n);
    EXPECT_EQ(n.xy, x * y);
    EXPECT_EQ(n.xz, x * z);
    EXPECT_EQ(n.yz, y * z);
    EXPECT_EQ(n.yx * n.zx * n.zy * n.xx * n.yy * n.zz, 1.0);
    n = Numbers();
    r.velocity(n);
    EXPECT_EQ(n.vx, x);
    EXPECT_EQ(n.vy, y);
    EXPECT_EQ(n.vz, z);
    r.rates(n);
    EXPECT_EQ(n.fx, x);
    EXPECT_EQ(n.fy, y);
    EXPECT_EQ(n.fz, z);
    r.slopes(n);
    EXPECT_EQ(n.px, x);
    EXPECT_EQ(n.py, y);
    EXPECT_EQ(n.pz, z);
    EXPECT_EQ(n.xy, x * y);
    EXPECT_EQ(n.xz, x * z);
    EXPECT_EQ(n.yz, y * z);
    n = Numbers();
    r.gradient(n);
    EXPECT_EQ(n.xy, x * y);
    EXPECT_EQ(n.yx, x * y);
    EXPECT_EQ(n.xz, x * z);
    EXPECT_EQ(n.zx, x * z);
    EXPECT_EQ(n.yz, y * z);
    EXPECT_EQ(n.zy, y * z);
    EXPECT_EQ(n.mxy, x * y);
    EXPECT_EQ(n.mxz, x * z);
    EXPECT_EQ(n.myz, y * z);
    EXPECT_EQ(n.hxy, x * y);
    EXPECT_EQ(n.hxz, x * z);
    EXPECT_EQ(n.hyz, y * z);
    EXPECT_EQ(n.xx * n.yy * n.zz * n.mxx * n.myy * n.mzz, 1.0);
  }
}

/* ---------------------------------------------------------------------- */

// a row of points one cell apart: none is near another

TEST(Memory, IsThatOfPointsCellsAndRows)
{
  constexpr int N = 1000;
  std::vector<std::array<double, 3>> at(N);
  std::vector<const double *> x;
  std::vector<int> type(N, 1);
  for (int i = 0; i < N; i++) {
    at[i] = {1000.0 * i, 0.0, 0.0};
    x.push_back(at[i].data());
  }
  RelativeMotion motion;
  motion.start(N, x.data(), 1.0, 0.1);
  ASSERT_EQ(motion.cells(), N);
  // on each level a box, the first of its neighbors, its parent; half as many cells on the next
  const double one = 6 * sizeof(double) + 2 * sizeof(int), least = N * (sizeof(int) + one);
  EXPECT_GE(motion.bytes(), least);
  const double levels = 24.0;    // 2^20 times the first
  EXPECT_LE(motion.bytes(), 2.0 * N * (sizeof(int) + levels * (one + 13 * sizeof(int))));

  const double cut[2] = {0.0, 1.21};
  const double *cutsq[2] = {cut, cut};
  NeighborRows rows;
  rows.start(motion, {N, N, x.data(), type.data(), cutsq, 1.21, true, 100});
  // order, types, first_of, ghosts_of, number, after_first, before_first; first; made; boxes; places
  const double bytes =
      N * (7 * sizeof(int) + sizeof(int *) + 1 + 6 * sizeof(double) + 3 * sizeof(double));
  EXPECT_GE(rows.bytes(), bytes);
  EXPECT_LE(rows.bytes(), 1.01 * bytes);
  for (int c = 0; c < N; c++) {
    EXPECT_TRUE(rows.is_lonely(c));
    EXPECT_EQ(rows.make(c), -1);
  }
  EXPECT_EQ(std::accumulate(rows.number.begin(), rows.number.end(), 0), 0);
  EXPECT_GE(rows.bytes(), bytes + (1 << 18) * sizeof(int));    // a page for rows
  EXPECT_LE(rows.bytes(), 1.1 * bytes + (1 << 18) * sizeof(int));
}

TEST(Rows, TellWhoHasTooManyNeighbors)
{
  constexpr int N = 6;
  const double at[3] = {0.0, 0.0, 0.0};
  const double *x[N] = {at, at, at, at, at, at};
  const int type[N] = {1, 1, 1, 1, 1, 1};
  const double cut[2] = {0.0, 1.0};
  const double *cutsq[2] = {cut, cut};
  RelativeMotion motion;
  motion.start(N, x, 1.0, 0.1);
  for (const int longest : {5, 4, 3}) {
    NeighborRows rows;
    rows.start(motion, {N, N, x, type, cutsq, 1.0, true, longest});
    EXPECT_EQ(rows.make(0), longest == 5 ? -1 : 0);    // the first has all five others
    EXPECT_FALSE(rows.is_lonely(0));
  }
}
