/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifdef FIX_CLASS
// clang-format off
FixStyle(hvi/fem,FixHVIFEM);
// clang-format on
#else

#ifndef LMP_FIX_HVI_FEM_H
#define LMP_FIX_HVI_FEM_H

#include "fix_hvi_fem_mesh.h"
#include "hvi_energy_carrier.h"
#include "hvi_fem_coupling.h"
#include "hvi_mesh.h"
#include "hvi_timestep.h"

#include <vector>

namespace LAMMPS_NS {

class FixHVIFEM :
    public FixHVIFEMMesh,
    public HVI::Mesh,
    public HVI::TimeStepSource,
    public HVI::EnergyCarrier {
 public:
  FixHVIFEM(class LAMMPS *, int, char **);
  ~FixHVIFEM() override;
  int setmask() override;
  void init() override;
  void setup_pre_exchange() override;
  void setup_pre_neighbor() override;
  void setup_post_neighbor() override { post_neighbor(); }
  void setup_pre_force(int) override;
  void setup_pre_reverse(int, int) override { pre_reverse(0, 0); }
  void setup(int) override;

  // a step, in this order

  void post_integrate() override;
  void pre_exchange() override { remove_nodes(); }
  void pre_neighbor() override;
  void post_neighbor() override { coupling.find_pairs(); }
  void pre_force(int) override {}    // so that setup_pre_force() is called
  void advance() override;
  void pre_reverse(int, int) override;
  void final_integrate() override;
  void end_of_step() override;
  void post_run() override;

  void write_restart(FILE *) override;
  void restart(char *) override;

  // output

  double compute_scalar() override { return total; }
  double compute_vector(int) override;
  double compute_array(int, int) override;
  double internal_energy(int) const override;
  double plastic_work(int) const override;
  double energy_without_particles(int) const override;
  bool is_shown(int, double &, double &) const override;
  double void_work(int) const override;

  bool is_node(int itype) const override { return node_types[itype]; }
  void give_masses() override;
  int copies() const override { return of_nodes.size() + of_embedded.size(); }
  void join(HVI::Components &, const std::vector<std::int64_t> &, int, bool) override;
  void copy(HVI::Components::Node *, int) override;
  int on_mirror_planes(int i) const override { return on_planes[i]; }
  void tighten(HVI::TimeStepBounds &) override;
  bool at_hand() const override { return true; }

 private:
  using Mechanics = HVI::ElementMechanics;

  HVIFEMCoupling coupling;
  Mechanics mechanics;
  double courant = 0.8;    // of the step, in units of the stable one
  bool converts = true;    // elements that fail become particles

  double dt_last = 0.0;               // of the step of the last forces
  double dt_forces = 0.0;             // that led to the present forces; 0: none
  double shortest = HVI::NO_BOUND;    // stable step of elements of this rank
  double smallest = 0.0;    // edge of a cube as large as the smallest element at the start of a run
  bool goes_on = false;     // at the start of a run: all is as the last one has left it
  bool resumed = false;     // until the first step of such a run
  bool at_end = false;      // of a step of a run: elements and their nodes are known
  bool looked_at = false;    // others may have changed velocities since the end of the last step
  bigint shown = -1;         // step that output sees particles and energies of
  std::vector<std::array<double, 3>> node_forces;
  std::vector<std::array<double, 3>>
      node_changes;              // of velocity, by other fixes at the end of the last step
  std::vector<int> on_planes;    // of owned particles, bits

  // of this rank, from the start on: failures by reason; heat and hourglass energy of what are particles now;
  // elements without particles that have failed, when asked for

  enum { HEAT = Mechanics::NFAILURE, HOURGLASS, PLAIN, NCOUNT };
  double counts[NCOUNT] = {};

  struct Probe {
    double x[3] = {};    // asked for
    static constexpr int NVALUE = 14;
    double value[NVALUE] = {};
    std::int64_t id = 0;    // of the element; 0: not known yet
  };
  std::vector<Probe> probes;
  bigint probed = -1;                   // step that their values are of
  int every = 0;                        // steps between lists of elements for local output; 0: none
  static constexpr int NCOLUMN = 17;    // of those lists

  void read_options(int, char **);

  // the start of a run

  void find_here();
  void find_laws();
  void start_elements();
  void keep_on_planes(bool start = false);
  void check_state();
  double fingerprint(std::size_t) const;
  static constexpr double MOST_DRAG = 0.1;
  void check_drag();

  void gather_middle();
  void take_changed_forces();
  double kick_of(std::size_t) const;
  void gather_changes();
  double power_on_changes(std::size_t) const;
  void release();
  void advance_batch(HVI::ElementBatch &, bool due) const;
  void bring_forces();
  bool is_looked_at() const;
  void show_particles();
  void find_probes();
  void read_probes();
  void list_elements();
};

}    // namespace LAMMPS_NS

#endif
#endif
