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
#include "fix_hvi_lists.h"
#include "fix_hvi_sph.h"
#include "force.h"
#include "hvi_anew.h"
#include "hvi_cite.h"
#include "hvi_kernel.h"
#include "hvi_material_file.h"
#include "hvi_mesh.h"
#include "hvi_restart.h"
#include "hvi_scheme_riemann.h"
#include "hvi_scheme_solid.h"
#include "hvi_sph_report.h"
#include "math_special.h"
#include "memory.h"
#include "modify.h"
#include "neigh_list.h"
#include "neighbor.h"
#include "tokenizer.h"
#include "update.h"

#include <cmath>
#include <cstring>
#include <map>
#include <string>

using namespace LAMMPS_NS;

static constexpr double BIG = 1.0e100;
static constexpr int RESTART_FORMAT = 1;
static constexpr char WHOSE[] = "Pair hvi/sph";
static constexpr double SKIN_OF_SPACING = 0.7;           // see choose_skin()
static constexpr char OWNER[] = "pair style hvi/sph";    // of materials
static constexpr double FAR_MASS = 1.5;        // times that of the spacing: another material's
static constexpr double H_OF_SPACING = 1.2;    // smoothing length in spacings: see Howto_choose

/* ---------------------------------------------------------------------- */

PairHVISPH::PairHVISPH(LAMMPS *lmp) :
    Pair(lmp), own_skin(0.0), visc_a(nullptr), visc_b(nullptr), tension(nullptr), store(nullptr),
    integrator(nullptr), lists(nullptr), strength(nullptr)
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
  HVI::run_anew(update);
  deallocate();
}

/* ---------------------------------------------------------------------- */

void PairHVISPH::allocate()
{
  allocated = 1;
  const int np1 = atom->ntypes + 1;

  memory->create(setflag, np1, np1, "pair:setflag");
  memory->create(cutsq, np1, np1, "pair:cutsq");
  memory->create(visc_a, np1, np1, "pair:visc_a");
  memory->create(visc_b, np1, np1, "pair:visc_b");
  memory->create(tension, np1, np1, "pair:tension");
  for (int i = 0; i < np1; i++)
    for (int j = 0; j < np1; j++) {
      setflag[i][j] = 0;
      cutsq[i][j] = 0.0;    // pairs of other styles in a hybrid
      visc_a[i][j] = set.laws.a;
      visc_b[i][j] = set.laws.b;
      tension[i][j] = (i == j || set.laws.stock) ? 1.0 : 0.0;
    }
  specs.assign(np1, "");
  spacings.assign(np1, 0.0);
  own_mass.resize(np1, 0.0);    // masses stay when the style is given again
  set.h.assign(np1, 0.0);
  store = FixHVIStore::instance(lmp);
  store->materials.forget(OWNER);    // of an earlier pair style of this name
}

/* ---------------------------------------------------------------------- */

void PairHVISPH::deallocate()
{
  if (!allocated) return;
  memory->destroy(setflag);
  memory->destroy(cutsq);
  memory->destroy(visc_a);
  memory->destroy(visc_b);
  memory->destroy(tension);
  allocated = 0;
}

/* ---------------------------------------------------------------------- */

