#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <reports/cost_points.hpp>
#include <reports/field.hpp>
#include <reports/record.hpp>
#include <reports/scenes.hpp>
#include <stdexcept>
#include <string_view>
#include <support/files.hpp>

namespace liecheck::reports {

namespace {

void check_result(const Field& row) {
  row.texts({"subject", "scalar", "property", "operation", "block", "band"});
  row["axis"].one_of({"theta", "pi_minus_theta", "none"});
  for (const char* name : {"low", "high", "budget"}) row[name].number();
  for (const char* name : {"max_eps", "p99_eps", "median_eps", "max_excess"}) row[name].measured();
  const std::uint64_t count = row["count"].count(row["status"].is("empty") ? 0 : 1);
  for (const char* name : {"ill_posed", "unresolved", "not_finite", "wrong_branch"})
    row[name].count(0, count);
  for (const char* name : {"refused", "failed"})  // younger than the other outcomes
    if (row.has(name)) row[name].count(0, count);
  if (row.has("reason")) row["reason"].text();
  row["rule"].one_of({"forward", "excess"});
  row["status"].one_of({"pass", "fail", "unresolved", "ill-posed", "empty"});
  const Field worst = row["worst"];
  if (worst.null()) return;  // a band without a judged case has no worst one
  worst["id"].text();
  worst["input"].each([](const Field& x) { x.text(); });
  if (worst.has("kappa")) worst["kappa"].measured();
}

void check_hard_case(const Field& hard) {
  hard.texts({"name", "class", "reason", "origin", "property", "expression"});
  const Field input = hard["input"];
  hard["cells"].each([&](const Field& cell) {
    cell.texts({"subject", "scalar", "operation", "block", "band", "replay"});
    cell["verdict"].one_of(
        {"stable", "refused", "ill-posed", "unresolved", "inaccurate", "wrong branch", "not finite"});
    cell["rule"].one_of({"forward", "excess"});
    cell["failed"].boolean();
    cell["budget"].number();
    for (const char* name : {"error", "kappa"}) cell[name].measured();
    if (cell.has("refusal")) cell["refusal"].text();
    input[cell.string("scalar").c_str()].each([](const Field& x) { x.text(); });
  });
}

void check_sweep(const Field& sweep) {
  sweep.texts({"version", "scalar"});
  sweep["verdict"].one_of({"pass", "fail", "incomplete"});
  sweep["bound"].one_of({"upper", "lower"});
  sweep["stride"].count(1);
  sweep["elapsed"].number();
  const bool upper = sweep["bound"].is("upper");
  sweep["coefficients"].each([upper](const Field& c) {
    c.texts({"name", "equation", "argument", "max_at", "reason"});
    c["kind"].one_of({"relative", "absolute"});
    c["constant"].count(0, c["evaluated"].count());
    if (upper || !c["bound_eps"].null()) c["bound_eps"].measured();
    c["max_eps"].measured();
    for (const char* name : {"max_at_decimal", "oracle_bound_eps", "square_eps", "documented_eps"})
      c[name].number();
    c["status"].one_of({"pass", "fail", "sampled"});
  });
}

void check_record(const Field& record) {
  record.texts({"version"});
  record["generator_version"].count(1);
  record["seed"].seed();
  record["cases"].count();
  if (record.has("total_cases")) record["total_cases"].count();
  record["verdict"].one_of({"pass", "fail", "incomplete"});
  record["digest"].texts({"inputs", "results"});
  record["environment"].texts({"cpu", "os", "compiler", "flags", "fma_contraction", "libm"});
  if (!record["robot"].null()) record["robot"].texts({"name", "hash"});
  record["subjects"].each([](const Field& subject) {
    subject.texts({"name", "version", "scalar"});
    if (subject["eps"].number() == 0 || subject["eps"].number() >= 1) subject["eps"].refuse("0 < eps < 1");
    subject["not_offered"].each([](const Field& name) { name.text(); });
  });
  record["absent"].each([](const Field& name) { name.text(); });
  record["blocks"].each([](const Field& b) { b.texts({"block", "error", "denominator", "unit"}); });
  record["operations"].each([](const Field& o) { o.texts({"operation", "definition", "frame"}); });
  record["properties"].each([](const Field& p) { p.texts({"property", "law", "equation", "source"}); });
  record["results"].each(check_result);
  if (record.has("hard_cases")) record["hard_cases"].each(check_hard_case);  // younger than the rest
  if (record.has("sweep")) check_sweep(record["sweep"]);                     // younger still
  if (record.has("cost")) check_cost(record["cost"]);
  if (record.has("scenes")) check_scenes(record["scenes"]);
}

/// "line 3, column 14" of a byte, both counted from 1, columns in bytes.
std::string place(std::string_view bytes, std::size_t at) {
  const std::string_view before = bytes.substr(0, at);
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  const auto newline = before.rfind('\n');
  return fmt::format("line {}, column {}", line, newline == before.npos ? at + 1 : at - newline);
}

/// Throws what is wrong with a text that is not JSON, and where: bytes are counted from 1 at both.
class FirstError final : public nlohmann::json_sax<Json> {
 public:
  FirstError(const std::string& file, std::string_view bytes) : file_(file), bytes_(bytes) {}
  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t) override { return true; }
  bool number_unsigned(number_unsigned_t) override { return true; }
  bool number_float(number_float_t, const string_t&) override { return true; }
  bool string(string_t&) override { return true; }
  bool binary(binary_t&) override { return true; }
  bool start_object(std::size_t) override { return true; }
  bool key(string_t&) override { return true; }
  bool end_object() override { return true; }
  bool start_array(std::size_t) override { return true; }
  bool end_array() override { return true; }
  bool parse_error(std::size_t byte, const std::string& token,
                   const nlohmann::detail::exception& e) override {
    constexpr int out_of_range = 406;  // of a double
    if (e.id == out_of_range)
      throw std::runtime_error(fmt::format("{}: {}: a number beyond double: {}", file_,
                                           place(bytes_, byte - std::min(byte, token.size())), token));
    const std::size_t at = byte > 0 ? byte - 1 : 0;
    throw std::runtime_error(
        fmt::format("{}: not JSON: {}: unexpected {}", file_, place(bytes_, at),
                    at < bytes_.size() ? fmt::format("\"{:#04x}\"", static_cast<unsigned char>(bytes_[at]))
                                       : "end of the file"));
  }

