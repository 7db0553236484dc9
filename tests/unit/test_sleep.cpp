/* ----------------------------------------------------------------------
   lammps-hvi: hypervelocity impact for LAMMPS, GNU GPL version 2, see LICENSE
   Who is asleep, and who is near somebody awake, against all pairs of points.
------------------------------------------------------------------------- */

#include "hvi_sleep.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

using Point = std::array<double, 3>;

namespace {

constexpr double CUT = 1.0, SKIN = 0.3, SIZE = CUT + 3.0 * SKIN, ALIKE = 1e-3;

struct Particle {
  Point x, v = {};
  bool disturbed = false;
};
using Particles = std::vector<Particle>;

// places in the middle of the cells of a block, and one more in each

Particles block(int n, const Point &v = {}, int start = 0)
{
  Particles made;
  for (int i = 0; i < n * n * n; i++)
    for (const double at : {0.5, 0.9}) {
      const double y = i / n % n + at, z = i / n / n + at;
      made.push_back({{SIZE * (start + i % n + at), SIZE * y, SIZE * z}, v});
    }
  return made;
}

class Night {
 public:
  HVI::RelativeMotion cells;
  HVI::Sleep sleep;
  Particles all;

  explicit Night(const Particles &particles) : all(particles)
  {
    std::vector<const double *> x;
    for (const Particle &p : all) x.push_back(p.x.data());
    cells.start(x.size(), x.data(), CUT, SKIN);
    settle();
  }
  void settle()
  {
    sleep.start(cells);
    for (size_t i = 0; i < all.size(); i++)
      sleep.add(cells.cell_of(i), all[i].v.data(), all[i].disturbed);
    sleep.settle(cells, ALIKE);
  }
  bool asleep(int i) const { return sleep.asleep(cells.cell_of(i)); }
  bool near_awake(int i) const { return sleep.near_awake(cells.cell_of(i)); }

  // by places: same or adjacent cells