void PairHVISPH::settings(int narg, char **arg)
{
  HVI::run_anew(update);
  if (narg < 1)
    error->all(
        FLERR,
        "Pair_style hvi/sph needs a kernel: one of {} (in pair_style hybrid gauss, which is a "
        "pair style, too, is gaussian)",
        HVI::kernel_names());
  deallocate();    // new settings, for instance after read_restart, ask for new coefficients

  set = HVI::SphSettings();
  HVI::SphLaws &laws = set.laws;
  laws.dim = domain->dimension;
  laws.a = 1.0;
  laws.b = 2.0;
  int form_given = 0, viscosity_given = 0;

  set.kernel = arg[0];
  if (set.kernel == "gaussian")
    set.kernel = "gauss";    // pair style hybrid takes gauss for a pair style
  const HVI::KernelFunctions *const kernel = HVI::find_kernel(set.kernel);
  if (!kernel)
    error->all(FLERR, "Unknown pair_style hvi/sph kernel {}: use one of {}", set.kernel,
               HVI::kernel_names());
  set.support = kernel->support;

  int iarg = 1;
  auto need = [&](int n) {
    if (iarg + n >= narg)
      utils::missing_cmd_args(FLERR, fmt::format("pair_style hvi/sph {}", arg[iarg]), error);
  };
  auto number = [&](int k, double lo) {
    const double value = utils::numeric(FLERR, arg[iarg + k], false, lmp);
    if (!(value >= lo) || !std::isfinite(value))
      error->all(FLERR, "Pair_style hvi/sph {} must be >= {}, not {}", arg[iarg], lo,
                 arg[iarg + k]);
    return value;
  };

  while (iarg < narg) {
    const std::string key = arg[iarg];
    if (key == "dim") {
      need(1);
      laws.dim = utils::inumeric(FLERR, arg[iarg + 1], false, lmp);
      if (laws.dim < 1 || laws.dim > domain->dimension)
        error->all(FLERR, "Pair_style hvi/sph dim must be 1 to {} in a box of dimension {}, not {}",
                   domain->dimension, domain->dimension, arg[iarg + 1]);
      iarg += 2;
    } else if (key == "form") {
      need(1);
      const std::string form = arg[iarg + 1];
      if (form != "sum" && form != "symmetric")
        error->all(FLERR, "Pair_style hvi/sph form must be sum or symmetric, not {}", form);
      laws.symmetric = form == "symmetric";
      form_given = 1;
      iarg += 2;
    } else if (key == "viscosity") {
      need(2);
      laws.a = number(1, 0.0);
      laws.b = number(2, 0.0);
      viscosity_given = 1;
      iarg += 3;
    } else if (key == "interface") {
      need(1);
      laws.automatic = strcmp(arg[iarg + 1], "auto") == 0;
      laws.alpha = laws.automatic ? 0.0 : number(1, 0.0);
      set.density = laws.automatic || laws.alpha > 0.0;
      iarg += 2;
    } else if (key == "dissipation") {
      need(1);
      const std::string name = arg[iarg + 1];
      if (name != "monaghan" && name != "riemann")
        error->all(FLERR, "Pair_style hvi/sph dissipation must be monaghan or riemann, not {}",
                   name);
      set.riemann = name == "riemann";
      iarg += 2;
    } else if (key == "gradient") {
      need(1);
      const std::string name = arg[iarg + 1];
      if (name == "plain" || name == "law")
        error->all(FLERR,
                   "Pair style hvi/sph: gradient plain and gradient law were removed: leave the "
                   "word out, for solids have corrected gradients");
      if (name != "corrected")
        error->all(FLERR, "Pair_style hvi/sph gradient must be corrected, not {}", name);
      iarg += 2;
    } else if (key == "artstress") {
      need(2);
      laws.art_eps = number(1, 0.0);
      laws.art_n = number(2, 0.0);
      if (!(laws.art_n > 0.0 && laws.art_n <= 50.0))
        error->all(FLERR, "Pair_style hvi/sph artstress needs 0 < n <= 50, not {}", arg[iarg + 2]);
      iarg += 3;
    } else if (key == "h") {
      need(1);
      const std::string mode = arg[iarg + 1];
      if (mode != "constant" && mode != "variable")
        error->all(FLERR, "Pair_style hvi/sph h must be constant or variable, not {}", mode);
      set.variable = mode == "variable";
      iarg += 2;
      if (set.variable && iarg < narg && utils::is_double(arg[iarg])) {
        iarg -= 2;
        need(3);
        set.hmin = number(2, 0.0);
        set.hmax = number(3, 0.0);
        if (!(set.hmin > 0.0 && set.hmin <= 1.0 && set.hmax >= 1.0))
          error->all(FLERR, "Pair_style hvi/sph h variable needs 0 < hmin <= 1 <= hmax, not {} {}",
                     arg[iarg + 2], arg[iarg + 3]);
        iarg += 4;
      }
    } else if (key == "mirror") {
      need(3);
      const std::string direction = arg[iarg + 1], which = arg[iarg + 3];
      const int k = direction.size() == 1 ? direction[0] - 'x' : -1;
      if (k < 0 || k > 2)
        error->all(FLERR, "Pair_style hvi/sph mirror must be x, y or z, not {}", direction);
      if (set.mirror.has(k))
        error->all(FLERR, "Pair_style hvi/sph has more than one mirror {}", direction);
      if (which != "lo" && which != "hi")
        error->all(FLERR, "Pair_style hvi/sph mirror {} must be lo or hi, not {}", direction,
                   which);
      set.mirror.planes |= 1 << k;
      set.mirror.at[k] = utils::numeric(FLERR, arg[iarg + 2], false, lmp);
      if (!std::isfinite(set.mirror.at[k]))
        error->all(FLERR, "Pair_style hvi/sph mirror {} must be at a number, not {}", direction,
                   arg[iarg + 2]);
      set.mirror.side[k] = which == "lo" ? 1.0 : -1.0;
      iarg += 4;
    } else if (key == "energy") {
      need(1);
      set.energy = utils::logical(FLERR, arg[iarg + 1], false, lmp);
      iarg += 2;
    } else if (key == "stock") {
      need(1);
      laws.stock = utils::logical(FLERR, arg[iarg + 1], false, lmp);
      iarg += 2;
    } else
      error->all(FLERR, "Unknown pair_style hvi/sph keyword: {}", key);
  }

  if (set.riemann && (viscosity_given || set.density || laws.symmetric || laws.stock))
    error->all(FLERR,
               "Pair_style hvi/sph dissipation riemann takes the place of viscosity and interface, "
               "and has its own form of the equations: do not give viscosity, interface, form "
               "symmetric or stock yes with it");
  if (laws.stock) {
    if (set.kernel != "lucy" || set.variable || set.density || !set.energy ||
        laws.dim != domain->dimension || laws.dim < 2 || (form_given && !laws.symmetric))
      error->all(FLERR,
                 "Pair_style hvi/sph stock yes does what the package SPH does: kernel lucy, form "
                 "symmetric, dim of the box, constant h, energy yes, no interface dissipation");
    laws.symmetric = 1;
  }
  HVI::cite(lmp->citeme, set.density ? HVI::CITE_ZISIS : nullptr);
  laws.norm = kernel->norm[laws.dim - 1];
  no_virial_fdotr_compute = set.mirror.planes ? 1 : 0;    // planes push, too
  set.text =
      fmt::format("{} dim {} form {} h {}{}", set.kernel, laws.dim,
                  laws.symmetric ? "symmetric" : "sum", set.variable ? "variable" : "constant",
                  laws.stock ? " stock yes" : (set.riemann ? " dissipation riemann" : ""));
  for (int k = 0; k < 3; k++)
    if (set.mirror.has(k))
      set.text += fmt::format(" mirror {} {} {}", "xyz"[k], set.mirror.at[k],
                              set.mirror.side[k] > 0.0 ? "lo" : "hi");
  if (laws.art_eps > 0.0) set.text += fmt::format(" artstress {} {}", laws.art_eps, laws.art_n);
}

