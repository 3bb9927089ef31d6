#pragma once
// The hard cases as JSON that other programs read, a file for each operation: fixtures/hard_cases/json/README.md.

#include <hard_cases/corpus.hpp>
#include <map>
#include <string>

namespace liecheck::properties {

struct SharedCorpus {
  std::map<std::string, std::string> files;  ///< text by operation
  std::size_t names = 0;                     ///< of hard cases that are in a file
  std::size_t cases = 0;                     ///< lines: operation, scalar and input
  std::size_t unresolved = 0;                ///< left out, because the oracles disagree or have no result
};

/// The cases in float and double of every operation that takes fields of their laws, except those whose results follow
/// from another one: right Jacobians and derivatives. Returns what was done if stop_requested.
SharedCorpus shared_corpus(const std::vector<HardCase>& cases);

}  // namespace liecheck::properties
