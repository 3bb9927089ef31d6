#pragma once
// Small sample records: one with only the required fields, one with every section and every documented field.

#include <reports/record.hpp>
#include <string>

namespace liecheck::reports {

/// A row of results, judged by a budget of 4 eps.
inline Json row(const std::string& subject, const std::string& band, double max_eps) {
  return {{"subject", subject},
          {"scalar", "double"},
          {"property", "exp_oracle"},
          {"operation", "exp6"},
          {"block", "translation"},
          {"band", band},
          {"axis", "theta"},
          {"low", 1e-5},
          {"high", 1e-4},
          {"count", 713},
          {"max_eps", max_eps},
          {"p99_eps", 0.1},
          {"median_eps", 0},
          {"max_excess", 0},
          {"budget", 4},
          {"rule", "forward"},
          {"ill_posed", 0},
          {"unresolved", 0},
          {"not_finite", 0},
          {"wrong_branch", 0},
          {"status", max_eps > 4 ? "fail" : "pass"},
          {"worst",
           {{"id", "g1.42.exp_oracle." + subject + ".double.none.7"},
            {"input", {"0x1p-3", "-0x0p+0"}},
            {"kappa", 1.25}}}};
}

/// A record with the required fields and no others.
inline Json record() {
  const auto subject = [](const char* name) {
    return Json{{"name", name},
                {"version", "0.1.0"},
                {"scalar", "double"},
                {"eps", 0x1p-52},
                {"not_offered", {"log6"}}};
  };
  return {
      {"version", "0.1.0"},
      {"generator_version", 1},
      {"seed", 42},
      {"cases", 20000},
      {"verdict", "pass"},
      {"digest", {{"inputs", "ab"}, {"results", "cd"}}},
      {"robot", {{"name", "none"}, {"hash", "0000000000000000"}}},
      {"environment",
       {{"cpu", "c"},
        {"os", "o"},
        {"compiler", "g"},
        {"flags", "-O2"},
        {"fma_contraction", "off"},
        {"libm", "glibc"}}},
      {"subjects", {subject("liecheck"), subject("textbook")}},
      {"absent", {"ceres"}},
      {"blocks", Json::array()},
      {"operations", Json::array()},
      {"properties", Json::array()},
      {"results", {row("liecheck", "theta 1e-5..1e-4", 0.5), row("textbook", "theta 1e-5..1e-4", 2311.5)}}};
}

inline Json swept() {
  return {{"version", "0.1.0"},
          {"verdict", "fail"},
          {"bound", "upper"},
          {"scalar", "float"},
          {"stride", 1},
          {"elapsed", 9.1},
          {"coefficients",
           {{{"name", "d2"},
             {"equation", "2 dd/dx"},
             {"argument", "theta^2"},
             {"kind", "relative"},
             {"evaluated", 1092479462},
             {"constant", 972947456},
             {"max_eps", 21.23865},
             {"max_at", "0x1.38968ap+3"},
             {"max_at_decimal", 9.76837635},
             {"bound_eps", 21.23866},
             {"oracle_bound_eps", 1.5e-8},
             {"square_eps", 0.32},
             {"documented_eps", 20},
             {"reason", "a < b"},
             {"status", "fail"}}}}};
}

inline Json hard_case(const std::string& subject, const std::string& verdict) {
  return {{"name", "zero"},
          {"class", "zero"},
          {"reason", "0/0"},
          {"origin", "docs/measuring.md"},
          {"property", "exp_oracle"},
          {"expression", "phi = 0, 0, 0"},
          {"input", {{"double", Json::array({"0x0p+0"})}}},
          {"cells",
           Json::array({{{"subject", subject},
                         {"scalar", "double"},
                         {"verdict", verdict},
                         {"failed", verdict != "stable"},
                         {"error", verdict == "stable" ? Json(0) : Json("inf")},
                         {"kappa", 0},
                         {"budget", 4},
                         {"rule", "forward"},
                         {"operation", "exp6"},
                         {"block", "translation"},
                         {"band", "0"},
                         {"replay", "liecheck replay raw.exp_oracle." + subject + ".double.none.0x0p+0"}}})}};
}

inline Json cost_row(const std::string& subject, const std::string& scalar, const std::string& operation,
                     Json error, double ns, Json dominated = nullptr) {
  const Json time = {{"median", ns}, {"low", ns}, {"high", ns}, {"repetitions", 25u}};
  const Json block = {{"block", "translation"}, {"measured", 640u},  {"max_eps", 2},
                      {"p99_eps", 1},           {"median_eps", 0.5}, {"not_finite", 0u},
                      {"wrong_branch", 0u},     {"unresolved", 0u},  {"refused", 0u}};
  Json set = {{"set", "mixed"},     {"inputs", 640u},          {"throughput_ns", time},
              {"latency_ns", time}, {"instructions", nullptr}, {"blocks", Json::array({block})}};
  return {{"subject", subject},
          {"version", "1"},
          {"scalar", scalar},
          {"operation", operation},
          {"eps", 0x1p-52},
          {"error", error},
          {"worst_block", "translation"},
          {"dominated_throughput", nullptr},
          {"dominated_latency", dominated},
          {"sets", Json::array({set})}};
}

inline Json cost() {
  Json rows = Json::array();
  for (const char* operation : {"exp6", "log6", "integrate", "difference"}) {
    rows.push_back(cost_row("book", "double", operation, 1e-9, 50));
    rows.push_back(cost_row("fast", "double", operation, 3e-15, 80));
    rows.push_back(cost_row("default", "double", operation, 4e-16, 100));
    rows.push_back(cost_row("library", "double", operation, 5e-16, 300, "default double"));
    rows.push_back(cost_row("nearly", "double", operation, 3e-16, 101));
    rows.push_back(cost_row("default", "quad", operation, 1e-32, 9000));
    rows.push_back(cost_row("breaks", "quad", operation, "inf", 10));
    rows.push_back(cost_row("call", "double", operation, nullptr, 2));
  }
  rows.push_back(cost_row("liecheck@gcc-O2", "double", "exp6", 2e-16, 1));  // fastest, but left out
  rows.push_back(cost_row("one", "double", "exp6", 0, 20000));
  return {{"version", "0.1.0"},
          {"verdict", "pass"},
          {"seed", 42u},
          {"repetitions", 25u},
          {"seconds", 30},
          {"elapsed", 33},
          {"clock", "processor time"},
          {"no_counter", "perf_event_open: none"},
          {"environment",
           {{"cpu", "c<1>"}, {"governor", "g"}, {"os", "o"}, {"compiler", "gcc"}, {"flags", "-O2"}}},
          {"rows", rows}};
}

inline Json point(double error, Json time = nullptr) {
  const Json drift = {{"slope", -2e-9}, {"oscillation", 3e-8}};
  return {{"steps", 16u},        {"tolerance", nullptr},      {"attitude", error},
          {"position", nullptr}, {"angular_velocity", error}, {"linear_velocity", nullptr},
          {"energy", drift},     {"momentum", nullptr},       {"time_ns", time},
          {"diverged", ""}};
}

inline Json scenes() {
  const Json time = {{"median", 100}, {"low", 90}, {"high", 110}, {"repetitions", 7u}};
  const Json series = {{"subject", "liecheck"}, {"version", "1"},
                       {"integrator", "rkmk4"}, {"order", 4u},
                       {"adaptive", false},     {"smallest", 2e-15},
                       {"at_floor", true},      {"points", Json::array({point(1e-2), point(5e-4, time)})}};
  const Json order = {
      {"integrator", "rkmk4"}, {"scalar", "float128"}, {"promised", 4u},         {"exact", false},
      {"observed", 4.003},     {"halvings", 5u},       {"settled", true},        {"first", 0u},
      {"floor", nullptr},      {"steps", {16u, 32u}},  {"errors", {1e-2, "inf"}}};
  const Json scene = {{"scene", "a<b>"},
                      {"what", "swings"},
                      {"duration", 4},
                      {"truth", "pendulum"},
                      {"closed", true},
                      {"disagreement", 0},
                      {"series", Json::array({series})},
                      {"orders", Json::array({order})}};
  const Json pose = {0, 0, -1, 0, 0, 0, 1};
  const Json link = {{"name", "body"},
                     {"centre", {0, 0, -1}},
                     {"half", {1, 1, 1}},
                     {"axes", {1, 0, 0, 0, 1, 0, 0, 0, 1}},
                     {"joints", Json::array()}};
  return {{"version", "0.1.0"},
          {"verdict", "pass"},
          {"elapsed", 20},
          {"wrong_orders", Json::array()},
          {"absent", {"DART"}},
          {"scenes", Json::array({scene})},
          {"peers", Json::array({{{"scene", "a<b>"},
                                  {"peer", "MuJoCo"},
                                  {"integrator", "RK4"},
                                  {"points", 3u},
                                  {"ratio", 0.25},
                                  {"error", 1e-6},
                                  {"ours", "rkmk4"},
                                  {"unmatched", false}}})},
          {"spins", Json::array({{{"integrator", "gauss12"},
                                  {"order", 12u},
                                  {"turns", 1000u},
                                  {"steps_per_turn", 24u},
                                  {"error", 7e-12},
                                  {"limit", 1.4e-12},
                                  {"seconds", 0.5}}})},
          {"flips", Json::array({{{"perturbation", 1e-8},
                                  {"scalar", "double"},
                                  {"integrator", "gauss12"},
                                  {"exact", {34.8, 102.2}},
                                  {"relative", {5e-17, "inf"}},
                                  {"predicted", 1u},
                                  {"horizon", 34.8}}})},
          {"costs", Json::array({{{"scene", "s"},
                                  {"stage", "gravity"},
                                  {"equation", "g"},
                                  {"energy", "conserves"},
                                  {"when", "evaluation"},
                                  {"why", "asked"},
                                  {"nanoseconds", 3.5}}})},
          {"films", Json::array({{{"name", "n"},
                                  {"what", "w"},
                                  {"integrator", "rkmk4"},
                                  {"interval", 0.02},
                                  {"ground", nullptr},
                                  {"links", Json::array({link})},
                                  {"frames", Json::array({Json::array({pose})})}}})}};
}

/// A record with every field that the schema documents.
inline Json full_record() {
  const Json environment = {
      {"cpu", "c"},     {"os", "o"}, {"compiler", "g"}, {"flags", "-O2"}, {"fma_contraction", "off"},
      {"libm", "glibc"}};
  const auto layout = [](const char* name) {
    return Json::array({{{"name", name}, {"size", 6}, {"unit", "m, rad"}, {"frame", "body"}},
                        {{"name", "q"}, {"size", "nq"}, {"unit", "rad"}, {"frame", "joint"}}});
  };
  Json all = record();
  all["total_cases"] = 40000;
  all["counterexamples"] = {{"replayed", 1}, {"skipped", 0}, {"failing", {"g3.1.a.b.double.none.0"}}};
  all["robot"]["root"] = "fixed";
  all["blocks"] = {{{"operation", "exp6"},
                    {"block", "translation"},
                    {"error", "|p - p_exact| of exp"},
                    {"denominator", "|p_exact|"},
                    {"unit", "m"}},
                   {{"operation", "log6"},
                    {"block", "translation"},
                    {"error", "|rho - rho_exact| of log"},
                    {"denominator", "|rho_exact|"},
                    {"unit", "m"}}};
  all["operations"] = {{{"operation", "exp6"},
                        {"definition", "T = exp(xi)"},
                        {"source", "Murray, Li, Sastry 1994, eq. 2.36"},
                        {"frame", "body axes"},
                        {"arguments", layout("xi")},
                        {"results", layout("T")},
                        {"expression", "SE3::exp(xi)"}}};
  all["properties"] = {{{"property", "exp_oracle"},
                        {"law", "exp is exp"},
                        {"equation", "T = exp(xi)"},
                        {"source", "definition"}}};
  for (Json& r : all["results"]) r.update({{"reason", "why"}, {"refused", 0}, {"failed", 0}});
  all["hard_cases"] = {hard_case("liecheck", "refused")};
  all["hard_cases"][0]["place"] = "zero.txt:3";
  all["hard_cases"][0]["cells"][0]["refusal"] = "not a unit quaternion";
  all["sweep"] = swept();
  all["cost"] = cost();
  all["cost"]["rows"] = Json::array({cost_row("liecheck", "double", "exp6", 1e-16, 40)});
  all["cost"]["environment"].update(environment);
  all["cost"]["bands"] = {{{"band", "theta 1"}, {"axis", "theta"}, {"low", 0.1}, {"high", 1}}};
  all["scenes"] = scenes();
  for (Json& p : all["scenes"]["scenes"][0]["series"][0]["points"]) p["momentum"] = p["energy"];
  for (const char* name : {"sweep", "scenes"}) all[name]["environment"] = environment;
  all["scenes"]["films"][0]["links"][0]["joints"] = {{0, 0, 1}};
  return all;
}

}  // namespace liecheck::reports
