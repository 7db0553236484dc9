/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

/* ----------------------------------------------------------------------
   Contributing authors: the lammps-hvi developers
------------------------------------------------------------------------- */

#include "hvi_sph_sweep.h"

#include "hvi_kernel.h"
#include "hvi_sph_fluid.h"
#include "hvi_sph_reference.h"
#include "hvi_sph_solid.h"

#include <algorithm>
#include <utility>

namespace HVI {

namespace {

  enum Pass { ONLY, FIRST, SECOND };

  template <class Kernel, int SCENE> class Sweeps final : public SphSweeps {
   public:
    int scene() const override { return SCENE; }
    bool vectors() const override { return true; }
    void first(SphWork &) const override;
    void forces(SphWork &) const override;
    double w(double q) const override { return Kernel::template w<double>(q); }

   private:
    template <class Record, class Law>
    static void each_particle(SphWork &, Pass, Record *, const Law &);
    template <class Record>
    static int within_reach(const SphWork &, const SphRows &, const SphPlace &, const int *, int,
                            const Record *, SphNear &);
    static int all_of(const SphWork &, const SphPlace &, const int *, int, SphNear &);
    static void tell(const SphWork &, int, int, const SphNear &);
  };

  /* ----------------------------------------------------------------------
     of the neighbors of a particle in an element those that are not in elements of the same body
  ------------------------------------------------------------------------- */

  int outside(const SphWork &work, int i, const int *jlist, int jnum, int *free)
  {
    int n = 0;
    for (int jj = 0; jj < jnum; jj++) {
      const int j = jlist[jj] & NEIGHBOR_INDEX;
      if (!work.in_elements_together(i, j)) free[n++] = j;
    }
    return n;
  }

  /* ----------------------------------------------------------------------
     squeeze out those beyond reach without a branch
  ------------------------------------------------------------------------- */

  template <class Kernel, int SCENE>
  template <class Record>
  inline int Sweeps<Kernel, SCENE>::within_reach(const SphWork &work, const SphRows &laws,
                                                 const SphPlace &pi, const int *jlist, int number,
                                                 const Record *records, SphNear &near)
  {
    const SphPlace *const place = work.records.place;
    const SphState *const state = work.records.state;
    const double reachsq = Kernel::support * Kernel::support * work.laws.h * work.laws.h;
    int n = 0;
    for (int jj = 0; jj < number; jj++) {
      const int j = jlist[jj] & NEIGHBOR_INDEX;
      const Vec4 d = part(&pi, 0) - part(&place[j], 0);
      __builtin_prefetch(&state[j]);
      if (!(SCENE & SPH_SOLID)) __builtin_prefetch(&records[j], 1);
      near.j[n] = j;
      near.d[n] = d;
      const Vec4 square = d * d;
      const double rsq = square[0] + square[2] + square[1];
      if (SCENE & SPH_SPACINGS) {
        const double ratio = laws.row_ratio[state[j].type()];
        const double h = 0.5 * (1.0 + ratio) * std::max(pi.h, (pi.h - d[3]) / ratio);
        n += rsq < Kernel::support * Kernel::support * h * h;
      } else if (SCENE & SPH_OWN_H) {
        const double h = SCENE & (SPH_RIEMANN | SPH_SOLID) ? std::max(pi.h, pi.h - d[3])
                                                           : pi.h - 0.5 * d[3];
        n += rsq < Kernel::support * Kernel::support * h * h;
      } else
        n += rsq < reachsq;
    }
    return n;
  }

  // who is within reach is known already

  template <class Kernel, int SCENE>
  inline int Sweeps<Kernel, SCENE>::all_of(const SphWork &work, const SphPlace &pi,
                                           const int *jlist, int number, SphNear &near)
  {
    const SphPlace *const place = work.records.place;
    const SphState *const state = work.records.state;
    for (int jj = 0; jj < number; jj++) {
      const int j = jlist[jj];
      __builtin_prefetch(&state[j]);
      if (SCENE & SPH_SOLID) {
        __builtin_prefetch(&work.records.traction[j]);
        __builtin_prefetch(&work.records.traction[j].xz);
        if (SCENE & SPH_RIEMANN) { __builtin_prefetch(&work.records.gradv[j]); }
      } else if (SCENE & SPH_RIEMANN) {
        __builtin_prefetch(&work.records.rates[j], 1);
        __builtin_prefetch(&work.records.slopes[j]);
        __builtin_prefetch(&work.records.slopes[j].pz);
      }
      near.j[jj] = j;
      near.d[jj] = part(&pi, 0) - part(&place[j], 0);
    }
    return number;
  }

