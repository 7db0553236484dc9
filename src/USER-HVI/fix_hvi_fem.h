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

#include "fix.h"
#include "hvi_element.h"
#include "hvi_energy_carrier.h"
#include "hvi_mesh.h"
#include "hvi_sph_records.h"
#include "hvi_tag_exchange.h"
#include "hvi_timestep.h"

#include <array>
#include <string>
#include <unordered_map>
#include <vector>

namespace LAMMPS_NS {

class FixHVIFEM :
    public Fix,
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
  void setup_pre_reverse(int, int) override;
  void setup(int) override;
  void post_integrate() override;
  void pre_exchange() override;
  void pre_neighbor() override;
  void post_neighbor() override;
  void pre_force(int) override {}
  void pre_reverse(int, int) override;
  void final_integrate() override;
  void end_of_step() override;
  void post_run() override;

  // migration, restart and data files: fix_hvi_fem_records.cpp

  void grow_arrays(int) override;
  void copy_arrays(int, int, int) override;
  void set_arrays(int) override;
  int pack_exchange(int, double *) override;
  int unpack_exchange(int, double *) override;
  int pack_restart(int, double *) override;
  void unpack_restart(int, int) override;
  int size_restart(int) override;
  int maxsize_restart() override;
  void write_restart(FILE *) override;
  void restart(char *) override;
  void read_data_header(char *) override;
  void read_data_section(char *, int, char *, tagint) override;
  bigint read_data_skip_lines(char *) override { return announced; }
  void write_data_header(FILE *, int) override;
  void write_data_section_size(int, int &, int &) override;
  void write_data_section_pack(int, double **) override;
  void write_data_section_keyword(int, FILE *) override;
  void write_data_section(int, FILE *, int, double **, int) override;
  int pack_forward_comm(int, int *, double *, int, int *) override;
  void unpack_forward_comm(int, int, double *) override;
  int pack_reverse_comm(int, int, double *) override;
  void unpack_reverse_comm(int, int *, double *) override;
  double memory_usage() override;

  double compute_scalar() override;
  double compute_vector(int) override;
  double compute_array(int, int) override;

  bool is_node(int itype) const override { return nodal[itype]; }
  void settle() override;
  void tighten(HVI::TimeStepBounds &) override;
  bool at_hand() const override { return true; }
  double internal_energy(int) const override;
  double plastic_work(int) const override;
  double void_work(int) const override;

 private:
  using Element = HVI::Element;

  // why an element becomes particles

  enum Reason { NONE = -1, STRAIN, DAMAGE, SPALL, SHAPE, STEP, ORPHAN, NREASON };

  struct {
    double q1 = 1.5, q2 = 0.06;    // bulk viscosity
    double viscous = 0.05;         // hourglass forces
    double stiffness = -1.0;       // of them; negative: from the material
    double courant = 0.8;          // of the step, in units of what is stable
    bool fails = true, damage = true, spall = true;
    double strain = 0.3;      // plastic; 0: no limit
    double jacobian = 0.2;    // scaled, of the shape
    double edges = 5.0;       // longest over shortest
    double shrink = 0.1;      // of the stable step since the start
  } options;

  struct Probe {
    double x[3];
    static constexpr int NVALUE = 14;
    double value[NVALUE];
    std::int64_t id;    // of the element; 0: not known yet
  };

  std::vector<char> nodal;    // by type
  std::vector<Probe> probes;
  bigint announced;                     // number of elements in the header of a data file
  std::int64_t id_before;               // largest ID of elements of others that were read before it
  bigint probed;                        // step that values of probes are of
  int every;                            // steps between lists of elements for local output; 0: none
  static constexpr int NCOLUMN = 17;    // of those
  bigint total;                         // of elements of all ranks; -1: to be counted
  int held;                             // bit of the group of particles in elements
  std::vector<int> inner;    // by type: that of those left out of lists; 0: there are none

  class FixHVIStore *store;
  class FixHVISPH *integrator;
  class FixHVIJohnsonCook *strength;
  class FixHVILedger *ledger;

