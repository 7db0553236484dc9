/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

// The only file that knows LAMMPS's plugin interface. It needs no change when a style is added:
// hvi_styles.h, written by CMake, includes every header with a style macro, and these macros
// fill the table here just as they fill LAMMPS's own.

#include "lammpsplugin.h"

#include "comm.h"
#include "error.h"
#include "lammps.h"
#include "version.h"

#include "hvi_styles.h"    // IWYU pragma: keep
#include "hvi_version.h"

#include <cstring>
#include <string>

using namespace LAMMPS_NS;

namespace {

template <class T> void *create1(void *lmp)
{
  return new T((LAMMPS *) lmp);
}

template <class T> void *create2(void *lmp, int narg, char **arg)
{
  return new T((LAMMPS *) lmp, narg, arg);
}

class Table {
 public:
  Table(void *lmp, void *handle, void *regfunc) :
      lmp(lmp), enter((lammpsplugin_regfunc) regfunc), entry{}
  {
    entry.version = LAMMPS_VERSION;
    static const std::string author = std::string("lammps-hvi ") + HVI::HVI_VERSION;
    entry.author = author.c_str();
    entry.handle = handle;
  }

  void add(const char *style, const char *name, const char *info, lammpsplugin_factory1 *creator)
  {
    entry.creator.v1 = creator;
    add(style, name, info);
  }

  void add(const char *style, const char *name, const char *info, lammpsplugin_factory2 *creator)
  {
    entry.creator.v2 = creator;
    add(style, name, info);
  }

 private:
  void *lmp;
  lammpsplugin_regfunc enter;
  lammpsplugin_t entry;

  // LAMMPS copies the entry but not its strings: they must be literals
  void add(const char *style, const char *name, const char *info)
  {
    entry.style = style;
    entry.name = name;
    entry.info = info;
    enter(&entry, lmp);
  }
};

}    // namespace

extern "C" void lammpsplugin_init(void *ptr, void *handle, void *regfunc)
{
  auto *lmp = (LAMMPS *) ptr;

  // the classes of another version are laid out differently: its styles would crash
  if (strcmp(lmp->version, LAMMPS_VERSION) != 0) {
    if (lmp->comm->me == 0)
      lmp->error->warning(FLERR,
                          "hviplugin.so is not loaded: it was compiled for LAMMPS {}, this is "
                          "LAMMPS {}. Compile it with -D LAMMPS_SOURCE_DIR=(source of this LAMMPS)",
                          LAMMPS_VERSION, lmp->version);
    return;
  }

  Table table(ptr, handle, regfunc);

#define PAIR_CLASS
#define PairStyle(key, Class) table.add("pair", #key, "USER-HVI pair style " #key, &create1<Class>)
#include "hvi_styles.h"    // IWYU pragma: keep
#undef PairStyle
#undef PAIR_CLASS

#define BOND_CLASS
#define BondStyle(key, Class) table.add("bond", #key, "USER-HVI bond style " #key, &create1<Class>)
#include "hvi_styles.h"    // IWYU pragma: keep
#undef BondStyle
#undef BOND_CLASS

#define FIX_CLASS
#define FixStyle(key, Class) table.add("fix", #key, "USER-HVI fix style " #key, &create2<Class>)
#include "hvi_styles.h"    // IWYU pragma: keep
#undef FixStyle
#undef FIX_CLASS

#define COMPUTE_CLASS
#define ComputeStyle(key, Class) \
  table.add("compute", #key, "USER-HVI compute style " #key, &create2<Class>)
#include "hvi_styles.h"    // IWYU pragma: keep
#undef ComputeStyle
#undef COMPUTE_CLASS

#define REGION_CLASS
#define RegionStyle(key, Class) \
  table.add("region", #key, "USER-HVI region style " #key, &create2<Class>)
#include "hvi_styles.h"    // IWYU pragma: keep
#undef RegionStyle
#undef REGION_CLASS

#define COMMAND_CLASS
#define CommandStyle(key, Class) \
  table.add("command", #key, "USER-HVI command style " #key, &create1<Class>)
#include "hvi_styles.h"    // IWYU pragma: keep
#undef CommandStyle
#undef COMMAND_CLASS
}
