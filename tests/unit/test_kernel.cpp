/* ----------------------------------------------------------------------
   lammps-hvi: hypervelocity impact for LAMMPS, GNU GPL version 2, see LICENSE
   SPH kernels: normalization, derivatives, agreement with LAMMPS's package SPH.
------------------------------------------------------------------------- */

#include "hvi_kernel.h"
#include "hvi_vector.h"

#include <gtest/gtest.h>

namespace {

constexpr double PI = HVI::Kernel::PI;

// Gauss-Legendre with 5 points on pieces that no joint of a spline cuts (they lie at multiples
// of 1/2); exact for the polynomials, up to degree 9

template <typename F> double integral(F f, double end)
{
  const double x[5] = {0.0, 0.53846931010568309, -0.53846931010568309, 0.90617984593866399,
                       -0.90617984593866399};
  const double w[5] = {0.56888888888888889, 0.47862867049936647, 0.47862867049936647,
                       0.23692688505618909, 0.23692688505618909};
  const int n = (int) (end * 64);
  double sum = 0.0;
  for (int i = 0; i < n; i++)
    for (int k = 0; k < 5; k++) sum += w[k] * f((i + 0.5 + 0.5 * x[k]) * end / n);
  return 0.5 * sum * end / n;
}

double shell(int dim, double r)
{
  return dim == 1 ? 2.0 : dim == 2 ? 2 * PI * r : 4 * PI * r * r;
}

class KernelTest : public ::testing::TestWithParam<HVI::KernelFunctions> {
 protected:
  const HVI::KernelFunctions K = GetParam();
};
INSTANTIATE_TEST_SUITE_P(All, KernelTest, ::testing::ValuesIn(HVI::KERNELS), [](const auto &one) {
  return one.param.name;
});

TEST_P(KernelTest, IntegralIsOne)
{
  for (int dim = 1; dim <= 3; dim++) {
    auto f = [dim, this](double q) {
      return shell(dim, q) * K.w(q);
    };
    EXPECT_NEAR(K.norm[dim - 1] * integral(f, K.support), 1.0, 1e-13) << dim << "d";
  }
}

// int x . grad W = -D, as long as W is 0 at the end of the support; the cut Gaussian's step
// takes as much as is said here

TEST_P(KernelTest, GradientOfALinearFieldIsExact)
{
  const bool gauss = std::string(K.name) == "gauss";
  const double step = gauss ? std::exp(-9.0) : 0.0;
  for (int dim = 1; dim <= 3; dim++) {
    auto f = [dim, this](double q) {
      return shell(dim, q) * q * K.dw(q);
    };
    const double lost = K.norm[dim - 1] * shell(dim, K.support) * K.support * step;
    EXPECT_NEAR(K.norm[dim - 1] * integral(f, K.support), -dim + lost, 1e-12) << dim << "d";
    if (gauss) { EXPECT_NEAR(lost / dim, dim == 1 ? 4.2e-4 : dim == 2 ? 1.11e-3 : 2.5e-3, 1e-4); }
  }
}

TEST_P(KernelTest, SlopeIsThatOfTheKernel)
{
  const double h = 1e-4;
  for (double q = 0.0107; q < K.support - 2 * h; q += 0.0107) {
    const double slope =
        (8.0 * (K.w(q + h) - K.w(q - h)) - K.w(q + 2 * h) + K.w(q - 2 * h)) / (12.0 * h);
    EXPECT_NEAR(K.dw(q), slope, 1e-9 * K.w(0.0)) << "q " << q;
    EXPECT_LT(K.dw(q), 0.0);
  }
}

TEST_P(KernelTest, ContinuousWherePiecesJoin)
{
  for (double q : {0.5, 1.0, 1.5, 2.0, 2.5}) {
    const double d = 1e-13;
    EXPECT_NEAR(K.w(q - d), K.w(q + d), 1e-11 * K.w(0.0)) << q;
    EXPECT_NEAR(K.dw(q - d), K.dw(q + d), 1e-11 * K.w(0.0)) << q;
  }
}

TEST_P(KernelTest, ZeroBeyondTheSupport)
{
  for (double q : {1.0, 1.0 + 1e-15, 1.1, 2.0, 10.0, 1e6, 1e100}) {
    EXPECT_EQ(K.w(q * K.support), 0.0) << q;
    EXPECT_EQ(K.dw(q * K.support), 0.0) << q;
    EXPECT_EQ(K.dw_q(q * K.support), 0.0) << q;
  }
  EXPECT_GT(K.w(0.999 * K.support), 0.0);
}

TEST_P(KernelTest, NothingButNumbersNearTheCenter)
{
  for (double q : {0.0, 1e-300, 1e-20, 1e-10, 1e-3}) {
    EXPECT_TRUE(std::isfinite(K.dw_q(q))) << q;
    EXPECT_LT(K.dw_q(q), 0.0) << q;
    EXPECT_LE(std::fabs(K.dw(q)), std::fabs(K.dw_q(q)) * 2.0) << q;
  }
  EXPECT_EQ(0.0 * K.dw_q(0.0), 0.0);    // no force when particles coincide
  if (std::string(K.name) != "quadratic") {
    EXPECT_NEAR(K.dw_q(1e-9), K.dw_q(1e-3), 1e-2 * std::fabs(K.dw_q(0.0)));
  }
}

TEST(Kernel, LucyIsThatOfPackageSph)
{
  // h and q without rounding errors of their own
  for (double h : {0.0078125, 1.0, 4.0})
    for (double q = 0.0; q < 1.0; q += 0.0078125) {
      const double ihsq = 1.0 / (h * h), wfd = h - q * h;
      const double in3d = -25.066903536973515383 * wfd * wfd * ihsq * ihsq * ihsq / h;
      const double in2d = -19.098593171027440292 * wfd * wfd * ihsq * ihsq * ihsq;
      EXPECT_NEAR(HVI::Lucy::norm[2] * HVI::Lucy::dw_q(q) / std::pow(h, 5) / in3d, 1.0, 1e-14);
      EXPECT_NEAR(HVI::Lucy::norm[1] * HVI::Lucy::dw_q(q) / std::pow(h, 4) / in2d, 1.0, 1e-14);
    }
}

TEST(Kernel, ExponentialToRoundOff)
{
  for (double q = 0.0; q < 3.0; q += 0.001)
    EXPECT_NEAR(HVI::Gauss::w(q) / std::exp(-q * q), 1.0, 1e-14) << q;
}

// closed forms as printed: Price (2012) for the splines, Esposito's eq 2.26 polynomial with the
// constants of its eq 2.27, Johnson et al. (1996), Dehnen & Aly (2012)

TEST(Kernel, PrintedForms)
{
  for (double q = 0.0; q < 1.0; q += 0.01) {
    EXPECT_NEAR(HVI::Cubic::w(q), 2.0 / 3.0 - q * q + 0.5 * q * q * q, 1e-15);
    EXPECT_NEAR(HVI::Cubic::w(1 + q), std::pow(1 - q, 3) / 6.0, 1e-15);
    EXPECT_NEAR(HVI::Quadratic::w(2 * q), 0.1875 * 4 * q * q - 0.75 * 2 * q + 0.75, 1e-15);
    EXPECT_NEAR(HVI::Quintic::w(q),
                std::pow(3 - q, 5) - 6 * std::pow(2 - q, 5) + 15 * std::pow(1 - q, 5), 1e-12);
    EXPECT_NEAR(HVI::Quartic::w(0.5 * q),
                std::pow(2.5 - 0.5 * q, 4) - 5 * std::pow(1.5 - 0.5 * q, 4) +
                    10 * std::pow(0.5 - 0.5 * q, 4),
                1e-13);
    EXPECT_NEAR(HVI::Wendland2::w(2 * q), std::pow(1 - q, 4) * (1 + 4 * q), 1e-15);
    EXPECT_NEAR(HVI::Wendland4::w(2 * q), std::pow(1 - q, 6) * (1 + 6 * q + 35.0 / 3.0 * q * q),
                1e-15);
  }
}

TEST(Kernel, FoundByName)
{
  int n = 0;
  const std::string list = HVI::kernel_names();
  for (size_t from = 0; from < list.size();) {
    const size_t to = std::min(list.find(", ", from), list.size());
    const std::string name = list.substr(from, to - from);
    ASSERT_TRUE(HVI::find_kernel(name)) << name;
    EXPECT_EQ(HVI::find_kernel(name)->name, name);
    from = to + 2;
    n++;
  }
  EXPECT_EQ(n, 8);
  EXPECT_FALSE(HVI::find_kernel("Cubic"));
  EXPECT_FALSE(HVI::find_kernel(""));
}

// vectors of numbers are these numbers

template <class K> void expect_vectors()
{
  for (double q = 0.0; q < 1.2 * K::support; q += 0.01) {
    HVI::Vec lanes;
    for (int k = 0; k < HVI::LANES; k++) lanes[k] = q + 0.3 * k;
    const HVI::Vec w = K::template w<HVI::Vec>(lanes), dw_q = K::template dw_q<HVI::Vec>(lanes);
    for (int k = 0; k < HVI::LANES; k++) {
      EXPECT_NEAR(w[k], K::w(lanes[k]), 1e-15);
      EXPECT_NEAR(dw_q[k], K::dw_q(lanes[k]), 1e-15);
    }
  }
}

TEST(Kernel, InVectors)
{
  expect_vectors<HVI::Cubic>();
  expect_vectors<HVI::Gauss>();
}

}    // namespace
