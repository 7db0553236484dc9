/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_ELEMENT_MECHANICS_H
#define LMP_HVI_ELEMENT_MECHANICS_H

#include "hvi_element.h"
#include "hvi_mirror.h"

#include <array>
#include <vector>

namespace HVI {

struct Motion {
  double x[3];            // place
  double v[3];            // velocity of the middle of the step
  double predicted[3];    // velocity of the end of the step
};

struct Node : Motion {
  double kick;       // per mass, what half kicks leave in kinetic energy when the step changes
  double valence;    // number of elements that have it
};

typedef std::array<const Node *, CORNERS> ElementNodes;
typedef double Corners[CORNERS][3];    // places of those, of an element in one piece
typedef std::array<double, CORNERS> Weights;
typedef std::vector<Weights> Cells;    // hex_subcells(): weights of corners at the centers of cells

/* ----------------------------------------------------------------------
   Means over embedded particles p of sums over what is near them, free or of another body: those of
   all, and of other bodies alone

     L = < - sum_j w_j v_pj (x) grad W >     M = < - sum_j w_j x_pj (x) grad W >

   in the middle of the step
------------------------------------------------------------------------- */

struct PairSums {
  double L[9], M[6];           // by rows; xx yy zz xy xz yz
  double trace_L_of_others;    // of other bodies
  double M_of_others[6];
};

// what is known of an element in a step, and not kept

struct ElementStep {
  bool paired = false;    // pairs act on its embedded particles: there are sums and forces of them
  double p = 0.0;         // pressure at the end of the step
  double c = 0.0;         // speed of longitudinal waves
  double work = 0.0;      // power of forces on nodes, on velocities before them
  double L[9] = {};       // its own velocity gradient in the middle of the step
  double K[9] = {};       // stress that pairs bear in place of the element
  PairSums sums = {};
};

// up to LANES elements, one after the other in memory, with their nodes; lanes that are left repeat the last

struct ElementBatch {
  int n;
  Element *element;
  ElementStep *step;
  HexNodes x, v;    // places at the end of the step, velocities of its middle
  HexNodes B;       // gradient of the volume V
  Vec V;
};

/* ----------------------------------------------------------------------
   Elements over a step, from places and velocities of their nodes:

     first_half()     begins the step; of the energy, when nodes have moved
     failure()        whether an element becomes particles
     advance()        state to the end of the step: density, stress, pressure, viscosity, stable step
     forces()         on nodes
     second_half()    of the energy

   No nodes are moved, no ranks known.
------------------------------------------------------------------------- */

class ElementMechanics {
 public:
  struct Options {
    double q1 = 1.5, q2 = 0.06;    // bulk viscosity, quadratic and linear
    double viscous = 0.05;         // drag of hourglasses
    double stiffness = -1.0;       // of hourglasses; negative: from the material
    bool damage = true,
         spall = true;        // what is a failure, besides strain, shape, step and no neighbors
    double strain = 0.3;      // plastic; 0: no limit
    double jacobian = 0.2;    // scaled, of the shape
    double edges = 5.0;       // longest over shortest
    double shrink = 0.1;      // of the stable step since the start
  } options;

  struct Law {
    const Eos *eos;
    const SolidModel *solid;
  };
  std::vector<Law> laws;    // of types of particles
  MirrorPlanes mirror;

  enum Failure { NONE = -1, STRAIN, DAMAGE, SPALL, SHAPE, STEP, ORPHAN, NFAILURE };

  enum Trouble { NO_TROUBLE, NOT_A_NUMBER, COLLAPSED };

  // at rest in its material; false: it is turned inside out or has no volume

  bool start(Element &, const Corners &x) const;

  void first_half(Element &, const ElementNodes &, double dt, double power_on_changes) const;
  void second_half(Element &, const ElementStep &, double dt) const;

  int shared_corners(const ElementNodes &) const;    // that other elements have, too, or the image
  Failure failure(const Element &, const ElementNodes &, const Corners &x) const;
  bool is_distorted(const Corners &) const;    // by jacobian or edges

  // Its state is that of free particles in these cells from now on.  Returns the heat per mass that it takes up:
  // kinetic energy that nodes have and particles have not.

  double let_go(Element &, const ElementNodes &, const Cells &) const;

  // due: the state is that of the begin of the step, else that of its end.  Of what trouble is told in lane, the
  // run ends.

  Trouble advance(ElementBatch &, double dt, bool due, int &lane) const;

  // as the last run has left them: what advance() told of p and L

  void resume(ElementBatch &) const;

  void forces(ElementBatch &, double dt) const;

 private:
  const Law &law(const Element &one) const { return laws[one.type]; }
  static SolidInput input(const Element &);
};

}    // namespace HVI

#endif
