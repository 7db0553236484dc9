/* -*- c++ -*- ----------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

#ifndef LMP_HVI_DELIVER_H
#define LMP_HVI_DELIVER_H

#include <mpi.h>
#include <vector>

namespace HVI {

/* ----------------------------------------------------------------------
   sends item[n] to rank[n]; what the others sent to me, in the order of ranks
------------------------------------------------------------------------- */

template <class T>
std::vector<T> deliver(MPI_Comm comm, const std::vector<T> &item, const std::vector<int> &rank)
{
  int nprocs;
  MPI_Comm_size(comm, &nprocs);
  std::vector<int> nsend(nprocs, 0), nrecv(nprocs), send_at(nprocs + 1, 0), recv_at(nprocs + 1, 0);
  for (const int p : rank) nsend[p]++;
  MPI_Alltoall(nsend.data(), 1, MPI_INT, nrecv.data(), 1, MPI_INT, comm);
  for (int p = 0; p < nprocs; p++) {
    send_at[p + 1] = send_at[p] + nsend[p];
    recv_at[p + 1] = recv_at[p] + nrecv[p];
  }

  // one spare element each: no buffer is ever empty

  std::vector<T> send(item.size() + 1), recv(recv_at[nprocs] + 1);
  std::vector<int> next(send_at);
  for (size_t n = 0; n < item.size(); n++) send[next[rank[n]]++] = item[n];

  MPI_Datatype type;
  MPI_Type_contiguous(sizeof(T), MPI_BYTE, &type);
  MPI_Type_commit(&type);
  MPI_Alltoallv(send.data(), nsend.data(), send_at.data(), type, recv.data(), nrecv.data(),
                recv_at.data(), type, comm);
  MPI_Type_free(&type);
  recv.pop_back();
  return recv;
}

}    // namespace HVI

#endif
