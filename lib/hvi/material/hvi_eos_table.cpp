/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#include "hvi_eos_table.h"

#include <cstdarg>
#include <cstdio>

namespace HVI {

namespace {

  std::string text(const char *format, ...)
  {
    char line[256];
    va_list args;
    va_start(args, format);
    std::vsnprintf(line, sizeof(line), format, args);
    va_end(args);
    return line;
  }

  /* ----------------------------------------------------------------------
     Slope at x[i] of the polynomial through the five nodes about it (four or
     five beside an edge): derivatives of Lagrange's polynomials.  Differences
     to f[i] are taken, so that the slope of a constant is exactly 0.
  ------------------------------------------------------------------------- */

  template <class F> double slope(const std::vector<double> &x, int i, const F &f)
  {
    const int n = x.size(), m = std::min(n, 5), first = std::min(std::max(i - 2, 0), n - m);
    double sum = 0.0;
    for (int k = first; k < first + m; k++) {
      if (k == i) continue;
      double weight = 1.0 / (x[k] - x[i]);
      for (int l = first; l < first + m; l++)
        if (l != i && l != k) weight *= (x[i] - x[l]) / (x[k] - x[l]);
      sum += weight * (f(k) - f(i));
    }
    return sum;
  }

  // Hermite's cubic and its slope over s in [0, 1], d0 and d1 the slopes at the ends

  struct Cubic {
    double f, d;
  };

  Cubic cubic(double f0, double f1, double d0, double d1, double s)
  {
    const double df = f1 - f0;
    const double c2 = 3.0 * df - 2.0 * d0 - d1, c3 = d0 + d1 - 2.0 * df;
    return {f0 + s * (d0 + s * (c2 + s * c3)), d0 + s * (2.0 * c2 + s * 3.0 * c3)};
  }

  std::string label_of(const TableData &data)
  {
    return text("table %.80s (densities %g to %g, energies %g to %g)", data.name.c_str(),
                data.rho.front(), data.rho.back(), data.e.front(), data.e.back());
  }

