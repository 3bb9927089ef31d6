#include <hard_cases/shared.hpp>

#include <fmt/format.h>
#include <algorithm>
#include <campaign/robots.hpp>
#include <campaign/selection.hpp>
#include <conventions/reference.hpp>
#include <hard_cases/attempt.hpp>
#include <invariants/arguments.hpp>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <support/json.hpp>
#include <support/json_number.hpp>
#include <support/stop.hpp>

namespace liecheck::properties {

namespace {

using nlohmann::json;
using oracles::Real;

constexpr int digits = 40;

bool is_shared(const Operation& o) {
  return !o.name.starts_with("d_") && !o.name.starts_with("right_") && o.results.size() > 0 &&
         o.results[0]->parts.size() > 0;
}

/// kappa of each operation in one case, the largest of its blocks; below 0 where the oracles have no result.
std::map<std::string_view, double> kappas(const Series& s, const std::vector<double>& x) {
  static const Budget ratio{"", "", "any", Rule::excess, std::numeric_limits<double>::infinity(), ""};
  Limits limits = s.limits();
  for (OutputLimits& l : limits) l.budgets = {&ratio, &ratio};
  std::map<std::string_view, double> all;
  for (const Judged& j : s.measure_by_digits(x, limits, true)) {
    double& kappa = all.try_emplace(s.outputs[j.residual.output].operation, 0).first->second;
    if (leaves_open(j.residual.outcome)) kappa = -1;
    if (kappa >= 0) kappa = std::max(kappa, j.residual.kappa);
  }
  return all;
}

std::vector<std::string> exact_of(const Operation& o, const std::vector<double>& arguments) {
  std::vector<Real> x;
  for (const double number : arguments) x.emplace_back(number);
  std::vector<std::string> text;
  for (const Real& number : conventions::exact_result(o, x)) {
    if (!boost::multiprecision::isfinite(number)) throw oracles::Undecided();
    text.push_back(number == 0 ? "0" : number.str(digits, std::ios_base::scientific));
  }
  return text;
}

json parts_of(const Few<const Layout*, 6>& layouts) {
  json all = json::array();
  for (const Layout* l : layouts)
    for (const Part& p : l->parts) all.push_back({{"name", p.name}, {"size", p.size}, {"unit", p.unit}});
  return all;
}

class Collector {
 public:
  void add(const Series& s, const HardCase& h) {
    const std::vector<double> x = s.parsed(raw_case(s, h));
    const FieldPositions fields(s.fields);
    std::map<std::string_view, double> kappa;
    std::set<const Operation*, ByName> operations;
    for (const Output& o : s.outputs) operations.insert(o.record);
    for (const Operation* o : operations) {
      if (!is_shared(*o) || !fields.has_arguments_of(*o) ||
          !seen_.insert(fmt::format("{} {} {}", h.name, o->name, s.scalar)).second)
        continue;
      if (kappa.empty()) kappa = kappas(s, x);
      try {
        const double k = kappa.contains(o->name) ? kappa.at(o->name) : 0;
        if (k < 0) throw oracles::Undecided();
        std::vector<std::string> input;
        const std::vector<double> arguments = fields.arguments_of(*o, x);
        for (const double number : arguments) input.push_back(hexadecimal_float(number));
        lines_[o].push_back(dumped({{"name", h.name},
                                    {"class", h.hard_class},
                                    {"origin", h.origin},
                                    {"scalar", s.scalar},
                                    {"kappa", number(std::stod(fmt::format("{:.3g}", k)))},
                                    {"input", input},
                                    {"exact", exact_of(*o, arguments)}}));
        names_.insert(h.name);
      } catch (const std::exception&) {  // no rotation, or the oracles disagree
        ++corpus_.unresolved;
      }
    }
  }
  SharedCorpus corpus() {
    for (const auto& [operation, lines] : lines_) {
      json takes = parts_of(operation->arguments);
      Few<const Layout*, 6> results;
      for (const Layout* l : operation->results) results.items[results.count++] = l;
      corpus_.files[std::string(operation->name)] = fmt::format(
          "{{\"format\": 1, \"licence\": \"BSD-3-Clause\", \"operation\": {}, \"definition\": "
          "{},\n\"takes\": {},\n"
          "\"gives\": {},\n\"cases\": [\n{}\n]}}\n",
          dumped(operation->name), dumped(operation->definition), dumped(takes), dumped(parts_of(results)),
          fmt::join(lines, ",\n"));
      corpus_.cases += lines.size();
    }
    corpus_.names = names_.size();
    return std::move(corpus_);
  }

 private:
  struct ByName {
    bool operator()(const Operation* a, const Operation* b) const { return a->name < b->name; }
  };

  SharedCorpus corpus_;
  std::map<const Operation*, std::vector<std::string>, ByName> lines_;
  std::set<std::string> names_, seen_;
};

}  // namespace

SharedCorpus shared_corpus(const std::vector<HardCase>& cases) {
  const auto all = select({{"liecheck"}, {}, {"float", "double"}}, built_in_robot());
  Collector collector;
  for (const HardCase& h : cases)
    for (const auto& s : all) {
      if (stop_requested) return collector.corpus();
      if (concerns(h, *s)) collector.add(*s, h);
    }
  return collector.corpus();
}

}  // namespace liecheck::properties
