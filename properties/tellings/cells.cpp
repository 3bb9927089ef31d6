#include <tellings/cells.hpp>

#include <algorithm>
#include <campaign/cliffs.hpp>
#include <campaign/expected.hpp>
#include <cmath>
#include <failures/blocks.hpp>
#include <failures/description.hpp>
#include <failures/findings.hpp>
#include <invariants/tree_laws.hpp>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <support/json_number.hpp>
#include <tuple>

namespace liecheck::properties::league {

namespace {

using nlohmann::json;

/// One operation in one scalar, of all laws that measure it.
struct Cell {
  struct InBand {
    double worst = 0;  ///< [eps], or [eps kappa] where the excess rule holds
    std::uint64_t cases = 0, bad = 0;
    std::size_t at = 0;  ///< of the band
    const Band* band = nullptr;
  };
  std::map<std::size_t, InBand> bands;
  double worst = -1;  ///< [eps]
  double eps = 0;
  std::uint64_t cases = 0, failed = 0, not_finite = 0, wrong_branch = 0, refused = 0, crashed = 0, other = 0;
  std::string block, cliff, replay;
  std::vector<std::string> input;
  json failure;

  std::uint64_t bad() const { return not_finite + wrong_branch + crashed + other + refused; }
};

const char* name_of(Axis axis) {
  return axis == Axis::theta ? "theta" : axis == Axis::pi_minus_theta ? "pi_minus_theta" : "none";
}

void add(Cell& c, const Series& s, const Rows::Cell& at, const Row& row, std::uint64_t seed,
         const Robot& robot) {
  if (row.failed > 0 && !fails(s, at, row)) return;  // the library documents it
  const auto output = static_cast<std::size_t>(at.first), band = static_cast<std::size_t>(at.second);
  const Band& b = s.bands()[band];
  const double error = s.budget(output, b.region).rule == Rule::forward ? row.max_error : row.max_excess;
  const std::uint64_t other = row.not_repeatable + row.argument_written + row.output_unwritten +
                              row.environment_changed + row.printed;
  c.eps = s.eps;
  c.cases += row.inside(), c.failed += row.failed;
  c.not_finite += row.not_finite, c.wrong_branch += row.wrong_branch, c.refused += row.refused;
  c.crashed += row.crashed, c.other += other;
  Cell::InBand& in = c.bands[band];
  in.band = &b, in.cases += row.judged();
  in.bad += row.not_finite + row.wrong_branch + row.refused + row.crashed + other;
  in.worst = std::max(in.worst, error);
  if (error > c.worst && row.judged() > 0) {
    const CaseId id = s.id(seed, row.worst_index);
    c.worst = error, c.block = s.outputs[output].block;
    c.replay = "liecheck replay " + id.text() + replay_flags(s, robot);
    c.input = s.input(id);
  }
}

/// The first block that fails is the worst one: its case is described in full.
json failure_of(const FailedBlock& f, const CampaignResult& r) {
  const BandOf& b = *f.worst;
  return {{"block", f.block},
          {"what", what_of(f)},
          {"where", where_of(f)},
          {"guess", guess_of(f)},
          {"failed", f.failed},
          {"cases", f.cases},
          {"text", describe_failure(*b.series, r.options.seed, static_cast<int>(b.output),
                                    static_cast<int>(b.band), *b.row, r.robot)}};
}

/// A: no case beyond the limit. B: at most four digits lost. C: at most eight. D: more. F: a result that is not finite,
/// on a wrong branch, or none.
const char* grade_of(const Cell& c) {
  return c.bad() ? "F" : c.failed == 0 ? "A" : c.worst <= 1e4 ? "B" : c.worst <= 1e8 ? "C" : "D";
}

json record_of(const CellKey& key, const Cell& c) {
  json bands = json::array();
  for (const auto& [at, b] : c.bands)
    bands.push_back({{"band", b.band->name},
                     {"axis", name_of(b.band->axis)},
                     {"low", b.band->low},
                     {"high", b.band->high},
                     {"cases", b.cases},
                     {"bad", b.bad},
                     {"eps", number(b.worst)}});
  const double digits = c.bad() ? 0 : std::max(0.0, -std::log10(std::max(1.0, c.worst) * c.eps));
  return {{"operation", key.first},
          {"scalar", key.second},
          {"cases", c.cases},
          {"failed", c.failed},
          {"worst_eps", number(c.worst)},
          {"digits", std::floor(10 * digits) / 10},
          {"block", c.block},
          {"not_finite", c.not_finite},
          {"wrong_branch", c.wrong_branch},
          {"refused", c.refused},
          {"crashed", c.crashed},
          {"other", c.other},
          {"cliff", c.cliff},
          {"ns", 0.0},
          {"grade", grade_of(c)},
          {"input", c.input},
          {"replay", c.replay},
          {"failure", c.failure},
          {"bands", bands}};
}

/// Whether an operation gives torques or accelerations, or derivatives of them, to which a reader may add friction.
bool has_friction(std::string_view operation) {
  for (const char* part : {"rnea", "nonlinear", "aba", "derivative", "power", "momentum_conserved"})
    if (operation.find(part) != operation.npos) return true;
  return false;
}

}  // namespace

CampaignOptions options_of(const std::string& subject, const MeasureOptions& options) {
  CampaignOptions o;
  o.selection.subjects = {subject};
  if (!options.limits.empty())
    o.selection.limits.push_back(std::make_shared<const SubjectLimits>(read_limits(options.limits)));
  o.cases = options.cases, o.seed = options.seed, o.jobs = options.jobs, o.quiet = true;
  return o;
}

std::vector<json> cells_of(const CampaignResult& r, const CellOf& key_of) {
  std::map<CellKey, Cell> cells;
  for (const auto& [series, tally] : r.series) {
    const auto own = [&](std::size_t output) -> Cell* {
      const auto key = key_of(std::string(series->outputs[output].operation), series->scalar);
      return key ? &cells[*key] : nullptr;
    };
    for (const auto& [at, row] : tally.rows)
      if (Cell* c = own(static_cast<std::size_t>(at.first)); c && row.inside() > 0)
        add(*c, *series, at, row, r.options.seed, r.robot);
    for (const Cliff& cliff : cliffs_of(*series, tally))
      if (Cell* c = own(cliff.output); c && c->cliff.empty()) c->cliff = text_of(*series, cliff);
  }
  std::vector<FailedBlock> failed = failed_blocks(r);
  const std::vector<Finding> findings = findings_of(r, failed, {});
  for (const FailedBlock& f : failed)
    if (const auto key = key_of(f.operation, f.scalar); key && cells[*key].failure.is_null())
      cells[*key].failure = failure_of(f, r);
  for (const Finding& finding : findings)
    for (const FailedBlock* f : finding.others)
      if (const auto key = key_of(f->operation, f->scalar); key && f->operation != finding.operation)
        cells[*key].failure["because"] = finding.operation;
  std::vector<json> all;
  for (const auto& [key, cell] : cells) all.push_back(record_of(key, cell));
  return all;
}

std::vector<Told> measure_tellings(const std::string& subject, const Robot& robot,
                                   const MeasureOptions& options) {
  std::vector<Told> all;
  CampaignOptions o = options_of(subject, options);
  o.cases = std::min(o.cases, most_told_cases);
  o.selection.scalars = {"double"};
  for (const std::string& law : property_names())
    if (is_tree_law(law) && law != "tree_invariance")  // which builds trees that no URDF describes
      o.selection.properties.push_back(law);
  for (const Telling& t : tellings(robot)) {
    // A path makes it a robot of the user's, on which the laws of trees are judged.
    const CampaignResult r = run_campaign(o, robot_of(t.urdf, t.name + ".urdf", robot.fixed));
    const CellKey key{"told_" + t.name, "double"};
    const auto cells = cells_of(r, [&](const std::string& operation, const std::string&) {
      return t.dissipates && has_friction(operation) ? std::nullopt : std::optional(key);
    });
    if (!cells.empty()) all.push_back({t, cells.front()});
  }
  return all;
}

}  // namespace liecheck::properties::league
