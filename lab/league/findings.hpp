#pragma once
// Findings: defects of libraries, each confirmed by a program in the library's own language.

#include <league/league.hpp>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace liecheck::properties::league {

struct Confirmed {
  int written = 0;   ///< findings, a file each
  std::string text;  ///< a line for each finding, and for each cell that fails and is no finding, the reason
};

/// What a record may start. Somebody else may have written it, so by default its commands must be those of the list of
/// adapters, and each of its programs one that the listed adapter prints for the same case.
struct Trust {
  std::vector<Entry> adapters;  ///< the list
  std::string file;             ///< of the record, for messages
  bool recorded = false;        ///< run what the record says
};

/// For each operation of a library that fails in the record: writes its program into `folder`, runs it, and if it
/// prints the numbers that the adapter returned, writes FOLDER/LIBRARY_OPERATION.md. A cell of grade A or B is no
/// finding: losing less than four digits may be the library's choice. One function is one finding, in double if
/// that fails, unless it is wrong since another one is (failures/findings.hpp). The repaired forms of the record
/// (league.hpp) run on the same input. Throws std::invalid_argument for a record whose commands are not trusted,
/// before anything is started or written, and std::runtime_error naming a file that cannot be written. Stops at
/// stop_requested.
Confirmed write_findings(const nlohmann::json& record, const Trust& trust, const std::string& folder);

}  // namespace liecheck::properties::league
