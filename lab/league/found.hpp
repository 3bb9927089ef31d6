#pragma once
// The page docs/found.md: defects of released libraries, and the record that it is made from. A person writes of a defect
// `function`, `what`, `operation`, `scalar`, `law`, `input` (as a line of fixtures/hard_cases) and perhaps `known`. The
// others follow: `call` and `program` from the adapter, `got`, which the library returned, and `block`, `lost`, `right`
// and `shows`, which are judged. docs/laboratory.md has all.

#include <league/findings.hpp>
#include <nlohmann/json.hpp>
#include <string>

namespace liecheck::properties::league {

/// Whether a file has a record of defects. Throws std::invalid_argument naming the file if it has no JSON.
bool is_found(const std::string& file);

/// Reads a record of defects. Throws std::invalid_argument naming the file and what is missing.
nlohmann::json read_found(const std::string& file);

/// The library of the record whose `adapter` is `name`, with each defect as the adapter, started as `text`, has it now.
/// Throws std::invalid_argument naming the file, and the defect if its law passes or does not measure it.
nlohmann::json measured_found(const std::string& file, const std::string& name, const std::string& text);

struct FoundAgain {
  nlohmann::json record;
  std::string text;  ///< a line for each library, and for each defect that differs from the record
  bool same = true;  ///< nothing differs
};

/// Measures and judges each defect again, and runs its program, where the list of `trust` has the library in the version of
/// the record; where it does not, judges the numbers of the record. Writes the programs into `folder`. Stops at
/// stop_requested.
FoundAgain found_again(const nlohmann::json& record, const Trust& trust, const std::string& folder);

/// The page, in Markdown.
std::string found_page(const nlohmann::json& record);

}  // namespace liecheck::properties::league
