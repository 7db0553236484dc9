/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

// loaded before MPI (LD_PRELOAD): how many bytes each rank gets by MPI_Allgatherv and MPI_Alltoallv,
// in a file traffic.RANK of the working folder

#include <mpi.h>
#include <stdio.h>

static long long received;

static void count(const int *number, MPI_Datatype type, MPI_Comm comm)
{
  int size, nprocs;
  PMPI_Type_size(type, &size);
  PMPI_Comm_size(comm, &nprocs);
  for (int p = 0; p < nprocs; p++) received += (long long) number[p] * size;
}

int MPI_Allgatherv(const void *send, int nsend, MPI_Datatype stype, void *recv, const int *nrecv,
                   const int *at, MPI_Datatype rtype, MPI_Comm comm)
{
  count(nrecv, rtype, comm);
  return PMPI_Allgatherv(send, nsend, stype, recv, nrecv, at, rtype, comm);
}

int MPI_Alltoallv(const void *send, const int *nsend, const int *sat, MPI_Datatype stype,
                  void *recv, const int *nrecv, const int *rat, MPI_Datatype rtype, MPI_Comm comm)
{
  count(nrecv, rtype, comm);
  return PMPI_Alltoallv(send, nsend, sat, stype, recv, nrecv, rat, rtype, comm);
}

int MPI_Finalize(void)
{
  int me;
  char name[32];
  PMPI_Comm_rank(MPI_COMM_WORLD, &me);
  snprintf(name, sizeof(name), "traffic.%d", me);
  FILE *const fp = fopen(name, "w");
  if (fp) {
    fprintf(fp, "%lld\n", received);
    fclose(fp);
  }
  return PMPI_Finalize();
}
