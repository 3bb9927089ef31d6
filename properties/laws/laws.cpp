#include <invariants/property.hpp>
#include <laws/liecheck_law.hpp>

#include <adapters/liecheck_adapter.h>
#include <fmt/format.h>
#include <adapters/check.hpp>
#include <adapters/subjects.hpp>
#include <campaign/campaign.hpp>
#include <campaign/cliffs.hpp>
#include <campaign/coverage_report.hpp>
#include <campaign/expected.hpp>
#include <campaign/series.hpp>
#include <failures/description.hpp>
#include <generators/shrinks.hpp>
#include <hard_cases/hard_cases.hpp>
#include <map>
#include <mutex>
#include <ostream>
#include <stdexcept>
#include <support/float_environment.hpp>

namespace liecheck::laws {

namespace {

using namespace properties;

/// Throws std::invalid_argument if the library has other conventions than liecheck.
void probe(const liecheck_adapter& library) {
  for (const auto& found : adapters::check(*adapters::linked(library)).findings)
    if (found.named)
      throw std::invalid_argument(
          fmt::format("{} has other conventions than liecheck: {}", library.name, found.sentence));
}

/// The name of the subject that the library is registered as.
const std::string& subject_of(const liecheck_adapter& library) {
  static std::mutex mutex;
  static std::map<const liecheck_adapter*, std::string> registered;
  const std::lock_guard lock(mutex);
  const auto found = registered.find(&library);
  if (found != registered.end()) return found->second;
  const std::string name = adapters::register_adapter(library);
  probe(library);
  return registered[&library] = name;
}

std::vector<std::unique_ptr<Series>> series_of(const liecheck_adapter& library,
                                               const std::vector<std::string>& laws) {
  return select({{subject_of(library)}, laws, {}}, built_in_robot());
}

/// "phi = (0x1p-3, 0x0p+0, 0x0p+0) rad [0.125, 0, 0]", one line for each field.
std::string text_of(const Series& series, const std::vector<double>& x) {
  std::string text = series.scalar;
  auto from = x.begin();
  for (const Field& f : series.fields) {
    std::vector<std::string> exact, decimal;
    for (auto end = from + std::min<std::ptrdiff_t>(f.size, x.end() - from); from != end; ++from)
      exact.push_back(hexadecimal_float(*from)), decimal.push_back(decimal_float(*from, series.format()));
    text += fmt::format("\n  {} = ({}) {}\n    exactly ({})", f.name, fmt::join(decimal, ", "), f.unit,
                        fmt::join(exact, ", "));
  }
  return text;
}

Input input_of(const Series& series, const std::vector<double>& x) {
  return {!series.format().is_float(), x, text_of(series, x)};
}
/// The numbers of an input that a program may have made itself, rounded to the scalar.
std::vector<double> numbers_of(const Series& series, const Input& input) {
  std::vector<double> x;
  for (const double number : input.numbers) x.push_back(series.format().rounded(number));
  return x;
}

std::string in_words(const Series& series, const Judged& j) {
  const Output& o = series.outputs.at(j.residual.output);
  const std::string where =
      fmt::format("{}, block {}, band {}", o.operation, o.block, series.bands()[j.residual.band].name);
  if (j.residual.outcome != Outcome::measured)
    return fmt::format("{}: {}\n", where, outcome_words[static_cast<int>(j.residual.outcome)]);
  const bool excess = j.budget->rule == Rule::excess;
  return fmt::format("{}: error {:.4g} eps, kappa {:.3g}, budget {} {}\n", where, j.residual.error,
                     j.residual.kappa, j.budget->limit, excess ? "eps kappa" : "eps");
}

/// The failures of one series, each output in its worst band.
std::string failures_of(const CampaignResult& campaign, const SeriesResult& of) {
  const Series& series = *of.series;
  std::map<int, std::pair<int, const Row*>> worst;
  for (const auto& [cell, row] : of.tally.rows) {
    if (!fails(series, cell, row)) continue;
    auto& w = worst[cell.first];
    if (!w.second || row.worst_score > w.second->worst_score) w = {cell.second, &row};
  }
  std::string text;
  for (const auto& [output, at] : worst)
    text += describe_failure(series, campaign.options.seed, output, at.first, *at.second, campaign.robot);
  for (const Cliff& c : cliffs_of(series, of.tally))
    if (!c.expected) text += fmt::format("cliff: {} in {}\n", text_of(series, c), series.scalar);
  for (const std::uint64_t index : of.tally.disagreed)
    text += fmt::format("ORACLES DISAGREE: {}\n", series.id(campaign.options.seed, index).text());
  for (const std::string& line : not_measured(series, of.tally))
    text += fmt::format("not measured in {}: {}\n", series.scalar, line);
  return text;
}

std::string failures_of(const std::vector<HardRow>& rows) {
  std::string text;
  for (const HardRow& r : rows)
    for (const HardCell& c : r.cells)
      if (c.failed || c.open)
        text +=
            fmt::format("hard case {} in {}: {}\n  {}, block {}, band {}: error {:.4g} eps; input {}\n  {}\n",
                        r.entry->name, c.scalar, name_of(c.verdict), c.operation, c.block, c.band, c.error,
                        r.entry->input, r.entry->reason);
  return text;
}

}  // namespace

struct Law::State {
  std::string subject, law;
  std::vector<std::unique_ptr<Series>> series;  ///< one for each scalar

