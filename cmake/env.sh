#!/bin/sh
# Runs a command with the settings that MPI jobs of this package need anywhere: as root, in a container, with more ranks than
# cores, beside each other.   cmake/env.sh mpirun -np 4 build/lmp -in in.file
# What the user has set stays.
if [ "$(id -u)" = 0 ]; then # Open MPI refuses to run as root without both
  export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
  export PRTE_ALLOW_RUN_AS_ROOT=1 PRTE_ALLOW_RUN_AS_ROOT_CONFIRM=1
fi
# more ranks than cores; give the core away while waiting; two jobs must not be bound to the same core
export OMPI_MCA_rmaps_base_oversubscribe="${OMPI_MCA_rmaps_base_oversubscribe:-1}"
export PRTE_MCA_rmaps_default_mapping_policy="${PRTE_MCA_rmaps_default_mapping_policy:-:oversubscribe}"
export OMPI_MCA_hwloc_base_binding_policy="${OMPI_MCA_hwloc_base_binding_policy:-none}"
export PRTE_MCA_hwloc_default_binding_policy="${PRTE_MCA_hwloc_default_binding_policy:-none}"
# a rank that waits in a loop for another would take the core from what it waits for: two tests beside each other, eight times slower
export OMPI_MCA_mpi_yield_when_idle="${OMPI_MCA_mpi_yield_when_idle:-1}"
# a quicker start: no search for networks. Not ess_singleton_isolated: programs that start at once then share a folder, and some stop (tests give each its own)
export OMPI_MCA_pml="${OMPI_MCA_pml:-ob1}"
# containers often forbid copies between processes; nothing is launched on another machine
export OMPI_MCA_btl_vader_single_copy_mechanism="${OMPI_MCA_btl_vader_single_copy_mechanism:-none}"
export OMPI_MCA_plm_rsh_agent="${OMPI_MCA_plm_rsh_agent:-false}"
export OMP_NUM_THREADS="${OMP_NUM_THREADS:-1}"
# the sanitizer build: leaks of the MPI library are not ours, and the stock library has no container marks
export ASAN_OPTIONS="${ASAN_OPTIONS:-detect_leaks=0:detect_container_overflow=0:detect_odr_violation=0}"
export UBSAN_OPTIONS="${UBSAN_OPTIONS:-print_stacktrace=1:halt_on_error=1}"
# Open MPI makes its folder of sessions with the first program and removes it with the last: one that starts in between stops with "File exists"
sessions="${TMPDIR:-/tmp}/ompi.$(uname -n | cut -d. -f1).$(id -u)"
mkdir -p -m 700 "$sessions" 2>/dev/null && mkdir -p "$sessions/keep" 2>/dev/null
exec "$@"
