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
#include "error.h"
#include "fix_hvi_johnson_cook.h"
#include "fix_hvi_ledger.h"
#include "fix_hvi_lists.h"
#include "fix_hvi_sph.h"
#include "force.h"
#include "hvi_interface.h"
#include "hvi_sph_report.h"
#include "math_special.h"
#include "memory.h"
#include "modify.h"
#include "neigh_list.h"
#include "neighbor.h"
#include "update.h"

#include <cmath>
#include <cstring>
#include <map>
#include <string>

using namespace LAMMPS_NS;

static constexpr double SKIN_OF_SPACING = 0.7;    // see choose_skin()

/* ---------------------------------------------------------------------- */

PairHVISPH::PairHVISPH(LAMMPS *lmp) :
    Pair(lmp), own_skin(0.0), visc_a(nullptr), visc_b(nullptr), tension(nullptr), ratio(nullptr),
    weight(nullptr), store(nullptr), integrator(nullptr), lists(nullptr), mesh(nullptr),
    strength(nullptr), placed(false), fastest(0.0), alone(0.0), narrowest(HVI::NO_BOUND), halo()
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

/* ----------------------------------------------------------------------
   Records are filled, of owned particles, ghosts and images; one sweep over the half list, or two
   with communication in between; what happened to images and ghosts goes to their owners.
------------------------------------------------------------------------- */

void PairHVISPH::compute(int eflag, int vflag)
{
  ev_init(eflag, vflag);

  HVI::SphFields &fields = store->fields;
  const bool mirrored = set.mirror.planes;
  if (neighbor->ago == 0) find_neighbors();
  if (mirrored) find_images();
  const int nrecords = mirrored ? MAX(atom->nmax, images.end()) : atom->nmax;
  fields.grow(nrecords, mirrored ? nrecords / 16 : 0);
  const HVI::SphView &records = fields.view();

  find_sleepers();
  if (strength) gather_stress();
  gather();
  choose_rows();
  if (records.art && !records.traction) artificial_stress();
  if (mirrored) images.fill(set.mirror, records);

  HVI::SphWork work = {
      records,    {(int) rows.size(), rows.data(), list->numneigh, list->firstneigh},
      set.laws,   visc_a,
      visc_b,     tension,
      ratio,      weight,
      atom->type, mirrored ? &images : nullptr,
      &kept,      fields.embedded.empty() ? nullptr : fields.embedded.data(),
      this,       evflag != 0,
      fastest};
  if (records.traction) work.laws.half = 0.5 * integrator->step();
  if (sweeps->has_first()) {
    sweeps->first(work);
    if (mirrored) images.fold_sums(records);
    if (records.traction)
      finish_gradients();
    else
      finish_slopes();
    if (mirrored) images.fill_sums(records);
  }
  sweeps->forces(work);
  fastest = work.fastest /
      (0.5 * set.support);    // half of the reach stands for h, for all kernels alike
  alone /= 0.5 * set.support;

  if (mirrored) images.fold(records, force->newton_pair);
  scatter();
  if (records.gradv && force->newton_pair) {
    if (records.traction)
      reverse(records.rates, mesh ? HVI::SphRates::WITH_POWER : HVI::SphRates::FORCE);
    else
      reverse(records.gradv, HVI::SphGradV::SENT_PLAIN);
  }

  if (vflag_fdotr) virial_fdotr_compute();
}

/* ---------------------------------------------------------------------- */

void PairHVISPH::tally(int i, int n, const HVI::SphNear &near, bool vectors)
{
  const int nlocal = atom->nlocal, newton_pair = force->newton_pair;
  for (int m = 0; m < n; m++) {
    const int j = near.j[m];
    const double d[3] = {near.d[m][0], near.d[m][1], near.d[m][2]};
    if (set.mirror.planes && images.is_image(j)) {
      double f[3] = {near.fx[m], near.fy[m], near.fz[m]};
      if (!vectors)
        for (int k = 0; k < 3; k++) f[k] = near.force[m] * d[k];
      tally_image(i, j, f, d);
    } else if (vectors)
      ev_tally_xyz(i, j, nlocal, newton_pair, 0.0, 0.0, near.fx[m], near.fy[m], near.fz[m], d[0],
                   d[1], d[2]);
    else
      ev_tally(i, j, nlocal, newton_pair, 0.0, 0.0, near.force[m], d[0], d[1], d[2]);
  }
}

/* ----------------------------------------------------------------------
   A pair with an image counts for the virial as the halves of it and of its image on
   this side: f.d of either particle.  With its own image a particle has one half.
------------------------------------------------------------------------- */

void PairHVISPH::tally_image(int i, int a, const double *f, const double *d)
{
  const int nlocal = atom->nlocal, newton = force->newton_pair;
  ev_tally_xyz(i, i, nlocal, newton, 0.0, 0.0, 0.5 * f[0], 0.5 * f[1], 0.5 * f[2], d[0], d[1],
               d[2]);
  if (images.is_own(a)) return;
  const int owner = images.owner(a);
  const HVI::Reflection reflect(images.operation(a));
  const double *const s = reflect.s;
  ev_tally_xyz(owner, owner, nlocal, newton, 0.0, 0.0, 0.5 * s[0] * f[0], 0.5 * s[1] * f[1],
               0.5 * s[2] * f[2], s[0] * d[0], s[1] * d[1], s[2] * d[2]);
}

