/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing authors: the lammps-hvi developers
------------------------------------------------------------------------- */

#include "hvi_sph_reference.h"

#include "hvi_kernel.h"
#include "hvi_sph_touching.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>

namespace HVI {

namespace {

  using Vector = Eigen::Vector3d;
  using Matrix = Eigen::Matrix3d;

  // numbers of records: three of a vector and six of a symmetric matrix, from the one that they begin with

  Eigen::Map<Vector> vector(double &x)
  {
    return Eigen::Map<Vector>(&x);
  }
  Matrix matrix(const VelocityGradient &t)
  {
    return (Matrix() << t.xx, t.xy, t.xz, t.yx, t.yy, t.yz, t.zx, t.zy, t.zz).finished();
  }
  Matrix symmetric(const double &xx)
  {
    const double *const t = &xx;
    return (Matrix() << t[0], t[3], t[4], t[3], t[1], t[5], t[4], t[5], t[2]).finished();
  }

  void add_symmetric(double &xx, const Matrix &m)
  {
    const double add[6] = {m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(0, 2), m(1, 2)};
    for (int k = 0; k < 6; k++) (&xx)[k] += add[k];
  }

  void add_symmetric_to_middle(SphGradV &to, const Matrix &m)
  {
    to.hxx += m(0, 0);
    to.hyy += m(1, 1);
    to.hzz += m(2, 2);
    to.hxy += m(0, 1);
    to.hxz += m(0, 2);
    to.hyz += m(1, 2);
  }

  // two particles within reach of each other

  struct Pair {
    int i, j;
    SphState si, sj;
    Vector x, v;                // x_ij = x_i - x_j, likewise v_ij
    double r, vx;               // |x_ij|, v_ij . x_ij
    double h;                   // (h_i + h_j)/2
    double width_i, width_j;    // h of the kernel by which i sees j, and j sees i
    double F_i, F_j;            // grad W of these is F x_ij
    double a, b;                // of the viscosity
    bool tied;                  // types with tension between them
    double weight;              // w_j/w_i in sums for the density

    Vector grad_i() const { return F_i * x; }
    Vector grad_j() const { return F_j * x; }
    Vector grad() const { return 0.5 * (F_i + F_j) * x; }
    double closing() const { return std::max(0.0, -vx / r); }    // speed at which they approach
  };

  class Reference final : public SphSweeps {
   public:
    Reference(const KernelFunctions &kernel, int scene) : kernel(kernel), bits(scene) {}
    int scene() const override { return bits; }
    bool vectors() const override { return false; }
    void first(SphWork &) const override;
    void forces(SphWork &) const override;
    double w(double q) const override { return kernel.w(q); }

   private:
    const KernelFunctions &kernel;
    const int bits;

    // what a pair does to both

    struct Change {
      Vector force = Vector::Zero();    // on i, opposite on j
      double de_i = 0.0, de_j = 0.0, drho_i = 0.0, drho_j = 0.0;
      double heat = 0.0;    // of either
    };

    bool has(int bit) const { return (bits & bit) != 0; }
    template <class Law> void each_pair(SphWork &, const Law &) const;
    bool within_reach(const SphWork &, int i, int j, Pair &) const;
    double W(const SphLaws &, double r, double h) const;
    double spread(const SphLaws &, double r, double h) const;
    double F(const SphLaws &, double r, double h) const;

    // first sweeps

    void add_slopes(const SphWork &, const Pair &) const;
    void add_gradients(const SphWork &, const Pair &) const;

    // forces

    Change fluid(const SphWork &, const Pair &) const;
    Change riemann(const SphWork &, const Pair &) const;
    Change solid(const SphWork &, const Pair &) const;
    void dissipate_density(const SphLaws &, const Pair &, double p_i, double p_j, double V_i,
                           double V_j, Change &) const;
    double bonded(const Pair &) const;
    double touching(const Pair &) const;
    double signal_rate(const SphLaws &, const Pair &) const;
  };

  // W(r, h), h dW/dh, and F of grad W = F x_ij

  double scale(const SphLaws &laws, double h)
  {
    return laws.norm / (laws.dim == 1 ? h : laws.dim == 2 ? h * h : h * h * h);
  }