  std::string values_problem(const char *what, const std::vector<double> &values, bool grid)
  {
    for (std::size_t k = 0; k < values.size(); k++) {
      if (!std::isfinite(values[k])) return text("%s %g is not a finite number", what, values[k]);
      if (grid && k && !(values[k] > values[k - 1]))
        return text("%s do not increase: %.10g after %.10g", what, values[k], values[k - 1]);
    }
    return "";
  }
}    // namespace

/* ---------------------------------------------------------------------- */

TableGrid::TableGrid(const TableData &data) :
    label(label_of(data)), rho(data.rho), x(data.rho), y(data.e), T(data.T),
    log_density(data.log_density), bicubic(data.bicubic)
{
  const int nx = x.size(), ny = y.size();
  if (log_density)
    for (double &value : x) value = std::log(value);

  nodes.resize(data.p.size());
  for (std::size_t k = 0; k < nodes.size(); k++) nodes[k] = {data.p[k], 0.0, 0.0, 0.0};
  if (!bicubic) return;
  for (int i = 0; i < nx; i++)
    for (int j = 0; j < ny; j++) {
      nodes[i * ny + j].px = slope(x, i, [&](int k) {
        return node(k, j).p;
      });
      nodes[i * ny + j].py = slope(y, j, [&](int k) {
        return node(i, k).p;
      });
    }
  for (int i = 0; i < nx; i++)
    for (int j = 0; j < ny; j++)
      nodes[i * ny + j].pxy = slope(y, j, [&](int k) {
        return node(i, k).px;
      });
}

/* ---------------------------------------------------------------------- */

bool TableGrid::find(double density, double e, Cell &cell) const
{
  if (!(density >= rho.front() && density <= rho.back() && e >= y.front() && e <= y.back()))
    return false;
  const int i = std::upper_bound(rho.begin(), rho.end(), density) - rho.begin() - 1;
  const int j = std::upper_bound(y.begin(), y.end(), e) - y.begin() - 1;
  cell.i = std::min(i, int(x.size()) - 2);
  cell.j = std::min(j, int(y.size()) - 2);
  const double here = log_density ? std::log(density) : density;
  cell.s = (here - x[cell.i]) / (x[cell.i + 1] - x[cell.i]);
  cell.t = (e - y[cell.j]) / (y[cell.j + 1] - y[cell.j]);
  return true;
}

/* ---------------------------------------------------------------------- */

void TableGrid::interpolate(const Cell &cell, double density, double &p, double &csq) const
{
  const int i = cell.i, j = cell.j;
  const double s = cell.s, t = cell.t, dx = x[i + 1] - x[i], dy = y[j + 1] - y[j];
  const Node &n00 = node(i, j), &n01 = node(i, j + 1);
  const Node &n10 = node(i + 1, j), &n11 = node(i + 1, j + 1);

  double px, py;
  if (bicubic) {
    const Cubic p0 = cubic(n00.p, n01.p, n00.py * dy, n01.py * dy, t);
    const Cubic p1 = cubic(n10.p, n11.p, n10.py * dy, n11.py * dy, t);
    const Cubic d0 = cubic(n00.px, n01.px, n00.pxy * dy, n01.pxy * dy, t);
    const Cubic d1 = cubic(n10.px, n11.px, n10.pxy * dy, n11.pxy * dy, t);
    const Cubic along = cubic(p0.f, p1.f, d0.f * dx, d1.f * dx, s);
    p = along.f;
    px = along.d / dx;
    py = cubic(p0.d, p1.d, d0.d * dx, d1.d * dx, s).f / dy;
  } else {
    const double p0 = n00.p + t * (n01.p - n00.p), p1 = n10.p + t * (n11.p - n10.p);
    p = p0 + s * (p1 - p0);
    px = (p1 - p0) / dx;
    py = ((1.0 - s) * (n01.p - n00.p) + s * (n11.p - n10.p)) / dy;
  }
  csq = (log_density ? px / density : px) + p / density / density * py;
}

/* ---------------------------------------------------------------------- */

bool TableGrid::state(double density, double e, double &p, double &csq) const
{
  Cell cell;
  if (!find(density, e, cell)) return false;
  interpolate(cell, density, p, csq);
  return true;
}

bool TableGrid::temperature(double density, double e, double &value) const
{
  Cell c;
  if (T.empty() || !find(density, e, c)) return false;
  const double *low = &T[c.i * y.size() + c.j], *high = low + y.size();
  const double T0 = low[0] + c.t * (low[1] - low[0]), T1 = high[0] + c.t * (high[1] - high[0]);
  value = T0 + c.s * (T1 - T0);
  return true;
}

/* ----------------------------------------------------------------------
   c^2 at 5 x 5 points of every cell, its corners among them.  In a bilinear
   cell c^2 is linear in e, so the two edges suffice.  0 is allowed, where
   pressure is constant, as in a table that cuts off tension.
------------------------------------------------------------------------- */

std::string TableGrid::check() const
{
  double lowest = 0.0, highest = 0.0;
  Cell worst = {0, 0, 0.0, 0.0};
  for (int i = 0; i + 1 < int(x.size()); i++)
    for (int j = 0; j + 1 < int(y.size()); j++)
      for (int k = 0; k <= 4; k++)
        for (int l = 0; l <= 4; l += bicubic ? 1 : 4) {
          const Cell cell = {i, j, 0.25 * k, 0.25 * l};
          const double here = x[i] + cell.s * (x[i + 1] - x[i]);
          double p, csq;
          interpolate(cell, log_density ? std::exp(here) : here, p, csq);
          if (!std::isfinite(csq))
            return text("no finite speed of sound between densities %g and %g, energies %g and %g",
                        rho[i], rho[i + 1], y[j], y[j + 1]);
          if (csq < lowest) {
            lowest = csq;
            worst = cell;
          }
          highest = std::max(highest, csq);
        }
  if (!(highest > 0.0)) return "pressure nowhere rises with density";
  if (lowest >= -1e-9 * highest) return "";
  return text("pressure falls with density at constant entropy (c^2 = %g) between densities %g and "
              "%g, energies %g and %g",
              lowest, rho[worst.i], rho[worst.i + 1], y[worst.j], y[worst.j + 1]);
}

/* ---------------------------------------------------------------------- */

std::unique_ptr<Eos> make_eos_table(const TableData &data, std::string &problem)
{
  problem.clear();
  const std::size_t nx = data.rho.size(), ny = data.e.size(), least = data.bicubic ? 4 : 2;
  if (nx < least || ny < least)
    problem = text("%zu densities and %zu energies are too few, %s needs %zu", nx, ny,
                   data.bicubic ? "bicubic" : "bilinear", least);
  else if (data.p.size() != nx * ny || (!data.T.empty() && data.T.size() != nx * ny))
    problem = text("has %zu pressures and %zu temperatures for %zu densities and %zu energies",
                   data.p.size(), data.T.size(), nx, ny);
  else
    problem = values_problem("densities", data.rho, true);
  if (problem.empty() && !(data.rho[0] > 0.0))
    problem = text("density %g must be > 0", data.rho[0]);
  if (problem.empty()) problem = values_problem("energies", data.e, true);
  if (problem.empty()) problem = values_problem("pressure", data.p, false);
  if (problem.empty()) problem = values_problem("temperature", data.T, false);
  if (!problem.empty()) return nullptr;

  const auto grid = std::make_shared<const TableGrid>(data);
  problem = grid->check();
  if (!problem.empty()) return nullptr;

  // e = 0 at the reference state is what all laws agree on

  double c0 = 0.0;
  if (data.rho0 > 0.0) {
    double p, csq;
    if (!grid->state(data.rho0, 0.0, p, csq))
      problem = text("the reference state, rho0 = %g and energy 0, is not in the table", data.rho0);
    else if (!(csq > 0.0) || !(std::fabs(p) <= 0.01 * data.rho0 * csq))
      problem = text("pressure %g of the reference state, rho0 = %g and energy 0, is not about 0",
                     p, data.rho0);
    if (!problem.empty()) return nullptr;
    c0 = std::sqrt(csq);
  }
  const double end = std::nextafter(data.rho.back(), NO_LIMIT);    // the last density is inside
  return std::make_unique<EosModel<EosTable>>(
      EosTable{grid->label.c_str(), data.rho0, c0, end, grid});
}

}    // namespace HVI
