/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing authors: the lammps-hvi developers
------------------------------------------------------------------------- */

#include "bond_hvi_spring.h"

#include "atom.h"
#include "atom_vec.h"
#include "comm.h"
#include "compute.h"
#include "domain.h"
#include "error.h"
#include "fix_hvi_ledger.h"
#include "force.h"
#include "hvi_anew.h"
#include "hvi_cite.h"
#include "hvi_compat.h"
#include "hvi_restart.h"
#include "hvi_tag_exchange.h"
#include "memory.h"
#include "modify.h"
#include "neighbor.h"
#include "output.h"
#include "special.h"
#include "thermo.h"
#include "update.h"

#include <cmath>
#include <cstring>
#include <string>
#include <vector>

using namespace LAMMPS_NS;

static constexpr int RESTART_FORMAT = 1;

/* ---------------------------------------------------------------------- */

BondHVISpring::BondHVISpring(LAMMPS *lmp) :
    Bond(lmp), kappa(nullptr), r_eq(nullptr), r_cut(nullptr), law(nullptr), ledger(nullptr),
    dropped(false), warned(false), exact_images(0), nmax(0), xowner(nullptr)
{
  partial_flag = 1;
  born_matrix_enable = 1;
  HVI::cite(lmp->citeme, HVI::CITE_WATSON);
}

/* ---------------------------------------------------------------------- */

BondHVISpring::~BondHVISpring()
{
  HVI::run_anew(update);
  memory->destroy(xowner);

  if (allocated && !copymode) {
    memory->destroy(setflag);
    memory->destroy(kappa);
    memory->destroy(r_eq);
    memory->destroy(r_cut);
    memory->destroy(law);
  }
}

/* ---------------------------------------------------------------------- */

void BondHVISpring::compute(int eflag, int vflag)
{
  ev_init(eflag, vflag);

  if (exact_images) {
    if (atom->nmax > nmax) {
      nmax = atom->nmax;
      memory->destroy(xowner);
      memory->create(xowner, nmax, 3, "bond/hvi/spring:xowner");
    }
    comm->forward_comm(this);
    if (evflag)
      eval<1, 0, 1>();
    else
      eval<0, 0, 1>();
  } else if (force->newton_bond) {
    if (evflag)
      eval<1, 1, 0>();
    else
      eval<0, 1, 0>();
  } else {
    if (evflag)
      eval<1, 0, 0>();
    else
      eval<0, 0, 0>();
  }
}

/* ----------------------------------------------------------------------
   EXACT: with newton_bond off both owners of a bond decide whether it breaks.
   Across a periodic boundary a ghost's coordinates are rounded after the
   shift, so the two would see distances that differ in the last digit.  Both
   then work from the coordinates as the owners hold them instead.
------------------------------------------------------------------------- */