 private:
  const std::string& file_;
  std::string_view bytes_;
};

}  // namespace

bool has_worst(const Json& row) {
  return row["worst"].is_object() && row["worst"]["id"] != "";
}

double figure(const Json& value) {
  using Limits = std::numeric_limits<double>;
  if (value.is_number()) return value.get<double>();
  return value == "inf" ? Limits::infinity() : Limits::quiet_NaN();
}

Json read_record(const std::filesystem::path& file) {
  const std::string name = file.string();
  const std::string bytes = properties::read_whole(file);
  Json record = Json::parse(bytes, nullptr, false);
  if (record.is_discarded()) {
    FirstError error(name, bytes);
    Json::sax_parse(bytes, &error);
  }
  check_record(Field(name, "", record));
  return record;
}

Merged merge_records(const std::vector<std::filesystem::path>& files) {
  if (files.empty()) throw std::runtime_error("no record given: a report needs at least one");
  Merged merged;
  std::map<std::vector<std::string>, std::string> seen;
  for (const auto& file : files) {
    Json record = read_record(file);
    for (Json& row : record["results"]) {
      std::vector<std::string> key;
      for (const char* name : {"subject", "scalar", "property", "operation", "block", "band"})
        key.push_back(row[name]);
      const auto [first, fresh] = seen.emplace(key, file.string());
      if (!fresh)
        throw std::runtime_error(fmt::format("{}: field results: row {} is already in {}", file.string(),
                                             fmt::join(key, " / "), first->second));
      merged.results.push_back(std::move(row));
    }
    for (const Json& hard : record.value("hard_cases", Json::array()))
      for (const Json& cell : hard["cells"]) {
        const std::vector<std::string> key = {hard["name"], hard["property"], cell["subject"],
                                              cell["scalar"]};
        const auto [first, fresh] = seen.emplace(key, file.string());
        if (!fresh)
          throw std::runtime_error(fmt::format("{}: field hard_cases: {} is already in {}", file.string(),
                                               fmt::join(key, " / "), first->second));
      }
    record.erase("results");
    merged.records.push_back(std::move(record));
  }
  return merged;
}

}  // namespace liecheck::reports