  double Reference::W(const SphLaws &laws, double r, double h) const
  {
    return scale(laws, h) * kernel.w(r / h);
  }

  double Reference::spread(const SphLaws &laws, double r, double h) const
  {
    return -scale(laws, h) * (laws.dim * kernel.w(r / h) + r / h * kernel.dw(r / h));
  }

  double Reference::F(const SphLaws &laws, double r, double h) const
  {
    return scale(laws, h) / (h * h) * kernel.dw_q(r / h);
  }

  /* ----------------------------------------------------------------------
     Fluids with viscosity have one kernel for both, with the mean of h.  Else either has its own; between
     types whose h are as 1 to ratio at the start it is as wide as the mean of both: h_i (1 + ratio)/2.
  ------------------------------------------------------------------------- */

  bool Reference::within_reach(const SphWork &work, int i, int j, Pair &pair) const
  {
    const SphPlace &at_i = work.records.place[i], &at_j = work.records.place[j];
    const SphState &si = work.records.state[i], &sj = work.records.state[j];
    const int itype = si.type(), jtype = sj.type();
    pair.h = pair.width_i = pair.width_j = 0.5 * (at_i.h + at_j.h);
    if (has(SPH_RIEMANN | SPH_SOLID)) {
      const double ratio = has(SPH_SPACINGS) ? work.ratio[itype][jtype] : 1.0;
      pair.width_i = 0.5 * (1.0 + ratio) * at_i.h;
      pair.width_j = 0.5 * (1.0 + 1.0 / ratio) * at_j.h;
    }
    pair.x = {at_i.x - at_j.x, at_i.y - at_j.y, at_i.z - at_j.z};
    pair.r = pair.x.norm();
    if (!(pair.r < kernel.support * std::max(pair.width_i, pair.width_j))) return false;

    pair.i = i;
    pair.j = j;
    pair.si = si;
    pair.sj = sj;
    pair.v = {si.vx - sj.vx, si.vy - sj.vy, si.vz - sj.vz};
    pair.vx = pair.v.dot(pair.x);
    pair.F_i = F(work.laws, pair.r, pair.width_i);
    pair.F_j = pair.width_j == pair.width_i ? pair.F_i : F(work.laws, pair.r, pair.width_j);
    pair.a = has(SPH_BODIES) ? work.visc_a[itype][jtype] : work.laws.a;
    pair.b = has(SPH_BODIES) ? work.visc_b[itype][jtype] : work.laws.b;
    pair.tied = has(SPH_BODIES) ? work.tension[itype][jtype] != 0.0 : true;
    pair.weight = has(SPH_SPACINGS) ? work.weight[itype][jtype] : 1.0;
    return true;
  }

  // the half list has those within reach and others; images are near those who are near

  template <class Law> void Reference::each_pair(SphWork &work, const Law &law) const
  {
    std::vector<int> neighbors;
    Pair pair;
    for (int ii = 0; ii < work.list.inum; ii++) {
      const int i = work.list.ilist[ii], n = work.list.numneigh[i];
      const int *const jlist = work.list.firstneigh[i];
      neighbors.assign(jlist, jlist + n);
      if (work.images) {
        const std::vector<int> &also = work.images->near(i, jlist, n);
        neighbors.insert(neighbors.end(), also.begin(), also.end());
      }
      for (const int entry : neighbors) {
        const int j = entry & NEIGHBOR_INDEX;
        if (work.in_elements_together(i, j)) continue;
        if (within_reach(work, i, j, pair)) law(pair);
      }
    }
  }

  /* ---------------------------------------------------------------------- */

  void Reference::first(SphWork &work) const
  {
    each_pair(work, [&](const Pair &pair) {
      if (has(SPH_SOLID))
        add_gradients(work, pair);
      else
        add_slopes(work, pair);
    });
  }

