/* ----------------------------------------------------------------------
   lammps-hvi, package USER-HVI: hypervelocity impact for LAMMPS

   Copyright (2026) the lammps-hvi developers.  This software is
   distributed under the GNU General Public License, version 2.
   See the LICENSE file in the top-level directory.
------------------------------------------------------------------------- */

// loaded before MPI (LD_PRELOAD): before each collective call all ranks of the communicator tell each other which it is, with
// its root, operation and bytes where these must be equal.  If they differ, or a buffer is missing, the run ends with all of
// them; at the end rank 0 writes how many calls agreed into the file collectives.agreed

#include <mpi.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { TEXT = 64, NONE = -1 };
static long long agreed;

static long long bytes(int count, MPI_Datatype type)
{
  int size;
  PMPI_Type_size(type, &size);
  return (long long) count * size;
}

static void agree(const char *name, long long nbytes, int root, int op, MPI_Comm comm)
{
  int size, me, differ = 0;
  char mine[TEXT] = {0};
  PMPI_Comm_size(comm, &size);
  PMPI_Comm_rank(comm, &me);
  snprintf(mine, TEXT, "%s, %lld bytes, root %d, operation %d", name, nbytes, root, op);
  char *const all = malloc((size_t) size * TEXT);
  PMPI_Allgather(mine, TEXT, MPI_CHAR, all, TEXT, MPI_CHAR, comm);
  for (int p = 0; p < size; p++) differ += strcmp(all + p * TEXT, mine) != 0;
  if (differ && me == 0) {
    for (int p = 0; p < size; p++) fprintf(stderr, "COLLECTIVES DIFFER: rank %d: %s\n", p, all + p * TEXT);
    fflush(stderr);
  }
  if (differ) {
    PMPI_Barrier(comm);    // rank 0 has written
    PMPI_Abort(MPI_COMM_WORLD, 17);
  }
  free(all);
  agreed++;
}

static void must(const void *buffer, long long nbytes, const char *name)
{
  if (buffer || nbytes == 0) return;
  fprintf(stderr, "COLLECTIVES DIFFER: %s of %lld bytes without a buffer\n", name, nbytes);
  PMPI_Abort(MPI_COMM_WORLD, 18);
}

// operations of the user have a number by the order of their making
static int number(MPI_Op op) { return MPI_Op_c2f(op); }

int MPI_Barrier(MPI_Comm comm)
{
  agree("MPI_Barrier", 0, NONE, NONE, comm);
  return PMPI_Barrier(comm);
}

int MPI_Bcast(void *buf, int n, MPI_Datatype t, int root, MPI_Comm comm)
{
  must(buf, bytes(n, t), "MPI_Bcast");
  agree("MPI_Bcast", bytes(n, t), root, NONE, comm);
  return PMPI_Bcast(buf, n, t, root, comm);
}

