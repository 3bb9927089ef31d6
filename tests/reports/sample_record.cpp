#include "sample_record.hpp"

// JSON is parsed from text, because the compiler needs many seconds for initializer lists of JSON.

namespace liecheck::reports {

Json row(const std::string& subject, const std::string& band, double max_eps) {
  Json all = parsed(
      R"json({"axis": "theta", "block": "translation", "budget": 4, "count": 713, "high": 0.0001,
 "ill_posed": 0, "low": 1e-05, "max_excess": 0, "median_eps": 0, "not_finite": 0, "operation": "exp6",
 "p99_eps": 0.1, "property": "exp_oracle", "rule": "forward", "scalar": "double", "unresolved": 0,
 "wrong_branch": 0})json");
  all["subject"] = subject;
  all["band"] = band;
  all["max_eps"] = max_eps;
  all["status"] = max_eps > 4 ? "fail" : "pass";
  all["worst"] = parsed(R"({"input": ["0x1p-3", "-0x0p+0"], "kappa": 1.25})");
  all["worst"]["id"] = "g1.42.exp_oracle." + subject + ".double.none.7";
  return all;
}

Json record() {
  Json all = parsed(
      R"json({"absent": ["ceres"], "blocks": [], "cases": 20000, "digest": {"inputs": "ab", "results": "cd"},
 "environment": {"compiler": "g", "cpu": "c", "flags": "-O2", "fma_contraction": "off", "libm": "glibc",
   "os": "o"},
 "generator_version": 1, "operations": [], "properties": [],
 "robot": {"hash": "0000000000000000", "name": "none"}, "seed": 42,
 "subjects": [{"eps": 2.220446049250313e-16, "name": "liecheck", "not_offered": ["log6"], "scalar": "double",
   "version": "0.1.0"},
  {"eps": 2.220446049250313e-16, "name": "textbook", "not_offered": ["log6"], "scalar": "double",
   "version": "0.1.0"}],
 "verdict": "fail", "version": "0.1.0"})json");
  all["results"] = {row("liecheck", "theta 1e-5..1e-4", 0.5), row("textbook", "theta 1e-5..1e-4", 2311.5)};
  return all;
}

Json with(Json record, const std::string& pointer, const Json& value) {
  record[Json::json_pointer(pointer)] = value;
  return record;
}
Json without(Json record, const std::string& pointer) {
  const Json::json_pointer at(pointer);
  Json& holder = record[at.parent_pointer()];
  holder.is_array() ? holder.erase(std::stoul(at.back())) : void(holder.erase(at.back()));
  return record;
}
std::string refusal_of(const Json& record, const std::string& kind) {
  return test::refusal<std::runtime_error>(
      [&] { kind == "record" ? check_record("r.json", record) : check_schema("r.json", record, kind); });
}

Json bounds() {
  return {{"version", "0.1"},
          {"verdict", "pass"},
          {"scalar", "double"},
          {"subject", "liecheck"},
          {"operations", Json::array({Json{{"operation", "exp6"},
                                           {"block", "translation"},
                                           {"inputs", "every twist"},
                                           {"bound_eps", 14.2},
                                           {"hunted_eps", 3.16},
                                           {"limit_eps", 3.9},
                                           {"boxes", 1000},
                                           {"widest", "theta 3..3.1"}}})}};
}

Json swept() {
  return parsed(R"json({"bound": "upper",
 "coefficients": [{"argument": "theta^2", "bound_eps": 21.23866, "constant": 972947456, "documented_eps": 20,
   "equation": "2 dd/dx", "evaluated": 1092479462, "kind": "relative", "max_at": "0x1.38968ap+3",
   "max_at_decimal": 9.76837635, "max_eps": 21.23865, "name": "d2", "oracle_bound_eps": 1.5e-08,
   "reason": "a < b", "square_eps": 0.32, "status": "fail"}],
 "elapsed": 9.1, "scalar": "float", "stride": 1, "verdict": "fail", "version": "0.1.0"})json");
}

Json hard_case(const std::string& subject, const std::string& verdict) {
  Json cell = parsed(
      R"json({"band": "0", "block": "translation", "budget": 4, "kappa": 0, "operation": "exp6",
 "rule": "forward", "scalar": "double"})json");
  cell["subject"] = subject;
  cell["verdict"] = verdict;
  cell["failed"] = verdict != "stable" && verdict != "unresolved";
  cell["error"] = verdict == "stable" ? Json(0) : Json("inf");
  cell["replay"] = "liecheck replay raw.exp_oracle." + subject + ".double.none.0x0p+0";
  Json all = parsed(
      R"json({"class": "zero", "expression": "phi = 0, 0, 0", "input": {"double": ["0x0p+0"]}, "name": "zero",
 "origin": "docs/measuring.md", "property": "exp_oracle", "reason": "0/0"})json");
  all["cells"].push_back(cell);
  return all;
}

