/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing authors: the lammps-hvi developers
------------------------------------------------------------------------- */

// what users type; the rest of the class is in pair_hvi_sph.cpp

#include "pair_hvi_sph.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "hvi_kernel.h"
#include "math_special.h"
#include "hvi_material_file.h"
#include "memory.h"

#include <cmath>
#include <cstring>
#include <map>

using namespace LAMMPS_NS;

static constexpr char OWNER[] = "pair style hvi/sph";    // of materials
static constexpr double FAR_MASS = 1.5;        // times that of the spacing: another material's
static constexpr double H_OF_SPACING = 1.2;    // smoothing length in spacings: see Howto_choose

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
  memory->create(ratio, np1, np1, "pair:ratio");
  memory->create(weight, np1, np1, "pair:weight");
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
  memory->destroy(ratio);
  memory->destroy(weight);
  allocated = 0;
}

/* ---------------------------------------------------------------------- */

void PairHVISPH::settings(int narg, char **arg)
{
  if (narg < 1) utils::missing_cmd_args(FLERR, "pair_style hvi/sph", error);
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
      if (name != "plain" && name != "law" && name != "corrected")
        error->all(FLERR, "Pair_style hvi/sph gradient must be plain, law or corrected, not {}",
                   name);
      set.gradient = name == "plain" ? HVI::SphSettings::PLAIN
          : name == "law"            ? HVI::SphSettings::LAW
                                     : HVI::SphSettings::CORRECTED;
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
  if (set.gradient != HVI::SphSettings::CORRECTED)
    set.text += set.gradient == HVI::SphSettings::LAW ? " gradient law" : " gradient plain";
  if (laws.art_eps > 0.0) set.text += fmt::format(" artstress {} {}", laws.art_eps, laws.art_n);
}

/* ----------------------------------------------------------------------
   I J MATERIAL h H | spacing A  |  I J tension yes|no viscosity a b
------------------------------------------------------------------------- */

void PairHVISPH::coeff(int narg, char **arg)
{
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
  if (volume > 0.0 && !atom->mass)
    error->all(FLERR,
               "Pair_coeff hvi/sph volume sets masses of types, but particles have their own");
  if (h == 0.0) h = H_OF_SPACING * spacing;
  const bool keeps_mass = volume == 0.0;    // that the type has from a data file, say
  if (keeps_mass && spacing > 0.0) volume = MathSpecial::powint(spacing, set.laws.dim);

  std::string spec = words[0];
  for (std::size_t n = 1; n < nwords; n++) spec += " " + words[n];

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