/* ----------------------------------------------------------------------
   I J MATERIAL h H | spacing A  |  I J tension yes|no viscosity a b
------------------------------------------------------------------------- */

void PairHVISPH::coeff(int narg, char **arg)
{
  HVI::run_anew(update);
  if (narg < 3) utils::missing_cmd_args(FLERR, "pair_coeff hvi/sph", error);
  if (!allocated) allocate();

  int ilo, ihi, jlo, jhi;
  utils::bounds(FLERR, arg[0], 1, atom->ntypes, ilo, ihi, error);
  utils::bounds(FLERR, arg[1], 1, atom->ntypes, jlo, jhi, error);

  const std::vector<std::string> words(arg + 2, arg + narg);
  if (words[0] == "file" || words[0] == "eos") {
    set_material(ilo, ihi, jlo, jhi, words, false);
    return;
  }

  // of fix hvi/fem, which LAMMPS need not ask for anything else of

  if (words[0] == "nodes") {
    if (words.size() > 1 || ilo != jlo || ihi != jhi)
      error->all(FLERR, "Pair_coeff hvi/sph nodes is for single types: pair_coeff I I nodes");
    for (int i = ilo; i <= ihi; i++) {
      if (set.h[i] > 0.0) error->all(FLERR, "Pair_coeff hvi/sph nodes: type {} has a material", i);
      setflag[i][i] = 1;
    }
    return;
  }

  for (std::size_t n = 0; n < words.size();) {
    const std::string &key = words[n];
    const std::size_t nvalues = key == "tension" ? 1 : 2;
    if (key != "tension" && key != "viscosity")
      error->all(
          FLERR,
          "Unknown pair_coeff hvi/sph keyword: {} (use file NAME spacing A, eos STYLE ARGS h H, "
          "nodes, tension yes|no or viscosity a b)",
          key);
    if (n + nvalues >= words.size())
      utils::missing_cmd_args(FLERR, fmt::format("pair_coeff hvi/sph {}", key), error);

    double value[2] = {0.0, 0.0};
    if (key == "tension")
      value[0] = utils::logical(FLERR, words[n + 1], false, lmp);
    else
      for (int k = 0; k < 2; k++) {
        value[k] = utils::numeric(FLERR, words[n + 1 + k], false, lmp);
        if (!(value[k] >= 0.0) || !std::isfinite(value[k]))
          error->all(FLERR, "Pair_coeff hvi/sph viscosity must be >= 0, not {}", words[n + 1 + k]);
      }

    int count = 0;
    for (int i = ilo; i <= ihi; i++)
      for (int j = MAX(jlo, i); j <= jhi; j++) {
        if (key == "tension") {
          if (i == j) {
            if (ilo == ihi && jlo == jhi)
              error->all(FLERR, "Pair_coeff hvi/sph tension is for pairs of different types");
            continue;
          }
          tension[i][j] = tension[j][i] = value[0];
        } else {
          visc_a[i][j] = visc_a[j][i] = value[0];
          visc_b[i][j] = visc_b[j][i] = value[1];
        }
        if (i != j) setflag[i][j] = 1;
        count++;
      }
    if (count == 0)
      error->all(FLERR, "Incorrect args for pair coefficients: no type pair with I <= J in {} {}",
                 arg[0], arg[1]);
    n += 1 + nvalues;
  }
}

/* ---------------------------------------------------------------------- */

