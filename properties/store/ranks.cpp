#include <store/ranks.hpp>

#include <cstdlib>
#include <initializer_list>
#include <stdexcept>

#ifdef LIECHECK_MPI
#define OMPI_SKIP_MPICXX 1
#include <mpi.h>
#endif

namespace liecheck::properties {

namespace {

/// The number of processes, from the launcher's environment (Open MPI; MPICH and Slurm). It is 1 without a
/// launcher, and 0 if the launcher does not give the number (PMIx).
int launched_processes() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"})
    if (const char* text = std::getenv(name)) return std::atoi(text);
  return std::getenv("PMIX_RANK") ? 0 : 1;
}

}  // namespace

#ifdef LIECHECK_MPI

Ranks::Ranks() {
  const int launched = launched_processes();
  if (launched == 1) return;
  MPI_Init(nullptr, nullptr);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &size_);
  started_ = true;
  if (size_ == 1 && launched > 1) {
    MPI_Finalize();
    throw std::runtime_error(
        "started by another MPI than the one it was built with: use --shard I/N instead");
  }
}

Ranks::~Ranks() {
  if (started_) MPI_Finalize();
}

int Ranks::largest(int mine) const {
  int all = mine;
  if (size_ > 1) MPI_Allreduce(&mine, &all, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  return all;
}

#else

Ranks::Ranks() {
  if (launched_processes() > 1)
    throw std::runtime_error("started by mpirun, but built without MPI: every process would do all the work");
}
Ranks::~Ranks() = default;
int Ranks::largest(int mine) const {
  return mine;
}

#endif

}  // namespace liecheck::properties
