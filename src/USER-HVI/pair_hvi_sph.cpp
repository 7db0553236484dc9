/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing authors: the lammps-hvi developers
------------------------------------------------------------------------- */

#include "pair_hvi_sph.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix_hvi_johnson_cook.h"
#include "fix_hvi_ledger.h"
#include "fix_hvi_sph.h"
#include "force.h"
#include "hvi_kernel.h"
#include "math_special.h"
#include "memory.h"
#include "modify.h"
#include "neigh_list.h"
#include "neighbor.h"
#include "update.h"

#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;

static constexpr double BIG = 1.0e100;

/* ---------------------------------------------------------------------- */

PairHVISPH::PairHVISPH(LAMMPS *lmp) :
    Pair(lmp), support(0.0), laws(), variable(false), energy(true), density(false), riemann(false),
    hmin(0.5), hmax(1.25), visc_a(nullptr), visc_b(nullptr), tension(nullptr), nmax(0),
    heating(0.0), fix(nullptr), sweep(nullptr)
{
  if (!atom->esph_flag || !atom->rho_flag || !atom->vest_flag)
    error->all(FLERR,
               "Pair style hvi/sph needs density, energy and velocity estimates of particles: "
               "use atom_style sph");
  respa_enable = 0;
  single_enable = 0;
}

/* ---------------------------------------------------------------------- */

PairHVISPH::~PairHVISPH()
{
  if (copymode) return;
  deallocate();
}

/* ---------------------------------------------------------------------- */

PairHVISPH *PairHVISPH::find(LAMMPS *lmp)
{
  return dynamic_cast<PairHVISPH *>(lmp->force->pair_match("^hvi/sph", 0));
}

/* ----------------------------------------------------------------------
   Zisis et al. eq 20, dh/dt = -(1/D) (h/rho) drho/dt, integrates to
   h rho^(1/D) = const: only the constant is stored, and sent with new ghosts
------------------------------------------------------------------------- */

double PairHVISPH::hscale(int itype, double rho) const
{
  return htype[itype] * std::pow(rho, 1.0 / laws.dim);
}

double PairHVISPH::smoothing_length(int itype, double rho, double scale) const
{
  if (!variable) return htype[itype];
  const double root = laws.dim == 3 ? std::cbrt(rho) : (laws.dim == 2 ? std::sqrt(rho) : rho);
  const double h = scale / root;
  return MAX(hmin * htype[itype], MIN(h, hmax * htype[itype]));
}

/* ---------------------------------------------------------------------- */

void PairHVISPH::compute(int eflag, int vflag)
{
  ev_init(eflag, vflag);

  if (mirror.planes) find_images();
  const int need = MAX(atom->nmax, images.first + (int) images.all.size());
  if (need > nmax) {
    nmax = mirror.planes ? need + need / 16 : need;
    place.reset(new HVI::SphPlace[nmax]);
    state.reset(new HVI::SphState[nmax]);
    rates.reset(new HVI::SphRates[nmax]);
    if (riemann) slopes.reset(new HVI::SphSlopes[nmax]);
    stress.reset(solid ? new HVI::SphStress[nmax] : nullptr);    // a fix may come and go
    gradv.reset(solid ? new HVI::SphGradV[nmax] : nullptr);
    art.reset(laws.art_eps > 0.0 ? new HVI::SphStress[nmax] : nullptr);
  }

  if (solid) gather_stress();
  gather();
  if (art) artificial_stress();
  if (mirror.planes) fill_images();
  (this->*sweep)();
  if (mirror.planes) fold_images();
  scatter();
  if (solid && force->newton_pair) {
    sending = STRESS;
    comm->reverse_comm(this);
  }

  if (vflag_fdotr) virial_fdotr_compute();
}

/* ----------------------------------------------------------------------
   one sweep over the half list, in two passes over the neighbors of a
   particle: squeeze out those beyond reach without a branch, then work out the
   pairs in vectors, which also adds what happens to the neighbors to their records.
   What is left of the list can be kept for a second sweep in the same step.
------------------------------------------------------------------------- */

