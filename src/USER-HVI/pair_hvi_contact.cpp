/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing authors: the lammps-hvi developers
------------------------------------------------------------------------- */

#include "pair_hvi_contact.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "fix_hvi_lists.h"
#include "force.h"
#include "hvi_anew.h"
#include "hvi_cite.h"
#include "hvi_interface.h"
#include "hvi_restart.h"
#include "memory.h"
#include "neigh_list.h"
#include "neighbor.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

using namespace LAMMPS_NS;

static constexpr double DEEP = 0.25;    // of r_eq^2
static constexpr int RESTART_FORMAT = 1;
static constexpr char WHOSE[] = "Pair hvi/contact";

/* ---------------------------------------------------------------------- */

PairHVIContact::PairHVIContact(LAMMPS *lmp) :
    Pair(lmp), prefactor(1.0), relative(0), uniform(0), epsilon(nullptr), sigma(nullptr),
    widest(nullptr), law(nullptr), looked(false)
{
  writedata = 1;
  respa_enable = 0;
  born_matrix_enable = 1;
  HVI::cite(lmp->citeme, HVI::CITE_WATSON);
}

/* ---------------------------------------------------------------------- */

PairHVIContact::~PairHVIContact()
{
  if (copymode) return;
  HVI::run_anew(update);

  if (allocated) {
    memory->destroy(setflag);
    memory->destroy(cutsq);
    memory->destroy(epsilon);
    memory->destroy(sigma);
    memory->destroy(widest);
    memory->destroy(law);
  }
}

/* ---------------------------------------------------------------------- */

void PairHVIContact::compute(int eflag, int vflag)
{
  ev_init(eflag, vflag);
  if (!made.empty()) check_reach();

  if (uniform) {
    if (force->newton_pair)
      evflag ? eval<1, 1, 1>() : eval<0, 1, 1>();
    else
      evflag ? eval<1, 0, 1>() : eval<0, 0, 1>();
  } else {
    if (force->newton_pair)
      evflag ? eval<1, 1, 0>() : eval<0, 1, 0>();
    else
      evflag ? eval<1, 0, 0>() : eval<0, 0, 0>();
  }

  if (vflag_fdotr) virial_fdotr_compute();
}

/* ----------------------------------------------------------------------
   One sweep over the half list; bonded pairs are in it like all others.
   Whether a pair at rest touches is a coin toss, and a mispredicted branch
   costs more than the force: so first collect the pairs in touch without a
   branch, of as many particles as it takes to fill a batch, then work through them.
   UNIFORM: all types share one law, their types need not be fetched
------------------------------------------------------------------------- */

template <int EVFLAG, int NEWTON_PAIR, int UNIFORM> void PairHVIContact::eval()
{
  if (list->inum == 0) return;

  // rows of x lie side by side: no need to fetch their pointers

  const double(*const x)[3] = (const double(*)[3]) atom->x[0];
  const int *const type = atom->type;

  const int inum = list->inum;
  const int *const ilist = list->ilist;
  const int *const numneigh = list->numneigh;
  const int *const *const firstneigh = list->firstneigh;

  const double one_cutsq = common.cutsq;
  Touching touch;
  int n = 0;

  for (int ii = 0; ii < inum; ii++) {
    const int i = ilist[ii];
    const double xtmp = x[i][0];
    const double ytmp = x[i][1];
    const double ztmp = x[i][2];
    const HVI::Contact *const ilaw = law[type[i]];
    const int *const jlist = firstneigh[i];
    const int jnum = numneigh[i];

    for (int jfirst = 0; jfirst < jnum; jfirst += NROW) {
      const int jlast = MIN(jfirst + NROW, jnum);
      if (n > NTOUCH - NROW) {
        work_off<EVFLAG, NEWTON_PAIR, UNIFORM>(touch, n);
        n = 0;
      }
      for (int jj = jfirst; jj < jlast; jj++) {
        const int j = jlist[jj] & NEIGHMASK;
        const double delx = xtmp - x[j][0];
        const double dely = ytmp - x[j][1];
        const double delz = ztmp - x[j][2];
        const double rsq = delx * delx + dely * dely + delz * delz;
        touch.delx[n] = delx;
        touch.dely[n] = dely;
        touch.delz[n] = delz;
        touch.rsq[n] = rsq;
        touch.i[n] = i;
        touch.j[n] = j;
        n += rsq < (UNIFORM ? one_cutsq : ilaw[type[j]].cutsq);
      }
    }
  }
  work_off<EVFLAG, NEWTON_PAIR, UNIFORM>(touch, n);
}

