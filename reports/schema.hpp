#pragma once
// The JSON Schema of a record (properties/record/schema), which is compiled into the program.

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace liecheck::reports {

/// Keeps keys in alphabetical order, as in the records that liecheck writes.
using Json = nlohmann::json;

/// The whole schema, with every reference replaced by its target.
const Json& schema();

/// Throws std::runtime_error with one line: the file, the field, and what was expected and found there.
[[noreturn]] void refuse(std::string_view file, std::string_view field, std::string_view expected,
                         const Json& found);

/// Refuses the first value of a record that does not satisfy the schema.
void check_schema(std::string_view file, const Json& record);

}  // namespace liecheck::reports
