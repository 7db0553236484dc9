/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing authors: the lammps-hvi developers
------------------------------------------------------------------------- */

#include "hvi_fem_coupling.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix_hvi_johnson_cook.h"
#include "fix_hvi_ledger.h"
#include "fix_hvi_sph.h"
#include "fix_hvi_store.h"
#include "force.h"
#include "group.h"
#include "hvi_compat.h"
#include "hvi_interface.h"
#include "modify.h"
#include "neigh_list.h"
#include "neighbor.h"
#include "pair.h"

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;
using HVI::CORNERS;

/* ---------------------------------------------------------------------- */

HVIFEMCoupling::HVIFEMCoupling(LAMMPS *lmp, FixHVIFEMMesh &mesh) : Pointers(lmp), mesh(mesh)
{
  const std::string name = std::string(mesh.id) + "_embedded";
  group_bit = group->bitmask[group->find_or_create(name.c_str())];
}

HVIFEMCoupling::~HVIFEMCoupling()
{
  unmark();
  if (FixHVIStore *const now = FixHVIStore::find(lmp)) now->embedded = 0;
}

/* ---------------------------------------------------------------------- */

void HVIFEMCoupling::init()
{
  store->embedded = group_bit;
  ledger = FixHVILedger::instance(lmp);
  make_groups();
  others = HVI::pair_styles(force).size() > 1 || force->bond || force->angle || force->dihedral ||
      force->improper || force->kspace;
}

/* ----------------------------------------------------------------------
   Lists leave out pairs of particles that are both embedded in elements of one body
------------------------------------------------------------------------- */

void HVIFEMCoupling::make_groups()
{
  std::vector<int> here(atom->ntypes + 1, 0), used(atom->ntypes + 1);
  for (const HVI::Element &one : mesh.elements)
    if (one.n > 0) here[one.type] = 1;
  MPI_Allreduce(here.data(), used.data(), used.size(), MPI_INT, MPI_MAX, world);
  inner.resize(atom->ntypes + 1, 0);
  for (int itype = 1; itype <= atom->ntypes; itype++) {
    if (!used[itype] || inner[itype]) continue;
    const std::string name = fmt::format("{}_inner_{}", mesh.id, itype);
    inner[itype] = group->bitmask[group->find_or_create(name.c_str())];
    neighbor->modify_params(fmt::format("exclude group {} {}", name, name));
  }
}

/* ----------------------------------------------------------------------
   Groups say which particles are embedded, and which of those lists leave out.  Not in restarts of
   other fixes, nor in data files.
------------------------------------------------------------------------- */

void HVIFEMCoupling::mark()
{
  struct Mark {
    std::int64_t type;
    double fingerprint;
  };
  std::vector<char> was_embedded(atom->nlocal);
  int here = 0, known;    // a data file has no groups
  for (int i = 0; i < atom->nlocal; i++) here |= was_embedded[i] = is_embedded(i);
  MPI_Allreduce(&here, &known, 1, MPI_INT, MPI_MAX, world);
  unmark();
  mesh.of_embedded.scatter(
      [this](int k) {
        const HVI::Element &one = mesh.element_of(k);
        return Mark{one.type, one.fingerprint};
      },
      [&](int i, const Mark &mark) {
        if (atom->type[i] != mark.type)
          error->one(FLERR,
                     "Fix hvi/fem: particle {} in an element of type {} has type {}: have IDs "
                     "changed? Use delete_atoms with compress no",
                     atom->tag[i], mark.type, atom->type[i]);
        if (is_embedded(i))
          error->one(FLERR, "Fix hvi/fem: particle {} is in two elements", atom->tag[i]);
        if (mark.fingerprint > 0.0 && known && !was_embedded[i])
          mesh.ids_have_changed(atom->tag[i]);
        check_group(i);
        atom->mask[i] |= group_bit | inner[mark.type];
      });
}

void HVIFEMCoupling::unmark()
{
  int bits = group_bit;
  for (const int bit : inner) bits |= bit;
  for (int i = 0; i < atom->nlocal; i++) atom->mask[i] &= ~bits;
}

