#pragma once
// The JSON Schema of a record, properties/record/schema, which the program carries with it.

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace liecheck::reports {

/// Keys in alphabetical order, as liecheck writes them.
using Json = nlohmann::json;

/// The whole schema, with every reference replaced by what it names.
const Json& schema();

/// Throws std::runtime_error, one line, that names the file, the field, what was expected there and what was found.
[[noreturn]] void refuse(std::string_view file, std::string_view field, std::string_view expected, const Json& found);

/// Refuses the first value of a record that does not meet the schema.
void check_schema(std::string_view file, const Json& record);

}  // namespace liecheck::reports
