#pragma once
// Reads JSON files, which somebody else may have written.

#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

namespace liecheck::properties {

/// Throws std::runtime_error with the name of the file, and line and column: for text that is not JSON, a number beyond
/// double, a member that is given twice, or lists and objects nested more deeply than deepest_json; read_json also
/// for a file of more than 128 MiB or six million values.
nlohmann::json read_json(const std::string& file);
nlohmann::json json_of(const std::string& file, std::string_view text);

/// Returns f(), which takes members from the JSON of the file. If one is missing or of another type, throws
/// std::invalid_argument: `FILE: is no WHAT: ...`.
template <class F>
auto members_of(const std::string& file, const std::string& what, const F& f) {
  try {
    return f();
  } catch (const nlohmann::json::exception& e) {
    const std::string why = e.what();
    throw std::invalid_argument(file + ": is no " + what + ": " + why.substr(why.find("] ") + 2));
  }
}

}  // namespace liecheck::properties
