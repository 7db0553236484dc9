/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_FIX_HVI_FEM_MESH_H
#define LMP_FIX_HVI_FEM_MESH_H

#include "atom.h"
#include "fix.h"
#include "hvi_element_mechanics.h"
#include "hvi_tag_exchange.h"

#include <string>
#include <unordered_map>
#include <vector>

namespace LAMMPS_NS {

/* ----------------------------------------------------------------------
   The elements of fix hvi/fem: a rank has those whose first nodes it owns, which go along with these to other
   ranks, into restart files and data files.  Where their nodes and embedded particles are, which any rank may own.
------------------------------------------------------------------------- */

class FixHVIFEMMesh : public Fix {
 public:
  using Element = HVI::Element;

  // of an embedded particle: number of its element on this rank, and of its cell in that

  struct Embedded {
    int element, cell;
  };

  std::vector<Element> elements;          // in the order of their IDs
  std::vector<HVI::ElementStep> steps;    // of each
  std::vector<HVI::Node> nodes;      // node list: all that elements of this rank have, each once
  std::vector<Embedded> embedded;    // in the order of elements and cells
  HVITagExchange of_nodes, of_embedded;    // slots: those lists
  HVITagExchange of_paired;                // of embedded particles those that pairs act on
  std::vector<char> node_types;            // by type: whether it is one of nodes
  std::vector<int> valence;    // of owned particles: number of elements they are a node of
  bool wraps = false;          // elements may lie across periodic faces
  bigint total = -1;           // number of elements of all ranks; -1: to be counted

  FixHVIFEMMesh(class LAMMPS *, int, char **);
  ~FixHVIFEMMesh() override;
  void begin();
  void init() override;
  void connect();    // after each exchange of particles

  // Into the node list, factor: of kicks.  At the end of a step the velocity is that, and nothing is predicted.

  void gather_nodes(double factor, bool at_end = false);
  void remove_nodes();    // that no element has any more
  [[noreturn]] void ids_have_changed(tagint) const;

  bool nodal(int i) const { return node_types[atom->type[i]]; }    // a particle that is a node
  int number(std::size_t e, int a) const { return corner[HVI::CORNERS * e + a]; }    // in nodes
  HVI::ElementNodes nodes_of(std::size_t e) const
  {
    HVI::ElementNodes list;
    for (int a = 0; a < HVI::CORNERS; a++) list[a] = &nodes[number(e, a)];
    return list;
  }
  void places(std::size_t e, HVI::Corners &x) const;    // of those, near the first
  const HVI::Cells &cells(std::size_t e) const { return subcells[elements[e].n]; }
  Element &element_of(int k) { return elements[embedded[k].element]; }    // of an embedded particle
  HVI::ElementStep &step_of(int k) { return steps[embedded[k].element]; }
  const HVI::Weights &weights(int k) const    // of corners
  {
    return cells(embedded[k].element)[embedded[k].cell];
  }
  HVI::Motion motion(int k);                    // that an embedded particle has in its element
  HVI::ElementBatch load(std::size_t first);    // of elements from first on
  bool paired(std::size_t first) const;         // pairs act on one of those

  // rows of owned and ghost particles, while the fix sends them

  static constexpr int WIDEST = 4;
  int width = 1;
  std::vector<double> halo;
  int pack_forward_comm(int, int *, double *, int, int *) override;
  void unpack_forward_comm(int, int, double *) override;
  int pack_reverse_comm(int, int, double *) override;
  void unpack_reverse_comm(int, int *, double *) override;

  template <class Visit>
  void each_of(int i, const Visit &visit) const    // those of an owned particle
  {
    for (int e = head[i]; e >= 0; e = next[e])
      if (elements[e].alive()) visit(elements[e]);
  }
  bigint count() const;    // on all ranks
  void check_ids() const;

  // particles that migrate, restart files and data files

  void grow_arrays(int) override;
  void copy_arrays(int, int, int) override;
  void set_arrays(int) override;
  int pack_exchange(int, double *) override;
  int unpack_exchange(int, double *) override;
  int size_restart(int) override;
  int maxsize_restart() override { return maxexchange + 1; }
  int pack_restart(int, double *) override;
  void unpack_restart(int, int) override;
  void read_data_header(char *) override;
  void read_data_section(char *, int, char *, tagint) override;
  bigint read_data_skip_lines(char *) override { return announced; }
  void write_data_header(FILE *, int) override;
  void write_data_section_size(int, int &, int &) override;
  void write_data_section_pack(int, double **) override;
  void write_data_section_keyword(int, FILE *) override;
  void write_data_section(int, FILE *, int, double **, int) override;
  double memory_usage() override;

 private:
  bool begun = false;
  std::vector<int> head;               // of owned particles: its first element, -1: none
  std::vector<int> next;               // by element: the next one of the same particle, -1: none
  std::vector<int> corner;             // by element: numbers of its nodes
  std::vector<HVI::Cells> subcells;    // by n
  std::size_t moved =
      -1;    // element that motion() was asked of before, and what it found of its corners
  HVI::Motion corner_motion[HVI::CORNERS] = {};

  bigint announced = -1;         // number of elements in the header of a data file
  std::int64_t id_before = 0;    // largest ID of elements before a data file
  bigint expected = -1;          // number of elements after it
  std::unordered_map<std::int64_t, std::size_t> by_id;    // while states are read
  std::vector<int> read_head;    // head of particles of a data file, until LAMMPS sets their arrays

  void link();
  void hang(std::vector<int> &heads, int i, const Element &);
  int copy_all(int i, double *buf) const;
};

}    // namespace LAMMPS_NS

#endif
