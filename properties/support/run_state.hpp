#pragma once
// What a long run has done, in a file from which the same command goes on.

#include <chrono>
#include <nlohmann/json.hpp>
#include <string>
#include <support/file_lock.hpp>

namespace liecheck::properties {

/// The parts of a run and how far each is, in a JSON file that no other program writes meanwhile.
class RunState {
 public:
  /// Reads the file if there is one; "" is no file. `options` is what a run must have in common to go on from it. Throws
  /// std::invalid_argument that names the file if it is of another run, or another program writes it, and
  /// std::runtime_error if it cannot be written.
  RunState(const std::string& file, const nlohmann::json& options);
  /// What was put for this part, or null.
  nlohmann::json get(const std::string& part) const;
  /// Writes the file, unless `later` and the last time was less than ten seconds ago.
  void put(const std::string& part, nlohmann::json value, bool later = false);
  const std::string& file() const { return file_; }

 private:
  std::string file_;
  FileLock lock_;
  nlohmann::json all_;
  std::chrono::steady_clock::time_point written_ = std::chrono::steady_clock::now();
};

}  // namespace liecheck::properties
