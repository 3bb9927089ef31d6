#pragma once
// The file of `lab lattice --resume`: one line for each verdict, appended as soon as it is known. After an
// interruption it holds every fault that was judged.

#include <fstream>
#include <lattice/row.hpp>
#include <map>

namespace liecheck::properties {

class VerdictFile {
 public:
  /// Reads the file if it exists, and opens it for appending. Without a name, does nothing. The first line
  /// is the header, which names what the verdicts depend on. A last line without its end is dropped: the
  /// program was killed while writing it. Throws std::runtime_error with file and line for a line that is no
  /// verdict, or for another header.
  VerdictFile(const std::string& name, const std::string& header);

  /// The last verdict on the fault, or null.
  const LatticeRow* find(const std::string& key) const;
  /// Throws std::runtime_error naming the file if it cannot be written.
  void append(const LatticeRow& row);

 private:
  std::string name_;
  std::ofstream file_;
  std::map<std::string, LatticeRow> rows_;
};

}  // namespace liecheck::properties