  /* ----------------------------------------------------------------------
     One sweep, in two passes over the neighbors of a particle: who is within reach; then
     law(i, place, n, laws, near, sum) works out the pairs in vectors, and adds what happens to
     the neighbors to their records.
  ------------------------------------------------------------------------- */

  template <class Kernel, int SCENE>
  template <class Record, class Law>
  void Sweeps<Kernel, SCENE>::each_particle(SphWork &work, Pass pass, Record *records,
                                            const Law &law)
  {
    const SphList &list = work.list;
    SphKept &kept = *work.kept;
    SphRows laws = {};
    static_cast<SphLaws &>(laws) = work.laws;
    laws.half_step = work.half_step;
    SphNear near;
    near.fastest = Vec{} + work.fastest;
    std::size_t nkept = 0;

    if (pass == FIRST) {
      std::size_t most = 0;
      for (int ii = 0; ii < list.inum; ii++) most += list.numneigh[list.ilist[ii]];
      kept.make_room(most, list.inum);
    }

    for (int ii = 0; ii < list.inum; ii++) {
      const int i = list.ilist[ii];
      const SphPlace pi = work.records.place[i];
      const int *jlist = pass == SECOND ? kept.j.data() + nkept : list.firstneigh[i];
      int jnum = pass == SECOND ? kept.number[ii] : list.numneigh[i];
      const bool held = work.embedded && work.embedded[i];
      if (held && pass != SECOND) {
        int *const free = kept.room_for(jnum);
        jnum = outside(work, i, jlist, jnum, free);
        jlist = free;
      }
      Record sum = {};

      if (SCENE & SPH_BODIES) {
        laws.row_a = work.visc_a[work.type[i]];
        laws.row_b = work.visc_b[work.type[i]];
        laws.row_tension = work.tension[work.type[i]];
      }
      if (SCENE & SPH_SPACINGS) {
        laws.row_ratio = work.ratio[work.type[i]];
        laws.row_weight = work.weight[work.type[i]];
      }

      // images are near those who are near: they are looked for anew in a second sweep

      auto visit = [&](const int *jvisit, int number, Pass how) {
        int found = 0;
        for (int jfirst = 0; jfirst < number; jfirst += SphNear::MAX) {
          const int nvisit = std::min(+SphNear::MAX, number - jfirst);
          const int n = how == SECOND
              ? all_of(work, pi, jvisit + jfirst, nvisit, near)
              : within_reach(work, laws, pi, jvisit + jfirst, nvisit, records, near);
          if (how == FIRST) std::copy_n(near.j, n, kept.j.data() + nkept + found);
          found += n;
          law(i, pi, n, laws, near, sum);
        }
        return found;
      };
      const int found = visit(jlist, jnum, pass);
      if (pass == FIRST) kept.number[ii] = found;
      nkept += found;
      if (work.images) {
        const std::vector<int> &also = work.images->near(i, jlist, jnum);
        const int *those = also.data();
        int n = also.size();
        if (held) {
          int *const free = kept.room_for(n);
          n = outside(work, i, those, n, free);
          those = free;
        }
        if (n) visit(those, n, ONLY);
      }
      for (int k = 0; k < (int) (sizeof(Record) / sizeof(Vec4)); k++)
        part(&records[i], k) += part(&sum, k);
    }
    for (int k = 0; k < LANES; k++) work.fastest = std::max(work.fastest, near.fastest[k]);
  }

  /* ---------------------------------------------------------------------- */

  template <class Kernel, int SCENE> void Sweeps<Kernel, SCENE>::first(SphWork &work) const
  {
    if constexpr ((SCENE & SPH_SOLID) != 0) {
      const SphView &r = work.records;
      each_particle(
          work, FIRST, r.gradv,
          [&](int i, const SphPlace &pi, int n, const SphRows &laws, SphNear &near, SphGradV &sum) {
            sph_gradients<Kernel, SCENE>(i, pi, r.state, n, laws, near, r.gradv, r.touching, sum);
          });
    } else if constexpr ((SCENE & SPH_RIEMANN) != 0) {
      const SphState *const state = work.records.state;
      SphSlopes *const slopes = work.records.slopes;
      each_particle(work, FIRST, slopes,
                    [=](int i, const SphPlace &pi, int n, const SphRows &laws, SphNear &near,
                        SphSlopes &sum) {
                      sph_slopes<Kernel, SCENE>(i, pi, state, n, laws, near, slopes, sum);
                    });
    }
  }

