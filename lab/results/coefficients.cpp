#include <fmt/format.h>
#include <algorithm>
#include <bounds/bounds.hpp>
#include <coefficients/sweep.hpp>
#include <record/record.hpp>
#include <results/coefficients.hpp>
#include <support/environment.hpp>
#include <support/json_number.hpp>

namespace liecheck::properties {

using nlohmann::json;

const char* error_kind(const SweptCoefficient& c) {
  return oracles::is_absolute(c.claim->coefficient) ? "absolute" : "relative";
}

const char* status_of(const SweepResult& r, const SweptCoefficient& c) {
  return r.failed(c) ? "fail" : r.upper_bound() ? "pass" : "sampled";
}

json record_of(const SweepResult& r) {
  const auto row = [&](const SweptCoefficient& c) -> json {
    return {{"name", c.claim->name},
            {"equation", c.claim->equation},
            {"argument", c.claim->argument},
            {"kind", error_kind(c)},
            {"evaluated", c.evaluated},
            {"constant", c.constant},
            {"max_eps", number(c.max_eps)},
            {"max_at", fmt::format("{:a}", c.max_at)},
            {"max_at_decimal", c.max_at},
            {"bound_eps", r.upper_bound() ? number(c.bound_eps) : json()},
            {"oracle_bound_eps", c.oracle_bound_eps},
            {"square_eps", c.square_eps},
            {"documented_eps", c.claim->documented_eps},
            {"reason", c.claim->reason},
            {"status", status_of(r, c)}};
  };
  return {{"version", LIECHECK_VERSION},
          {"verdict", verdict_of(r.complete || r.failed(), !r.failed())},
          {"bound", r.upper_bound() ? "upper" : "lower"},
          {"scalar", "float"},
          {"stride", r.stride},
          {"elapsed", r.elapsed},
          {"environment", environment()},
          {"coefficients", list_of(r.coefficients, row)}};
}

json record_of(const std::vector<ProvedBound>& bounds, bool complete, bool failed) {
  const auto row = [](const ProvedBound& b) -> json {
    return {{"operation", b.operation}, {"block", b.block},
            {"inputs", b.inputs},       {"bound_eps", number(b.bound)},
            {"hunted_eps", b.hunted},   {"limit_eps", b.limit},
            {"boxes", b.boxes},         {"widest", b.worst}};
  };
  return {{"version", LIECHECK_VERSION},  {"verdict", verdict_of(complete || failed, !failed)},
          {"scalar", "double"},           {"subject", "liecheck"},
          {"environment", environment()}, {"operations", list_of(bounds, row)}};
}

}  // namespace liecheck::properties