template <int EVFLAG, int NEWTON_BOND, int EXACT> void BondHVISpring::eval()
{
  const int nbondlist = neighbor->nbondlist;
  if (nbondlist == 0) return;

  // rows of x, f and bondlist lie side by side: no need to fetch their pointers

  const double(*const x)[3] = (const double(*)[3]) atom->x[0];
  double(*const f)[3] = (double(*)[3]) atom->f[0];
  int(*const bondlist)[3] = (int(*)[3]) neighbor->bondlist[0];
  const int nlocal = atom->nlocal;

  // a batch at a time: distances; forces, of as many at once as vectors have lanes; who gets them

  double delx[NBATCH], dely[NBATCH], delz[NBATCH], rsq[NBATCH], fbonds[NBATCH];

  for (int first = 0; first < nbondlist; first += NBATCH) {
    const int nbatch = MIN(NBATCH, nbondlist - first);
    int(*const bond)[3] = bondlist + first;

    for (int n = 0; n < nbatch; n++) {
      const int i1 = bond[n][0];
      const int i2 = bond[n][1];
      const double *const x2 = (EXACT && i2 >= nlocal) ? xowner[i2] : x[i2];
      delx[n] = x[i1][0] - x2[0];
      dely[n] = x[i1][1] - x2[1];
      delz[n] = x[i1][2] - x2[2];
      if (EXACT) HVI::minimum_image(domain, delx[n], dely[n], delz[n]);
      rsq[n] = delx[n] * delx[n] + dely[n] * dely[n] + delz[n] * delz[n];
    }

    // whether a bond of an intact lattice is slack is a coin toss: no branch on it

    if (atom->nbondtypes == 1) {
      const HVI::Spring s = law[1];
      for (int n = 0; n < nbatch; n++) fbonds[n] = s.force(rsq[n]);
    } else
      for (int n = 0; n < nbatch; n++)
        fbonds[n] = bond[n][2] > 0 ? law[bond[n][2]].force(rsq[n]) : 0.0;

    for (int n = 0; n < nbatch; n++) {
      const int type = bond[n][2];
      if (type <= 0) continue;
      const int i1 = bond[n][0];
      const int i2 = bond[n][1];
      const HVI::Spring &s = law[type];
      const double fbond = fbonds[n];

      if (s.broken(rsq[n])) {
        bond[n][2] = 0;
        break_bond(i1, i2, type, NEWTON_BOND, s.energy(rsq[n]), delx[n] * fbond, dely[n] * fbond,
                   delz[n] * fbond);
        continue;
      }

      f[i1][0] += delx[n] * fbond;
      f[i1][1] += dely[n] * fbond;
      f[i1][2] += delz[n] * fbond;
      if (NEWTON_BOND || i2 < nlocal) {
        f[i2][0] -= delx[n] * fbond;
        f[i2][1] -= dely[n] * fbond;
        f[i2][2] -= delz[n] * fbond;
      }

      if (EVFLAG)
        ev_tally(i1, i2, nlocal, NEWTON_BOND, eflag_either ? s.energy(rsq[n]) : 0.0, fbond, delx[n],
                 dely[n], delz[n]);
    }
  }
}

/* ----------------------------------------------------------------------
   the bond is gone for good: off both owners' records at once, its energy
   and the half kick it no longer gives into the ledger
------------------------------------------------------------------------- */

void BondHVISpring::break_bond(int i1, int i2, int type, int newton_bond, double ebond, double fx,
                               double fy, double fz)
{
  const int nlocal = atom->nlocal;
  int nerased = erase_record(i1, atom->tag[i2], type);
  if (i2 < nlocal) nerased += erase_record(i2, atom->tag[i1], type);

  // newton_bond off: a bond between ranks is broken, and half of it booked, on both

  const int booked_here_alone = newton_bond || i2 < nlocal;
  ledger->book_break(nerased, booked_here_alone ? ebond : 0.5 * ebond);
  ledger->book_lost_kick(i1, fx, fy, fz);
  if (booked_here_alone) ledger->book_lost_kick(i2, -fx, -fy, -fz);
}

/* ---------------------------------------------------------------------- */

int BondHVISpring::erase_record(int i, tagint partner, int type)
{
  const int n = atom->num_bond[i];
  tagint *const bond_atom = atom->bond_atom[i];
  int *const bond_type = atom->bond_type[i];

  for (int m = 0; m < n; m++)
    if (bond_atom[m] == partner && bond_type[m] == type) {
      bond_atom[m] = bond_atom[n - 1];
      bond_type[m] = bond_type[n - 1];
      atom->num_bond[i]--;
      return 1;
    }
  return 0;
}

/* ----------------------------------------------------------------------
   shortest sqrt(m/k) of the intact bonds
------------------------------------------------------------------------- */

