#pragma once
// `cost --batches`: times of batches beside the loop over single ones and a copy of memory.

#include <app/command.hpp>

namespace liecheck::properties {

struct BatchFlags {
  std::vector<long> columns;
  unsigned threads = 1;
  double seconds = 0.003;

  /// Adds the flags and returns them.
  std::vector<Flag> add(Arguments& arguments);
};

/// Times the operations, or all if none is named, and prints the table. Returns the exit code.
int run_batches(const BatchFlags& flags, const std::vector<std::string>& operations);

}  // namespace liecheck::properties