template <class Kernel, int SCENE, int SWEEP, class Record, class Work>
void PairHVISPH::each_particle(Record *records, Work work)
{
  const int inum = list->inum;
  const int *const ilist = list->ilist;
  const int *const numneigh = list->numneigh;
  const int *const *const firstneigh = list->firstneigh;
  HVI::SphPlace *const where = place.get();

  HVI::SphLaws mine = laws;
  HVI::SphNear near;
  const double reachsq = Kernel::support * Kernel::support * laws.h * laws.h;
  const bool mirrored = mirror.planes;
  bigint nkept = 0;
  if (SWEEP == FIRST) keep_lists();

  for (int ii = 0; ii < inum; ii++) {
    const int i = ilist[ii];
    HVI::SphPlace pi = where[i];
    const int *const jlist = SWEEP == SECOND ? &kept[nkept] : firstneigh[i];
    const int jnum = SWEEP == SECOND ? numkept[ii] : numneigh[i];
    if (SWEEP == FIRST) numkept[ii] = 0;
    Record sum = {};

    if (SCENE & HVI::SPH_BODIES) {
      mine.row_a = visc_a[atom->type[i]];
      mine.row_b = visc_b[atom->type[i]];
      mine.row_tension = tension[atom->type[i]];
    }

    auto visit = [&](const int *jvisit, int number) {
      for (int jfirst = 0; jfirst < number; jfirst += HVI::SphNear::MAX) {
        const int jlast = MIN(jfirst + HVI::SphNear::MAX, number);
        int n = 0;
        for (int jj = jfirst; jj < jlast; jj++) {
          const int j = jvisit[jj] & NEIGHMASK;
          const HVI::Vec4 d = HVI::part(&pi, 0) - HVI::part(&where[j], 0);
          __builtin_prefetch(&state[j]);
          if (!(SCENE & HVI::SPH_STRENGTH)) __builtin_prefetch(&records[j], 1);
          near.j[n] = j;
          near.d[n] = d;
          if (SWEEP == SECOND) {
            __builtin_prefetch(&slopes[j]);
            __builtin_prefetch(&slopes[j].pz);
            n++;
            continue;
          }
          const HVI::Vec4 square = d * d;
          const double rsq = square[0] + square[2] + square[1];
          if (SCENE & HVI::SPH_OWN_H) {
            const double h = SCENE & HVI::SPH_RIEMANN ? MAX(pi.h, pi.h - d[3]) : pi.h - 0.5 * d[3];
            n += rsq < Kernel::support * Kernel::support * h * h;
          } else
            n += rsq < reachsq;
        }
        if (SWEEP == FIRST) {
          memcpy(&kept[nkept], near.j, n * sizeof(int));
          numkept[ii] += n;
        }
        if (SWEEP != ONLY) nkept += n;
        work(i, pi, n, mine, near, sum);
      }
    };
    visit(jlist, jnum);
    if (mirrored) {
      const std::vector<int> &also = images_near(i, jlist, jnum);
      if (!also.empty()) visit(also.data(), also.size());
    }
    for (int k = 0; k < (int) (sizeof(Record) / sizeof(HVI::Vec4)); k++)
      HVI::part(&records[i], k) += HVI::part(&sum, k);
  }
}

/* ---------------------------------------------------------------------- */

void PairHVISPH::keep_lists()
{
  bigint most = 0;
  for (int ii = 0; ii < list->inum; ii++) most += list->numneigh[list->ilist[ii]];
  if ((std::size_t) most > kept.size()) kept.resize(1.1 * most);
  if ((std::size_t) list->inum > numkept.size()) numkept.resize(atom->nmax);
}

/* ---------------------------------------------------------------------- */