  template <class Kernel, int SCENE> void Sweeps<Kernel, SCENE>::forces(SphWork &work) const
  {
    const SphView &r = work.records;
    each_particle(
        work, has_first() ? SECOND : ONLY, r.rates,
        [&](int i, const SphPlace &pi, int n, const SphRows &laws, SphNear &near, SphRates &sum) {
          bool overlaps;
          if constexpr ((SCENE & SPH_SOLID) != 0)
            overlaps = sph_solid<Kernel, SCENE>(i, pi, r, n, laws, near, sum);
          else if constexpr ((SCENE & SPH_RIEMANN) != 0)
            overlaps =
                sph_riemann<Kernel, SCENE>(i, pi, r.state, r.slopes, n, laws, near, r.rates, sum);
          else
            overlaps = sph_fluid<Kernel, SCENE>(i, pi, r.state, n, laws, near, r.rates, sum);
          if (overlaps)
            for (int m = 0; m < n; m++)
              if (near.d[m][0] == 0.0 && near.d[m][1] == 0.0 && near.d[m][2] == 0.0)
                work.watcher->overlap(i, near.j[m]);
          if (work.tally) tell(work, i, n, near);
        });
  }

  template <class Kernel, int SCENE>
  void Sweeps<Kernel, SCENE>::tell(const SphWork &work, int i, int n, const SphNear &near)
  {
    for (int m = 0; m < n; m++) {
      const double d[3] = {near.d[m][0], near.d[m][1], near.d[m][2]}, along = near.force[m];
      const double f[3] = {SCENE & SPH_SOLID ? near.f[m][0] : along * d[0],
                           SCENE & SPH_SOLID ? near.f[m][1] : along * d[1],
                           SCENE & SPH_SOLID ? near.f[m][2] : along * d[2]};
      work.watcher->tally(i, near.j[m], d, f);
    }
  }

  /* ----------------------------------------------------------------------
     The scenes that are compiled, cheaper ones first: taken is the first that has all the terms
     asked for.  Terms it has besides come out as nothing, to the last digit.
  ------------------------------------------------------------------------- */

  constexpr int H = SPH_OWN_H, B = SPH_BODIES, D = SPH_DENSITY, R = SPH_RIEMANN, S = SPH_SOLID,
                W = SPH_SPACINGS;

  using Scenes =
      std::integer_sequence<int, 0, H, B, H | B, H | B | D, R, R | H, R | H | B, R | H | B | W, S,
                            S | B, S | H | B, S | R, S | R | B, S | R | H | B>;

  template <class Kernel, int... SCENE>
  std::unique_ptr<SphSweeps> make(int scene, std::integer_sequence<int, SCENE...>)
  {
    // what these two do and what is done without them exclude each other

    constexpr int SAME = R | S;
    std::unique_ptr<SphSweeps> made;
    ((!made && (scene & ~SCENE) == 0 && (scene & SAME) == (SCENE & SAME)
          ? (void) (made = std::make_unique<Sweeps<Kernel, SCENE>>())
          : (void) 0),
     ...);
    return made;
  }

  std::unique_ptr<SphSweeps> make_in_vectors(const std::string &kernel, int scene)
  {
    if (kernel == Cubic::name) return make<Cubic>(scene, Scenes());
    if (kernel == Gauss::name) return make<Gauss>(scene, Scenes());
    return nullptr;
  }
}    // namespace

/* ----------------------------------------------------------------------
   Builds for any machine have this file twice: as it is, and with HVI_SWEEPS_AVX2 for machines with
   AVX2.  All code in here is internal to the file, so that neither takes functions of the other.
------------------------------------------------------------------------- */

std::unique_ptr<SphSweeps> make_avx2_sph_sweeps(const std::string &kernel, int scene);

#if defined(HVI_SWEEPS_AVX2)
std::unique_ptr<SphSweeps> make_avx2_sph_sweeps(const std::string &kernel, int scene)
{
  return make_in_vectors(kernel, scene);
}
#else
std::unique_ptr<SphSweeps> make_sph_sweeps(const std::string &kernel, int scene)
{
  std::unique_ptr<SphSweeps> made;
#if defined(HVI_HAS_AVX2_SWEEPS)
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
    made = make_avx2_sph_sweeps(kernel, scene);
  else
#endif
    made = make_in_vectors(kernel, scene);
  return made ? std::move(made) : make_sph_reference(kernel, scene);
}
#endif

}    // namespace HVI