void HVIFEMCoupling::check_group(int i) const
{
  if (!(atom->mask[i] & integrator->groupbit))
    error->one(FLERR,
               "Fix hvi/fem: {} {} is not in the group of fix hvi/sph, which moves all nodes, and "
               "particles when their elements fail",
               mesh.nodal(i) ? "node" : "particle", atom->tag[i]);
}

/* ----------------------------------------------------------------------
   Forces of fixes come after those of elements have gone to nodes.  What acts on nodes, of a body as gravity
   say, is all that there is; what acts on particles in them only would be lost.
------------------------------------------------------------------------- */

void HVIFEMCoupling::check_fixes()
{
  const auto mask = [this](int i) {
    return (std::int64_t) atom->mask[i];
  };
  const auto of_nodes = mesh.of_nodes.gather(mask), of_embedded = mesh.of_embedded.gather(mask);
  int here = 0, lost;    // groups that have embedded particles, and none of their nodes
  for (std::size_t k = 0; k < of_embedded.size(); k++) {
    std::int64_t groups = of_embedded[k];
    for (int a = 0; a < CORNERS; a++) groups &= ~of_nodes[mesh.number(mesh.embedded[k].element, a)];
    here |= groups;
  }
  MPI_Allreduce(&here, &lost, 1, MPI_INT, MPI_BOR, world);
  for (int n = 0; n < modify->nfix; n++) {
    const Fix *const other = modify->fix[n];
    if ((modify->fmask[n] & FixConst::POST_FORCE) && (lost & other->groupbit))
      error->all(FLERR,
                 "Fix hvi/fem: what fix {} ({}) does to particles in elements would be lost: fixes "
                 "act on elements by their nodes, which its group {} must have, too",
                 other->id, other->style, group->names[other->igroup]);
  }
}

/* ----------------------------------------------------------------------
   has a command moved embedded particles, or their nodes without them?
------------------------------------------------------------------------- */

bool HVIFEMCoupling::strayed()
{
  bool found = false;
  mesh.of_embedded.gather(
      [this](int i) {
        const double *const x = atom->x[i], *const v = atom->v[i];
        return HVI::Motion{{x[0], x[1], x[2]}, {v[0], v[1], v[2]}, {}};
      },
      [&](int k, const HVI::Motion &now) {
        const HVI::Motion there = mesh.motion(k);
        double way[3], speed = 0.0;
        for (int d = 0; d < 3; d++) {
          way[d] = there.x[d] - now.x[d];
          for (const HVI::Node *const node : mesh.nodes_of(mesh.embedded[k].element))
            speed = std::max(speed, std::fabs(node->v[d]));
        }
        HVI::minimum_image(domain, way[0], way[1], way[2]);
        const double size = std::cbrt(mesh.element_of(k).V);
        for (int d = 0; d < 3; d++)
          found = found || std::fabs(way[d]) > 1.0e-9 * size ||
              std::fabs(there.v[d] - now.v[d]) > 1.0e-9 * speed;
      });
  return found;
}

/* ----------------------------------------------------------------------
   An element has pairs if something in lists acts on its particles, that is, what is free, or of another
   body; only then these have sums and forces, others are idle.  So there are new lists whenever elements
   fail: those beside them are to have pairs.
------------------------------------------------------------------------- */

void HVIFEMCoupling::find_pairs()
{
  HVI::SphFields &fields = store->fields;
  const int nall = atom->nlocal + atom->nghost;
  fields.embedded.assign(nall, 0);
  fields.idle.assign(nall, 0);
  for (int i = 0; i < nall; i++)
    if (is_embedded(i)) fields.embedded[i] = atom->type[i];

  mesh.width = 1;
  mesh.halo.assign(nall, 0.0);
  const NeighList *const list = force->pair_match("^hvi/sph$", 0)->list;
  for (int ii = 0; ii < list->inum; ii++) {
    const int i = list->ilist[ii], itype = fields.embedded[i];
    for (int jj = 0; jj < list->numneigh[i]; jj++) {
      const int j = list->firstneigh[i][jj] & NEIGHMASK, jtype = fields.embedded[j];
      if (itype && itype == jtype) continue;
      if (itype) mesh.halo[i] = 1.0;
      if (jtype) mesh.halo[j] = 1.0;
    }
  }
  if (force->newton_pair) comm->reverse_comm(&mesh, mesh.width);
  std::vector<double> paired = mesh.of_embedded.gather([this](int i) {
    return mesh.halo[i];
  });
  for (std::size_t k = 0; k < paired.size(); k++)
    if (paired[k] > 0.0) mesh.step_of(k).paired = true;
  for (std::size_t k = 0; k < paired.size(); k++) paired[k] = mesh.step_of(k).paired;
  for (std::size_t e = 0; e < mesh.elements.size(); e++)
    if (!mesh.steps[e].paired) forget(mesh.elements[e]);

  mesh.of_paired.select(mesh.of_embedded, paired);
  mesh.halo.assign(nall, 0.0);
  mesh.of_embedded.scatter(paired, [this](int i, double acted) {
    mesh.halo[i] = acted == 0.0;
  });
  comm->forward_comm(&mesh, mesh.width);
  fields.idle.assign(mesh.halo.begin(), mesh.halo.end());
}