#define REDUCTION(NAME)                                                                               \
  int MPI_##NAME(const void *send, void *recv, int n, MPI_Datatype t, MPI_Op op, MPI_Comm comm)       \
  {                                                                                                   \
    must(send, bytes(n, t), "MPI_" #NAME);                                                            \
    agree("MPI_" #NAME, bytes(n, t), NONE, number(op), comm);                                         \
    return PMPI_##NAME(send, recv, n, t, op, comm);                                                   \
  }
REDUCTION(Allreduce)
REDUCTION(Scan)
REDUCTION(Exscan)

int MPI_Reduce(const void *send, void *recv, int n, MPI_Datatype t, MPI_Op op, int root, MPI_Comm comm)
{
  must(send, bytes(n, t), "MPI_Reduce");
  agree("MPI_Reduce", bytes(n, t), root, number(op), comm);
  return PMPI_Reduce(send, recv, n, t, op, root, comm);
}

int MPI_Reduce_scatter(const void *send, void *recv, const int *n, MPI_Datatype t, MPI_Op op, MPI_Comm comm)
{
  int size;
  long long sum = 0;
  PMPI_Comm_size(comm, &size);
  for (int p = 0; p < size; p++) sum += bytes(n[p], t);
  agree("MPI_Reduce_scatter", sum, NONE, number(op), comm);
  return PMPI_Reduce_scatter(send, recv, n, t, op, comm);
}

#define FROM_ALL(NAME)                                                                                \
  int MPI_##NAME(const void *send, int ns, MPI_Datatype ts, void *recv, int nr, MPI_Datatype tr,      \
                 MPI_Comm comm)                                                                       \
  {                                                                                                   \
    must(send, bytes(ns, ts), "MPI_" #NAME);                                                          \
    agree("MPI_" #NAME, bytes(nr, tr), NONE, NONE, comm);                                             \
    return PMPI_##NAME(send, ns, ts, recv, nr, tr, comm);                                             \
  }
FROM_ALL(Allgather)
FROM_ALL(Alltoall)

#define ROOTED(NAME)                                                                                  \
  int MPI_##NAME(const void *send, int ns, MPI_Datatype ts, void *recv, int nr, MPI_Datatype tr,      \
                 int root, MPI_Comm comm)                                                             \
  {                                                                                                   \
    agree("MPI_" #NAME, 0, root, NONE, comm);                                                         \
    return PMPI_##NAME(send, ns, ts, recv, nr, tr, root, comm);                                       \
  }
ROOTED(Gather)
ROOTED(Scatter)

int MPI_Allgatherv(const void *send, int ns, MPI_Datatype ts, void *recv, const int *nr, const int *at,
                   MPI_Datatype tr, MPI_Comm comm)
{
  int size, me;
  long long sum = 0;
  PMPI_Comm_size(comm, &size);
  PMPI_Comm_rank(comm, &me);
  for (int p = 0; p < size; p++) sum += bytes(nr[p], tr);
  if (bytes(nr[me], tr) != bytes(ns, ts)) sum = NONE - me;    // what it sends is not what it is said to send
  agree("MPI_Allgatherv", sum, NONE, NONE, comm);
  return PMPI_Allgatherv(send, ns, ts, recv, nr, at, tr, comm);
}

int MPI_Alltoallv(const void *send, const int *ns, const int *sat, MPI_Datatype ts, void *recv, const int *nr,
                  const int *rat, MPI_Datatype tr, MPI_Comm comm)
{
  agree("MPI_Alltoallv", 0, NONE, NONE, comm);
  return PMPI_Alltoallv(send, ns, sat, ts, recv, nr, rat, tr, comm);
}

int MPI_Gatherv(const void *send, int ns, MPI_Datatype ts, void *recv, const int *nr, const int *at,
                MPI_Datatype tr, int root, MPI_Comm comm)
{
  agree("MPI_Gatherv", 0, root, NONE, comm);
  return PMPI_Gatherv(send, ns, ts, recv, nr, at, tr, root, comm);
}

int MPI_Comm_dup(MPI_Comm comm, MPI_Comm *made)
{
  agree("MPI_Comm_dup", 0, NONE, NONE, comm);
  return PMPI_Comm_dup(comm, made);
}

int MPI_Comm_split(MPI_Comm comm, int color, int key, MPI_Comm *made)
{
  agree("MPI_Comm_split", 0, NONE, NONE, comm);
  return PMPI_Comm_split(comm, color, key, made);
}

int MPI_Cart_create(MPI_Comm comm, int n, const int *dims, const int *periods, int reorder, MPI_Comm *made)
{
  agree("MPI_Cart_create", n, NONE, NONE, comm);
  return PMPI_Cart_create(comm, n, dims, periods, reorder, made);
}

int MPI_Finalize(void)
{
  int me;
  PMPI_Comm_rank(MPI_COMM_WORLD, &me);
  agree("MPI_Finalize", 0, NONE, NONE, MPI_COMM_WORLD);
  if (me == 0) {
    FILE *const fp = fopen("collectives.agreed", "w");
    if (fp) {
      fprintf(fp, "%lld\n", agreed);
      fclose(fp);
    }
  }
  return PMPI_Finalize();
}
