/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing authors: the lammps-hvi developers
------------------------------------------------------------------------- */

// what restart files keep; the rest of the class is in pair_hvi_sph.cpp

#include "pair_hvi_sph.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "hvi_kernel.h"

using namespace LAMMPS_NS;

/* ---------------------------------------------------------------------- */

static void write_text(FILE *fp, const std::string &text)
{
  const int n = text.size();
  fwrite(&n, sizeof(int), 1, fp);
  fwrite(text.data(), 1, n, fp);
}

static std::string read_text(FILE *fp, int me, MPI_Comm world, Error *error)
{
  int n = 0;
  if (me == 0) utils::sfread(FLERR, &n, sizeof(int), 1, fp, nullptr, error);
  MPI_Bcast(&n, 1, MPI_INT, 0, world);
  std::string text(n, ' ');
  if (me == 0 && n) utils::sfread(FLERR, &text[0], 1, n, fp, nullptr, error);
  MPI_Bcast(&text[0], n, MPI_CHAR, 0, world);
  return text;
}

/* ---------------------------------------------------------------------- */

void PairHVISPH::write_restart(FILE *fp)
{
  write_restart_settings(fp);
  const int np1 = atom->ntypes + 1;
  for (int i = 1; i < np1; i++) {
    write_text(fp, specs[i]);
    fwrite(setflag[i], sizeof(int), np1, fp);
    fwrite(visc_a[i], sizeof(double), np1, fp);
    fwrite(visc_b[i], sizeof(double), np1, fp);
    fwrite(tension[i], sizeof(double), np1, fp);
  }
}

/* ---------------------------------------------------------------------- */

void PairHVISPH::read_restart(FILE *fp)
{
  read_restart_settings(fp);
  allocate();

  const int me = comm->me;
  const int np1 = atom->ntypes + 1;
  for (int i = 1; i < np1; i++) {
    const std::string spec = read_text(fp, me, world, error);
    if (!spec.empty()) set_material(i, i, i, i, utils::split_words(spec), true);
    if (me == 0) {
      utils::sfread(FLERR, setflag[i], sizeof(int), np1, fp, nullptr, error);
      utils::sfread(FLERR, visc_a[i], sizeof(double), np1, fp, nullptr, error);
      utils::sfread(FLERR, visc_b[i], sizeof(double), np1, fp, nullptr, error);
      utils::sfread(FLERR, tension[i], sizeof(double), np1, fp, nullptr, error);
    }
    MPI_Bcast(setflag[i], np1, MPI_INT, 0, world);
    MPI_Bcast(visc_a[i], np1, MPI_DOUBLE, 0, world);
    MPI_Bcast(visc_b[i], np1, MPI_DOUBLE, 0, world);
    MPI_Bcast(tension[i], np1, MPI_DOUBLE, 0, world);
  }
}

/* ---------------------------------------------------------------------- */

void PairHVISPH::write_restart_settings(FILE *fp)
{
  write_text(fp, set.kernel);
  write_text(fp, set.text);
  const HVI::SphLaws &laws = set.laws;
  const int flags[8] = {laws.dim,     laws.symmetric, laws.stock,  laws.automatic,
                        set.variable, set.energy,     set.riemann, set.gradient};
  const double values[7] = {laws.a,   laws.b,       laws.alpha, set.hmin,
                            set.hmax, laws.art_eps, laws.art_n};
  fwrite(flags, sizeof(int), 8, fp);
  fwrite(values, sizeof(double), 7, fp);
  fwrite(&set.mirror.planes, sizeof(int), 1, fp);
  fwrite(set.mirror.at, sizeof(double), 3, fp);
  fwrite(set.mirror.side, sizeof(double), 3, fp);
}

/* ---------------------------------------------------------------------- */

void PairHVISPH::read_restart_settings(FILE *fp)
{
  set = HVI::SphSettings();
  set.kernel = read_text(fp, comm->me, world, error);
  set.text = read_text(fp, comm->me, world, error);
  int flags[9];
  double values[13];
  if (comm->me == 0) {
    utils::sfread(FLERR, flags, sizeof(int), 8, fp, nullptr, error);
    utils::sfread(FLERR, values, sizeof(double), 7, fp, nullptr, error);
    utils::sfread(FLERR, flags + 8, sizeof(int), 1, fp, nullptr, error);
    utils::sfread(FLERR, values + 7, sizeof(double), 6, fp, nullptr, error);
  }
  MPI_Bcast(flags, 9, MPI_INT, 0, world);
  MPI_Bcast(values, 13, MPI_DOUBLE, 0, world);

  HVI::SphLaws &laws = set.laws;
  laws.dim = flags[0];
  laws.symmetric = flags[1];
  laws.stock = flags[2];
  laws.automatic = flags[3];
  set.variable = flags[4];
  set.energy = flags[5];
  set.riemann = flags[6];
  set.gradient = static_cast<HVI::SphSettings::Gradient>(flags[7]);
  laws.a = values[0];
  laws.b = values[1];
  laws.alpha = values[2];
  set.density = laws.automatic || laws.alpha > 0.0;
  set.hmin = values[3];
  set.hmax = values[4];
  laws.art_eps = values[5];
  laws.art_n = values[6];
  set.mirror.planes = flags[8];
  for (int k = 0; k < 3; k++) {
    set.mirror.at[k] = values[7 + k];
    set.mirror.side[k] = values[10 + k];
  }
  no_virial_fdotr_compute = set.mirror.planes ? 1 : 0;
  const HVI::KernelFunctions &kernel = *HVI::find_kernel(set.kernel);
  set.support = kernel.support;
  laws.norm = kernel.norm[laws.dim - 1];
}