  void Reference::forces(SphWork &work) const
  {
    SphRates *const rates = work.records.rates;
    each_pair(work, [&](const Pair &pair) {
      if (pair.r == 0.0) work.watcher->overlap(pair.i, pair.j);
      const Change change = has(SPH_SOLID) ? solid(work, pair)
          : has(SPH_RIEMANN)               ? riemann(work, pair)
                                           : fluid(work, pair);
      const auto add = [&](SphRates &to, double sign, double de, double drho) {
        vector(to.fx) += sign * change.force;
        to.de_x += de;
        to.drho += drho;
        to.heat += change.heat;
      };
      add(rates[pair.i], 1.0, change.de_i, change.drho_i);
      add(rates[pair.j], -1.0, change.de_j, change.drho_j);
      work.fastest = std::max(work.fastest, signal_rate(work.laws, pair));
      if (work.tally) work.watcher->tally(pair.i, pair.j, pair.x.data(), change.force.data());
    });
  }

  /* ----------------------------------------------------------------------
     Monaghan 1992, for pairs that approach: Pi = (- a c mu + b mu^2)/rho with the means of both,
     mu = h v_ij.x_ij/(r^2 + 0.01 h^2)
  ------------------------------------------------------------------------- */

  double mu(const Pair &pair)
  {
    return pair.h * std::min(0.0, pair.vx) / (pair.r * pair.r + 0.01 * pair.h * pair.h);
  }

  double viscosity(const Pair &pair)
  {
    const double c = 0.5 * (pair.si.c + pair.sj.c), rho = 0.5 * (pair.si.rho + pair.sj.rho);
    return (-pair.a * c * mu(pair) + pair.b * mu(pair) * mu(pair)) / rho;
  }

  /* ----------------------------------------------------------------------
     For the time step, of pairs that approach: (c + approach + 0.6 (a c + b |mu|))/h, after Monaghan 1992 eq 4.5.
     Riemann problems are as viscous as a = 1 and, in shocks that are faster by 1.2 |U|, b |mu| = 0.6 |U|.
  ------------------------------------------------------------------------- */

  double Reference::signal_rate(const SphLaws &laws, const Pair &pair) const
  {
    if (!(pair.vx < 0.0)) return 0.0;
    const SphState &si = pair.si, &sj = pair.sj;
    double c = std::max(si.c, sj.c);
    // the pressure between fluids of Riemann problems goes with the smaller impedance
    if (laws.unlike && (!has(SPH_RIEMANN) || has(SPH_SOLID)))
      c = std::max(c, sph_swing(si.c, si.rho, si.w, sj.c, sj.rho, sj.w));
    const double viscous = has(SPH_RIEMANN) ? c + 0.6 * pair.closing()
                                            : pair.a * c - pair.b * mu(pair);
    return (c + pair.closing() + 0.6 * viscous) / pair.h;
  }

  /* ----------------------------------------------------------------------
     Interface density dissipation, Zisis et al. eqs 22 to 25,

       Phi_i = alpha_i (p_i - p_j)/c V_j dW/dr

     with the mean c and a constant alpha; and with (Howto_sph, interface auto)

       alpha_i = 2 rho_i c/(z_i + z_j) max(0, 1 - min(z_i, z_j) |v_ij|/|p_i - p_j|),  z = rho c,

     without the second term in the bracket between bodies; nothing where those would pull each other
  ------------------------------------------------------------------------- */

  void Reference::dissipate_density(const SphLaws &laws, const Pair &pair, double p_i, double p_j,
                                    double V_i, double V_j, Change &change) const
  {
    if (!has(SPH_DENSITY) || p_i == p_j || !(pair.tied || p_i + p_j > 0.0)) return;
    const SphState &si = pair.si, &sj = pair.sj;
    const double c = 0.5 * (si.c + sj.c), z_i = si.rho * si.c, z_j = sj.rho * sj.c;
    double alpha_i = laws.alpha, alpha_j = laws.alpha;
    if (laws.automatic) {
      const double wave = pair.tied ? std::min(z_i, z_j) * pair.v.norm() / std::fabs(p_i - p_j)
                                    : 0.0;
      alpha_i += 2.0 * si.rho * c / (z_i + z_j) * std::max(0.0, 1.0 - wave);
      alpha_j += 2.0 * sj.rho * c / (z_i + z_j) * std::max(0.0, 1.0 - wave);
    }
    const double dWdr = 0.5 * (pair.F_i + pair.F_j) * pair.r;
    change.drho_i += alpha_i * (p_i - p_j) / c * V_j * dWdr;
    change.drho_j += alpha_j * (p_j - p_i) / c * V_i * dWdr;
  }

