#include <record/campaign.hpp>

#include <algorithm>
#include <map>
#include <set>
#include <support/environment.hpp>
#include <support/json_number.hpp>

namespace liecheck::properties {

namespace {

using nlohmann::json;

/// What each operation is, and in which frame its result stands.
json operation_of(const std::string& name) {
  static const std::map<std::string, std::pair<const char*, const char*>> table = {
      {"exp3_quaternion",
       {"Q = (sin(theta/2) n, cos(theta/2)) of phi = theta n", "right-handed, angle about n positive"}},
      {"exp3_matrix", {"R = exp [phi]", "right-handed, angle about n positive"}},
      {"log3_quaternion", {"phi of Q/|Q|, |phi| <= pi", "either sign of the axis at pi"}},
      {"log3_matrix", {"phi of the rotation nearest to R, |phi| <= pi", "either sign of the axis at pi"}},
      {"exp6", {"T = exp(rho, phi)", "twist increment in body axes, linear part first"}},
      {"log6", {"(rho, phi) = log(R, p)", "twist increment in body axes, linear part first"}},
      {"integrate", {"q1 = T exp(delta)", "delta in body axes; p in the parent frame"}},
      {"difference", {"delta = log(T0^-1 T1)", "from q0 to q1, in the axes of q0's body"}},
      {"difference_of_integrate", {"difference(q, integrate(q, delta)) against delta", "body axes"}},
      {"integrate_of_difference", {"integrate(q0, difference(q0, q1)) against q1", "parent frame"}},
      {"d_integrate_arg0", {"Ad(exp(-delta))", "nv x nv, tangent spaces in body axes"}},
      {"d_integrate_arg1", {"J_r(delta)", "nv x nv, tangent spaces in body axes"}},
      {"d_difference_arg0", {"-J_l^-1(delta)", "nv x nv, tangent spaces in body axes"}},
      {"d_difference_arg1", {"J_r^-1(delta)", "nv x nv, tangent spaces in body axes"}},
      {"act_motion", {"V_A = X V_B", "from B to A"}},
      {"act_inverse_motion", {"V_B = X^-1 V_A", "from A to B"}},
      {"act_force", {"F_A = X^-T F_B", "from B to A"}},
      {"act_inverse_force", {"F_B = X^T F_A", "from A to B"}},
      {"act_inertia", {"I_A = X^-T I_B X^-1", "from B to A"}},
      {"act_inverse_inertia", {"I_B = X^T I_A X", "from A to B"}},
      {"cross_motion", {"ad_V W", "one frame"}},
      {"cross_force", {"ad_V* F = -ad_V^T F", "one frame"}},
      {"power", {"F_A^T V_A = F_B^T V_B", "both frames"}},
      {"momentum", {"h = I V", "about the body's origin"}},
      {"kinetic_energy", {"T = 1/2 V^T I V", "any frame"}},
      {"compose", {"X_AC = X_AB X_BC", "stored numbers of both"}},
      {"inverse", {"X_BA = (R^T, -R^T p)", "stored numbers"}},
      {"act_point", {"x_A = R x_B + p", "from B to A"}},
      {"rotate_point", {"R(Q/|Q|) x", "from B to A"}},
      {"integrate_coefficient_jacobian",
       {"d integrate(q, delta) / d delta at 0, 7 x 6", "body axes to stored numbers"}}};
  const auto found = table.find(name);
  if (found != table.end())
    return {{"operation", name}, {"definition", found->second.first}, {"frame", found->second.second}};
  const bool left = name.find("left") != std::string::npos,
             inverse = name.find("inverse") != std::string::npos;
  if (name.find("jacobian") != std::string::npos)
    return {{"operation", name},
            {"definition", std::string(left ? "J_l" : "J_r") + (inverse ? "^-1" : "") +
                               (name.find('6') != std::string::npos ? "(rho, phi)" : "(phi)")},
            {"frame", left ? "increments on the left: parent axes" : "increments on the right: body axes"}};
  return {{"operation", name}, {"definition", "see the law"}, {"frame", "joint by joint, body axes"}};
}

/// The table of blocks of docs/measuring.md, as the report prints it.
json blocks() {
  const char* table[][4] = {
      {"rotation", "2 min |Q/|Q| -+ Q_exact|; of a matrix, of its polar factor", "absolute", "rad"},
      {"norm defect", "| |Q|^2 - 1 |", "absolute", "1"},
      {"orthogonality defect", "|R^T R - I|", "absolute", "1"},
      {"rotation vector", "|phi - phi_exact|", "|phi_exact|", "rad"},
      {"translation", "|p - p_exact|", "|p_exact|; integrate, compose: max(|result|, |p0|, |increment|)",
       "m"},
      {"linear", "|rho - rho_exact|", "|rho_exact|; difference: max(|rho|, |p1 - p0|)", "m"},
      {"jacobian", "|J - J_exact| of the 3x3 rotation block", "|J_exact|", "1"},
      {"coupling", "|C - C_exact| of the 3x3 coupling block",
       "|C_exact|; beyond pi max(|C|, |rho| min(1, |J|))", "m"},
      {"jump", "|(y+ - y+_exact) - (y- - y-_exact)| over adjacent inputs", "|y_exact|", "1"},
      {"sign", "how far Q0 . Q1 is below zero", "absolute", "1"},
      {"angular", "|omega - omega_exact| or |n - n_exact|", "|exact|", "rad/s or N m"},
      {"point", "|x - x_exact|", "|x_exact|", "m"},
      {"power", "|F_A^T V_A - F_B^T V_B|", "|f|(|u| + |p||omega|) + (|n| + |p||f|)|omega|", "W"},
      {"energy", "|T - T_exact|; energy_frames: between the two frames",
       "|T_exact|; energy_frames: the law's scale", "J"},
      {"mass", "|m - m_exact|", "m_exact", "kg"},
      {"lever", "|c - c_exact|", "|c_exact|", "m"},
      {"inertia", "|I - I_exact|, Frobenius", "|I_exact|", "kg m^2"},
      {"matrix", "|M - M_exact|, Frobenius, by 3x3 block", "|M_exact| of that block", "kg, kg m, kg m^2"},
      {"rotation rate", "|Q_dot - 1/2 Q (omega, 0)|", "|Q_dot exact|", "1/s"},
      {"R_dot", "|R_dot - R [omega]|", "|R_dot exact|", "1/s"},
      {"translation matrix", "|J_p - R|, Frobenius", "|R|", "1"},
      {"quaternion matrix", "|J_Q - J_Q exact|, Frobenius", "|J_Q exact|", "1"},
      {"zeros", "0 where the structural zeros are zero, else infinite", "absolute", "1"},
      {"continuous", "|(cos, sin) - exact|; difference: |angle - exact|", "absolute; difference: |angle|",
       "rad"},
      {"joint", "|q - exact|", "|exact|", "rad or m"},
      {"same", "0 where Q and -Q compare as one configuration, else a wrong branch", "absolute", "1"}};
  json all = json::array();
  for (const auto& b : table)
    all.push_back({{"block", b[0]}, {"error", b[1]}, {"denominator", b[2]}, {"unit", b[3]}});
  return all;
}

const char* name_of(Axis axis) {
  return axis == Axis::theta ? "theta" : axis == Axis::pi_minus_theta ? "pi_minus_theta" : "none";
}

const char* status_of(const Row& row) {
  return row.failed                   ? "fail"
         : row.unresolved             ? "unresolved"
         : row.ill_posed == row.count ? "ill-posed"
                                      : "pass";
}

/// One output of a series in one band.
json row_record(const Series& series, const Output& o, const Band& b, const Row& row, std::uint64_t seed) {
  const Budget& budget = budget_of(series.subject, o.operation, o.block, b.region);
  const CaseId id = series.id(seed, row.worst_index);
  return {{"subject", series.subject},
          {"scalar", series.scalar},
          {"property", series.property},
          {"operation", o.operation},
          {"block", o.block},
          {"band", b.name},
          {"axis", name_of(b.axis)},
          {"low", b.low},
          {"high", b.high},
          {"count", row.count},
          {"max_eps", row.not_finite > 0 ? json("inf") : number(row.max_error)},
          {"p99_eps", number(std::min(row.errors.quantile(0.99), row.max_error))},
          {"median_eps", number(std::min(row.errors.quantile(0.5), row.max_error))},
          {"max_excess", number(row.max_excess)},
          {"budget", budget.limit},
          {"rule", budget.rule == Rule::forward ? "forward" : "excess"},
          {"reason", budget.reason},
          {"ill_posed", row.ill_posed},
          {"unresolved", row.unresolved},
          {"not_finite", row.not_finite},
          {"wrong_branch", row.wrong_branch},
          {"refused", row.refused},
          {"failed", row.failed},
          {"status", status_of(row)},
          {"worst", {{"id", id.text()}, {"input", series.input(id)}, {"kappa", number(row.worst_kappa)}}}};
}

/// Every row, and the operations in the order in which the rows name them.
std::pair<json, json> rows_and_operations(const CampaignResult& r) {
  json rows = json::array(), operations = json::array();
  std::set<std::string> seen;
  for (const auto& [series, tally] : r.series)
    for (const auto& [cell, row] : tally.rows) {
      const Output& o = series->outputs.at(static_cast<std::size_t>(cell.first));
      const Band& band = series->bands()[static_cast<std::size_t>(cell.second)];
      if (seen.insert(o.operation).second) operations.push_back(operation_of(o.operation));
      rows.push_back(row_record(*series, o, band, row, r.options.seed));
    }
  return {rows, operations};
}

json laws(const CampaignResult& r) {
  json all = json::array();
  std::set<std::string> seen;
  for (const auto& [series, tally] : r.series)
    if (seen.insert(series->property).second)
      all.push_back({{"property", series->property},
                     {"law", series->law},
                     {"equation", series->equation},
                     {"source", series->source}});
  return all;
}

/// Each with the operations of this campaign that it does not offer.
json subjects_record(const CampaignResult& r) {
  struct Offered {
    const Series* series;
    std::set<std::string> operations;
  };
  std::map<std::pair<std::string, std::string>, Offered> subjects;
  std::set<std::string> operations;
  for (const auto& [series, tally] : r.series) {
    for (const Output& o : series->outputs) operations.insert(o.operation);
    Offered& offered = subjects[{series->subject, series->scalar}];
    offered.series = series.get();
    for (const auto& [cell, row] : tally.rows)
      offered.operations.insert(series->outputs.at(static_cast<std::size_t>(cell.first)).operation);
  }
  json all = json::array();
  for (const auto& [key, offered] : subjects) {
    std::vector<std::string> not_offered;
    std::set_difference(operations.begin(), operations.end(), offered.operations.begin(),
                        offered.operations.end(), std::back_inserter(not_offered));
    all.push_back({{"name", key.first},
                   {"version", offered.series->subject_version},
                   {"scalar", key.second},
                   {"eps", offered.series->eps},
                   {"not_offered", not_offered}});
  }
  return all;
}

json counterexamples_record(const Counterexamples& c) {
  json failing = json::array();
  for (const auto& f : c.failing) failing.push_back(f.id);
  return {{"replayed", c.replayed}, {"skipped", c.skipped}, {"failing", failing}};
}

}  // namespace

json record_of(const CampaignResult& r, const Counterexamples& replayed,
               const std::string& earlier_environment) {
  const auto [rows, operations] = rows_and_operations(r);
  return {
      {"version", LIECHECK_VERSION},
      {"generator_version", generator_version},
      {"seed", r.options.seed},
      {"cases", r.options.seconds ? r.total_cases : r.options.cases},
      {"total_cases", r.total_cases},
      {"verdict", r.incomplete ? "incomplete"
                  : r.failed   ? "fail"
                               : "pass"},
      {"counterexamples", counterexamples_record(replayed)},
      {"digest", {{"inputs", r.inputs_digest}, {"results", r.results_digest}}},
      {"robot",
       {{"name", r.robot.name}, {"hash", r.robot.hash}, {"root", r.robot.fixed ? "fixed" : "free-flyer"}}},
      {"environment", earlier_environment.empty() ? environment() : json::parse(earlier_environment)},
      {"subjects", subjects_record(r)},
      {"absent", absent_subjects()},
      {"blocks", blocks()},
      {"operations", operations},
      {"properties", laws(r)},
      {"results", rows}};
}

}  // namespace liecheck::properties