/* ----------------------------------------------------------------------
   To their places, with velocity and what pairs and lists see of density and energy.  A particle whose element is no
   more keeps all that.
------------------------------------------------------------------------- */

void HVIFEMCoupling::place()
{
  struct Placed : HVI::Motion {
    double rho, esph, change;    // the last: of energy in half a step
    double free;
  };
  mesh.of_embedded.scatter(
      [this](int k) {
        const HVI::Element &one = mesh.element_of(k);
        return Placed{mesh.motion(k), one.rho, one.ahead * one.mass / one.particles(),
                      one.change * one.mass / one.particles(), (double) !one.alive()};
      },
      [this](int i, const Placed &now) {
        double *const x = atom->x[i];
        double way[3] = {now.x[0] - x[0], now.x[1] - x[1], now.x[2] - x[2]};
        if (mesh.wraps) HVI::minimum_image(domain, way[0], way[1], way[2]);
        for (int k = 0; k < 3; k++) {
          x[k] += way[k];
          atom->v[i][k] = atom->vest[i][k] = now.v[k];
        }
        atom->rho[i] = now.rho;
        atom->esph[i] = now.esph;
        integrator->set_work_velocity(i, now.predicted);
        if (now.free == 0.0) return;

        // this rank may have no element itself

        atom->mask[i] &= ~(group_bit | inner[atom->type[i]]);
        integrator->let_go(i, now.change);
        ledger->hand_over(i, atom->rmass[i]);
        if (i < (int) store->fields.embedded.size()) store->fields.embedded[i] = 0;
      });
}

/* ---------------------------------------------------------------------- */

void HVIFEMCoupling::gather_sums()
{
  using HVI::PairSums;
  for (HVI::ElementStep &step : mesh.steps)
    if (step.paired) step.sums = {};
  const HVI::SphView &records = store->fields.view();
  mesh.of_paired.gather(
      [&](int i) {
        PairSums sums = {};
        const HVI::VelocityGradient L = records.gradv[i].gradient();
        const HVI::Symmetric M = records.gradv[i].middle_moment();
        std::copy_n(&L.xx, 9, sums.L);
        std::copy_n(&M.xx, 6, sums.M);
        if (!records.touching || !records.touching->has(i)) return sums;
        const HVI::SphGradV &contact = records.touching->of(i).sums;
        sums.trace_L_of_others = contact.xx + contact.yy + contact.zz;
        const HVI::Symmetric M_of_others = contact.middle_moment();
        std::copy_n(&M_of_others.xx, 6, sums.M_of_others);
        return sums;
      },
      [this](int k, const PairSums &of_particle) {
        const double share = 1.0 / mesh.element_of(k).particles();
        PairSums &sums = mesh.step_of(k).sums;
        for (int n = 0; n < 9; n++) sums.L[n] += share * of_particle.L[n];
        for (int n = 0; n < 6; n++) sums.M[n] += share * of_particle.M[n];
        sums.trace_L_of_others += share * of_particle.trace_L_of_others;
        for (int n = 0; n < 6; n++) sums.M_of_others[n] += share * of_particle.M_of_others[n];
      });
}

/* ---------------------------------------------------------------------- */

void HVIFEMCoupling::show_all()
{
  mesh.of_embedded.scatter(
      [this](int k) {
        return mesh.element_of(k).solid;
      },
      [this](int i, const HVI::SolidState &solid) {
        strength->embed(i, solid);
      });
}