  const Series& in(bool is_double) const {
    for (const auto& s : series)
      if ((s->scalar == "double") == is_double) return *s;
    return *series.front();
  }
};

std::ostream& operator<<(std::ostream& out, const Input& input) {
  return out << input.text;
}

std::vector<std::string> names() {
  return property_names();
}
std::vector<std::string> offered(const liecheck_adapter& library) {
  std::vector<std::string> names;
  for (const auto& s : series_of(library, {}))
    if (std::find(names.begin(), names.end(), s->property) == names.end()) names.push_back(s->property);
  return names;
}

Law::Law(const liecheck_adapter& library, const std::string& name) : state_(new State) {
  require_usual_arithmetic();
  state_->subject = subject_of(library), state_->law = name;
  state_->series = series_of(library, {name});
  if (state_->series.empty())
    throw std::invalid_argument(fmt::format("{} offers no operation of the law {}", library.name, name));
}
Law::~Law() = default;

Input Law::generate(const std::uint64_t (&bits)[4]) const {
  const Series& s = state_->in(bits[3] & 1);
  Source source({bits[0], bits[1], bits[2], bits[3]});
  return input_of(s, s.tested_law().generate(source));
}

std::vector<Input> Law::simpler(const Input& input) const {
  const Series& s = state_->in(input.is_double);
  std::vector<Input> all;
  const std::vector<double> x = laws::numbers_of(s, input);
  const auto add = [&](const std::vector<double>& y) {
    if (y != x && s.tested_law().valid(y)) all.push_back(input_of(s, y));
  };
  for (const auto& y : s.tested_law().simpler(x)) add(y);
  std::size_t from = 0;
  for (const Field& f : s.fields) {
    const auto size = static_cast<std::size_t>(f.size);
    const std::vector<double> group(&x[from], &x[from] + size);
    for (const auto& candidate : shrinks::candidates(s.format(), group, f.kind)) {
      if (candidate == group) break;  // later candidates are no simpler
      std::vector<double> y = x;
      std::copy(candidate.begin(), candidate.end(), y.begin() + static_cast<std::ptrdiff_t>(from));
      add(y);
    }
    from += size;
  }
  return all;
}

Judgement Law::judge(const Input& input) const {
  const Series& s = state_->in(input.is_double);
  const auto judged = s.measure_twice(laws::numbers_of(s, input));
  Judgement all{s.bands()[judged.empty() ? 0 : judged.front().residual.band].name, ""};
  for (const Judged& j : judged)
    if (fails(s, j) || leaves_open(j.residual.outcome)) all.failure += in_words(s, j);
  if (!all.failure.empty())
    all.failure = fmt::format("{}: {}\n  {}\n{}", s.property, s.law, s.equation, all.failure);
  return all;
}

std::string Law::campaign(std::uint64_t seed, std::uint64_t cases) const {
  require_usual_arithmetic();
  CampaignOptions options;
  options.selection = {{state_->subject}, {state_->law}, {}};
  options.seed = seed, options.cases = cases, options.quiet = true;
  const CampaignResult campaign = run_campaign(options, built_in_robot());
  std::string text;
  for (const SeriesResult& s : campaign.series) text += failures_of(campaign, s);
  text += failures_of(run_hard_cases(options.selection, campaign.robot));
  if (text.empty() && (campaign.failed || campaign.undecided())) text = "the campaign is not complete\n";
  return text;
}

}  // namespace liecheck::laws