  /* ----------------------------------------------------------------------
     Fluids with viscosity: Zisis et al. eqs 9 and 13, with q = rho_i rho_j Pi for the viscosity,

       f_i = - (V_i V_j (p_i + p_j) + m_i m_j Pi) grad W
       dE_i = (V_i V_j p_i + m_i m_j Pi/2) v_ij.grad W      drho_i = rho_i V_j v_ij.grad W

     and form symmetric, Monaghan 1992: p/rho^2 in place of p, m in place of V, and drho_i without rho_i.
     The package SPH gives either particle half of both energies.  Bodies without tension between them
     push, but do not pull, nor do they stretch each other.
  ------------------------------------------------------------------------- */

  Reference::Change Reference::fluid(const SphWork &work, const Pair &pair) const
  {
    const SphState &si = pair.si, &sj = pair.sj;
    const double V_i = si.w, V_j = sj.w, m_i = V_i * si.rho, m_j = V_j * sj.rho;
    const Vector grad = pair.grad();
    const double g = pair.v.dot(grad), mmPi = m_i * m_j * viscosity(pair);
    const bool acts = pair.tied || si.p + sj.p > 0.0;

    double push_i = 0.0, push_j = 0.0;
    if (acts && has(SPH_SYMMETRIC)) {
      push_i = m_i * m_j * si.p / (si.rho * si.rho);
      push_j = m_i * m_j * sj.p / (sj.rho * sj.rho);
    } else if (acts) {
      push_i = V_i * V_j * si.p;
      push_j = V_i * V_j * sj.p;
    }

    Change change;
    change.force = -(push_i + push_j + mmPi) * grad;
    change.heat = 0.5 * mmPi * g;
    change.de_i = push_i * g + change.heat;
    change.de_j = push_j * g + change.heat;
    if (has(SPH_STOCK)) change.de_i = change.de_j = 0.5 * (change.de_i + change.de_j);
    if (acts || pair.vx < 0.0) {
      change.drho_i = (has(SPH_SYMMETRIC) ? m_j : si.rho * V_j) * g;
      change.drho_j = (has(SPH_SYMMETRIC) ? m_i : sj.rho * V_i) * g;
    }
    dissipate_density(work.laws, pair, si.p, sj.p, V_i, V_j, change);
    return change;
  }

  /* ----------------------------------------------------------------------
     Riemann problems (Howto_sph, Riemann problems between particles).  First sweep, with the mean of both kernels in
     gradients, and weights of the neighbor in units of a particle's own:

       grad v_i = - sum_j V_j v_ij (x) grad W,   grad p_i = - sum_j V_j (p_i - p_j) grad W
       n_i = sum_j w_j/w_i W(r, h_i),   spread_i = sum_j w_j/w_i h_i dW/dh(r, h_i)
  ------------------------------------------------------------------------- */

  void Reference::add_slopes(const SphWork &work, const Pair &pair) const
  {
    const Vector grad = pair.grad();
    const Matrix L = pair.v * grad.transpose(), D = 0.5 * (L + L.transpose());
    const Vector dp = (pair.si.p - pair.sj.p) * grad;
    const auto add = [&](int k, double V_other, double weight, double width) {
      SphSlopes &slopes = work.records.slopes[k];
      add_symmetric(slopes.xx, -V_other * D);
      vector(slopes.px) -= V_other * dp;
      slopes.n += weight * W(work.laws, pair.r, width);
      slopes.spread += weight * spread(work.laws, pair.r, width);
    };
    add(pair.i, pair.sj.w, pair.weight, pair.width_i);
    add(pair.j, pair.si.w, 1.0 / pair.weight, pair.width_j);
  }

  // van Leer's monotonized central limiter: the mean of both, at most twice either, 0 if signs differ