/* ---------------------------------------------------------------------- */

template <int EVFLAG, int NEWTON_PAIR, int UNIFORM>
void PairHVIContact::work_off(const Touching &touch, int ntouch)
{
  double(*const f)[3] = (double(*)[3]) atom->f[0];
  const int *const type = atom->type;
  const int nlocal = atom->nlocal;

  double fpairs[NTOUCH];    // Watson & Steinhauser eq 2
  const HVI::Contact one_law = common;
  // compute() has filled the first ntouch, which is too far for the analyzer
  for (int n = 0; n < ntouch; n++)
    // NOLINTNEXTLINE(clang-analyzer-core.CallAndMessage,clang-analyzer-core.uninitialized.ArraySubscript)
    fpairs[n] = (UNIFORM ? one_law : law[type[touch.i[n]]][type[touch.j[n]]]).force(touch.rsq[n]);

  for (int n = 0; n < ntouch; n++) {
    const int i = touch.i[n], j = touch.j[n];
    if (touch.rsq[n] == 0.0)
      error->one(FLERR, "Pair hvi/contact: particles {} and {} are at the same place at step {}",
                 atom->tag[i], atom->tag[j], update->ntimestep);
    const double fpair = fpairs[n];
    f[i][0] += touch.delx[n] * fpair;
    f[i][1] += touch.dely[n] * fpair;
    f[i][2] += touch.delz[n] * fpair;
    if (NEWTON_PAIR || j < nlocal) {
      f[j][0] -= touch.delx[n] * fpair;
      f[j][1] -= touch.dely[n] * fpair;
      f[j][2] -= touch.delz[n] * fpair;
    }

    if (EVFLAG) {
      const double rsq = touch.rsq[n];
      const HVI::Contact &c = UNIFORM ? one_law : law[type[i]][type[j]];
      ev_tally(i, j, nlocal, NEWTON_PAIR, eflag_either ? c.energy(rsq) : 0.0, 0.0, fpair,
               touch.delx[n], touch.dely[n], touch.delz[n]);
    }
  }
}

/* ----------------------------------------------------------------------
   said once: no impact presses so many particles that far into each other, but sigma in other units does
------------------------------------------------------------------------- */