Json cost_row(const std::string& subject, const std::string& scalar, const std::string& operation,
              const Json& error, double ns, const Json& dominated) {
  Json time{{"ns", ns}, {"processes", 20u}};
  for (const char* name : {"ratio", "low", "high"}) time[name] = ns / 25;
  Json all = parsed(R"json({"dominated_throughput": null, "eps": 2.220446049250313e-16,
 "sets": [{"blocks": [{"block": "translation", "max_eps": 2, "measured": 640, "median_eps": 0.5,
     "not_finite": 0, "p99_eps": 1, "refused": 0, "unresolved": 0, "wrong_branch": 0}],
   "inputs": 640, "instructions": null, "set": "mixed"}],
 "version": "1", "worst_block": "translation"})json");
  all["subject"] = subject;
  all["scalar"] = scalar;
  all["operation"] = operation;
  all["error"] = error;
  all["dominated_latency"] = dominated;
  for (const char* name : {"throughput", "latency"}) all["sets"][0][name] = time;
  return all;
}

Json cost() {
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
  rows.push_back(cost_row("liecheck@gcc-O2", "double", "exp6", 2e-16, 1));  // fastest, but not on any front
  rows.push_back(cost_row("one", "double", "exp6", 0, 20000));
  Json all = parsed(R"json({"clock": "processor time", "elapsed": 33,
 "environment": {"compiler": "gcc", "cpu": "c<1>", "flags": "-O2", "governor": "g", "os": "o"},
 "disturbed": 0.01, "no_counter": "perf_event_open: none", "processes": 20, "reference_ns": 25, "repetitions": 2,
 "seconds": 30, "steady": true, "seed": 42, "verdict": "pass",
 "version": "0.1.0"})json");
  all["rows"] = rows;
  return all;
}

Json scenes() {
  const auto point = [](double error, const char* time) {
    Json all = parsed(
        R"json({"diverged": "", "energy": {"oscillation": 3e-08, "slope": -2e-09}, "linear_velocity": null,
 "momentum": null, "position": null, "steps": 16, "tolerance": null})json");
    for (const char* name : {"attitude", "angular_velocity"}) all[name] = error;
    all["time_ns"] = parsed(time);
    return all;
  };
  Json all = parsed(R"json({"absent": ["DART"],
 "costs": [{"energy": "conserves", "equation": "g", "instructions": 12, "nanoseconds": 3.5, "scene": "s", "stage": "gravity",
   "when": "evaluation", "why": "asked"}],
 "elapsed": 20,
 "films": [{"frames": [[[0, 0, -1, 0, 0, 0, 1]]], "ground": null, "integrator": "rkmk4", "interval": 0.02,
   "links": [{"axes": [1, 0, 0, 0, 1, 0, 0, 0, 1], "centre": [0, 0, -1], "half": [1, 1, 1], "joints": [],
     "name": "body"}],
   "name": "n", "what": "w"}],
 "flips": [{"exact": [34.8, 102.2], "horizon": 34.8, "integrator": "gauss12", "perturbation": 1e-08,
   "predicted": 1, "relative": [5e-17, "inf"], "scalar": "double"}],
 "peers": [{"error": 1e-06, "integrator": "RK4", "measure": "attitude", "ours": "rkmk4", "peer": "MuJoCo", "points": 3,
   "behind": 0, "high": 0.27, "low": 0.24, "ratio": 0.25, "scene": "a<b>", "unmatched": false}],
"scenes": [{"closed": true,
   "disagreement": {"angular_velocity": 0, "attitude": 0, "linear_velocity": null, "position": null},
   "duration": 4, "left_out": [{"peer": "ODE", "why": "it has no armature"}],
   "orders": [{"errors": [0.01, "inf"], "exact": false, "first": 0, "floor": null, "halvings": 5,
     "integrator": "rkmk4", "observed": 4.003, "promised": 4, "scalar": "float128", "settled": true,
     "steps": [16, 32]}],
   "scene": "a<b>",
   "series": [{"adaptive": false, "at_floor": true, "integrator": "rkmk4", "order": 4, "points": [],
     "smallest": 2e-15, "subject": "liecheck", "version": "1"}],
   "truth": "pendulum", "what": "swings"}],
 "spins": [{"error": 7e-12, "integrator": "gauss12", "limit": 1.4e-12, "order": 12, "seconds": 0.5,
   "steps_per_turn": 24, "turns": 1000}],
 "verdict": "pass", "version": "0.1.0", "wrong_orders": []})json");
  Json& points = all["scenes"][0]["series"][0]["points"];
  points.push_back(point(1e-2, "null"));
  points.push_back(point(5e-4, R"({"median": 100, "low": 90, "high": 110, "repetitions": 7})"));
  return all;
}

