/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_TIMESTEP_H
#define LMP_HVI_TIMESTEP_H

#include <string>
#include <vector>

namespace LAMMPS_NS {
class LAMMPS;
}

namespace HVI {

static constexpr double NO_BOUND = 1.0e100;

/* ----------------------------------------------------------------------
   What a source tells about the present state of its own pairs on this rank:
   the shortest time sqrt(m/k) that must be resolved, m the reduced mass and k
   the stiffness d2phi/dr2 of a pair, for each reason that may limit it.
------------------------------------------------------------------------- */

struct TimeStepBounds {
  double contact = NO_BOUND;     // stiffness of pairs in contact as they stand
  double spring = NO_BOUND;      // stiffness of intact bonds
  double approach = NO_BOUND;    // stiffness where approaching pairs will turn back
  double signal = NO_BOUND;      // not of a stiffness: a length over the speed of signals
  double alone = NO_BOUND;       // the same of what has no neighbors: counts if nothing else does

  // a step that is stable as it is: not in proportion to C

  double stable = NO_BOUND;

  // by this factor a step may be longer than the one before, for schemes that dissipate

  double growth = 1.01;

  // in one step no two particles come closer by more than this; the time of those that are near each
  // other for what they may, from a source that knows them

  double travel = NO_BOUND;
  double meet = NO_BOUND;

  /* for pairs or bonds with a stiffness, where particles act on each other within a distance:
     velocity Verlet keeps their energy only while its step changes slowly.  Where a whole plate
     is struck at once and rebounds, 0.2 % in place of 0.05 % costs 40 times the drift
     (examples/dem-scaling, 6 layers at 2 km/s). */

  void come_closer(double distance)
  {
    if (travel > distance) travel = distance;
  }
  void conserve_energy(double distance)
  {
    if (growth > 1.0005) growth = 1.0005;
    come_closer(0.1 * distance);    // a pair is seen on its approach before it is deep in contact
  }
};

/* ----------------------------------------------------------------------
   A pair style, bond style or fix that limits the time step: whoever
   implements this is found and asked, from Fix::setup() on.  Velocities of ghost particles are up
   to date when tighten() is called, unless all have at hand what they say: then they are asked in
   every step.
------------------------------------------------------------------------- */

class TimeStepSource {
 public:
  virtual ~TimeStepSource() noexcept(false) {}
  virtual void tighten(TimeStepBounds &bounds) = 0;
  virtual bool at_hand() const { return false; }    // it is left over from the last forces

  // for an error message: what on this rank has the fastest signals, a particle say, and its state

  virtual std::string fastest_signal() const { return ""; }
};

// shortest distance over which the pair style acts, NO_BOUND without one

double shortest_cutoff(const LAMMPS_NS::LAMMPS *);

/* ----------------------------------------------------------------------
   The longest steps that the present state allows, on all ranks: C times the
   times that must be resolved, and travel, which is not in proportion to C.
   A negative one stands for what is not a number; one of C NO_BOUND or more
   for no limit.
------------------------------------------------------------------------- */

struct StableSteps {
  double contact, spring, approach, signal;
  double growth;
};

bool at_hand(const std::vector<TimeStepSource *> &);

StableSteps stable_steps(const LAMMPS_NS::LAMMPS *, const std::vector<TimeStepSource *> &,
                         double factor);

/* ----------------------------------------------------------------------
   The shortest of them, of all sources of this simulation, whether fix hvi/dt
   is in use or not: INFINITY if nothing limits the step, not > 0 if it is not
   a number.  To be called on all ranks, when forces have been computed.
------------------------------------------------------------------------- */

double stable_step(const LAMMPS_NS::LAMMPS *, double factor);

}    // namespace HVI

#endif
