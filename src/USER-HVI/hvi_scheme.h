/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_SCHEME_H
#define LMP_HVI_SCHEME_H

#include "fix_hvi_store.h"
#include "hvi_images.h"
#include "hvi_sleep.h"
#include "hvi_sph_message.h"
#include "hvi_sph_sweep.h"
#include "hvi_timestep.h"
#include "pair.h"
#include "pointers.h"

#include <cmath>
#include <memory>
#include <string>
#include <vector>

namespace LAMMPS_NS {

// what pair style hvi/sph has at hand in a run

struct HVIPairTables {
  Pair *style;                                                     // has the list, and communicates
  HVI::SphWatcher *watcher;                                        // is told about pairs
  const double *const *visc_a, *const *visc_b, *const *tension;    // by types
  std::vector<char> is_ours;      // by type: has a material of that pair style
  class FixHVISPH *integrator;    // null: another fix integrates
  class FixHVILists *lists;
};

/* ----------------------------------------------------------------------
   A force evaluation of SPH particles:

     prepare()   when ghosts and lists are there: records of particles, sums over neighbors and, in a step, what
                 these bring to its end.  Called by fix hvi/sph, before forces; by forces() if there is none, in
                 a setup, and where another pair style makes densities
     forces()    sums over pairs, to f, drho, desph of owned particles and ghosts

   A class for each scheme: fluids, fluids with Riemann problems, solids.
------------------------------------------------------------------------- */

class HVIScheme : protected Pointers {
 public:
  HVIScheme(class LAMMPS *, const HVIPairTables &);
  ~HVIScheme() override = default;

  void prepare();
  void forces(bool tally);

  int terms() const { return sweeps->scene(); }    // bits of SphScene
  bool wants(int term) const { return asked & term; }
  bool vectors() const { return sweeps->vectors(); }    // of pairs, not the reference loop
  bool has_inactive() const { return quiet.v < HVI::NO_BOUND; }

  // the largest h, at the start, of a kernel between particles of two types; weights between these, null: all
  // are 1

  virtual double widest(int itype, int jtype) const;
  virtual const double *const *weights() const { return nullptr; }

  // doubles per particle to its ghosts and back: the most at once, and in all of an evaluation, but for what touches

  struct Traffic {
    int forward, reverse, all_forward, all_reverse;
  };
  virtual Traffic traffic() const { return {0, 0, 0, 0}; }

  // of the pair style

  int pack_forward(int n, const int *list, double *buf) const;
  void unpack_forward(int n, int first, const double *buf);
  int pack_reverse(int n, int first, double *buf) const;
  void unpack_reverse(int n, const int *list, const double *buf);

  const HVI::Images &mirror_images() const { return images; }
  HVI::SphList all_pairs();    // the half list, with the rows of inactive particles
  void tighten(HVI::TimeStepBounds &) const;
  std::string fastest_signal() const;    // for an error message: of which particle, and its state
  double bytes() const
  {
    return kept.bytes() + has_neighbor.capacity();
  }    // records are the store's

 protected:
  // of a density and an energy per mass: pressure, dp/drho at constant entropy, cube root of rho/rho0

  struct EosState {
    double rho = NAN, e = 0.0, p = 0.0, csq = 0.0, width = 1.0;
  };

  const HVIPairTables pairs;
  class FixHVIStore *store;
  class FixHVISPH *integrator;
  HVI::SphFields &fields;
  HVI::SphSettings &set;    // of the run
  std::unique_ptr<HVI::SphSweeps> sweeps;
  HVI::Images images;    // of particles, behind mirror planes
  HVI::SphWork work;
  HVI::Sleep cells;    // those of fix hvi/lists: in which of them nothing happens

  // What differs between schemes.  evaluate(): all of prepare(), from start() on.  gather(): of one particle weight
  // and pressure in its record, and the square of the speed of sound, which it gets from the equation of state

  virtual void evaluate() = 0;
  virtual double gather(int i, const EosState &, HVI::SphState &) = 0;
  virtual void gather_limits() {}    // of stress, before records of particles are filled

  // whether places of inactive particles are asked for in this step

  virtual bool looks_at_all() const { return false; }
  virtual void forces_done() {}

  // at the end of a constructor: terms of the scheme, beside common ones; whether undisturbed matter may be left out

  void choose(int terms, bool may_be_inactive = true);
  void start();    // images, inactive particles, records of owned particles, ghosts and images
  double mass(int i) const;
  bool has_record(int i) const;    // of this style, and neither idle nor frozen
  template <class Work> void each_active(const Work &action) const    // owned particle
  {
    for (const int i : active)
      if (has_record(i)) action(i);
  }
  void take_out(int i);
  [[noreturn]] void no_answer(int i, double rho) const;
  void forward(const HVI::SphMessage &);
  void reverse(const HVI::SphMessage &);

  // Undisturbed matter is left out: what counts as undisturbed

  struct {
    double v =
        HVI::NO_BOUND;    // the most that velocities may differ by; NO_BOUND: nothing is left out
    double rho_part = 0.0;      // the most that densities may, over that at rest
    std::vector<double> rho;    // by type: density at rest; 0: never undisturbed
    std::vector<double> e;      // by type: the most energy per mass
  } quiet;
  bool all_sums = false;    // particles have sums over all of their neighbors, be these inactive

  // Whose records are filled, owned ones first: those of rows, and what is next to these; what has just come to
  // rest; all ghosts; all when lists are new.  Others keep what they had, for nothing has happened to them since.

  std::vector<int> filled;

 private:
  int asked = 0;    // terms, of which those of the loop may be more
  bool prepared = false;
  bool placed = false;    // all particles are in cells
  HVI::SphKept kept;
  std::vector<char> has_neighbor;              // in the list, or its own image: owned and ghosts
  std::vector<int> rows;                       // of the list, that are gone through
  std::vector<int> all_rows;                   // if they are made where they are asked for
  std::vector<int> active;                     // owned particles to which something may happen
  std::vector<int> reached, reached_before;    // owned, where rows or neighbors in rows can be
  std::vector<int> of_ghosts;                  // cells with ghosts
  struct {
    double fastest = 0.0, narrowest = HVI::NO_BOUND;
  } resting;    // of inactive particles, since lists were made: the largest 1/time of a signal, the smallest h
  std::vector<EosState> eos_states;    // by type: of the last particle that was asked for
  double fastest =
      0.0;    // of the last forces: 1/time in which signals pass half of what a kernel reaches
  double alone = 0.0;                  // the same of particles without neighbors
  double narrowest = HVI::NO_BOUND;    // and the smallest h
  HVI::SphMessage sent;                // what is being communicated

  void find_quiet(bool can);
  void find_neighbors();
  void make_rows(int cell);
  void note_neighbors(int cell);
  bool is_at_rest(int i) const;    // in a cell where nothing happens: owned particle or ghost
  void find_images();
  void find_inactive();
  void gather_records();
  void choose_rows();
  void choose_records(bool lost);
  void scatter();
  double fastest_to_images(double far) const;
};

/* ----------------------------------------------------------------------
   Monaghan's viscosity, in forms sum, symmetric and stock
------------------------------------------------------------------------- */

class HVISchemeFluid : public HVIScheme {
 public:
  HVISchemeFluid(class LAMMPS *, const HVIPairTables &);

 protected:
  void evaluate() override { start(); }
  double gather(int, const EosState &, HVI::SphState &) override;
};

}    // namespace LAMMPS_NS

#endif