Json full_record() {
  Json all = record();
  const Json environment = all["environment"];
  all["robot"]["root"] = "fixed";
  all.update(parsed(R"json({"total_cases": 40000,
 "counterexamples": {"failing": ["g4.1.a.b.double.none.0"], "replayed": 1, "skipped": 0},
 "findings": [{"operation": "exp6", "subject": "textbook", "text": "1  exp6 (translation): all 15.7 digits lost in double\\n"}],
 "cliffs": [{"band": "theta 1e-8..1e-7", "beside": "moderate angles", "block": "translation", "figure": 3e7,
   "operation": "exp6", "property": "exp_oracle", "reference": 1.5, "scalar": "double", "subject": "textbook",
   "expected": false}],
 "expected": [{"block": "translation", "failed": 3, "inputs": "theta 1e-8..1e-7", "link": "l", "measured": 200,
   "operation": "exp6", "passed": false, "reason": "r", "subject": "textbook"}],
 "blocks": [{"block": "translation", "denominator": "|p_exact|", "error": "|p - p_exact| of exp",
   "operation": "exp6", "unit": "m"},
  {"block": "translation", "denominator": "|rho_exact|", "error": "|rho - rho_exact| of log",
   "operation": "log6", "unit": "m"}],
 "operations": [{"arguments": [{"frame": "body", "name": "xi", "size": 6, "unit": "m, rad"},
    {"frame": "joint", "name": "q", "size": "nq", "unit": "rad"}],
   "definition": "T = exp(xi)", "expression": "SE3::exp(xi)", "frame": "body axes", "operation": "exp6",
   "results": [{"frame": "body", "name": "T", "size": 6, "unit": "m, rad"},
    {"frame": "joint", "name": "q", "size": "nq", "unit": "rad"}],
   "source": "Murray, Li, Sastry 1994, eq. 2.36"},
  {"definition": "log3_matrix of A", "formed_from": ["log3_matrix"], "operation": "log_of_drifted_matrix"}],
 "properties": [{"equation": "T = exp(xi)", "law": "exp is exp", "property": "exp_oracle",
   "source": "definition"}]})json"));
  for (Json& r : all["results"])
    r.update(
        {{"reason", "why"}, {"refused", 0}, {"failed", r["status"] == "fail" ? 5 : 0}, {"unmeasured", 0}});
  all["not_measured"] = parsed(R"json([{"property": "exp_oracle", "scalar": "double", "subject": "liecheck",
 "what": "exp6, jump: measured in 0 of 20000 cases"}])json");
  all["wrong_calls"] = parsed(R"json([{"subject": "liecheck",
 "sentence": "tree_rnea of a chain of joints with two bodies each: number 4 of its result is 1, and 2 is right"}])json");
  for (Json& r : all["results"])
    for (const char* name : {"not_repeatable", "argument_written", "output_unwritten", "outside_domain",
                             "crashed", "environment_changed", "printed"})
      r[name] = 0;
  for (Json& s : all["subjects"])
    s.update({{"profile", "careful"},
              {"limits", "own.limits"},
              {"limits_hash", "0123456789abcdef"},
              {"flags", " --adapter './a b.so'"}});
  all["results"][1]["worst"].update(parsed(
      R"json({"call": "exp6", "numbers": [{"name": "p[2]", "got": "0x1p-3", "expected": "0x1.8p-3"}]})json"));
  all["maps"] =
      parsed(R"json({"angles": [{"axis": "theta", "low": 1e-08}, {"axis": "pi_minus_theta", "low": 0.1}],
 "scales": [1, 100],
 "panels": [{"block": "translation", "errors": [[0.5, "inf"], [2e7, null]], "operation": "exp6",
   "property": "exp_oracle", "scalar": "double", "subject": "textbook"}]})json");
  all["further_findings"] = 2;
  all["hard_cases"] = Json::array({hard_case("liecheck", "refused")});
  all["hard_cases"][0]["place"] = "zero.txt:3";
  all["hard_cases"][0]["cells"][0]["refusal"] = "not a unit quaternion";
  all["hard_cases"][0]["cells"][0]["open"] = false;
  all["sweep"] = swept();
  all["bounds"] = bounds();
  all["cost"] = cost();
  all["cost"]["rows"] = Json::array({cost_row("liecheck", "double", "exp6", 1e-16, 40)});
  Json& row = all["cost"]["rows"][0];  // of an adapter
  Json& set = row["sets"][0];
  row["timed"] = "own types", set["interface"] = set["latency"], set["cycles"] = 900;
  all["cost"]["spread"] = 0.05;
  all["cost"]["environment"].update(environment);
  all["cost"]["bands"] =
      Json::array({Json{{"band", "theta 1"}, {"axis", "theta"}, {"low", 0.1}, {"high", 1}}});
  all["scenes"] = scenes();
  for (Json& p : all["scenes"]["scenes"][0]["series"][0]["points"]) p["momentum"] = p["energy"];
  for (const char* name : {"sweep", "bounds", "scenes"}) all[name]["environment"] = environment;
  all["scenes"]["films"][0]["links"][0]["joints"] = {{0, 0, 1}};
  return all;
}

