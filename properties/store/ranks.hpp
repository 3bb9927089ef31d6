#pragma once
// The ranks of `mpirun -n N liecheck ...`. If mpirun did not start the program, it is rank 0 of 1.

namespace liecheck::properties {

class Ranks {
 public:
  Ranks();   ///< initialises MPI if mpirun started this process
  ~Ranks();  ///< finalises MPI
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;
  int rank() const { return rank_; }
  int size() const { return size_; }
  /// Waits for all ranks and returns the largest of their values.
  int largest(int mine) const;

 private:
  int rank_ = 0, size_ = 1;
  bool started_ = false;
};

}  // namespace liecheck::properties