  bool close(int i, int j) const
  {
    for (int k = 0; k < 3; k++)
      if (std::fabs(std::floor(all[i].x[k] / SIZE) - std::floor(all[j].x[k] / SIZE)) > 1.0)
        return false;
    return true;
  }
};

bool alike(const Particle &a, const Particle &b)
{
  for (int k = 0; k < 3; k++)
    if (std::fabs(a.v[k] - b.v[k]) > ALIKE) return false;
  return true;
}

TEST(Sleep, AllAtRestOrInFlight)
{
  for (const Point &v : {Point{}, Point{5e3, -1.0, 1e-9}}) {
    Night night(block(4, v));
    for (size_t i = 0; i < night.all.size(); i++) EXPECT_TRUE(night.asleep(i));
    night.sleep.spread(night.cells);
    for (size_t i = 0; i < night.all.size(); i++) EXPECT_FALSE(night.near_awake(i));
  }
  Night nobody({});
  nobody.sleep.spread(nobody.cells);
}

TEST(Sleep, NeighborsOfOneDisturbedAreAwake)
{
  Night night(block(6));
  for (const int who : {0, 150, 301, 431}) {
    for (Particle &p : night.all) p.disturbed = false;
    night.all[who].disturbed = true;
    night.settle();
    int nawake = 0;
    for (size_t i = 0; i < night.all.size(); i++) {
      EXPECT_EQ(night.asleep(i), !night.close(i, who)) << who << ", " << i;
      nawake += !night.asleep(i);
    }
    EXPECT_GE(nawake, 2 * 8);
    EXPECT_LE(nawake, 2 * 27);
  }
}

// two bodies side by side: where they are adjacent both are awake, inside of each not

TEST(Sleep, DifferentVelocitiesWakeBoth)
{
  Particles two = block(4), other = block(4, {2.0 * ALIKE, 0.0, 0.0}, 4);
  two.insert(two.end(), other.begin(), other.end());
  Night night(two);
  for (size_t i = 0; i < two.size(); i++)
    EXPECT_EQ(night.asleep(i), std::fabs(two[i].x[0] / SIZE - 4.0) > 1.0) << i;

  for (Particle &p : night.all) p.v[0] *= 0.49;    // counts as one velocity
  night.settle();
  for (size_t i = 0; i < two.size(); i++) EXPECT_TRUE(night.asleep(i));

  night.all[1].v = {0.0, 0.0, -1.1 * ALIKE};    // within one cell
  night.settle();
  EXPECT_FALSE(night.asleep(0));
  EXPECT_FALSE(night.asleep(1));
}

TEST(Sleep, AtRandomAgainstAllPairs)
{
  std::mt19937 random(9);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  int nasleep = 0, nawake = 0, nnear = 0, nwatched = 0;
  for (int scene = 0; scene < 60; scene++) {
    Particles particles(400);
    const double size = 8.0 + 20.0 * part(random);
    for (Particle &p : particles) {
      for (int k = 0; k < 3; k++) p.x[k] = size * (part(random) - 0.4);
      p.v = {part(random) < 0.01 ? 1.0 : 0.4 * ALIKE * part(random), 0.0, 7.0};
      p.disturbed = part(random) < 0.005;
    }
    Night night(particles);
    std::vector<char> awake(particles.size(), 0), watched;
    for (size_t i = 0; i < particles.size(); i++)
      for (size_t j = 0; j < particles.size(); j++)
        if (night.close(i, j) && (particles[j].disturbed || !alike(particles[i], particles[j])))
          awake[i] = 1;

    // a cell sleeps as a whole

    for (size_t i = 0; i < particles.size(); i++)
      for (size_t j = 0; j < particles.size(); j++)
        if (awake[i] && night.cells.cell_of(i) == night.cells.cell_of(j)) awake[j] = 1;
    for (size_t i = 0; i < particles.size(); i++) {
      EXPECT_EQ(night.asleep(i), !awake[i]) << scene << ", " << i;
      (awake[i] ? nawake : nasleep)++;
    }

    // some are awake for other ranks only

    watched = awake;
    for (size_t i = 0; i < particles.size(); i += 97) {
      night.sleep.watch(night.cells.cell_of(i));
      watched[i] = 1;
    }
    night.sleep.spread(night.cells);
    for (size_t i = 0; i < particles.size(); i++) {
      bool near = false;
      for (size_t j = 0; j < particles.size(); j++)
        near = near || (watched[j] && night.close(i, j));
      EXPECT_EQ(night.near_awake(i), near) << scene << ", " << i;
      EXPECT_EQ(night.asleep(i), !awake[i]);    // of that nobody wakes
      nnear += near && !awake[i];
      nwatched += watched[i] && !awake[i];
    }
  }
  EXPECT_GT(nasleep, 1000);
  EXPECT_GT(nawake, 1000);
  EXPECT_GT(nnear, 1000);
  EXPECT_GT(nwatched, 50);
}

// cells are those of the last list: until the next one nobody who sleeps has one within cut that is not

TEST(Sleep, NothingComesNearUnseen)
{
  std::mt19937 random(11);
  std::uniform_real_distribution<double> part(-1.0, 1.0);
  int nasleep = 0, nnear = 0, ncame = 0;
  for (int scene = 0; scene < 40; scene++) {
    Particles particles(300);
    for (size_t i = 0; i < particles.size(); i++) {
      Particle &p = particles[i];
      for (double &s : p.x) s = 7.0 * part(random);
      if (i < 3) p.v = {9.0 * part(random), 9.0 * part(random), 9.0 * part(random)};
      if (i < 2) p.disturbed = true;
    }
    Night night(particles);
    double t = 0.0;
    std::vector<Point> moved(particles.size(), Point{});
    std::vector<const double *> rows;
    for (const Point &p : moved) rows.push_back(p.data());
    while (true) {
      t += 0.002;
      for (size_t i = 0; i < particles.size(); i++)
        for (int k = 0; k < 3; k++) moved[i][k] = t * particles[i].v[k];
      if (night.cells.exceeded(rows.data())) break;
      for (size_t i = 3; i < particles.size(); i++) {
        nasleep += night.asleep(i);
        for (size_t j = 0; j < 3; j++) {
          double now = 0.0, then = 0.0;
          for (int k = 0; k < 3; k++) {
            const double d = particles[i].x[k] - particles[j].x[k];
            then += d * d;
            now += (d - moved[j][k]) * (d - moved[j][k]);
          }
          if (now < CUT * CUT) {
            EXPECT_FALSE(night.asleep(i));
            nnear++;
            ncame += then > CUT * CUT;
          }
        }
      }
    }
  }
  EXPECT_GT(nasleep, 10000);
  EXPECT_GT(nnear, 100);
  EXPECT_GT(ncame, 20);
}

}    // namespace