  double limited(double a, double b)
  {
    if (!(a * b > 0.0)) return 0.0;
    const double size =
        std::min(0.5 * std::fabs(a + b), 2.0 * std::min(std::fabs(a), std::fabs(b)));
    return a > 0.0 ? size : -size;
  }

  // velocities along e = x_ij/r, in the frame of the mean: U_i - U_j = a

  struct Shock {
    double a;    // difference of velocities
    double z_i,
        z_j;    // impedances: of shocks, of the velocity that the problem of sounds would give

    Shock(const Pair &pair, double p_i, double p_j) : a(pair.vx / pair.r)
    {
      const SphState &si = pair.si, &sj = pair.sj;
      const double sound_i = si.rho * si.c, sound_j = sj.rho * sj.c;
      const double U = (0.5 * a * (sound_i - sound_j) - (p_i - p_j)) / (sound_i + sound_j);
      z_i = si.rho * (si.c + 1.2 * std::max(0.0, U - 0.5 * a));
      z_j = sj.rho * (sj.c + 1.2 * std::max(0.0, -0.5 * a - U));
    }
  };

  /* ----------------------------------------------------------------------
     Second sweep.  States extrapolated to half-way,

       U_i' = U_i - phi(a, a_i)/(2 (1 + 1.5 max(0, -a)/c)),  a_i = 2 r e.grad v_i.e - a,  p_i' = p_i - phi(p_i - p_j, ...)/2,

     meet with p* and U* of the acoustic Riemann problem.  With delta = (U* - (U_i + U_j)/2) e, volumes
     Q = V/w, G_i = w_j V_i/(n_i Omega_i) grad W_i, K = 2 Q_i Q_j/(Q_i + Q_j) (grad W_i + grad W_j):

       f_i = - p* (G_i + G_j),   dE_i = p* (G_i.v_ij - (G_i + G_j).delta)
       drho_i/rho_i = G_i/V_i.v_ij - w_j K.delta/Omega_i

     Bodies without tension push, but do not pull, nor do they stretch each other.
  ------------------------------------------------------------------------- */

  Reference::Change Reference::riemann(const SphWork &work, const Pair &pair) const
  {
    const SphState &si = pair.si, &sj = pair.sj;
    SphSlopes &slopes_i = work.records.slopes[pair.i], &slopes_j = work.records.slopes[pair.j];
    const Vector e = pair.x / pair.r;
    const Shock shock(pair, si.p, sj.p);
    const double a = shock.a, z_i = shock.z_i, z_j = shock.z_j, dp = si.p - sj.p;

    const double a_i = 2.0 * pair.r * e.dot(symmetric(slopes_i.xx) * e) - a;
    const double a_j = 2.0 * pair.r * e.dot(symmetric(slopes_j.xx) * e) - a;
    const double p_beyond_i = 2.0 * pair.r * e.dot(vector(slopes_i.px)) - dp;
    const double p_beyond_j = 2.0 * pair.r * e.dot(vector(slopes_j.px)) - dp;
    const double steep = 1.0 + 1.5 * pair.closing() / std::min(si.c, sj.c);
    const double U_i = 0.5 * a - 0.5 * limited(a, a_i) / steep;
    const double U_j = -0.5 * a + 0.5 * limited(a, a_j) / steep;
    const double p_i = si.p - 0.5 * limited(dp, p_beyond_i);
    const double p_j = sj.p + 0.5 * limited(dp, p_beyond_j);

    const double viscous = -z_i * z_j * (U_i - U_j) / (z_i + z_j);
    double p_star = (z_j * p_i + z_i * p_j) / (z_i + z_j) + viscous;
    double U_star = (z_i * U_i + z_j * U_j - (p_i - p_j)) / (z_i + z_j);
    const bool acts = pair.tied || p_star > 0.0;
    if (!acts) p_star = U_star = 0.0;
    const Vector delta = U_star * e;

    // with w_i = 1; n_j is in units of w_j

    const double w_j = pair.weight, Q = sj.w / w_j;
    const Vector by_n_i = w_j * slopes_i.by_n_omega() * pair.grad_i();
    const Vector by_n_j = slopes_j.by_n_omega() / w_j * pair.grad_j();
    const Vector G_i = si.w * by_n_i, G_j = sj.w * by_n_j, G = G_i + G_j;
    const Vector K = 2.0 * si.w * Q / (si.w + Q) * (pair.grad_i() + pair.grad_j());
    const Vector stretch = acts || pair.vx < 0.0 ? pair.v : Vector(0.0, 0.0, 0.0);

    Change change;
    change.force = -p_star * G;
    change.de_i = p_star * (G_i.dot(pair.v) - G.dot(delta));
    change.de_j = p_star * (G_j.dot(pair.v) + G.dot(delta));
    change.drho_i = si.rho * (by_n_i.dot(stretch) - w_j * K.dot(delta) * slopes_i.by_omega());
    change.drho_j = sj.rho * (by_n_j.dot(stretch) + K.dot(delta) * slopes_j.by_omega());
    change.heat = 0.5 * viscous * G.dot(pair.v);
    return change;
  }