template <class Kernel, int SCENE> void PairHVISPH::eval()
{
  const int nlocal = atom->nlocal;
  const int newton_pair = force->newton_pair;

  if (SCENE & HVI::SPH_RIEMANN) eval_slopes<Kernel, SCENE>();

  each_particle<Kernel, SCENE, SCENE & HVI::SPH_RIEMANN ? SECOND : ONLY>(
      rates.get(),
      [&](int i, const HVI::SphPlace &pi, int n, const HVI::SphLaws &mine, HVI::SphNear &near,
          HVI::SphRates &sum) {
        bool same;
        if constexpr ((SCENE & HVI::SPH_RIEMANN) != 0)
          same = HVI::sph_riemann<Kernel, SCENE>(i, pi, state.get(), slopes.get(), n, mine, near,
                                                 rates.get(), sum);
        else
          same = HVI::sph_interact<Kernel, SCENE>(i, pi, state.get(), n, mine, near, rates.get(),
                                                  sum, stress.get(), gradv.get(), art.get());
        if (same) report_overlap(i, n, near);

        if (evflag && n && near.j[0] >= nlocal + atom->nghost)
          for (int m = 0; m < n; m++) {
            const double d[3] = {near.d[m][0], near.d[m][1], near.d[m][2]};
            double f[3] = {near.fx[m], near.fy[m], near.fz[m]};
            if (!(SCENE & HVI::SPH_STRENGTH))
              for (int k = 0; k < 3; k++) f[k] = near.force[m] * d[k];
            tally_image(i, near.j[m], f, d);
          }
        else if (evflag && (SCENE & HVI::SPH_STRENGTH))
          for (int m = 0; m < n; m++)
            ev_tally_xyz(i, near.j[m], nlocal, newton_pair, 0.0, 0.0, near.fx[m], near.fy[m],
                         near.fz[m], near.d[m][0], near.d[m][1], near.d[m][2]);
        else if (evflag)
          for (int m = 0; m < n; m++)
            ev_tally(i, near.j[m], nlocal, newton_pair, 0.0, 0.0, near.force[m], near.d[m][0],
                     near.d[m][1], near.d[m][2]);
      });
}

/* ----------------------------------------------------------------------
   gradients of owned particles, then of ghosts
------------------------------------------------------------------------- */

template <class Kernel, int SCENE> void PairHVISPH::eval_slopes()
{
  if constexpr ((SCENE & HVI::SPH_RIEMANN) != 0) {
    memset((void *) slopes.get(), 0, (atom->nlocal + atom->nghost) * sizeof(HVI::SphSlopes));
    each_particle<Kernel, SCENE, FIRST>(
        slopes.get(),
        [&](int i, const HVI::SphPlace &pi, int n, const HVI::SphLaws &mine, HVI::SphNear &near,
            HVI::SphSlopes &sum) {
          HVI::sph_slopes<Kernel, SCENE>(i, pi, state.get(), n, mine, near, slopes.get(), sum);
        });
    sending = SLOPES;
    if (force->newton_pair) comm->reverse_comm(this);

    // Omega is 1 where h stays as it is, and far from 1 only for particles nearly alone: bounded

    for (int i = 0; i < atom->nlocal; i++) {
      if (!materials[atom->type[i]]) continue;
      const double start = htype[atom->type[i]], h = place[i].h;
      const double W0 = Kernel::w(0.0) * laws.norm / MathSpecial::powint(h, laws.dim);
      const double n = slopes[i].volume + W0;
      const bool follows = variable && h > hmin * start && h < hmax * start;
      const double omega = follows ? 1.0 + (slopes[i].omega / laws.dim - W0) / n : 1.0;
      slopes[i].omega = 1.0 / MAX(omega, 0.25);
      slopes[i].volume = slopes[i].omega / n;
    }
    comm->forward_comm(this);
  }
}

/* ---------------------------------------------------------------------- */

void PairHVISPH::report_overlap(int i, int n, const HVI::SphNear &near)
{
  for (int m = 0; m < n; m++)
    if (near.d[m][0] == 0.0 && near.d[m][1] == 0.0 && near.d[m][2] == 0.0)
      error->one(FLERR, "Pair hvi/sph: particles {} and {} are at the same place at step {}",
                 atom->tag[i], tag_of(near.j[m]), update->ntimestep);
}