void PairHVISPH::set_material(int ilo, int ihi, int jlo, int jhi,
                              const std::vector<std::string> &words, bool restored)
{
  store = FixHVIStore::instance(lmp);    // unfix may have taken the one there was

  // after the material: h and its value; what a particle's volume is to be at rest; that it is a liquid

  const std::size_t nwords = words.size();
  auto made = std::make_shared<HVI::Material>();
  std::size_t used;
  if (words[0] == "file") {
    if (nwords < 2) utils::missing_cmd_args(FLERR, "pair_coeff hvi/sph file", error);
    *made = HVI::read_material_file(lmp, words[1]);
    used = 2;
  } else if (nwords > 1 && words[1] == HVI::EOS_TABLE) {
    if (nwords < 3) utils::missing_cmd_args(FLERR, "pair_coeff hvi/sph eos table", error);
    made->name = words[2];
    made->eos = HVI::read_table_file(lmp, words[2], made->checksum);
    used = 3;
  } else {
    if (nwords < 2) utils::missing_cmd_args(FLERR, "pair_coeff hvi/sph eos", error);
    const int nargs = HVI::eos_nargs(words[1]);
    if (nargs < 0)
      error->all(FLERR, "Unknown equation of state {} in pair_coeff hvi/sph: use one of {}",
                 words[1], HVI::eos_names());
    std::vector<double> args;
    for (int k = 2; k < 2 + nargs; k++) {
      const std::string word = k < (int) nwords ? words[k] : "";
      if (!utils::is_double(word))
        error->all(FLERR, "Pair_coeff hvi/sph eos {} needs {}{}", words[1], HVI::eos_args(words[1]),
                   word.empty() ? word : ", not " + word);
      args.push_back(utils::numeric(FLERR, word, false, lmp));
    }
    std::string problem;
    made->name = words[1];
    made->eos = HVI::make_eos(words[1], args, problem);
    if (!made->eos) error->all(FLERR, "Pair_coeff hvi/sph eos {}: {}", words[1], problem);
    used = 2 + nargs;
  }

  if (used >= nwords || (words[used] != "h" && words[used] != "spacing"))
    error->all(FLERR,
               "Pair_coeff hvi/sph: after the material must come h or spacing and its value{}",
               used < nwords ? ", not " + words[used] : std::string());
  double h = 0.0, spacing = 0.0, volume = 0.0;
  const std::map<std::string, double *> lengths = {
      {"h", &h}, {"spacing", &spacing}, {"volume", &volume}};
  while (used < nwords) {
    const std::string &key = words[used];
    const auto found = lengths.find(key);
    const bool liquid = key == "strength";
    if (liquid ? made->liquid : (found == lengths.end() || *found->second > 0.0)) break;
    if (used + 2 > nwords)
      utils::missing_cmd_args(FLERR, fmt::format("pair_coeff hvi/sph {}", key), error);
    if (liquid) {
      if (words[used + 1] != "none")
        error->all(FLERR,
                   "Pair_coeff hvi/sph strength must be none, not {}: laws of strength are chosen "
                   "by fix hvi/johnson-cook",
                   words[used + 1]);
      made->liquid = true;
    } else {
      double &value = *found->second;
      value = utils::numeric(FLERR, words[used + 1], false, lmp);
      if (!(value > 0.0) || !std::isfinite(value))
        error->all(FLERR, "Pair_coeff hvi/sph {} must be > 0, not {}", key, words[used + 1]);
    }
    used += 2;
  }
  if (used < nwords)
    error->all(FLERR, "Pair_coeff hvi/sph: unexpected {} after {} {}", words[used], words[used - 2],
               words[used - 1]);
  if ((volume > 0.0 || spacing > 0.0) && !(made->eos->rho0() > 0.0))
    error->all(FLERR, "Pair_coeff hvi/sph {}: {} has no density at rest",
               volume > 0.0 ? "volume" : "spacing", made->name);
  if (h == 0.0) h = H_OF_SPACING * spacing;
  const bool keeps_mass = volume == 0.0;    // that the type has from a data file, say
  if (keeps_mass && spacing > 0.0) volume = MathSpecial::powint(spacing, set.laws.dim);

  std::string spec;    // a word in each line, as names of files may have blanks
  for (std::size_t n = 0; n < nwords; n++) spec += (n ? "\n" : "") + words[n];

  int count = 0;
  for (int i = ilo; i <= ihi; i++) {
    if (i < jlo || i > jhi) continue;
    store->materials.set(i, {made, OWNER, volume, restored});
    specs[i] = spec;
    set.h[i] = h;
    spacings[i] = spacing;
    const bool other = atom->mass && atom->mass_setflag[i] && atom->mass[i] != own_mass[i];
    if (restored || !atom->mass || volume == 0.0) {
      count++;
      continue;
    }
    const double mass = made->eos->rho0() * volume;
    if (!keeps_mass || !other) {
      own_mass[i] = mass;
      atom->set_mass(FLERR, i, mass);
    } else if (comm->me == 0 &&
               !(atom->mass[i] < FAR_MASS * mass && mass < FAR_MASS * atom->mass[i]))
      error->warning(
          FLERR,
          "Pair_coeff hvi/sph: type {} keeps its mass {:.6g}, that of {} at a spacing of "
          "{:.6g} is {:.6g}: if it is of another material, give it again by mass",
          i, atom->mass[i], made->name, spacing, mass);
    count++;
  }
  if (count == 0)
    error->all(FLERR,
               "Pair_coeff hvi/sph: a material is given to types I I, not to pairs of types");
  for (int i = ilo; i <= ihi; i++)
    for (int j = MAX(jlo, i); j <= jhi; j++) setflag[i][j] = 1;
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
  HVI::check_types(lmp);
  HVI::check_ghosts(lmp);
  if (store && modify->nfix_restart_peratom > 0) store->has_forgotten = true;

  store = FixHVIStore::instance(lmp);
  FixHVILedger::instance(lmp);    // fix hvi/sph cannot make it: a fix must not add fixes
  const auto integrators = modify->get_fix_by_style("^hvi/sph$");
  integrator = integrators.empty() ? nullptr : dynamic_cast<FixHVISPH *>(integrators[0]);
  lists = FixHVILists::make(lmp, !integrator || integrator->relative_lists(), false);
  strength = FixHVIJohnsonCook::find(lmp);
  if (HVI::Mesh *const mesh = HVI::find_mesh(lmp)) {
    mesh->give_masses();
  } else {
    store->fields.embedded.clear();
    store->fields.idle.clear();
  }

  const int ntypes = atom->ntypes;
  is_ours.assign(ntypes + 1, 0);
  looked_for.resize(ntypes + 1, 0);
  for (int i = 1; i <= ntypes; i++) is_ours[i] = set.h[i] > 0.0 && store->materials.of(i);
  choose_skin();
  check_fixes();
  check_materials();
  check_mirror();

  set.solid = strength != nullptr;
  store->fields.settings = set;
  const HVIPairTables tables = {this, this, visc_a, visc_b, tension, is_ours, integrator, lists};
  if (set.solid)
    scheme = std::make_unique<HVISchemeSolid>(lmp, tables);
  else if (set.riemann)
    scheme = std::make_unique<HVISchemeRiemann>(lmp, tables);
  else
    scheme = std::make_unique<HVISchemeFluid>(lmp, tables);

  // pair_style hybrid looks at these in settings() only, and sizes the buffers

  comm_forward = scheme->traffic().forward;
  comm_reverse = scheme->traffic().reverse;
  force->pair->comm_forward = MAX(force->pair->comm_forward, comm_forward);
  force->pair->comm_reverse = MAX(force->pair->comm_reverse, comm_reverse);
  double widest = 0.0;
  for (int i = 1; i <= ntypes; i++)
    if (is_ours[i]) widest = MAX(widest, reach(i, i));
  lists->keep_rows(lists->may_keep_rows(widest));

  // LAMMPS tells its users about the list, and makes it if a compute asks for one like it

  neighbor->add_request(this, lists->rows() ? NeighConst::REQ_OCCASIONAL : NeighConst::REQ_DEFAULT);
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
   the list reaches as far as the largest h, so that it stays valid while h changes
------------------------------------------------------------------------- */

double PairHVISPH::init_one(int i, int j)
{
  const HVI::Mesh *const mesh = HVI::find_mesh(lmp);
  for (const int itype : {i, j}) {
    if (mesh && mesh->is_node(itype)) return 0.0;
    if (!is_ours[itype]) error->all(FLERR, "Pair style hvi/sph: type {} has no material", itype);
  }
  return reach(i, j);
}

double PairHVISPH::reach(int i, int j) const
{
  return set.support * (set.variable ? set.hmax : 1.0) * scheme->widest(i, j);
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
    return scheme->widest(i, j);
  };
  report.weight = scheme->weights();
  report.vectors = scheme->vectors();
  const HVIScheme::Traffic traffic = scheme->traffic();
  report.forward = traffic.all_forward;
  report.reverse = force->newton_pair ? traffic.all_reverse : 0;
  if (lists->in_charge()) report.forward += FixHVILists::SENT;
  if (integrator) {
    report.border = 2;
    report.kept_bytes += integrator->bytes_per_particle();
    report.unmoved.resize(atom->nlocal);
    for (int i = 0; i < atom->nlocal; i++) report.unmoved[i] = integrator->is_new(i);
  }
  if (strength) {
    report.solid = true;
    report.kept_bytes += strength->bytes_per_particle();
    for (int i = 1; i <= atom->ntypes; i++) report.laws[i] = strength->laws_of(i);
  }
  report.count(scheme->all_pairs(), force->newton_pair);
  report.write();
  report.warn();
}