// and what tractions of pairs need

void HVIFEMCoupling::show()
{
  struct Shown {
    HVI::SolidState solid;
    double rho, p;
    HVI::VelocityGradient L;
  };
  const HVI::SphView &records = store->fields.view();
  mesh.of_paired.scatter(
      [this](int k) {
        const HVI::ElementStep &step = mesh.step_of(k);
        Shown now = {mesh.element_of(k).solid, mesh.element_of(k).rho, step.p, {}};
        std::copy_n(step.L, 9, &now.L.xx);
        return now;
      },
      [&](int i, const Shown &now) {
        strength->embed(i, now.solid);
        records.traction[i].rho = now.rho;
        records.traction[i].p = now.p;
        records.gradv[i].set_gradient(now.L);
      });
}

/* ----------------------------------------------------------------------
   of particles, as output sees them, at the end of the step: velocity, with that of nodes; density and energy beside those
   of the forces, from which a run goes on
------------------------------------------------------------------------- */

void HVIFEMCoupling::show_end()
{
  struct End : HVI::Motion {
    Shown shown;
  };
  at_end.assign(atom->nlocal, {0.0, 0.0, 0});
  mesh.of_embedded.scatter(
      [this](int k) {
        const HVI::Element &one = mesh.element_of(k);
        return End{mesh.motion(k), {one.rho, (one.e - one.kick) * one.mass / one.particles(), 0}};
      },
      [this](int i, const End &now) {
        std::copy_n(now.v, 3, atom->v[i]);
        if (i < (int) at_end.size()) at_end[i] = {now.shown.rho, now.shown.esph, atom->tag[i]};
      });
}

bool HVIFEMCoupling::is_shown(int i, double &rho, double &esph) const
{
  if (i >= (int) at_end.size() || at_end[i].tag != atom->tag[i])
    return false;    // commands may have moved it
  rho = at_end[i].rho;
  esph = at_end[i].esph;
  return true;
}

/* ----------------------------------------------------------------------
   What pairs did to embedded particles: force f, to nodes with the weights N_a; energy de, and f.w with the velocity w
   that they saw; and the part of the stress that they carry in place of the element,

     K = < - sum_j w_j (sigma_p grad W) (x) x_pj > = < sigma_p M >

   with sigma_p as pairs had it: under contact only what pushes.  Weights N_a sum up to an eighth of the
   particles for each node, so masses go the same way, and momentum is exact.
------------------------------------------------------------------------- */

void HVIFEMCoupling::gather_forces()
{
  struct Acted {
    double f[3], power, K[9];
  };
  for (std::size_t e = 0; e < mesh.elements.size(); e++) {
    if (!mesh.steps[e].paired && !others) continue;
    forget(mesh.elements[e]);
    std::fill_n(mesh.steps[e].K, 9, 0.0);
  }
  const HVI::SphView &records = store->fields.view();
  mesh.of_paired.gather(
      [&](int i) {
        const HVI::SphRates &rates = records.rates[i];
        const HVI::SphTraction &T = records.traction[i];
        const HVI::SphGradV &g = records.gradv[i];
        Acted now = {{rates.fx, rates.fy, rates.fz},
                     rates.de() + rates.fx * T.vx + rates.fy * T.vy + rates.fz * T.vz,
                     {}};
        const double factor = records.state[i].w / T.volume;
        const HVI::VelocityGradient rows = T.by_rows();
        const double m[9] = {g.mxx, g.mxy, g.mxz, g.mxy, g.myy, g.myz, g.mxz, g.myz, g.mzz};
        for (int k = 0; k < 9; k++) {
          const double *const t = &rows.xx + 3 * (k / 3);
          now.K[k] = factor * (t[0] * m[k % 3] + t[1] * m[3 + k % 3] + t[2] * m[6 + k % 3]);
        }
        if (!records.touching || !records.touching->has(i)) return now;
        const HVI::SphGradV &c = records.touching->of(i).sums;
        const double mc[9] = {c.mxx, c.mxy, c.mxz, c.mxy, c.myy, c.myz, c.mxz, c.myz, c.mzz};
        for (int k = 0; k < 9; k++) now.K[k] -= records.touching->of(i).push.p * mc[k];
        return now;
      },
      [this](int k, const Acted &now) {
        HVI::Element &one = mesh.element_of(k);
        HVI::ElementStep &step = mesh.step_of(k);
        const HVI::Weights &N = mesh.weights(k);
        const double share = 1.0 / one.particles();
        one.pair_power += now.power;
        for (int n = 0; n < 9; n++) step.K[n] += share * now.K[n];
        for (int a = 0; a < CORNERS; a++)
          for (int d = 0; d < 3; d++) one.pair_force[a][d] += N[a] * now.f[d];
      });
}

