#pragma once
// Small sample records: one with only the required fields, one with every section and every documented field.

#include <reports/record.hpp>
#include <string>

#include "../refusal.hpp"

namespace liecheck::reports {

using test::has;

/// A row of results, judged by a budget of 4 eps.
Json row(const std::string& subject, const std::string& band, double max_eps);

/// A record with the required fields and no others.
Json record();

/// A record with every field that the schema documents.
Json full_record();

/// A measurement of a kind of measurement_kinds with every field that its schema documents.
Json measurement(const std::string& kind);

/// A record with another value at a JSON pointer, and without the member at one.
Json with(Json record, const std::string& pointer, const Json& value);
Json without(Json record, const std::string& pointer);
/// Why check_record refuses a record, or check_schema a measurement of another kind; "" if it does not.
std::string refusal_of(const Json& record, const std::string& kind = "record");

// Sections of a record, and rows of them.
Json swept();
Json hard_case(const std::string& subject, const std::string& verdict);
Json cost_row(const std::string& subject, const std::string& scalar, const std::string& operation,
              const Json& error, double ns, const Json& dominated = nullptr);
Json cost();
Json scenes();

}  // namespace liecheck::reports