/* ---------------------------------------------------------------------- */

void PairHVISPH::init_style()
{
  if (utils::strmatch(update->integrate_style, "^respa"))
    error->all(FLERR, "Pair style hvi/sph does not support run_style respa");
  if (update->whichflag == 2)
    error->all(FLERR, "Pair style hvi/sph does not support minimization: it has no energy");
  if (!atom->tag_enable) error->all(FLERR, "Pair style hvi/sph needs particles with IDs");
  if (force->mvv2e != 1.0 || force->ftm2v != 1.0)
    error->all(FLERR,
               "Pair style hvi/sph needs units in which force = mass * acceleration: "
               "si, cgs, micro, nano or lj");
  const bool hybrid = utils::strmatch(force->pair_style, "^hybrid");
  if (hybrid && find(lmp) != this) error->all(FLERR, "More than one pair style hvi/sph");

  FixHVILedger::instance(lmp);    // fix hvi/sph cannot make it: a fix must not add fixes
  auto fixes = modify->get_fix_by_style("^hvi/sph$");
  fix = fixes.empty() ? nullptr : dynamic_cast<FixHVISPH *>(fixes[0]);
  if (variable && !fix)
    error->all(FLERR, "Pair style hvi/sph h variable needs fix hvi/sph, which keeps h");
  if (fixes.empty() && modify->get_fix_by_style("^sph").empty() &&
      modify->get_fix_by_style("meso").empty() && comm->me == 0)
    error->warning(FLERR,
                   "Pair style hvi/sph: no fix integrates density and energy and estimates "
                   "velocities, as fix hvi/sph does");

  for (int i = 1; i <= atom->ntypes; i++) {
    if (!materials[i]) {
      if (hybrid) continue;
      error->all(FLERR, "Pair style hvi/sph: type {} has no material", i);
    }
    if (laws.stock) {
      const std::string eos = materials[i]->eos->name();
      if (eos != "tait" && eos != "idealgas")
        error->all(FLERR, "Pair style hvi/sph stock yes knows eos tait and idealgas only, not {}",
                   eos);
    }
  }

  check_mirror();
  auto laws_of_solids = modify->get_fix_by_style("^hvi/johnson-cook$");
  strength = laws_of_solids.empty() ? nullptr
                                    : dynamic_cast<FixHVIJohnsonCook *>(laws_of_solids[0]);
  solid = strength != nullptr;
  if (solid && (riemann || laws.symmetric))
    error->all(FLERR,
               "Pair style hvi/sph: fix hvi/johnson-cook works with form sum and dissipation "
               "monaghan");
  if (laws.art_eps > 0.0 && !solid)
    error->all(FLERR,
               "Pair style hvi/sph artstress needs fix hvi/johnson-cook, which keeps the stress");
  if (solid && !stress) nmax = 0;    // arrays are to be made
  int scene = riemann ? HVI::SPH_RIEMANN : (density ? HVI::SPH_DENSITY : 0);
  if (solid) scene |= HVI::SPH_STRENGTH;
  if (laws.art_eps > 0.0) scene |= HVI::SPH_ARTSTRESS | HVI::SPH_OWN_H;
  int first = 0;
  if (variable) scene |= HVI::SPH_OWN_H;
  for (int i = 1; i <= atom->ntypes; i++) {
    if (!materials[i]) continue;
    if (!first) first = i;
    if (htype[i] != htype[first]) scene |= HVI::SPH_OWN_H;
    for (int j = 1; j <= atom->ntypes; j++)
      if (materials[j] &&
          (tension[i][j] == 0.0 || visc_a[i][j] != visc_a[first][first] ||
           visc_b[i][j] != visc_b[first][first]))
        scene |= HVI::SPH_BODIES;
  }
  if (first) {
    laws.h = htype[first];
    laws.a = visc_a[first][first];
    laws.b = visc_b[first][first];
  }
  HVI::with_kernel(kernel, [&](auto k) {
    choose_scene<decltype(k)>(scene);
  });

  comm_forward = solid ? HVI::SphStress::SENT : (riemann ? HVI::SphSlopes::SENT : 0);
  comm_reverse = solid ? HVI::SphGradV::SENT : (riemann ? HVI::SphSlopes::SENT : 0);
  neighbor->add_request(this);
}

