#pragma once
// The processes of one `mpirun -n N liecheck ...`; one alone where the program was not started by mpirun or was
// built without MPI.

namespace liecheck::properties {

class Ranks {
 public:
  Ranks();   ///< starts MPI where mpirun started this process
  ~Ranks();  ///< ends it
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;
  int rank() const { return rank_; }
  int size() const { return size_; }
  /// Waits for all ranks; the largest of their numbers.
  int largest(int mine) const;

 private:
  int rank_ = 0, size_ = 1;
  bool started_ = false;
};

}  // namespace liecheck::properties