void BondHVISpring::tighten(HVI::TimeStepBounds &bounds)
{
  const double *const rmass = atom->rmass;
  const double *const mass = atom->mass;
  const int *const type = atom->type;
  const double mvv2e = force->mvv2e;

  double spring = bounds.spring * bounds.spring;
  for (int n = 0; n < neighbor->nbondlist; n++) {
    const int btype = neighbor->bondlist[n][2];
    if (btype <= 0 || !setflag[btype]) continue;    // broken, or of another style under hybrid
    const int i1 = neighbor->bondlist[n][0];
    const int i2 = neighbor->bondlist[n][1];
    const double m1 = rmass ? rmass[i1] : mass[type[i1]];
    const double m2 = rmass ? rmass[i2] : mass[type[i2]];
    spring = MIN(spring, mvv2e * m1 * m2 / ((m1 + m2) * kappa[btype]));
  }
  bounds.spring = std::sqrt(spring);
  bounds.conserve_energy(HVI::shortest_cutoff(lmp));
}

/* ---------------------------------------------------------------------- */

void BondHVISpring::allocate()
{
  allocated = 1;
  const int np1 = atom->nbondtypes + 1;

  memory->create(kappa, np1, "bond:kappa");
  memory->create(r_eq, np1, "bond:r_eq");
  memory->create(r_cut, np1, "bond:r_cut");
  memory->create(law, np1, "bond:law");
  memory->create(setflag, np1, "bond:setflag");
  for (int i = 1; i < np1; i++) setflag[i] = 0;
}

/* ---------------------------------------------------------------------- */

void BondHVISpring::coeff(int narg, char **arg)
{
  HVI::run_anew(update);
  if (narg < 4) utils::missing_cmd_args(FLERR, "bond_coeff hvi/spring", error);
  if (narg > 4)
    error->all(FLERR, "Bond_coeff for hvi/spring takes T kappa r_eq r_cut, but got extra: {}",
               arg[4]);
  if (!allocated) allocate();

  int ilo, ihi;
  utils::bounds(FLERR, arg[0], 1, atom->nbondtypes, ilo, ihi, error);

  const double kappa_one = utils::numeric(FLERR, arg[1], false, lmp);
  const double r_eq_one = utils::numeric(FLERR, arg[2], false, lmp);
  const double r_cut_one = utils::numeric(FLERR, arg[3], false, lmp);
  if (!(kappa_one > 0.0) || !std::isfinite(kappa_one))
    error->all(FLERR, "Bond hvi/spring kappa must be > 0, not {}", arg[1]);
  if (!(r_eq_one > 0.0) || !std::isfinite(r_eq_one))
    error->all(FLERR, "Bond hvi/spring r_eq must be > 0, not {}", arg[2]);
  if (!(r_cut_one > r_eq_one) || !std::isfinite(r_cut_one))
    error->all(FLERR, "Bond hvi/spring r_cut must be > r_eq = {}, not {}", arg[2], arg[3]);

  for (int i = ilo; i <= ihi; i++) {
    kappa[i] = kappa_one;
    r_eq[i] = r_eq_one;
    r_cut[i] = r_cut_one;
    setflag[i] = 1;
  }
}

/* ---------------------------------------------------------------------- */

