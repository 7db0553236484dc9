/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_SPH_FIELDS_H
#define LMP_HVI_SPH_FIELDS_H

#include "hvi_mirror.h"
#include "hvi_sph.h"
#include "hvi_sph_records.h"
#include "hvi_stress.h"

#include <memory>
#include <string>
#include <vector>

namespace HVI {

// what pair_style and pair_coeff hvi/sph say; written by that pair style, read by all

struct SphSettings {
  std::string kernel;    // empty: there was no pair_style hvi/sph yet
  std::string text;      // all of pair_style, for messages and restart files
  double support = 0.0;
  SphLaws laws = {};
  bool variable = false;             // h
  double hmin = 0.5, hmax = 1.25;    // its bounds, in units of the start value
  bool energy = true, density = false, riemann = false;
  enum Gradient { PLAIN, LAW, CORRECTED } gradient = CORRECTED;
  bool whole = false;    // gradient corrected, and there are solids
  MirrorPlanes mirror;
  std::vector<double> h;    // by type, 0: not a particle of this style

  bool is_stock() const { return laws.stock; }

  // Zisis et al. eq 20, dh/dt = -(1/D) (h/rho) drho/dt, integrates to h rho^(1/D) = const:
  // only the constant, hscale, is kept for a particle

  double hscale(int itype, double rho) const;
  double smoothing_length(int itype, double rho, double hscale) const;
};

/* ----------------------------------------------------------------------
   The packed records of SPH particles, in one place.

   record     of                        written by, when                               read by
   place      owned, ghosts, images     pair hvi/sph, before its loop                  loop, its time step
   state      owned, ghosts, images     pair hvi/sph, before its loop                  loop, its time step, pressure()
   stress     owned                     pair, from the fix that integrates it          loop
              ghosts, images            pair, forward communication; reflected
                                        (with traction: p_min and shear only)
   art        owned, ghosts, images     pair, after state and stress; or, with         loop
                                        traction, after that, forward comm., reflected
   slopes     owned, ghosts             first sweep; reverse, then forward comm.       second sweep
   rates      owned, ghosts, images     loop; images folded back to owners             pair: f, drho, desph
   gradv      owned, ghosts, images     loop; images folded, reverse communication     velocity_gradient()

   Solids with gradient corrected (records there are for them only):
   gradv      owned, ghosts, images     first sweep; folded, reverse; then L M^-1      second sweep (riemann),
              owned                     and M^-1 in place of M                         velocity_gradient()
   contact    (the same of other bodies, and of rubble; then see correct_gradient())   find_traction()
   traction,  owned                     pair: p, rho and v before, T from M^-1         second sweep, pressure(),
   push                                 between the sweeps                             density()
              ghosts, images            forward communication; reflected
   rates      drho is written between the sweeps, without pairs

   They hold from a force evaluation to the next exchange of particles, that is: through
   final_integrate and end_of_step, and through the initial_integrate that follows, unless a
   new run needs others.
   Nothing here migrates, nothing is in restart files: what must outlive a
   step is in the arrays of LAMMPS and of fixes.  What a scene has no use for is
   not allocated.
------------------------------------------------------------------------- */

class SphFields {
 public:
  SphSettings settings;    // of the present run

  // for the pair style

  void choose(bool slopes, bool stress, bool art, bool whole,
              bool bodies);           // which records the scene has
  void grow(int n, int spare = 0);    // to hold n of each, if they do not: contents are lost
  const SphView &view() const { return records; }
  std::string arrays() const;    // those of this scene, with bytes per particle: for people
  double bytes_per_particle() const;
  double bytes() const { return nmax * bytes_per_particle(); }

  // of the last forces, for fixes; owned particles, sums over this rank

  double pressure(int i) const;
  double density(int i) const { return traction ? traction[i].rho : state[i].rho; }
  VelocityGradient velocity_gradient(int i) const;
  const double *own_force(int i) const { return &rates[i].fx; }    // solids with gradient corrected
  bool asleep(int i) const { return (std::size_t) i < sleepers.size() && sleepers[i]; }
  // of particles in elements, owned and ghosts: their type, else 0; whether nothing acts on them.  Empty:
  // there are no elements

  std::vector<int> embedded;
  std::vector<char> idle;
  bool is_idle(int i) const { return !idle.empty() && idle[i]; }
  std::vector<char> sleepers;    // owned particles that nothing happens to; empty: there are none
  double viscous_power = 0.0;    // heat of viscosity, of particles that fix hvi/sph integrates
  double plane_force[3] = {0, 0, 0};    // of mirror planes on the particles
  bool along[3] = {true, true,
                   true};    // the directions in which particles extend, laws.dim of them

 private:
  int nmax = 0;
  bool has_slopes = false, has_stress = false, has_art = false, has_whole = false,
       has_bodies = false;
  SphView records;
  std::unique_ptr<SphPlace[]> place;
  std::unique_ptr<SphState[]> state;
  std::unique_ptr<SphRates[]> rates;
  std::unique_ptr<SphSlopes[]> slopes;
  std::unique_ptr<SphStress[]> stress, art;
  std::unique_ptr<SphGradV[]> gradv, contact;
  std::unique_ptr<SphTraction[]> traction;
  std::unique_ptr<SphPush[]> push;
};

}    // namespace HVI

#endif