void HVIFEMCoupling::forget(HVI::Element &one)
{
  one.pair_power = 0.0;
  std::fill_n(one.pair_force[0], 3 * CORNERS, 0.0);
}

/* ----------------------------------------------------------------------
   What other styles did to embedded particles: all of their forces but those of pair hvi/sph, to nodes with the weights
   N_a, so they work on particles and nodes alike, and their energy is where these styles have it; and heat, to
   elements.  Sums over ghosts are done here, as the forces of nodes must be complete before fixes see them.
   None is left on embedded particles.
------------------------------------------------------------------------- */

void HVIFEMCoupling::take_forces(std::vector<std::array<double, 3>> &node_forces)
{
  typedef std::array<double, 4> Taken;    // force, heat
  const HVI::SphFields &fields = store->fields;
  double *const *const f = atom->f;
  std::vector<double> &halo = mesh.halo;
  halo.clear();
  for (int i = 0; i < atom->nlocal + atom->nghost; i++) {
    const bool is_embedded = fields.embedded[i];
    if (others && is_embedded) halo.insert(halo.end(), {f[i][0], f[i][1], f[i][2], atom->desph[i]});
    if (others && !is_embedded) halo.insert(halo.end(), 4, 0.0);
    if (is_embedded) f[i][0] = f[i][1] = f[i][2] = 0.0;
  }
  if (!others) return;
  mesh.width = 4;
  if (force->newton) comm->reverse_comm(&mesh, mesh.width);
  mesh.of_embedded.gather(
      [&](int i) {
        Taken now = {halo[4 * i], halo[4 * i + 1], halo[4 * i + 2], halo[4 * i + 3]};
        if (fields.is_idle(i)) return now;
        const HVI::SphRates &rates = fields.view().rates[i];
        now[0] -= rates.fx;
        now[1] -= rates.fy;
        now[2] -= rates.fz;
        if (fields.settings.energy) now[3] -= rates.de();
        return now;
      },
      [&](int k, const Taken &now) {
        mesh.element_of(k).pair_power += now[3];
        for (int a = 0; a < CORNERS; a++)
          for (int d = 0; d < 3; d++)
            node_forces[mesh.number(mesh.embedded[k].element, a)][d] += mesh.weights(k)[a] * now[d];
      });
}

/* ----------------------------------------------------------------------
   Nodes of elements that are no more lose their part of the mass.  Those that have none left are taken out when
   lists are made: until then not with a mass of 0, for others divide by it.
------------------------------------------------------------------------- */

void HVIFEMCoupling::take_masses()
{
  struct Lost {
    double mass, elements;
  };
  std::vector<Lost> lost(mesh.nodes.size(), Lost{0.0, 0.0});
  for (std::size_t e = 0; e < mesh.elements.size(); e++) {
    if (mesh.elements[e].alive()) continue;
    for (int a = 0; a < CORNERS; a++) {
      lost[mesh.number(e, a)].mass += mesh.elements[e].mass / CORNERS;
      lost[mesh.number(e, a)].elements += 1.0;
    }
  }
  mesh.of_nodes.scatter(lost, [this](int i, const Lost &gone) {
    if (gone.elements == 0.0) return;
    mesh.valence[i] -= gone.elements;
    ledger->hand_over(i, -gone.mass);
    if (mesh.valence[i] > 0) {
      atom->rmass[i] -= gone.mass;
      return;
    }
    atom->rmass[i] *= 1.0e-30;
    for (int k = 0; k < 3; k++) atom->v[i][k] = atom->vest[i][k] = 0.0;
  });
}