/* ---------------------------------------------------------------------- */

void PairHVISPH::overlap(int i, int j)
{
  const int other = set.mirror.planes && images.is_image(j) ? images.owner(j) : j;
  error->one(FLERR, "Pair hvi/sph: particles {} and {} are at the same place at step {}",
             atom->tag[i], atom->tag[other], update->ntimestep);
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

  store = FixHVIStore::instance(lmp);
  FixHVILedger::instance(lmp);    // fix hvi/sph cannot make it: a fix must not add fixes
  const auto integrators = modify->get_fix_by_style("^hvi/sph$");
  integrator = integrators.empty() ? nullptr : dynamic_cast<FixHVISPH *>(integrators[0]);
  lists = FixHVILists::make(lmp, !integrator || integrator->relative_lists(), false);
  strength = FixHVIJohnsonCook::find(lmp);
  mesh = HVI::find_mesh(lmp);
  if (!mesh) {
    store->fields.embedded.clear();
    store->fields.idle.clear();
  }

  const int ntypes = atom->ntypes;
  is_ours.assign(ntypes + 1, 0);
  for (int i = 1; i <= ntypes; i++) is_ours[i] = set.h[i] > 0.0 && store->materials.of(i);
  choose_skin();
  check_fixes();
  check_materials();
  check_mirror();

  set.whole = strength && set.gradient == HVI::SphSettings::CORRECTED;
  sweeps = HVI::make_sph_sweeps(set.kernel, choose_scene());
  store->fields.settings = set;
  store->fields.choose(set.riemann && !set.whole, strength != nullptr, set.laws.art_eps > 0.0,
                       set.whole, sweeps->scene() & HVI::SPH_BODIES);
  kept = HVI::SphKept();
  find_quiet();

  // pair_style hybrid looks at these in settings() only, and sizes the buffers

  comm_forward = set.whole
      ? HVI::SphTraction::SENT
      : (strength ? HVI::SphStress::SENT : (set.riemann ? HVI::SphSlopes::SENT : 0));
  comm_reverse = set.whole
      ? HVI::SphGradV::SENT
      : (strength ? HVI::SphGradV::SENT_PLAIN : (set.riemann ? HVI::SphSlopes::SENT : 0));
  force->pair->comm_forward = MAX(force->pair->comm_forward, comm_forward);
  force->pair->comm_reverse = MAX(force->pair->comm_reverse, comm_reverse);
  neighbor->add_request(this);
}

/* ----------------------------------------------------------------------
   The skin that LAMMPS has by default for the units, 1 mm in SI, is no choice of anybody for
   particles of these spacings.  Any other is the user's.
------------------------------------------------------------------------- */

void PairHVISPH::choose_skin()
{
  static const std::map<std::string, double> DEFAULTS = {
      {"lj", 0.3}, {"si", 0.001}, {"cgs", 0.1}, {"micro", 0.1}, {"nano", 0.1}};
  const auto units = DEFAULTS.find(update->unit_style);
  if (units == DEFAULTS.end() || force->pair != this) return;
  if (neighbor->skin != units->second && neighbor->skin != own_skin) return;
  double widest = 0.0;
  for (int i = 1; i <= atom->ntypes; i++) {
    if (is_ours[i] && spacings[i] == 0.0) return;
    if (is_ours[i]) widest = MAX(widest, spacings[i]);
  }
  if (widest > 0.0) neighbor->skin = own_skin = SKIN_OF_SPACING * widest;
}

/* ----------------------------------------------------------------------
   what pairs differ in, and which terms they have: bits of SphScene
------------------------------------------------------------------------- */

int PairHVISPH::choose_scene()
{
  int scene = set.riemann ? HVI::SPH_RIEMANN : (set.density ? HVI::SPH_DENSITY : 0);
  if (strength) scene |= HVI::SPH_STRENGTH;
  if (set.laws.art_eps > 0.0) scene |= HVI::SPH_ARTSTRESS;
  if (set.whole) scene |= HVI::SPH_CORRECTED;
  if (set.whole && strength->can_fail()) scene |= HVI::SPH_BODIES;
  if (set.variable) scene |= HVI::SPH_OWN_H;
  int first = 0;
  for (int i = 1; i <= atom->ntypes; i++) {
    if (!is_ours[i]) continue;
    if (!first) first = i;
    if (set.h[i] != set.h[first]) scene |= HVI::SPH_OWN_H;
    for (int j = 1; j <= atom->ntypes; j++)
      if (is_ours[j] &&
          (tension[i][j] == 0.0 || visc_a[i][j] != visc_a[first][first] ||
           visc_b[i][j] != visc_b[first][first]))
        scene |= HVI::SPH_BODIES;
  }
  if (first) {
    set.laws.h = set.h[first];
    set.laws.a = visc_a[first][first];
    set.laws.b = visc_b[first][first];
  }
  if (set.riemann && !set.whole && find_weights()) scene |= HVI::SPH_SPACINGS;
  return scene;
}