Json measurement(const std::string& kind) {
  const Json figures = parsed(
      R"json({"checks": 130, "calls": 100, "same_calls": 98, "same_verdicts": 121, "not_judged": 3, "worse": 0,
 "not_finite": 0, "wrong_branch": 0, "refused": 0, "of_limit": 2.05, "digits_lost": 1.04, "block": "translation",
 "worst": "g1.42.exp_oracle.liecheck.double.none.7"})json");
  std::map<std::string, Json> all{
      {"environments", parsed(R"json({"environments": 1, "verdict": "fail", "cases": 60,
 "own": [{"subject": "liecheck", "checks": 130, "right": 130}, {"subject": "<mine>", "checks": 130, "right": 99}],
 "rows": [{"subject": "liecheck", "environment": "up", "what": "every call rounds up",
   "expected": "four times the limits", "operations": [{"operation": "exp6", "scalar": "double"}]},
  {"subject": "<mine>", "environment": "wasm", "what": "by node", "expected": "same",
   "operations": [{"operation": "exp6", "scalar": "double"}, {"operation": "log6", "scalar": "float"}]}],
 "absent": [{"environment": "riscv64", "what": "by qemu", "why": "qemu-riscv64 is not there"}],
 "not_built": [{"subject": "<mine>", "environment": "aarch64", "why": "error: no"}]})json")},
      {"horizons", parsed(R"json({"horizons": 1, "verdict": "fail", "steps": 1000000, "paths": 2,
 "rows": [{"subject": "liecheck", "scalar": "float", "walk": "random", "exponent": 0.51, "low": 0.46,
   "high": 0.56, "status": "pass", "why": "", "points": [{"n": 64, "norm_eps": 1, "attitude_eps": 3},
    {"n": 1000000, "norm_eps": 1.2, "attitude_eps": 200}]},
  {"subject": "mine", "scalar": "float", "walk": "pure", "exponent": "nan", "low": "nan", "high": "nan",
   "status": "fail", "why": "norm beyond 4 eps", "points": [{"n": 64, "norm_eps": "nan", "attitude_eps": "inf"}]}]})json")},
      {"rounding", parsed(R"json({"rounding": 1, "verdict": "measured", "inputs": 64, "samples": 16,
 "rows": [{"subject": "mine", "operation": "exp6", "part": "translation", "band": "theta 1e-5..1e-3",
   "actual_digits": 7.13, "estimated_digits": 15.68, "digits_all_at_random": "nan", "deceives": true},
  {"subject": "mine", "operation": "exp6", "part": "rotation", "band": "theta 1e-5..1e-3", "actual_digits": 15.9,
   "estimated_digits": 15.8, "digits_all_at_random": 15.7, "deceives": false}],
 "lines": [{"share": 0.5, "line": "a.hpp:3", "function": "f"}]})json")}};
  for (Json& row : all["environments"]["rows"]) {
    row["sum"] = figures;
    for (Json& o : row["operations"]) o["figures"] = figures;
  }
  Json& last = all["environments"]["rows"][1];
  last["sum"].update({{"worse", 2}, {"of_limit", "inf"}});
  last["operations"][0]["figures"].update({{"worse", 2}, {"of_limit", "inf"}});
  last["operations"][1]["figures"]["same_calls"] = 100;
  Json one = all.at(kind);
  one.update({{"version", "0.1.0"}, {"seed", 42}, {"environment", record()["environment"]}});
  return one;
}

}  // namespace liecheck::reports