/* ---------------------------------------------------------------------- */

double PairHVISPH::memory_usage()
{
  return scheme ? scheme->bytes() : 0.0;
}

/* ---------------------------------------------------------------------- */

void PairHVISPH::check_fixes() const
{
  // hybrid/scaled, which would scale forces but neither rates of density nor of energy, is refused by LAMMPS

  if (utils::strmatch(force->pair_style, "^hybrid") &&
      force->pair_match("^hvi/sph$", 0, 1) != force->pair_match("^hvi/sph$", 0, 2))
    error->all(FLERR, "More than one pair style hvi/sph");

  // fix hvi/sph takes the density in forces for the one that it has extrapolated

  for (const char *const name : {"sph/rhosum", "mdpd/rhosum", "multi/lucy"})
    if (!set.laws.stock && force->pair_match(std::string("^") + name, 0, 1))
      error->all(FLERR,
                 "Pair style hvi/sph integrates density, which pair style {} writes over: leave it "
                 "out, or use stock yes",
                 name);
  if (set.variable && !integrator)
    error->all(FLERR, "Pair style hvi/sph h variable needs fix hvi/sph, which keeps h");
  if (strength && set.laws.symmetric)
    error->all(FLERR, "Pair style hvi/sph: fix hvi/johnson-cook works with form sum");
  if (set.laws.art_eps > 0.0 && !strength)
    error->all(FLERR,
               "Pair style hvi/sph artstress needs fix hvi/johnson-cook, which keeps the stress");
}