/* ---------------------------------------------------------------------- */

// bits that exclude each other make no scene; artificial stress comes with pairs' own h, for fewer of them

static constexpr bool is_scene(int s)
{
  const bool density = s & HVI::SPH_DENSITY, riemann = s & HVI::SPH_RIEMANN;
  const bool strength = s & HVI::SPH_STRENGTH, art = s & HVI::SPH_ARTSTRESS;
  return !(riemann && (density || strength)) && !(art && !(strength && (s & HVI::SPH_OWN_H)));
}

template <class Kernel, int SCENE> void PairHVISPH::choose_scene(int scene)
{
  if constexpr (SCENE < HVI::SPH_NSCENES) {
    if constexpr (is_scene(SCENE))
      if (scene == SCENE) sweep = &PairHVISPH::eval<Kernel, SCENE>;
    choose_scene<Kernel, SCENE + 1>(scene);
  }
}

/* ----------------------------------------------------------------------
   the list reaches as far as the largest h, so that it stays valid while h changes
------------------------------------------------------------------------- */

double PairHVISPH::init_one(int i, int j)
{
  for (const int itype : {i, j})
    if (!materials[itype]) error->all(FLERR, "Pair style hvi/sph: type {} has no material", itype);
  const double h = riemann ? MAX(htype[i], htype[j]) : 0.5 * (htype[i] + htype[j]);
  return support * (variable ? hmax : 1.0) * h;
}

/* ----------------------------------------------------------------------
   a row of particles must not see its own images across it
------------------------------------------------------------------------- */

void PairHVISPH::setup()
{
  check_sides();
  if (laws.dim == domain->dimension) return;

  double mine[6], all[6];
  for (int k = 0; k < 6; k++) mine[k] = -BIG;
  for (int i = 0; i < atom->nlocal; i++)
    for (int k = 0; k < 3 && materials[atom->type[i]]; k++) {
      mine[k] = MAX(mine[k], atom->x[i][k]);
      mine[3 + k] = MAX(mine[3 + k], -atom->x[i][k]);
    }
  MPI_Allreduce(mine, all, 6, MPI_DOUBLE, MPI_MAX, world);

  int extended = 0;
  double cutmax = 0.0;
  for (int i = 1; i <= atom->ntypes; i++)
    if (materials[i]) cutmax = MAX(cutmax, sqrt(cutsq[i][i]));
  for (int k = 0; k < domain->dimension; k++) {
    if (all[k] + all[3 + k] > 1.0e-9 * cutmax)
      extended++;
    else if (domain->periodicity[k] && domain->prd[k] < cutmax)
      error->all(FLERR,
                 "Pair hvi/sph dim {}: the box is only {} long along {}, particles would interact "
                 "with their images beyond the reach of {}",
                 laws.dim, domain->prd[k], "xyz"[k], cutmax);
  }
  if (extended > laws.dim)
    error->all(FLERR, "Pair hvi/sph dim {}: particles extend along {} directions", laws.dim,
               extended);
}

/* ---------------------------------------------------------------------- */

double PairHVISPH::memory_usage()
{
  return (double) nmax *
      (sizeof(HVI::SphPlace) + sizeof(HVI::SphState) + sizeof(HVI::SphRates) +
       (riemann ? sizeof(HVI::SphSlopes) : 0) +
       (solid ? sizeof(HVI::SphStress) + sizeof(HVI::SphGradV) : 0) +
       (art ? sizeof(HVI::SphStress) : 0)) +
      (double) (kept.capacity() + numkept.capacity()) * sizeof(int);
}