void BondHVISpring::init_style()
{
  if (utils::strmatch(update->integrate_style, "^respa"))
    error->all(FLERR, "Bond style hvi/spring does not support run_style respa");
  if (update->whichflag == 2)
    error->all(FLERR, "Bond style hvi/spring cannot be minimized: its bonds break for good");
  if (atom->molecular != Atom::MOLECULAR)
    error->all(FLERR, "Bond style hvi/spring requires an atom style with bonds stored per atom");
  for (int i = 0; i < atom->nlocal; i++)
    for (int k = 0; k < atom->num_bond[i]; k++)
      if (atom->bond_type[i][k] > atom->nbondtypes)
        error->one(FLERR,
                   "A bond of particle {} is of type {}, but there are types 1 to {}: the restart "
                   "file it is from is "
                   "damaged, take another one",
                   atom->tag[i], atom->bond_type[i][k], atom->nbondtypes);

  double rmax = 0.0;
  for (int i = 1; i <= atom->nbondtypes; i++)
    if (setflag[i]) {
      law[i] = HVI::Spring::make(kappa[i], r_eq[i], r_cut[i]);
      rmax = MAX(rmax, r_cut[i]);
    }

  // a rebuild must find both ends of every intact bond: by then a bond may have
  // stretched beyond r_cut by one step's motion, for which half the skin is ample

  const double cutneed = rmax + 0.5 * neighbor->skin;
  if (comm->cutghostuser < cutneed) comm->cutghostuser = cutneed;

  ledger = FixHVILedger::instance(lmp);
  ledger->watch_breaking();
  exact_images =
      !force->newton_bond && (domain->xperiodic || domain->yperiodic || domain->zperiodic);
  comm_forward = exact_images ? 3 : 0;

  // weights matter only once there is a run: create_bonds wants 1-2 weights of 0 and comes
  // here through init() as well

  if (update->whichflag == 1) {
    for (int i = 1; i <= 3; i++)
      if (force->special_lj[i] != 1.0 || force->special_coul[i] != 1.0)
        error->all(FLERR,
                   "Bond style hvi/spring requires special_bonds lj/coul 1 1 1 for a run: contact "
                   "acts between bonded particles too");
    if (const auto found = modify->get_compute_by_style("^fragment/atom"); !found.empty())
      error->all(FLERR,
                 "Compute {} (fragment/atom) finds no bonds of bond style hvi/spring in a run: use "
                 "compute hvi/fragment/atom",
                 found[0]->id);
    drop_special();
  } else
    restore_special();
}

/* ----------------------------------------------------------------------
   with all weights 1 nothing reads the lists of special neighbors, which
   breaking bonds would leave stale: empty them, they cost memory, migration
   and a search per pair in every rebuild.  Rows keep their width, into which molecules
   of fixes and commands must fit.
------------------------------------------------------------------------- */

void BondHVISpring::drop_special()
{
  for (int i = 0; i < atom->nlocal; i++)
    atom->nspecial[i][0] = atom->nspecial[i][1] = atom->nspecial[i][2] = 0;
  memory->destroy(atom->special);
  memory->create(atom->special, atom->nmax, atom->maxspecial, "atom:special");
  atom->avec->grow_pointers();
  dropped = true;
}

/* ----------------------------------------------------------------------
   commands between runs, such as create_bonds and reset_atoms mol, find lists that are those of the bonds
------------------------------------------------------------------------- */

void BondHVISpring::restore_special()
{
  std::vector<tagint> partners;
  bigint owned[2] = {0, 0}, total[2];    // bonds, special neighbors
  for (int i = 0; i < atom->nlocal; i++) {
    partners.insert(partners.end(), atom->bond_atom[i], atom->bond_atom[i] + atom->num_bond[i]);
    owned[1] += atom->nspecial[i][0];
  }
  owned[0] = partners.size();
  MPI_Allreduce(owned, total, 2, MPI_LMP_BIGINT, MPI_SUM, world);
  if (total[0] == 0) return;

  const std::vector<char> none(atom->ntypes + 1, 0);
  if (const tagint gone = HVITagExchange(lmp).connect(partners, none, false)) {
    const std::string said = fmt::format(
        "Bond style hvi/spring: there are bonds to particle {}, which is gone: use delete_atoms "
        "with bond yes",
        gone);
    if (output->thermo->lostbond == Thermo::ERROR) error->all(FLERR, said);
    if (comm->me == 0 && !warned)
      error->warning(FLERR, said + ", without which reset_atoms mol finds no bonds");
    warned = true;
    return;
  }
  if (!dropped && total[1] == total[0] * (force->newton_bond ? 2 : 1)) return;
  Special(lmp).build();
  dropped = false;
}