/* ---------------------------------------------------------------------- */

void PairHVISPH::check_materials() const
{
  const bool hybrid = utils::strmatch(force->pair_style, "^hybrid");
  const HVI::Mesh *const mesh = HVI::find_mesh(lmp);
  for (int i = 1; i <= atom->ntypes; i++) {
    if (!is_ours[i]) {
      if (hybrid || (mesh && mesh->is_node(i))) continue;
      error->all(FLERR, "Pair style hvi/sph: type {} has no material", i);
    }
    const HVI::Materials::Entry &entry = store->materials.entry(i);
    const std::string eos = entry.material->eos->name();
    if (set.laws.stock && eos != "tait" && eos != "idealgas")
      error->all(FLERR, "Pair style hvi/sph stock yes knows eos tait and idealgas only, not {}",
                 eos);
  }
}

/* ----------------------------------------------------------------------
   what may be meant: said at the start of a run, not whenever LAMMPS initializes
------------------------------------------------------------------------- */

void PairHVISPH::warn()
{
  std::vector<bigint> here(atom->ntypes + 1, 0), all(atom->ntypes + 1);    // particles
  for (int i = 0; i < atom->nlocal; i++) here[atom->type[i]]++;
  MPI_Allreduce(here.data(), all.data(), all.size(), MPI_LMP_BIGINT, MPI_SUM, world);
  if (comm->me != 0) return;
  const bool comes = HVI::find_mesh(lmp) || !modify->get_fix_by_style("^deposit").empty() ||
      !modify->get_fix_by_style("^pour").empty();
  const bool hybrid = utils::strmatch(force->pair_style, "^hybrid");
  for (int i = 1; i <= atom->ntypes; i++) {
    if (!is_ours[i] || looked_for[i]) continue;
    looked_for[i] = 1;
    if (all[i] == 0 && !comes)
      error->warning(
          FLERR,
          "Pair style hvi/sph: there are no particles of type {}, which has material {}: "
          "beside a lattice, regions are in its spacings unless they say units box",
          i, store->materials.of(i)->name);
    for (int j = 1; j <= atom->ntypes; j++)
      if (hybrid && is_ours[j] && looked_for[j] && all[i] && all[j] && cutsq[i][j] == 0.0)
        error->warning(
            FLERR,
            "Pair style hvi/sph: types {} and {} have materials but do not feel each "
            "other, as pair_coeff {} {} names other styles only: give it to hvi/sph, too",
            MIN(i, j), MAX(i, j), MIN(i, j), MAX(i, j));
  }
  if (!integrator && modify->get_fix_by_style("^sph").empty() &&
      modify->get_fix_by_style("meso").empty())
    error->warning(FLERR,
                   "Pair style hvi/sph: no fix integrates density and energy and estimates "
                   "velocities, as fix hvi/sph does");
  if (strength) return;
  for (int i = 1; i <= atom->ntypes; i++) {
    if (!is_ours[i]) continue;
    const HVI::Material &material = *store->materials.of(i);
    if (material.is_liquid()) continue;
    for (const HVI::Section &section : material.sections)
      if (section.kind == "strength" && section.law != "none") {
        error->warning(FLERR,
                       "Pair style hvi/sph: type {} is a liquid: material {} has strength, but "
                       "there is no fix hvi/johnson-cook (pair_coeff ... strength none if that is "
                       "meant)",
                       i, material.name);
        break;
      }
  }
}

/* ---------------------------------------------------------------------- */

void PairHVISPH::check_mirror() const
{
  for (int k = 0; k < 3; k++) {
    if (!set.mirror.has(k)) continue;
    if (k >= domain->dimension)
      error->all(FLERR, "Pair style hvi/sph: mirror {} in a two-dimensional box", "xyz"[k]);
    if (domain->periodicity[k])
      error->all(FLERR, "Pair style hvi/sph: mirror {} needs a box that is not periodic along {}",
                 "xyz"[k], "xyz"[k]);
  }
  if (!set.mirror.planes) return;
  if (domain->triclinic)
    error->all(FLERR, "Pair style hvi/sph: mirror needs a box that is not triclinic");
  if (!integrator)
    error->all(FLERR,
               "Pair style hvi/sph: mirror needs fix hvi/sph, which keeps particles on "
               "their side");
}