  /* ----------------------------------------------------------------------
     Solids (Howto_sph, Corrected solids).  What hangs together, sound particles of one body and
     of types with tension between them, and how much of the rest counts: all of it under pressure, or while it comes
     nearer, and of rubble in rubble; smoothly to nothing within LITTLE of rho c^2, and of c
  ------------------------------------------------------------------------- */

  double Reference::bonded(const Pair &pair) const
  {
    if (!has(SPH_BODIES)) return 1.0;
    return pair.tied && !pair.si.is_rubble() && !pair.sj.is_rubble() &&
            pair.si.label() == pair.sj.label()
        ? 1.0
        : 0.0;
  }

  double Reference::touching(const Pair &pair) const
  {
    static constexpr double LITTLE = 1.0e-6;
    if (bonded(pair) == 1.0) return 0.0;
    const SphState &si = pair.si, &sj = pair.sj;
    if (pair.tied && si.is_rubble() && sj.is_rubble()) return 1.0;
    const double stiff = si.rho * si.c * si.c + sj.rho * sj.c * sj.c;
    const double pushed = (si.p + sj.p) / (std::fabs(si.p) + std::fabs(sj.p) + LITTLE * stiff);
    const double nearing = -pair.vx / (LITTLE * pair.r * std::max(si.c, sj.c) + 1.0e-300);
    return std::max(0.0, std::min(1.0, std::max(pushed, nearing)));
  }

  // first sweep, F x = grad W: L = - sum w v (x) F x and H = - sum w x (x) F x in the middle of the step; M, as H,
  // and nu at its end

  void Reference::add_gradients(const SphWork &work, const Pair &pair) const
  {
    const Vector x = pair.x - work.half_step * pair.v;
    const double r = x.norm();
    const SphGradV &of_i = work.records.gradv[pair.i], &of_j = work.records.gradv[pair.j];
    const auto add = [&](SphGradV &to, double w, double F_end, double width, double weight) {
      const double wF = weight * w * F(work.laws, r, width);
      const Matrix L = matrix(to.gradient()) - wF * pair.v * x.transpose();
      const Matrix M = symmetric(to.moment().xx) - w * F_end * pair.x * pair.x.transpose();
      add_symmetric_to_middle(to, -wF * x * x.transpose());
      to.set_gradient(
          {L(0, 0), L(0, 1), L(0, 2), L(1, 0), L(1, 1), L(1, 2), L(2, 0), L(2, 1), L(2, 2)});
      to.set_moment({M(0, 0), M(1, 1), M(2, 2), M(0, 1), M(0, 2), M(1, 2)});
      to.nu += w * W(work.laws, pair.r, width);
    };
    const auto add_both = [&](double share, const auto &record) {
      if (share == 0.0) return;
      add(record(pair.i), share * pair.sj.w, pair.F_i, pair.width_i, of_j.weight);
      add(record(pair.j), share * pair.si.w, pair.F_j, pair.width_j, of_i.weight);
    };
    add_both(bonded(pair), [&](int i) -> SphGradV & {
      return work.records.gradv[i];
    });
    add_both(touching(pair), [&](int i) -> SphGradV & {
      return work.records.touching->at(i).sums;
    });
  }