void PairHVIContact::setup()
{
  if (looked) return;
  bigint here = 0, pairs;
  for (int ii = 0; ii < list->inum; ii++) {
    const int i = list->ilist[ii];
    for (int jj = 0; jj < list->numneigh[i]; jj++) {
      const int j = list->firstneigh[i][jj] & NEIGHMASK;
      double rsq = 0.0;
      for (int k = 0; k < 3; k++)
        rsq += (atom->x[i][k] - atom->x[j][k]) * (atom->x[i][k] - atom->x[j][k]);
      if (rsq < DEEP * law[atom->type[i]][atom->type[j]].cutsq)
        here += (force->newton_pair || j < atom->nlocal) ? 2 : 1;
    }
  }
  MPI_Allreduce(&here, &pairs, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  looked = pairs > 0;
  if (pairs && comm->me == 0)
    error->warning(
        FLERR,
        "Pair style hvi/contact: {} pairs of particles are less than half of 2^(1/6) sigma "
        "apart at step {}: is sigma that of their spacing?",
        pairs / 2, update->ntimestep);
}

/* ----------------------------------------------------------------------
   shortest sqrt(m/k) of the pairs in reach
------------------------------------------------------------------------- */

void PairHVIContact::tighten(HVI::TimeStepBounds &bounds)
{
  HVI::ContactTimes least = {bounds.contact * bounds.contact, bounds.approach * bounds.approach};
  if (uniform && one_mass())
    tighten_uniform(least);
  else
    tighten_each(least);
  bounds.contact = std::sqrt(least.contact);
  bounds.approach = std::sqrt(least.approach);
  bounds.conserve_energy(HVI::shortest_cutoff(lmp));
}

bool PairHVIContact::one_mass() const
{
  if (atom->rmass) return false;
  for (int i = 2; i <= atom->ntypes; i++)
    if (atom->mass[i] != atom->mass[1]) return false;
  return true;
}

void PairHVIContact::tighten_uniform(HVI::ContactTimes &least) const
{
  if (list->inum == 0) return;
  const double(*const x)[3] = (const double(*)[3]) atom->x[0];
  const double(*const v)[3] = (const double(*)[3]) atom->v[0];
  HVI::UniformContactStep step(common, 0.5 * force->mvv2e * atom->mass[1]);

  for (int ii = 0; ii < list->inum; ii++) {
    const int i = list->ilist[ii];
    const int *const jlist = list->firstneigh[i];
    const int jnum = list->numneigh[i];
    const double xi[3] = {x[i][0], x[i][1], x[i][2]};
    const double vi[3] = {v[i][0], v[i][1], v[i][2]};

    for (int jfirst = 0; jfirst < jnum; jfirst += HVI::UniformContactStep::ROW) {
      const int jlast = MIN(jfirst + HVI::UniformContactStep::ROW, jnum);
      const auto row = step.row();
      double *const __restrict rsq = row.rsq;    // else the loop would reload positions
      double *const __restrict rdotv = row.rdotv;
      for (int jj = jfirst; jj < jlast; jj++) {
        const int j = jlist[jj] & NEIGHMASK;
        const double delx = xi[0] - x[j][0];
        const double dely = xi[1] - x[j][1];
        const double delz = xi[2] - x[j][2];
        rsq[jj - jfirst] = delx * delx + dely * dely + delz * delz;
        rdotv[jj - jfirst] =
            delx * (vi[0] - v[j][0]) + dely * (vi[1] - v[j][1]) + delz * (vi[2] - v[j][2]);
      }
      step.filled(jlast - jfirst);
    }
  }
  step.finish(least);
}

void PairHVIContact::tighten_each(HVI::ContactTimes &least) const
{
  const double *const *const x = atom->x;
  const double *const *const v = atom->v;
  const double *const rmass = atom->rmass;
  const double *const mass = atom->mass;
  const int *const type = atom->type;
  const double mvv2e = force->mvv2e;
  const int np1 = atom->ntypes + 1;
  std::vector<HVI::ContactStep> steps(np1 * np1);    // of pairs of types

  for (int ii = 0; ii < list->inum; ii++) {
    const int i = list->ilist[ii];
    const int itype = type[i];
    const int *const jlist = list->firstneigh[i];
    const int jnum = list->numneigh[i];
    const double mi = rmass ? rmass[i] : mass[itype];

    for (int jj = 0; jj < jnum; jj++) {
      const int j = jlist[jj] & NEIGHMASK;
      const int jtype = type[j];
      const double delx = x[i][0] - x[j][0];
      const double dely = x[i][1] - x[j][1];
      const double delz = x[i][2] - x[j][2];
      const double mj = rmass ? rmass[j] : mass[jtype];
      steps[itype * np1 + jtype].add(
          law[itype][jtype], mvv2e * mi * mj / (mi + mj), delx * delx + dely * dely + delz * delz,
          delx * (v[i][0] - v[j][0]) + dely * (v[i][1] - v[j][1]) + delz * (v[i][2] - v[j][2]),
          least);
    }
  }
}

/* ---------------------------------------------------------------------- */

void PairHVIContact::allocate()
{
  allocated = 1;
  const int np1 = atom->ntypes + 1;

  memory->create(setflag, np1, np1, "pair:setflag");
  memory->create(cutsq, np1, np1, "pair:cutsq");
  memory->create(epsilon, np1, np1, "pair:epsilon");
  memory->create(sigma, np1, np1, "pair:sigma");
  memory->create(widest, np1, np1, "pair:widest");
  memory->create(law, np1, np1, "pair:law");
  std::fill_n(setflag[0], np1 * np1, 0);
  std::fill_n(epsilon[0], np1 * np1, 0.0);
  std::fill_n(sigma[0], np1 * np1, 0.0);
  std::fill_n(widest[0], np1 * np1, 0.0);
}

/* ---------------------------------------------------------------------- */

void PairHVIContact::settings(int narg, char **arg)
{
  HVI::run_anew(update);
  prefactor = 1.0;
  relative = 0;

  int iarg = 0;
  while (iarg < narg) {
    if (strcmp(arg[iarg], "prefactor") == 0) {
      if (iarg + 2 > narg)
        utils::missing_cmd_args(FLERR, "pair_style hvi/contact prefactor", error);
      prefactor = utils::numeric(FLERR, arg[iarg + 1], false, lmp);
      if (!(prefactor > 0.0) || !std::isfinite(prefactor))
        error->all(FLERR, "Pair_style hvi/contact prefactor must be > 0, not {}", arg[iarg + 1]);
      iarg += 2;
    } else if (strcmp(arg[iarg], "lists") == 0) {
      if (iarg + 2 > narg) utils::missing_cmd_args(FLERR, "pair_style hvi/contact lists", error);
      if (strcmp(arg[iarg + 1], "relative") != 0 && strcmp(arg[iarg + 1], "displacement") != 0)
        error->all(FLERR, "Pair_style hvi/contact lists must be relative or displacement, not {}",
                   arg[iarg + 1]);
      relative = strcmp(arg[iarg + 1], "relative") == 0;
      iarg += 2;
    } else
      error->all(FLERR, "Unknown pair_style hvi/contact keyword: {}", arg[iarg]);
  }
}

/* ---------------------------------------------------------------------- */

void PairHVIContact::coeff(int narg, char **arg)
{
  HVI::run_anew(update);
  if (narg < 4) utils::missing_cmd_args(FLERR, "pair_coeff hvi/contact", error);
  if (narg > 4)
    error->all(FLERR, "Pair_coeff for pair hvi/contact takes I J epsilon sigma, but got extra: {}",
               arg[4]);
  if (!allocated) allocate();

  int ilo, ihi, jlo, jhi;
  utils::bounds(FLERR, arg[0], 1, atom->ntypes, ilo, ihi, error);
  utils::bounds(FLERR, arg[1], 1, atom->ntypes, jlo, jhi, error);

  const double epsilon_one = utils::numeric(FLERR, arg[2], false, lmp);
  const double sigma_one = utils::numeric(FLERR, arg[3], false, lmp);
  if (!(epsilon_one > 0.0) || !std::isfinite(epsilon_one))
    error->all(FLERR, "Pair hvi/contact epsilon must be > 0, not {}", arg[2]);
  if (!(sigma_one > 0.0) || !std::isfinite(sigma_one))
    error->all(FLERR, "Pair hvi/contact sigma must be > 0, not {}", arg[3]);

  int count = 0;
  for (int i = ilo; i <= ihi; i++)
    for (int j = MAX(jlo, i); j <= jhi; j++) {
      epsilon[i][j] = epsilon_one;
      sigma[i][j] = widest[i][j] = sigma_one;
      setflag[i][j] = 1;
      count++;
    }

  if (count == 0)
    error->all(FLERR, "Incorrect args for pair coefficients: no type pair with I <= J in {} {}",
               arg[0], arg[1]);
}

/* ---------------------------------------------------------------------- */

void PairHVIContact::init_style()
{
  if (utils::strmatch(update->integrate_style, "^respa"))
    error->all(FLERR, "Pair style hvi/contact does not support run_style respa");
  HVI::check_types(lmp);
  HVI::check_ghosts(lmp);

  neighbor->add_request(this);
  if (!force->pair_match("^hvi/sph$", 0)) {
    bool all = true;    // one fix decides for all of a hybrid
    for (auto *const pair : HVI::pair_styles(force))
      if (const auto *const contact = dynamic_cast<PairHVIContact *>(pair))
        all = all && contact->relative;
    FixHVILists::make(lmp, all, true);
  }
  uniform = -1;
  made.clear();
  reach.assign((atom->ntypes + 1) * (atom->ntypes + 1), 0.0);
}

/* ---------------------------------------------------------------------- */

double PairHVIContact::init_one(int i, int j)
{
  if (setflag[i][j] == 0) {
    epsilon[i][j] = mix_energy(epsilon[i][i], epsilon[j][j], sigma[i][i], sigma[j][j]);
    sigma[i][j] = mix_distance(sigma[i][i], sigma[j][j]);
    widest[i][j] = mix_distance(widest[i][i], widest[j][j]);
  }

  epsilon[j][i] = epsilon[i][j];
  sigma[j][i] = sigma[i][j];
  made.emplace_back(i, j);
  law[i][j] = law[j][i] = HVI::Contact::make(epsilon[i][j], sigma[i][j], prefactor);

  if (uniform < 0) {
    uniform = 1;
    common = law[i][j];
  } else if (law[i][j].depth != common.depth || law[i][j].cutsq != common.cutsq)
    uniform = 0;

  const double cut =
      HVI::Contact::r_eq(MAX(sigma[i][j], widest[i][j]));    // that fix adapt may come back to
  double &listed = reach[i * (atom->ntypes + 1) + j];
  if (listed == 0.0) listed = cut;
  return cut;
}

/* ----------------------------------------------------------------------
   fix adapt calls init_one(), also through pair style hybrid: lists and ghosts are those of the start of the run
------------------------------------------------------------------------- */

void PairHVIContact::check_reach()
{
  for (const auto &[i, j] : made) {
    if (std::sqrt(law[i][j].cutsq) > (1.0 + 1.0e-12) * reach[i * (atom->ntypes + 1) + j])
      error->all(FLERR,
                 "Pair style hvi/contact: contacts of types {} and {} reach farther than those "
                 "of pair_coeff, as sigma has grown: give pair_coeff the largest sigma, and let "
                 "fix adapt make it smaller",
                 i, j);
  }
  made.clear();
}

/* ---------------------------------------------------------------------- */

void PairHVIContact::write_restart(FILE *fp)
{
  write_restart_settings(fp);

  const int np1 = atom->ntypes + 1;
  HVI::RestartSection section(RESTART_FORMAT);
  for (int i = 1; i < np1; i++) {
    section.put(setflag[i], np1);
    section.put(epsilon[i], np1);
    section.put(sigma[i], np1);
  }
  section.write(fp);
}

/* ---------------------------------------------------------------------- */

void PairHVIContact::read_restart(FILE *fp)
{
  read_restart_settings(fp);
  allocate();

  const int np1 = atom->ntypes + 1;
  HVI::RestartSection section(lmp, WHOSE, RESTART_FORMAT, fp);
  for (int i = 1; i < np1; i++) {
    section.get(setflag[i], np1);
    section.get(epsilon[i], np1);
    section.get(sigma[i], np1);
    std::copy_n(sigma[i], np1, widest[i]);
  }
}

/* ---------------------------------------------------------------------- */

void PairHVIContact::write_restart_settings(FILE *fp)
{
  HVI::RestartSection section(RESTART_FORMAT);
  section.put(&prefactor, 1);
  section.put(&relative, 1);
  section.put(&mix_flag, 1);
  section.write(fp);
}

/* ---------------------------------------------------------------------- */

void PairHVIContact::read_restart_settings(FILE *fp)
{
  HVI::RestartSection section(lmp, WHOSE, RESTART_FORMAT, fp);
  section.get(&prefactor, 1);
  section.get(&relative, 1);
  section.get(&mix_flag, 1);
}

/* ---------------------------------------------------------------------- */

void PairHVIContact::write_data(FILE *fp)
{
  for (int i = 1; i <= atom->ntypes; i++)
    fprintf(fp, "%d %.17g %.17g\n", i, epsilon[i][i], sigma[i][i]);
}

/* ---------------------------------------------------------------------- */

void PairHVIContact::write_data_all(FILE *fp)
{
  for (int i = 1; i <= atom->ntypes; i++)
    for (int j = i; j <= atom->ntypes; j++)
      fprintf(fp, "%d %d %.17g %.17g\n", i, j, epsilon[i][j], sigma[i][j]);
}

/* ---------------------------------------------------------------------- */

double PairHVIContact::single(int /*i*/, int /*j*/, int itype, int jtype, double rsq,
                              double /*factor_coul*/, double /*factor_lj*/, double &fforce)
{
  return pair_energy(itype, jtype, rsq, fforce);
}

double PairHVIContact::pair_energy(int itype, int jtype, double rsq, double &fforce) const
{
  const HVI::Contact &c = law[itype][jtype];
  if (rsq >= c.cutsq) {
    fforce = 0.0;
    return 0.0;
  }
  fforce = c.force(rsq);
  return c.energy(rsq);
}

/* ---------------------------------------------------------------------- */

void PairHVIContact::born_matrix(int /*i*/, int /*j*/, int itype, int jtype, double rsq,
                                 double /*factor_coul*/, double /*factor_lj*/, double &dupair,
                                 double &du2pair)
{
  const HVI::Contact &c = law[itype][jtype];
  dupair = du2pair = 0.0;
  if (rsq >= c.cutsq) return;
  dupair = -std::sqrt(rsq) * c.force(rsq);
  du2pair = c.stiffness(rsq);
}

/* ---------------------------------------------------------------------- */

void *PairHVIContact::extract(const char *str, int &dim)
{
  dim = 2;
  if (strcmp(str, "epsilon") == 0) return (void *) epsilon;
  if (strcmp(str, "sigma") == 0) return (void *) sigma;
  dim = 0;
  if (strcmp(str, "prefactor") == 0) return (void *) &prefactor;
  return nullptr;
}