/* ----------------------------------------------------------------------
   By how much a particle counts more than another in the density of that, with dissipation riemann: the
   ratio of their volumes, of those at rho0 if both have one.  A gas has none: what is large
   because it is thin now will be as small as others of its mass when pressures are even.  So of
   volumes, by h, and masses that ratio counts which is nearer to 1; and 1 if they do not agree
   on who is larger.  Volumes that nearly agree are the same.  Kernels between types are as wide
   as the mean of both h at the start.  Returns whether types differ.
------------------------------------------------------------------------- */

bool PairHVISPH::find_weights()
{
  static constexpr double SAME = 0.01;
  bool differ = false;
  for (int i = 1; i <= atom->ntypes; i++) {
    if (!is_ours[i]) continue;
    ratio[i][i] = weight[i][i] = 1.0;
    for (int j = i + 1; j <= atom->ntypes; j++) {
      if (!is_ours[j]) continue;
      ratio[i][j] = set.h[j] / set.h[i];
      double w = MathSpecial::powint(ratio[i][j], set.laws.dim);
      if (!atom->rmass) {
        const double rho_i = store->materials.of(i)->eos->rho0();
        const double rho_j = store->materials.of(j)->eos->rho0();
        const double masses = atom->mass[j] / atom->mass[i];
        w = rho_i > 0.0 && rho_j > 0.0 ? masses * rho_i / rho_j
                                       : MAX(MIN(w, masses), MIN(1.0, MAX(w, masses)));
      }
      if (std::fabs(std::log(w)) < SAME) w = 1.0;
      weight[i][j] = w;
      weight[j][i] = 1.0 / w;
      ratio[j][i] = 1.0 / ratio[i][j];
      if (ratio[i][j] != 1.0 || w != 1.0) differ = true;
    }
  }
  return differ;
}

/* ----------------------------------------------------------------------
   the largest h, at the start, of a kernel by which particles of two types see each other
------------------------------------------------------------------------- */

double PairHVISPH::widest(int i, int j) const
{
  const double h_i = set.h[i], h_j = set.h[j];
  if (set.whole) return MAX(h_i, h_j);
  if (!set.riemann) return 0.5 * (h_i + h_j);
  return 0.5 * MAX((1.0 + ratio[i][j]) * h_i, (1.0 + ratio[j][i]) * h_j);
}

/* ----------------------------------------------------------------------
   the list reaches as far as the largest h, so that it stays valid while h changes
------------------------------------------------------------------------- */

double PairHVISPH::init_one(int i, int j)
{
  for (const int itype : {i, j}) {
    if (mesh && mesh->is_node(itype)) return 0.0;
    if (!is_ours[itype]) error->all(FLERR, "Pair style hvi/sph: type {} has no material", itype);
  }
  return set.support * (set.variable ? set.hmax : 1.0) * widest(i, j);
}

/* ---------------------------------------------------------------------- */

void PairHVISPH::setup()
{
  check_places();
  check_sides();
  check_extent();
  warn();

  HVISphReport report(lmp, store, is_ours);
  report.widest = [this](int i, int j) {
    return widest(i, j);
  };
  if (sweeps->scene() & HVI::SPH_SPACINGS) report.weight = weight;
  report.forward = comm_forward;
  report.reverse = force->newton_pair ? comm_reverse : 0;
  if (set.whole) {
    const bool bodies = sweeps->scene() & HVI::SPH_BODIES;
    report.forward += HVI::SphStress::LIMITS;
    if (set.laws.art_eps > 0.0) report.forward += HVI::SphStress::FIRST_LIMIT;
    if (bodies) report.forward += HVI::SphPush::SENT;
    if (set.riemann) report.forward += HVI::SphGradV::SENT_L;
    if (bodies) report.reverse *= 2;
    if (force->newton_pair) report.reverse += HVI::SphRates::FORCE;
  }
  if (lists->in_charge()) report.forward += FixHVILists::SENT;
  if (integrator) {
    report.border = 1;
    report.kept_bytes += integrator->bytes_per_particle();
    report.unmoved.resize(atom->nlocal);
    for (int i = 0; i < atom->nlocal; i++) report.unmoved[i] = integrator->is_new(i);
  }
  if (strength) {
    report.solid = true;
    report.kept_bytes += strength->bytes_per_particle();
    for (int i = 1; i <= atom->ntypes; i++) report.laws[i] = strength->laws_of(i);
  }
  report.count({list->inum, list->ilist, list->numneigh, list->firstneigh}, force->newton_pair);
  report.write();
  report.warn();
}

/* ---------------------------------------------------------------------- */

double PairHVISPH::memory_usage()
{
  return kept.bytes() + has_neighbor.capacity();    // records are the store's
}
