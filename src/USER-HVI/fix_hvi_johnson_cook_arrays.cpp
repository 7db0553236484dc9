/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing authors: the lammps-hvi developers
------------------------------------------------------------------------- */

// the rest of fix hvi/johnson-cook: its arrays, restart and data files

#include "fix_hvi_johnson_cook.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "memory.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;

void FixHVIJohnsonCook::set_arrays(int i)
{
  const bool state = state_rows.take(i), forces = force_rows.take(i);
  if (!state && !forces) solid[i] = HVI::SolidModel::blank();
}

void FixHVIJohnsonCook::grow_arrays(int n)
{
  solid = (Solid *) memory->srealloc(solid, n * sizeof(Solid), "hvi/johnson-cook:solid");
}

void FixHVIJohnsonCook::copy_arrays(int i, int j, int /*delflag*/)
{
  solid[j] = solid[i];
}

int FixHVIJohnsonCook::pack_exchange(int i, double *buf)
{
  memcpy(buf, &solid[i], sizeof(Solid));
  return NSOLID;
}

int FixHVIJohnsonCook::unpack_exchange(int i, double *buf)
{
  memcpy((void *) &solid[i], buf, sizeof(Solid));
  return NSOLID;
}

int FixHVIJohnsonCook::pack_restart(int i, double *buf)
{
  buf[0] = NSOLID + 1;
  memcpy(&buf[1], &solid[i], sizeof(Solid));
  return NSOLID + 1;
}

void FixHVIJohnsonCook::unpack_restart(int nlocal, int nth)
{
  double **stored = atom->extra;
  int m = 0;
  for (int i = 0; i < nth; i++) m += static_cast<int>(stored[nlocal][m]);
  memcpy((void *) &solid[nlocal], &stored[nlocal][m + 1], sizeof(Solid));
}

int FixHVIJohnsonCook::maxsize_restart()
{
  return NSOLID + 1;
}

int FixHVIJohnsonCook::size_restart(int /*nlocal*/)
{
  return NSOLID + 1;
}

/* ---------------------------------------------------------------------- */

void FixHVIJohnsonCook::write_restart(FILE *fp)
{
  if (comm->me) return;
  const int size = text.size() + 1;
  fwrite(&size, sizeof(int), 1, fp);
  fwrite(text.c_str(), 1, size, fp);
}

void FixHVIJohnsonCook::restart(char *buf)
{
  restored = buf;
}

/* ----------------------------------------------------------------------
   Two sections of data files: the state, and the stress in the last forces with
   what the next step needs beside it.  Data files have no infinity: it is DBL_MAX.
------------------------------------------------------------------------- */

void FixHVIJohnsonCook::write_data_section_size(int section, int &nx, int &ny)
{
  nx = atom->nlocal;
  ny = rows(section).width();
}

void FixHVIJohnsonCook::write_data_section_pack(int section, double **buf)
{
  rows(section).pack_ids(buf);
  for (int i = 0; i < atom->nlocal; i++) {
    const Solid &s = solid[i];
    const HVI::Deviator &S = section == 0 ? s.S : s.seen.S;
    double *to = buf[i] + 1;
    for (const double value : {S.xx, S.yy, S.zz, S.xy, S.xz, S.yz}) *to++ = value;
    if (section == 0)
      for (const double value : {s.eps, s.damage, s.spalled, s.heat}) *to++ = value;
    else
      for (const double value : {std::max(s.seen.p_min, -DBL_MAX), s.seen.shear, s.shear, s.rate})
        *to++ = value;
  }
}

void FixHVIJohnsonCook::write_data_section_keyword(int section, FILE *fp)
{
  rows(section).write_keyword(fp);
}

void FixHVIJohnsonCook::write_data_section(int section, FILE *fp, int n, double **buf, int)
{
  rows(section).write(fp, n, buf);
}

void FixHVIJohnsonCook::read_data_section(char *keyword, int n, char *buf, tagint offset)
{
  const bool forces =    // sections of another fix end alike
      keyword != state_rows.title() && utils::strmatch(keyword, "_forces$");
  rows(forces).read(n, buf, offset, [this, forces](int i, const double *c) {
    if (!state_rows.has(i) && !force_rows.has(i)) solid[i] = HVI::SolidModel::blank();
    Solid &s = solid[i];
    const HVI::Deviator S = {c[0], c[1], c[2], c[3], c[4], c[5]};
    if (forces) {
      s.seen = {S, c[6] > -DBL_MAX ? c[6] : -INFINITY, c[7]};
      s.shear = c[8];
      s.rate = c[9];
    } else {
      s.S = S;
      s.eps = c[6];
      s.damage = c[7];
      s.spalled = c[8];
      s.heat = c[9];
    }
  });
}

/* ---------------------------------------------------------------------- */

double FixHVIJohnsonCook::memory_usage()
{
  return (double) atom->nmax * sizeof(Solid);
}
