#include <campaign/ranks.hpp>

#include <cstdlib>
#include <stdexcept>

#ifdef LIECHECK_MPI
#define OMPI_SKIP_MPICXX 1
#include <mpi.h>
#endif

namespace liecheck::properties {

namespace {

/// Open MPI, MPICH and Slurm name the number of processes so.
int processes() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"})
    if (const char* text = std::getenv(name)) return std::atoi(text);
  return 1;
}

}  // namespace

#ifdef LIECHECK_MPI

Ranks::Ranks() {
  if (processes() <= 1) return;
  MPI_Init(nullptr, nullptr);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &size_);
}

Ranks::~Ranks() {
  if (size_ > 1) MPI_Finalize();
}

int Ranks::largest(int mine) const {
  int all = mine;
  if (size_ > 1) MPI_Allreduce(&mine, &all, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  return all;
}

#else

Ranks::Ranks() {
  if (processes() > 1)
    throw std::runtime_error("started by mpirun, but built without MPI: every process would do all the work");
}
Ranks::~Ranks() = default;
int Ranks::largest(int mine) const {
  return mine;
}

#endif

}  // namespace liecheck::properties
