#pragma once
// Reads records of campaigns and checks every field with the JSON Schema in properties/record/schema. The
// other files of this folder rely on this check.
//
// JSON has no infinity and no NaN: the strings "inf" and "nan" stand for them.

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <string_view>
#include <support/json.hpp>
#include <vector>

namespace liecheck::reports {

/// Keeps keys in alphabetical order, as in the records that liecheck writes.
using Json = nlohmann::json;
using properties::dumped, properties::parsed;

/// The text of a file that embed.cmake compiles into the program: "page.html", "chart.min.js", "record.json".
std::string_view embedded_file(std::string_view name);

/// The kinds of measurement that have a record of their own; each has a member of this name, whose value is 1, and a schema
/// in a file of this name.
inline constexpr const char* measurement_kinds[] = {"environments", "horizons", "rounding"};

/// The whole schema of a campaign's record or of a measurement of this kind, with every reference replaced by its target.
const Json& schema(const std::string& kind = "record");

/// Throws std::runtime_error with one line: the file, the field, and what was expected and found there.
[[noreturn]] void refuse(std::string_view file, std::string_view field, std::string_view expected,
                         const Json& found);

/// Refuses the first value of a record that does not satisfy the schema.
void check_schema(std::string_view file, const Json& record, const std::string& kind = "record");

/// Removes the members that the schema does not know, which later versions may write.
void prune(Json& record, const std::string& kind = "record");

/// Several records. `records` has each record of a campaign without its rows; `results` has the rows of all, in order.
struct Merged {
  std::vector<Json> records;
  std::vector<Json> results;
  std::map<std::string, std::vector<Json>> measurements;  ///< by kind
};

/// Refuses a record that does not satisfy the schema, or whose fields contradict one another.
void check_record(std::string_view file, const Json& record);

/// Reads, checks and concatenates records. Throws std::runtime_error that names file, field and value. Also
/// throws if there is no record of a campaign, if two rows have equal subject, scalar, property, operation, block and band, or if a hard case
/// occurs twice for the same law, subject and scalar.
Merged merge_records(const std::vector<std::filesystem::path>& files);

/// Escapes each text as printable_lines() does, for a page.
void escape_texts(Json& value);

/// The list with this name, or an empty list if the record is older and lacks it.
const Json& list_in(const Json& object, const char* name);

/// Whether a band has a worst case; a band without a judged case has none.
bool has_worst(const Json& row);

/// The number in `value`; for the strings "inf" and "nan", infinity and NaN.
double figure(const Json& value);

/// Different items, in the order in which they came.
template <class T>
class Distinct {
 public:
  void add(const T& item) {
    if (known_.insert(item).second) list_.push_back(item);
  }
  bool empty() const { return list_.empty(); }
  std::size_t size() const { return list_.size(); }
  auto begin() const { return list_.begin(); }
  auto end() const { return list_.end(); }
  operator const std::vector<T>&() const { return list_; }

 private:
  std::set<T> known_;
  std::vector<T> list_;
};

}  // namespace liecheck::reports