  /* ----------------------------------------------------------------------
     Second sweep.  What works on the velocity of the end of the step, v~_ij, which SphTraction has:

       f_i = w_i w_j (T_i grad W_i + T_j grad W_j),   dE_i = - w_i w_j v~_ij.T_i grad W_i

     between bodies with the part of T that is a pressure, while they push.  Viscosity, with the velocity in the middle of the
     step, is a pressure q on the mean gradient, f_i = - 2 V_i V_j q grad W; dissipation of the density as in fluids.
     Artificial stress (Gray, Monaghan & Swift 2001): f_i += V_i V_j f^n (R_i + R_j) grad W; SphView::art has
     R/w(dp)^n.
  ------------------------------------------------------------------------- */

  Reference::Change Reference::solid(const SphWork &work, const Pair &pair) const
  {
    // where the solid is compressed extrapolation is less: see sph_solid()

    static constexpr double COMPRESSION = 300.0;
    const SphState &si = pair.si, &sj = pair.sj;
    SphTraction &T_i = work.records.traction[pair.i], &T_j = work.records.traction[pair.j];
    const Vector v_end = vector(T_i.vx) - vector(T_j.vx), grad = pair.grad();
    const double ww = si.w * sj.w, VV = T_i.volume * T_j.volume;
    Change change;
    const auto act = [&](const Vector &f_i, const Vector &f_j) {
      change.force += f_i + f_j;
      change.de_i -= f_i.dot(v_end);
      change.de_j -= f_j.dot(v_end);
    };

    if (bonded(pair) == 1.0)
      act(ww * matrix(T_i.by_rows()) * pair.grad_i(), ww * matrix(T_j.by_rows()) * pair.grad_j());
    else {
      const SphPush &P_i = work.records.touching->of(pair.i).push,
                    &P_j = work.records.touching->of(pair.j).push;
      const double share = P_i.p + P_j.p > 0.0 ? touching(pair) : 0.0;
      act(share * ww * symmetric(P_i.xx) * pair.grad_i(),
          share * ww * symmetric(P_j.xx) * pair.grad_j());
    }

    double q = 0.0;
    if (!has(SPH_RIEMANN))
      q = 0.5 * si.rho * sj.rho * viscosity(pair);
    else if (pair.vx < 0.0) {
      const Shock shock(pair, T_i.p, T_j.p);
      const Matrix L_i = symmetric(work.records.gradv[pair.i].stretch().xx),
                   L_j = symmetric(work.records.gradv[pair.j].stretch().xx);
      const Vector e = pair.x / pair.r;
      const double a = shock.a, c = std::min(si.c, sj.c);
      const double a_i = 2.0 * pair.r * e.dot(L_i * e) - a, a_j = 2.0 * pair.r * e.dot(L_j * e) - a;
      const double compressed = std::max({0.0, -L_i.trace(), -L_j.trace()});
      const double steep = 1.0 + (1.5 * pair.closing() + COMPRESSION * pair.r * compressed) / c;
      const double jump = a - 0.5 * (limited(a, a_i) + limited(a, a_j)) / steep;
      q = shock.z_i * shock.z_j / (shock.z_i + shock.z_j) * std::max(0.0, -jump);
    }
    const Vector half = -VV * q * grad;
    act(half, half);
    change.heat = -half.dot(v_end);

    dissipate_density(work.laws, pair, T_i.p, T_j.p, T_i.volume, T_j.volume, change);

    if (has(SPH_ARTSTRESS) && bonded(pair) == 1.0) {
      const double fn = std::pow(kernel.w(pair.r / pair.h), work.laws.art_n);
      act(VV * fn * symmetric(work.records.art[pair.i].xx) * grad,
          VV * fn * symmetric(work.records.art[pair.j].xx) * grad);
    }
    return change;
  }

}    // namespace

std::unique_ptr<SphSweeps> make_sph_reference(const std::string &kernel, int scene)
{
  const KernelFunctions *const known = find_kernel(kernel);
  return known ? std::make_unique<Reference>(*known, scene) : nullptr;
}

}    // namespace HVI
