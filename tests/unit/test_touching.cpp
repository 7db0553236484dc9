/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#include "hvi_sph_message.h"

#include <gtest/gtest.h>
#include <vector>

using namespace HVI;

TEST(Touching, HasRecordsWhereAskedForUntilTheNextStart)
{
  SphTouching touching;
  touching.start(4);
  EXPECT_EQ(touching.of(2).sums.nu, 0.0);
  EXPECT_FALSE(touching.has(2));
  touching.at(2).sums.nu = 1.5;
  touching.at(0).push.p = 3.0;
  touching.at(2).push.p = 2.0;
  EXPECT_TRUE(touching.has(2) && touching.has(0));
  EXPECT_FALSE(touching.has(1) || touching.has(3));
  EXPECT_EQ(touching.of(2).sums.nu, 1.5);
  EXPECT_EQ(touching.of(2).push.p, 2.0);
  EXPECT_EQ(touching.of(0).push.p, 3.0);

  touching.start(2);    // fewer than before, and more
  for (int i = 0; i < 4; i++) EXPECT_FALSE(touching.has(i));
  touching.start(100);
  EXPECT_FALSE(touching.has(99));
  EXPECT_EQ(touching.at(2).sums.nu, 0.0);
}

namespace {

// numbers of particles on two ranks: those of `of` here are those of `there`, in the order of a message

struct Rank {
  std::vector<SphTraction> traction;
  std::vector<SphGradV> gradv;
  SphTouching touching;

  Rank(int n) : traction(n), gradv(n) { touching.start(n); }
  SphMessage tractions()
  {
    return SphMessage()
        .with(traction.data())
        .with((SphStress *) nullptr)
        .with(gradv.data(), SphGradV::SENT_STRETCH)
        .with_pushes(&touching);
  }
  SphMessage sums() { return SphMessage().with(gradv.data()).with_sums(&touching); }
};

const auto put = [](double &here, double number) {
  here = number;
};
const auto add = [](double &here, double number) {
  here += number;
};

}    // namespace

TEST(Message, BringsRecordsAndWhatTouchesToGhosts)
{
  Rank from(5), to(9);
  for (int i = 0; i < 5; i++) {
    from.traction[i].xx = 10 + i;
    from.traction[i].vz = 20 + i;
    from.traction[i].div = 30 + i;    // is not sent
    from.gradv[i].xx = 40 + i;
    from.gradv[i].hxx = 50 + i;    // nor this
  }
  from.touching.at(3).push.p = 63;
  from.touching.at(0).push.yz = 60;
  from.touching.at(3).sums.nu = 1.0;    // nor this
  const std::vector<int> list = {4, 3, 1};
  const auto there = [](int k) {
    return 6 + k;
  };
  const SphMessage message = from.tractions();
  std::vector<double> buffer(3 * message.size());
  const int n = message.pack(
      3,
      [&](int k) {
        return list[k];
      },
      buffer.data());
  EXPECT_EQ(n, 3 * (SphTraction::SENT + SphGradV::SENT_STRETCH) + 1 + 1 + SphPush::SENT);
  to.tractions().unpack(3, there, buffer.data(), put);
  for (int k = 0; k < 3; k++) {
    const SphTraction &T = to.traction[there(k)];
    EXPECT_EQ(T.xx, 10 + list[k]);
    EXPECT_EQ(T.vz, 20 + list[k]);
    EXPECT_EQ(T.div, 0.0);
    EXPECT_EQ(to.gradv[there(k)].xx, 40 + list[k]);
    EXPECT_EQ(to.gradv[there(k)].hxx, 0.0);
    EXPECT_EQ(to.touching.has(there(k)), list[k] == 3);
  }
  EXPECT_EQ(to.touching.of(7).push.p, 63);
  EXPECT_EQ(to.touching.of(7).sums.nu, 0.0);
  EXPECT_EQ(message.pack(
                0,
                [](int) {
                  return 0;
                },
                buffer.data()),
            0);
}

TEST(Message, AddsSumsAtOwnersAndFitsItsSize)
{
  Rank ghosts(4), owners(4);
  for (int i = 0; i < 4; i++) {
    ghosts.gradv[i].nu = 1 + i;
    owners.gradv[i].nu = 0.5;
    ghosts.touching.at(i).sums.mxx = 10 + i;
  }
  owners.touching.at(2).sums.mxx = 0.25;
  const SphMessage message = ghosts.sums();
  std::vector<double> buffer(4 * message.size());
  const auto reversed = [](int k) {
    return 3 - k;
  };
  const auto same = [](int k) {
    return k;
  };
  EXPECT_LE(message.pack(4, same, buffer.data()), (int) buffer.size());    // all of them touch
  owners.sums().unpack(4, reversed, buffer.data(), add);
  for (int i = 0; i < 4; i++) {
    EXPECT_EQ(owners.gradv[i].nu, 0.5 + 4 - i);
    EXPECT_EQ(owners.touching.of(i).sums.mxx, 13 - i + (i == 2 ? 0.25 : 0.0));
  }
}