/* ----------------------------------------------------------------------
   forces do not look at pairs of particles that sleep
------------------------------------------------------------------------- */

void PairHVISPH::check_places()
{
  const double *const *const x = atom->x;
  const HVI::SphList pairs = scheme->all_pairs();
  for (int ii = 0; ii < pairs.inum; ii++) {
    const int i = pairs.ilist[ii];
    for (int jj = 0; jj < pairs.numneigh[i]; jj++) {
      const int j = pairs.firstneigh[i][jj] & NEIGHMASK;
      if (x[i][0] == x[j][0] && x[i][1] == x[j][1] && x[i][2] == x[j][2]) overlap(i, j);
    }
  }
}

/* ----------------------------------------------------------------------
   at the start of a run no particle may be beyond a plane, and none that is in no run before on it: rubble that the
   dissipation of its own image slows down comes as near to a plane as numbers do
------------------------------------------------------------------------- */

void PairHVISPH::check_sides() const
{
  if (!set.mirror.planes) return;
  for (int i = 0; i < atom->nlocal; i++) {
    if (!is_ours[atom->type[i]]) continue;
    const bool is_new = !integrator || integrator->is_new(i);
    for (int k = 0; k < 3; k++) {
      if (!set.mirror.has(k)) continue;
      const double depth = set.mirror.depth(k, atom->x[i]);
      if (is_new ? !(depth > 1.0e-12 * set.h[atom->type[i]]) : !(depth >= 0.0))
        error->one(FLERR,
                   "Pair style hvi/sph: particle {} at {} = {} is on the mirror plane {} or beyond "
                   "it (mirror {} {} {} wants all {} it); a lattice is best half a spacing away",
                   atom->tag[i], "xyz"[k], atom -> x[i][k], set.mirror.at[k], "xyz"[k],
                   set.mirror.at[k], set.mirror.side[k] > 0 ? "lo" : "hi",
                   set.mirror.side[k] > 0 ? "above" : "below");
    }
  }
}

/* ----------------------------------------------------------------------
   in which directions the particles extend: dim of them.  A row of particles must not see
   its own images across it.
------------------------------------------------------------------------- */

void PairHVISPH::check_extent()
{
  const int dim = set.laws.dim;
  bool *const along = store->fields.along;
  for (int k = 0; k < 3; k++) along[k] = k < domain->dimension;
  if (dim == domain->dimension) return;

  double here[6], extreme[6];    // largest coordinates, and largest of those turned around
  for (double &value : here) value = -BIG;
  for (int i = 0; i < atom->nlocal; i++)
    for (int k = 0; k < 3 && is_ours[atom->type[i]]; k++) {
      here[k] = MAX(here[k], atom->x[i][k]);
      here[3 + k] = MAX(here[3 + k], -atom->x[i][k]);
    }
  MPI_Allreduce(here, extreme, 6, MPI_DOUBLE, MPI_MAX, world);

  int extended = 0;
  double cutmax = 0.0;
  for (int i = 1; i <= atom->ntypes; i++)
    if (is_ours[i]) cutmax = MAX(cutmax, sqrt(cutsq[i][i]));
  for (int k = 0; k < domain->dimension; k++) {
    along[k] = extreme[k] + extreme[3 + k] > 1.0e-9 * cutmax;
    if (along[k])
      extended++;
    else if (domain->periodicity[k] && domain->prd[k] < cutmax)
      error->all(FLERR,
                 "Pair hvi/sph dim {}: the box is only {} long along {}, particles would interact "
                 "with their images beyond the reach of {}",
                 dim, domain->prd[k], "xyz"[k], cutmax);
  }
  if (extended > dim)
    error->all(FLERR, "Pair hvi/sph dim {}: particles extend along {} directions", dim, extended);
  for (int k = 0; k < domain->dimension && extended < dim; k++)
    if (!along[k]) {
      along[k] = true;
      extended++;
    }
  for (int k = 0; k < domain->dimension; k++)
    if (set.mirror.has(k) && !along[k])
      error->all(
          FLERR,
          "Pair hvi/sph dim {}: particles do not extend along {}, across which there is a mirror: "
          "they would interact with their images",
          dim, "xyz"[k]);
}

/* ---------------------------------------------------------------------- */

void PairHVISPH::compute(int eflag, int vflag)
{
  ev_init(eflag, vflag);
  scheme->forces(evflag != 0);
  if (vflag_fdotr) virial_fdotr_compute();
}

int PairHVISPH::pack_forward_comm(int n, int *sent, double *buf, int /*pbc_flag*/, int * /*pbc*/)
{
  return scheme->pack_forward(n, sent, buf);
}

void PairHVISPH::unpack_forward_comm(int n, int first, double *buf)
{
  scheme->unpack_forward(n, first, buf);
}

