/* ----------------------------------------------------------------------
   lammps-hvi: hypervelocity impact for LAMMPS, GNU GPL version 2, see LICENSE
   What fuzzing of the readers found, and what it began with: see tests/fuzz.
------------------------------------------------------------------------- */

#include "../fuzz/fuzz_readers.h"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <sstream>

namespace {

namespace fs = std::filesystem;

const fs::path TESTS = fs::path(__FILE__).parent_path().parent_path();

int check(const fs::path &folder, std::string (*wrong)(std::string))
{
  int n = 0;
  if (!fs::exists(folder)) return n;
  for (const auto &entry : fs::directory_iterator(folder)) {
    std::stringstream text;
    text << std::ifstream(entry.path(), std::ios::binary).rdbuf();
    EXPECT_EQ(wrong(text.str()), "") << entry.path();
    n++;
  }
  return n;
}

TEST(Fuzz, Material)
{
  check(TESTS / "fuzz" / "found" / "material", Fuzz::check_material);
  EXPECT_GT(check(TESTS.parent_path() / "potentials", Fuzz::check_material), 15);
}

TEST(Fuzz, Table)
{
  check(TESTS / "fuzz" / "found" / "table", Fuzz::check_table);
  EXPECT_EQ(Fuzz::check_table("# UNITS: si\nrho0 1\ninterpolation bilinear\npressure 3 2\ne -1 1\n"
                              "0.5 -2 -2\n1 0 0\n2 4 4\n"),
            "");
}

// what it looks for is seen

TEST(Fuzz, Sees)
{
  EXPECT_NE(Fuzz::check_message("y.hvi: wrong"), "");
  EXPECT_NE(Fuzz::check_message("x.hvi:1: wrong\nand more"), "");
  class Wrong final : public HVI::Eos {
   public:
    const char *name() const override { return "wrong"; }
    double rho0() const override { return 1.0; }
    double c0() const override { return 1.0; }
    double rho_max() const override { return HVI::NO_LIMIT; }
    bool evaluate(double rho, double, double &p, double &csq) const override
    {
      p = csq = rho > 10.0 ? -1.0 : 1.0;
      return true;
    }
    double temperature(double, double) const override { return 0.0; }
  };
  EXPECT_NE(Fuzz::check_eos(Wrong()), "");
}

}    // namespace
