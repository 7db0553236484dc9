/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing authors: the lammps-hvi developers
------------------------------------------------------------------------- */

#include "hvi_leavers.h"

#include "atom.h"
#include "atom_vec.h"
#include "comm.h"
#include "domain.h"
#include "force.h"
#include "hvi_cells.h"
#include "hvi_compat.h"
#include "hvi_deliver.h"
#include "hvi_energy_carrier.h"
#include "hvi_interface.h"
#include "hvi_torn.h"
#include "math_extra.h"
#include "neighbor.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

using namespace LAMMPS_NS;

static constexpr double BIG = 1.0e100;

/* ---------------------------------------------------------------------- */

bigint HVILeavers::pick(bool at_faces)
{
  bool fixed[3][2], any = false;
  for (int k = 0; k < 3; k++)
    for (int side = 0; side < 2; side++) {
      fixed[k][side] = at_faces && domain->boundary[k][side] == 1;
      any = any || fixed[k][side];
    }
  std::vector<const HVI::EnergyCarrier *> send_away;
  for (const auto *const carrier : HVI::find_interface<HVI::EnergyCarrier>(lmp))
    if (carrier->may_send_away()) send_away.push_back(carrier);
  if (!any && send_away.empty()) return 0;
  const auto is_to_go = [&](int i) {
    return std::any_of(send_away.begin(), send_away.end(), [i](const HVI::EnergyCarrier *carrier) {
      return carrier->is_to_go(i);
    });
  };

  // beyond a face, or within depth of it

  auto beyond = [&](int i, const double *depth) {
    double x[3] = {atom->x[i][0], atom->x[i][1], atom->x[i][2]};
    double lo[3] = {domain->boxlo[0], domain->boxlo[1], domain->boxlo[2]};
    double hi[3] = {domain->boxhi[0], domain->boxhi[1], domain->boxhi[2]};
    if (domain->triclinic) {
      domain->x2lamda(atom->x[i], x);
      lo[0] = lo[1] = lo[2] = 0.0;
      hi[0] = hi[1] = hi[2] = 1.0;
    }
    for (int k = 0; k < 3; k++)
      if ((fixed[k][0] && x[k] < lo[k] + depth[k]) || (fixed[k][1] && x[k] >= hi[k] - depth[k]))
        return true;
    return false;
  };

  const double zero[3] = {0.0, 0.0, 0.0};
  for (int i = 0; i < atom->nlocal; i++)
    if (beyond(i, zero) || is_to_go(i)) leaving.push_back(i);

  const bigint here = leaving.size();
  MPI_Allreduce(&here, &number, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  if (number == 0) return 0;

  reach = MAX(neighbor->cutneighmax, comm->cutghostuser);
  double depth[3] = {reach, reach, reach};
  if (domain->triclinic) fraction_of_box(reach, depth);
  size_t next = 0;
  for (int i = 0; i < atom->nlocal; i++)
    if (next < leaving.size() && leaving[next] == i)
      next++;
    else if (!send_away.empty() || beyond(i, depth))
      near.push_back(i);
  return number;
}

/* ----------------------------------------------------------------------
   the distance between planes of equal fractional coordinate is 1 over the
   length of a row of h_inv
------------------------------------------------------------------------- */

void HVILeavers::fraction_of_box(double distance, double *fraction) const
{
  const double *const h = domain->h_inv;
  if (domain->triclinic) {
    fraction[0] = distance * std::sqrt(h[0] * h[0] + h[5] * h[5] + h[4] * h[4]);
    fraction[1] = distance * std::sqrt(h[1] * h[1] + h[3] * h[3]);
    fraction[2] = distance * h[2];
  } else
    for (int k = 0; k < 3; k++) fraction[k] = distance / domain->prd[k];
}

/* ----------------------------------------------------------------------
   velocities are those between the half kicks of a step of length dt, or
   those at a full step if dt is 0
------------------------------------------------------------------------- */

HVILeavers::Account HVILeavers::take_out(double dt_in)
{
  dt = dt_in;
  Account a = {};
  const auto carriers = HVI::find_interface<HVI::EnergyCarrier>(lmp);

  for (const int i : leaving) {
    const double *const v = atom->v[i];
    const double m = atom->rmass ? atom->rmass[i] : atom->mass[atom->type[i]];
    const double ke = 0.5 * force->mvv2e * m * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    a.energy += ke;
    if (atom->esph_flag) a.energy += atom->esph[i];
    for (const auto *carrier : carriers) {
      a.energy += carrier->internal_energy(i);
      a.plastic += carrier->plastic_work(i);
      a.voids += carrier->void_work(i);
    }
    for (int k = 0; k < 3; k++) a.momentum[k] += m * v[k];
    a.mass += m;
    a.count += 1.0;
  }

  const HVITorn laws(lmp);
  const bool bonded = force->bond && atom->molecular == Atom::MOLECULAR;
  a.unknown = laws.unknown();
  if (bonded || laws.has_pairs()) share(bonded);
  a.energy += tear_contacts(laws);
  if (bonded) a.energy += tear_bonds(laws, a.nrecords);
  remove();
  return a;
}

/* ----------------------------------------------------------------------
   own leavers, and the bonds they hold, to all ranks that have particles within
   twice the reach: a bond may be longer than pairs reach.  This one is among them.
------------------------------------------------------------------------- */

void HVILeavers::share(bool bonded)
{
  double s[3], width[3], mine[6] = {BIG, BIG, BIG, -BIG, -BIG, -BIG};
  for (const auto *list : {&near, &leaving})
    for (const int i : *list) {
      fractional(atom->x[i], s);
      for (int k = 0; k < 3; k++) {
        mine[k] = std::min(mine[k], s[k]);
        mine[3 + k] = std::max(mine[3 + k], s[k]);
      }
    }
  std::vector<double> boxes(6 * comm->nprocs);
  MPI_Allgather(mine, 6, MPI_DOUBLE, boxes.data(), 6, MPI_DOUBLE, world);
  fraction_of_box(2.0 * reach, width);

  std::vector<Leaver> leavers;
  std::vector<int> rank, bond_rank;
  for (const int i : leaving) {
    const double *const x = atom->x[i], *const v = atom->v[i];
    fractional(x, s);
    for (int p = 0; p < comm->nprocs; p++) {
      bool apart = false;
      for (int k = 0; k < 3; k++) {
        const double lo = boxes[6 * p + k] - width[k], hi = boxes[6 * p + 3 + k] + width[k];
        double above = s[k] - lo;
        if (domain->periodicity[k]) above -= std::floor(above);
        apart = apart || above < 0.0 || above > hi - lo;
      }
      if (apart) continue;
      leavers.push_back({atom->tag[i],
                         atom->type[i],
                         comm->me,
                         {x[0], x[1], x[2]},
                         {v[0], v[1], v[2]},
                         atom->mask[i],
                         atom->molecule ? atom->molecule[i] : 0});
      rank.push_back(p);
      for (int n = 0; bonded && n < atom->num_bond[i]; n++) {
        bonds.push_back({atom->tag[i], atom->bond_atom[i][n], atom->bond_type[i][n]});
        bond_rank.push_back(p);
      }
    }
  }
  out = HVI::deliver(world, leavers, rank);
  bonds = HVI::deliver(world, bonds, bond_rank);
}

/* ----------------------------------------------------------------------
   a pair that is torn apart takes its energy along, and the half kick that it
   no longer gives; law(rsq, fforce) is its energy
------------------------------------------------------------------------- */

template <class Law>
double HVILeavers::torn(const Law &law, const double *x, const double *v, const Leaver &l) const
{
  double d[3] = {x[0] - l.x[0], x[1] - l.x[1], x[2] - l.x[2]};
  HVI::minimum_image(domain, d[0], d[1], d[2]);
  double rdotv = 0.0, fforce = 0.0;
  for (int k = 0; k < 3; k++) rdotv += d[k] * (v[k] - l.v[k]);
  const double phi = law(MathExtra::lensq3(d), fforce);
  return phi + 0.5 * dt * fforce * rdotv;
}

double HVILeavers::contact(const HVITorn &laws, const HVI::ExcludedBy &one, const double *x,
                           const double *v, const Leaver &l) const
{
  if (HVI::excluded(*neighbor, *group, one, {l.type, l.mask, l.molecule})) return 0.0;
  const auto law = [&](double rsq, double &fforce) {
    return laws.pair(one.type, l.type, rsq, fforce);
  };
  return torn(law, x, v, l);
}

double HVILeavers::spring(const HVITorn &laws, int btype, const double *x, const double *v,
                          const Leaver &l) const
{
  const auto law = [&](double rsq, double &fforce) {
    return laws.bond(btype, rsq, fforce);
  };
  return torn(law, x, v, l);
}

/* ----------------------------------------------------------------------
   leavers sorted into cells of the longest distance at which one of them may
   be in touch, so that the time does not grow with their number squared; the
   order of the sum is that of all pairs.  A pair of two leavers is booked by the
   owner of the one that comes later in the order of ranks, which is that of out.
------------------------------------------------------------------------- */

double HVILeavers::tear_contacts(const HVITorn &laws) const
{
  std::vector<bool> leaves(atom->ntypes + 1, false);
  for (const Leaver &l : out) leaves[l.type] = true;
  double cutsq = 0.0;
  for (int itype = 1; itype <= atom->ntypes; itype++)
    for (int jtype = 1; jtype <= atom->ntypes; jtype++)
      if (leaves[jtype]) cutsq = MAX(cutsq, laws.pair_cutsq(itype, jtype));
  if (cutsq == 0.0) return 0.0;

  double width[3];
  fraction_of_box(std::sqrt(cutsq), width);
  const bool periodic[3] = {domain->xperiodic != 0, domain->yperiodic != 0, domain->zperiodic != 0};
  HVI::Cells cells(width, periodic);
  double s[3];
  for (size_t n = 0; n < out.size(); n++) {
    fractional(out[n].x, s);
    cells.add(n, s);
  }
  cells.sort();

  double energy = 0.0;
  for (const int i : near) {
    fractional(atom->x[i], s);
    cells.near(s, [&](int n) {
      const HVI::ExcludedBy one = {atom->type[i], atom->mask[i],
                                   atom->molecule ? atom->molecule[i] : 0};
      energy += contact(laws, one, atom->x[i], atom->v[i], out[n]);
    });
  }

  for (int n = 0; n < (int) out.size(); n++) {
    if (out[n].rank != comm->me) continue;
    fractional(out[n].x, s);
    cells.near(s, [&](int m) {
      const HVI::ExcludedBy one = {out[n].type, out[n].mask, out[n].molecule};
      if (m < n) energy += contact(laws, one, out[n].x, out[n].v, out[m]);
    });
  }
  return energy;
}

void HVILeavers::fractional(const double *x, double *s) const
{
  if (domain->triclinic)
    domain->x2lamda(const_cast<double *>(x), s);
  else
    for (int k = 0; k < 3; k++) s[k] = (x[k] - domain->boxlo[k]) / domain->prd[k];
}

/* ----------------------------------------------------------------------
   bonds by record: with newton_bond off a bond has one at either end, each
   worth half; one that delete_bonds has turned off has no energy.  The atom map may be gone: fix balance migrates particles first.
------------------------------------------------------------------------- */

double HVILeavers::tear_bonds(const HVITorn &laws, bigint &nrecords)
{
  const double share = force->newton_bond ? 1.0 : 0.5;
  double energy = 0.0;
  bigint nrecords_here = 0;

  std::unordered_map<tagint, const Leaver *> leaver;
  for (const Leaver &l : out) leaver[l.tag] = &l;

  // records of those who stay

  std::unordered_map<tagint, int> stayer;
  for (const int i : near) {
    stayer[atom->tag[i]] = i;
    for (int n = 0; n < atom->num_bond[i];) {
      const auto it = leaver.find(atom->bond_atom[i][n]);
      if (it == leaver.end()) {
        n++;
        continue;
      }
      const int btype = atom->bond_type[i][n];
      if (btype > 0) energy += share * spring(laws, btype, atom->x[i], atom->v[i], *it->second);
      const int last = --atom->num_bond[i];
      atom->bond_atom[i][n] = atom->bond_atom[i][last];
      atom->bond_type[i][n] = atom->bond_type[i][last];
      nrecords_here++;
    }
  }

  // records of those who leave: the owner knows of a partner that leaves too where it is, else the
  // partner's owner does

  for (const LeaverBond &b : bonds) {
    const Leaver &l = *leaver[b.tag];
    const bool own = l.rank == comm->me;
    const auto other = leaver.find(b.partner);
    const auto it = stayer.find(b.partner);
    nrecords_here += own;
    if (b.type <= 0) continue;
    if (other != leaver.end()) {
      if (own) energy += share * spring(laws, b.type, other->second->x, other->second->v, l);
    } else if (it != stayer.end())
      energy += share * spring(laws, b.type, atom->x[it->second], atom->v[it->second], l);
  }

  MPI_Allreduce(&nrecords_here, &nrecords, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  return energy;
}

/* ----------------------------------------------------------------------
   as fix evaporate does
------------------------------------------------------------------------- */

void HVILeavers::remove()
{
  for (int n = (int) leaving.size() - 1; n >= 0; n--) {
    atom->avec->copy(atom->nlocal - 1, leaving[n], 1);
    atom->nlocal--;
  }
  atom->natoms -= number;
  if (atom->map_style != Atom::MAP_NONE) {
    atom->nghost = 0;
    atom->map_init();
    atom->map_set();
  }
}