int PairHVISPH::pack_reverse_comm(int n, int first, double *buf)
{
  return scheme->pack_reverse(n, first, buf);
}

void PairHVISPH::unpack_reverse_comm(int n, int *sent, double *buf)
{
  scheme->unpack_reverse(n, sent, buf);
}

/* ---------------------------------------------------------------------- */

void PairHVISPH::tally(int i, int j, const double *d, const double *f)
{
  if (set.mirror.planes && scheme->mirror_images().is_image(j))
    tally_image(i, j, f, d);
  else
    ev_tally_xyz(i, j, atom->nlocal, force->newton_pair, 0.0, 0.0, f[0], f[1], f[2], d[0], d[1],
                 d[2]);
}

/* ----------------------------------------------------------------------
   A pair with an image counts for the virial as the halves of it and of its image on
   this side: f.d of either particle.  With its own image a particle has one half.
------------------------------------------------------------------------- */

void PairHVISPH::tally_image(int i, int a, const double *f, const double *d)
{
  const HVI::Images &images = scheme->mirror_images();
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
  const HVI::Images &images = scheme->mirror_images();
  const int other = set.mirror.planes && images.is_image(j) ? images.owner(j) : j;
  error->one(FLERR, "Pair hvi/sph: particles {} and {} are at the same place at step {}",
             atom->tag[i], atom->tag[other], update->ntimestep);
}

/* ---------------------------------------------------------------------- */

void PairHVISPH::write_restart(FILE *fp)
{
  write_restart_settings(fp);
  const int np1 = atom->ntypes + 1;
  HVI::RestartSection section(RESTART_FORMAT);
  for (int i = 1; i < np1; i++) {
    section.put(specs[i]);
    section.put(setflag[i], np1);
    section.put(visc_a[i], np1);
    section.put(visc_b[i], np1);
    section.put(tension[i], np1);
  }
  section.write(fp);
}

/* ---------------------------------------------------------------------- */

void PairHVISPH::read_restart(FILE *fp)
{
  read_restart_settings(fp);
  allocate();

  const int np1 = atom->ntypes + 1;
  HVI::RestartSection section(lmp, WHOSE, RESTART_FORMAT, fp);
  for (int i = 1; i < np1; i++) {
    const std::string spec = section.text();
    const bool lines = spec.find('\n') != std::string::npos;    // else of an older version
    if (!spec.empty())
      set_material(i, i, i, i, lines ? Tokenizer(spec, "\n").as_vector() : utils::split_words(spec),
                   true);
    section.get(setflag[i], np1);
    section.get(visc_a[i], np1);
    section.get(visc_b[i], np1);
    section.get(tension[i], np1);
  }
}

/* ---------------------------------------------------------------------- */

void PairHVISPH::write_restart_settings(FILE *fp)
{
  const HVI::SphLaws &laws = set.laws;
  const int flags[8] = {laws.dim,     laws.symmetric, laws.stock,  laws.automatic,
                        set.variable, set.energy,     set.riemann, set.mirror.planes};
  const double values[7] = {laws.a,   laws.b,       laws.alpha, set.hmin,
                            set.hmax, laws.art_eps, laws.art_n};
  HVI::RestartSection section(RESTART_FORMAT);
  section.put(set.kernel);
  section.put(set.text);
  section.put(flags, 8);
  section.put(values, 7);
  section.put(set.mirror.at, 3);
  section.put(set.mirror.side, 3);
  section.write(fp);
}

/* ---------------------------------------------------------------------- */

void PairHVISPH::read_restart_settings(FILE *fp)
{
  set = HVI::SphSettings();
  HVI::RestartSection section(lmp, WHOSE, RESTART_FORMAT, fp);
  set.kernel = section.text();
  set.text = section.text();
  int flags[8];
  double values[13];
  section.get(flags, 8);
  section.get(values, 13);

  HVI::SphLaws &laws = set.laws;
  laws.dim = flags[0];
  laws.symmetric = flags[1];
  laws.stock = flags[2];
  laws.automatic = flags[3];
  set.variable = flags[4];
  set.energy = flags[5];
  set.riemann = flags[6];
  laws.a = values[0];
  laws.b = values[1];
  laws.alpha = values[2];
  set.density = laws.automatic || laws.alpha > 0.0;
  set.hmin = values[3];
  set.hmax = values[4];
  laws.art_eps = values[5];
  laws.art_n = values[6];
  set.mirror.planes = flags[7];
  for (int k = 0; k < 3; k++) {
    set.mirror.at[k] = values[7 + k];
    set.mirror.side[k] = values[10 + k];
  }
  HVI::cite(lmp->citeme, set.density ? HVI::CITE_ZISIS : nullptr);
  no_virial_fdotr_compute = set.mirror.planes ? 1 : 0;
  const HVI::KernelFunctions &kernel = *HVI::find_kernel(set.kernel);
  set.support = kernel.support;
  laws.norm = kernel.norm[laws.dim - 1];
}