  std::vector<Element> elements;    // of this rank, which has their first nodes; type 0: is no more
  int *head;                        // of owned particles: its first element, -1: none
  int *users;                       // of owned particles: number of elements that have it as a node
  std::vector<int> next;            // by element: of the same particle, -1: none
  std::unordered_map<std::int64_t, std::size_t>
      read_ids;                  // of elements, while their states are read
  bigint expected = -1;          // elements that data files have announced
  bigint shown = -1;             // step that output sees particles and energies of
  std::vector<int> read_head;    // head of particles of a data file, until LAMMPS sets their arrays

  // from one exchange of particles to the next

  struct Member {
    int e, p;
  };
  HVITagExchange nodes, particles;    // of all elements
  HVITagExchange near;                // particles of those that are active
  std::vector<Member> inside;         // by slot of particles
  std::vector<Member> members;        // by slot of near
  std::vector<int> corner, place;     // by element: CORNERS nodes; first particle, -1: none
  std::vector<char> active;           // by element: particles act on some of its own
  std::vector<int> flags;             // by particle, while lists are looked at

  // of a step

  enum {
    X,
    V = 3,
    W = 6,
    KICK = 9,
    USERS,
    NODE
  };    // of a node: V of the middle of a step, W of its end
  enum { L = 0, M = 9, TRACE = 15, CONTACT = 16, SUMS = 22 };
  enum { RHO = 9, ESPH, AHEAD, FLAG, PLACE };    // of a particle, after X, V, W
  enum { STAYS, IS_FREE, IS_NO_MORE };           // FLAG
  struct Now {
    double p, c;
    double work;    // power of the last forces on the velocity before them
    double L[9], K[9];
    double sums[SUMS];
  };
  std::vector<double> node, push;    // of nodes: the above; forces
  std::vector<double> rows;          // of particles
  struct Beside {
    double f[3], power;
  };
  std::vector<Beside>
      beside;     // of owned and ghost particles: what other styles do to those in elements
  bool others;    // there may be such
  std::vector<Now> now;                                                   // by element
  std::vector<std::vector<std::array<double, HVI::CORNERS>>> subcells;    // by n
  double dt_last;     // of the step of the last forces
  double shortest;    // stable step
  double smallest;    // edge of a cube as large as the smallest element at the start of a run
  bool going_on;      // all elements are as the last run has left them
  bool wraps;         // they may lie across periodic faces
  double nearby;      // as far as there is no other image

  // of this rank, from the start on

  enum { HEAT = NREASON, HOURGLASS, PLAIN, NCOUNT };
  double count
      [NCOUNT];    // by reason; heat and hourglass energy of what are particles now; failed without

  void read_options(int, char **);
  void make_groups();
  void link();
  void connect();
  void start_elements();
  void ids_have_changed(tagint) const;
  void mark_particles();
  void unmark_particles();
  void check_group(int) const;
  void check_masses();
  bool left_over(int) const;
  void gather_start();
  void check_state();
  void keep_on_planes();
  bool strayed();
  double fingerprint(std::size_t) const;
  void gather_nodes();
  void half_energy(double dt);
  double half_kick(int i) const;
  void place_particles(const std::vector<char> &freed);
  void show_particles();
  void gather_sums();
  void resume(std::size_t);
  void advance(std::size_t first, int n, double dt, bool due);
  void show_states(bool all);
  double with_pairs(const Now &, double felt[9]) const;
  bool waits(std::size_t first, int n) const;
  void make_forces(double dt);
  void gather_forces();
  bool find_others() const;
  void gather_beside();
  void check_fixes();
  void element_forces(std::size_t first, int n, double dt);
  void bring_forces();
  int shared(std::size_t) const;
  Reason reason(std::size_t) const;
  void release(std::vector<char> &freed);
  void let_go(const std::vector<char> &freed);
  static constexpr double MOST_DRAG = 0.1;
  void check_drag();
  void find_probes();
  void read_probes();
  void list_elements();
  bool alive(std::size_t e) const { return elements[e].type > 0; }
  const HVI::SolidModel &model(const Element &) const;
  HVI::SolidInput input(const Element &) const;
  const double *at(std::size_t e, int a) const
  {
    return &node[NODE * corner[HVI::CORNERS * e + a]];
  }
  void corners(std::size_t e, int what, double x[HVI::CORNERS][3]) const;
  void load(std::size_t first, int n, int what, HVI::HexNodes &) const;
};

}    // namespace LAMMPS_NS

#endif
#endif