/* ----------------------------------------------------------------------
   Comm::get_comm_cutoff() takes 1.5 times this plus the skin as its estimate
   of what bonds need: give it what makes that the true need, see init_style()
------------------------------------------------------------------------- */

double BondHVISpring::equilibrium_distance(int i)
{
  return MAX(r_cut[i] - 0.5001 * neighbor->skin, 0.0) / 1.5;
}

/* ---------------------------------------------------------------------- */

void BondHVISpring::write_restart(FILE *fp)
{
  HVI::RestartSection section(RESTART_FORMAT);
  for (const double *const values : {kappa, r_eq, r_cut}) section.put(&values[1], atom->nbondtypes);
  section.write(fp);
}

/* ---------------------------------------------------------------------- */

void BondHVISpring::read_restart(FILE *fp)
{
  allocate();

  HVI::RestartSection section(lmp, "Bond hvi/spring", RESTART_FORMAT, fp);
  for (double *const values : {kappa, r_eq, r_cut}) section.get(&values[1], atom->nbondtypes);
  for (int i = 1; i <= atom->nbondtypes; i++) setflag[i] = 1;
}

/* ---------------------------------------------------------------------- */

void BondHVISpring::write_data(FILE *fp)
{
  for (int i = 1; i <= atom->nbondtypes; i++)
    fprintf(fp, "%d %.17g %.17g %.17g\n", i, kappa[i], r_eq[i], r_cut[i]);
}

/* ---------------------------------------------------------------------- */

double BondHVISpring::single(int type, double rsq, int /*i*/, int /*j*/, double &fforce)
{
  return bond_energy(type, rsq, fforce);
}

double BondHVISpring::bond_energy(int type, double rsq, double &fforce) const
{
  fforce = 0.0;
  if (type <= 0) return 0.0;

  // beyond r_cut only between a move and the force evaluation that breaks the bond

  const HVI::Spring &s = law[type];
  fforce = s.force(rsq);
  return s.energy(rsq);
}

/* ---------------------------------------------------------------------- */

void BondHVISpring::born_matrix(int type, double rsq, int /*i*/, int /*j*/, double &du, double &du2)
{
  du = du2 = 0.0;
  if (type <= 0) return;

  const HVI::Spring &s = law[type];
  if (rsq <= s.eqsq) return;
  du = s.kappa * (std::sqrt(rsq) - s.r_eq);
  du2 = s.kappa;
}

/* ---------------------------------------------------------------------- */

void *BondHVISpring::extract(const char *str, int &dim)
{
  dim = 1;
  if (strcmp(str, "kappa") == 0) return (void *) kappa;
  if (strcmp(str, "r_eq") == 0 || strcmp(str, "r0") == 0) return (void *) r_eq;
  if (strcmp(str, "r_cut") == 0) return (void *) r_cut;
  return nullptr;
}

/* ---------------------------------------------------------------------- */

int BondHVISpring::pack_forward_comm(int n, int *list, double *buf, int /*pbc_flag*/, int * /*pbc*/)
{
  const int nlocal = atom->nlocal;
  int m = 0;
  for (int i = 0; i < n; i++) {
    const int j = list[i];
    const double *const xj = (j < nlocal) ? atom->x[j] : xowner[j];
    buf[m++] = xj[0];
    buf[m++] = xj[1];
    buf[m++] = xj[2];
  }
  return m;
}

/* ---------------------------------------------------------------------- */

void BondHVISpring::unpack_forward_comm(int n, int first, double *buf)
{
  int m = 0;
  for (int i = first; i < first + n; i++) {
    xowner[i][0] = buf[m++];
    xowner[i][1] = buf[m++];
    xowner[i][2] = buf[m++];
  }
}

/* ---------------------------------------------------------------------- */

double BondHVISpring::memory_usage()
{
  return Bond::memory_usage() + 3.0 * nmax * sizeof(double);
}
